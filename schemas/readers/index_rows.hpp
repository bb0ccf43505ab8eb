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

/// The material of n and k, which may be known in another range than n. Where it is not known
/// and its nearest value is below 1e-4, that value is held, else the material is not known there: a
/// note says so. Throws InputError if the material is known nowhere.
MaterialFile material_of(const std::string& file, Dispersion n, std::optional<Table> k,
                         std::vector<std::string> notes, std::string source = "");

/// "1 row", "2 rows".
std::string plural(std::size_t count, const std::string& noun);

/// "400 to 700 nm".
std::string in_words(WavelengthRange range);

}  // namespace irido::schemas
