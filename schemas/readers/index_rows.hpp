#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// A row of a material table: a wavelength in nm and one or two values.
using IndexRow = std::array<double, 3>;

/// Sorts rows by wavelength and averages rows at the same wavelength. Adds notes about it, which
/// begin with `where`.
void put_in_order(std::vector<IndexRow>& rows, const std::string& where,
                  std::vector<std::string>& notes);

/// Value 1 or 2 of sorted rows as a function of wavelength.
Table column(const std::vector<IndexRow>& rows, std::size_t value);

/// Makes k (value 2) positive for absorption: if k is nowhere positive, the file is taken to mean n
/// - ik, with a note. Throws InputError if both signs occur.
void make_k_positive(std::vector<IndexRow>& rows, const std::string& file,
                     std::vector<std::string>& notes);

/// The material with these n and k, whose ranges may differ. Where k is unknown, its nearest value
/// is used if that is below 1e-4; otherwise the material is undefined there. Notes say which.
/// Throws InputError if the material is defined nowhere.
/// file    the material's name, also in messages
/// n       the index over nm
/// k       the extinction coefficient over nm; if absent, 0
/// notes   notes so far, to which this function adds
/// source  the publication, or ""
MaterialFile material_of(const std::string& file, Dispersion n, std::optional<Table> k,
                         std::vector<std::string> notes, std::string source = "");

/// "1 row", "2 rows".
std::string plural(std::size_t count, const std::string& noun);

/// "400 to 700 nm".
std::string in_words(WavelengthRange range);

}  // namespace irido::schemas
