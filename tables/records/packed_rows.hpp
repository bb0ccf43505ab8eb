#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tables/records/record_layout.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

/// How texts lie in a packed row: as many bytes as the field is wide, or as many characters of four
/// bytes; zeros follow.
enum class TextCode { utf8, utf32 };

/// Bytes of a field in a packed row: a number has 8, a flag 1.
std::size_t packed_bytes(const RecordField& field, TextCode code);

/// Bytes of a packed row.
std::size_t packed_bytes(const RecordLayout& layout, TextCode code);

/// One record after the other, their fields in order without gaps, little-endian. Throws what
/// check_columns() does, and std::invalid_argument if a text for UTF-32 is not UTF-8.
std::string packed_rows(const RecordLayout& layout, const Records& records, TextCode code);

/// The records of packed rows in UTF-8.
Records unpacked_rows(const RecordLayout& layout, std::string_view bytes);

/// Throws std::logic_error unless the records have the columns of the layout and no longer text.
void check_columns(const RecordLayout& layout, const Records& records);

/// Of a text in UTF-8. Throws std::invalid_argument if it is not.
std::u32string code_points(const std::string& text);

}  // namespace irido::tables
