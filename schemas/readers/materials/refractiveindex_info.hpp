#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// Reads a data file of the refractiveindex.info database, given as its YAML text, in the format
/// before or after 2018. All items of the list DATA count: non-overlapping tables of n or of k are
/// joined, and overlapping ones must agree. n without k means k = 0. Tables are sorted, rows at the
/// same wavelength averaged, k < 0 set to 0, and interpolated linearly in wavelength. Indices
/// relative to air, according to SPECS or because the file is a glass catalogue's, are converted to
/// vacuum. `notes` lists what was done.
/// Throws InputError with file `name` for any other text, for the nonlinear index n2 and for files
/// without n.
/// Source: M. N. Polyanskiy, Sci. Data 11, 94 (2024), and the database's definition sheet.
MaterialFile read_refractiveindex_info(std::string_view text, const std::string& name);

}  // namespace irido::schemas
