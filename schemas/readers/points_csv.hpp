#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// The values of one path, one per row: numbers, or strings by their codes.
struct PointsColumn {
    std::string path;
    std::vector<double> numbers;
    std::vector<std::string> texts;    ///< each different one once, in the order of the rows
    std::vector<std::uint32_t> codes;  ///< indices into texts
};

/// A CSV file of combinations (RFC 4180): the header names the paths, each row is one combination.
/// A column all of whose cells are numbers has `numbers`, any other has `texts` and `codes`. A byte
/// order mark and blank lines are skipped, blanks around cells outside of quotes left out; there
/// are no comments. Throws InputError with file `name` and "line:column" for what is no such table,
/// an empty cell and a number that is not finite.
std::vector<PointsColumn> read_points_csv(std::string_view text, const std::string& name);

}  // namespace irido::schemas
