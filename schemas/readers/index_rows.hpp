#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// A row of a table of a file: a wavelength in nm and one or two values.
using IndexRow = std::array<double, 3>;

/// Sorts rows by wavelength and averages those at one wavelength; notes, which begin with `where`,
/// say so.
void put_in_order(std::vector<IndexRow>& rows, const std::string& where,
                  std::vector<std::string>& notes);

/// Values 1 or 2 of rows in order over their wavelengths.
Table column(const std::vector<IndexRow>& rows, std::size_t value);

/// Makes k (value 2) positive where light is absorbed: a k that is nowhere positive is that of
/// n - ik, which a note says. Throws InputError for both signs.
void make_k_positive(std::vector<IndexRow>& rows, const std::string& file,
                     std::vector<std::string>& notes);

/// The material of n and k, whose ranges may differ. Where k is not known it is extended if its
/// nearest value is below 1e-4, else the material is not known there; notes say which. Throws
/// InputError if the material is known nowhere.
/// file    the material's name, also in messages
/// n       the index over nm
/// k       the extinction coefficient over nm; none: 0
/// notes   of the reader
/// source  the publication, or ""
MaterialFile material_of(const std::string& file, Dispersion n, std::optional<Table> k,
                         std::vector<std::string> notes, std::string source = "");

/// "1 row", "2 rows".
std::string plural(std::size_t count, const std::string& noun);

/// "400 to 700 nm".
std::string in_words(WavelengthRange range);

}  // namespace irido::schemas
