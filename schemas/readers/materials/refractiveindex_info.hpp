#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// The material in a data file of the refractiveindex.info database, given as its YAML text, of
/// before or after 2018. Of the list DATA all items count: tables of n or of k that do not overlap
/// are joined, and what is given twice must agree. n alone has k = 0. Tables are put in order, rows
/// at one wavelength averaged, k < 0 set to 0, and interpolated linearly in the wavelength. What is
/// relative to air, as SPECS says or as glass catalogues are, is converted to vacuum. `notes` says
/// what was done.
/// Throws InputError with file `name` for a text that is no such file, for the nonlinear index n2
/// and for files without n.
/// Source: M. N. Polyanskiy, Sci. Data 11, 94 (2024), and the database's definition sheet.
MaterialFile read_refractiveindex_info(std::string_view text, const std::string& name);

}  // namespace irido::schemas
