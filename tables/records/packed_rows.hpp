#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tables/records/record_layout.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

/// Encoding of strings in a packed row: UTF-8 with one byte, or UTF-32 with four bytes, per unit of
/// the field's width; padded with zeros.
enum class TextCode { utf8, utf32 };

/// Bytes of a field in a packed row: 8 for a number, 1 for a flag.
std::size_t packed_bytes(const RecordField& field, TextCode code);

/// Bytes of a packed row.
std::size_t packed_bytes(const RecordLayout& layout, TextCode code);

/// Consecutive records, their fields in order without padding, little-endian. Throws
/// std::logic_error like check_columns(), and std::invalid_argument if a string for UTF-32 is not
/// valid UTF-8.
std::string packed_rows(const RecordLayout& layout, const Records& records, TextCode code);

/// The records of packed rows in UTF-8.
Records unpacked_rows(const RecordLayout& layout, std::string_view bytes);

/// Throws std::logic_error unless the records have the columns of the layout and fit its widths.
void check_columns(const RecordLayout& layout, const Records& records);

/// The code points of a UTF-8 string. Throws std::invalid_argument for invalid UTF-8.
std::u32string code_points(const std::string& text);

}  // namespace irido::tables
