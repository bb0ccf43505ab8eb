// npy: NumPy's array format, a one-dimensional structured array with one field per column.
// - Little-endian; numbers are <f8, strings <U with the longest one's byte count, flags |b1.
// - A head whose number of rows is still unknown leaves room for 20 digits, so that it can be
// replaced.

#include "tables/records/npy.hpp"

#include <cstdio>

#include "tables/records/packed_rows.hpp"
#include "tables/records/record_format.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kDigits = 20;  // of a 64-bit count

std::string type_name(const RecordField& field) {
    if (field.type == RecordField::Type::number) return "<f8";
    return field.type == RecordField::Type::flag ? "|b1" : "<U" + std::to_string(field.width);
}

/// A name as an ASCII literal in Python.
std::string python_literal(const std::string& name) {
    std::string out = "'";
    for (const char32_t c : code_points(name)) {
        if (c >= 0x20 && c < 0x7F) {
            if (c == U'\'' || c == U'\\') out += '\\';
            out += static_cast<char>(c);
            continue;
        }
        char escaped[11];
        std::snprintf(escaped, sizeof escaped, "\\U%08x", static_cast<unsigned>(c));
        out += escaped;
    }
    return out + "'";
}

std::string head(const RecordLayout& layout, std::uint64_t rows, HeadKind kind) {
    std::string type = "[";
    for (const RecordField& field : with_distinct_names(layout))
        type += "(" + python_literal(field.name) + ", '" + type_name(field) + "'), ";
    const std::string count = std::to_string(rows);
    return npy_header(type + "]", "(" + count + ",)",
                      kind == HeadKind::open ? kDigits - count.size() : 0);
}

std::string rows(const RecordLayout& layout, const Records& records) {
    return packed_rows(layout, records, TextCode::utf32);
}

}  // namespace

extern const RecordFormat record_format_npy{
    .name = "npy",
    .summary = "NumPy structured array with the CSV's names",
    .is_binary = true,
    .separator = "",
    .head = head,
    .rows = rows,
    .tail = ""};

}  // namespace irido::tables
