#pragma once

#include <cstdint>
#include <string>

#include "tables/records/record_layout.hpp"
#include "tables/records/records.hpp"

namespace irido {

/// NumPy's array format 1.0: a one-dimensional structured array, one field a column, little-endian;
/// numbers are <f8, texts <U of the longest one's bytes, flags |b1.
/// Source: NumPy documentation, numpy.lib.format.
std::string write_npy(const Records& records);

/// What stands before the packed rows (stream/packed_rows.hpp, texts as UTF-32) of an array of that
/// many. Its length is that of an array of 10^19 rows if `is_open`, so that it can be replaced when
/// their number is known.
std::string npy_head(const RecordLayout& layout, std::uint64_t rows, bool is_open);

/// Magic, version (1.0, or 2.0 for a longer header than that can have) and header of an array:
/// `type` and `shape` in Python's spelling, "'<f4'" and "(3, 4)"; with room for `spare` more
/// characters. The array's bytes follow.
std::string npy_header(const std::string& type, const std::string& shape, std::size_t spare = 0);

}  // namespace irido
