#pragma once

#include <string>
#include <string_view>

#include "schemas/material_file.hpp"

namespace irido {

/// The material in a data file of the refractiveindex.info database, given as its YAML text.
/// Only the list DATA counts: n from its first item that gives n, k from the first that gives k,
/// n alone with k = 0. Tables are put in order, rows at one wavelength averaged, k < 0 set to 0,
/// and interpolated linearly in the wavelength; `notes` says what was done.
/// Throws InputError with file `name` for a text that is no such file, for the nonlinear index n2
/// and for files without n.
/// Source: M. N. Polyanskiy, Sci. Data 11, 94 (2024), and the database's definition sheet.
MaterialFile read_refractiveindex_info(std::string_view text, const std::string& name);

}  // namespace irido
