#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// The values of one path, one per row: numbers, or strings given by codes.
struct PointsColumn {
    std::string path;
    std::vector<double> numbers;
    std::vector<std::string> texts;    ///< the distinct strings, in order of first appearance
    std::vector<std::uint32_t> codes;  ///< indices into texts

    /// "row 3: must be a number (got 'abc')": the first cell that keeps the column from being one
    /// of numbers; "" if it is.
    std::string problem_as_numbers() const;
};

/// Reads a CSV file of combinations (RFC 4180): the header names the paths, each row is one
/// combination. A column with only numeric cells has `numbers`, any other has `texts` and `codes`.
/// A byte order mark, blank lines and blanks around unquoted cells are skipped; there are no
/// comments. Throws InputError with file `name` and "line:column" for malformed tables, empty cells
/// and non-finite numbers.
std::vector<PointsColumn> read_points_csv(std::string_view text, const std::string& name);

}  // namespace irido::schemas
