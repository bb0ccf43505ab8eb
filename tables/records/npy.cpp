#include "tables/records/npy.hpp"

#include <algorithm>
#include <cstdio>

#include "tables/records/packed_rows.hpp"

namespace irido {

namespace {

constexpr std::size_t kAlignment = 64, kDigits = 20;  // of a count of 64 bits

/// The layout of records that are all there: texts are as wide as the longest one.
struct FieldOf {
    std::string name;

    static std::size_t longest(const Column::Texts& texts) {
        std::size_t length = 1;
        for (const std::string& text : texts) length = std::max(length, text.size());
        return length;
    }
    RecordField operator()(const Column::Numbers&) const {
        return {name, RecordField::Type::number, 0};
    }
    RecordField operator()(const Column::Texts& texts) const {
        return {name, RecordField::Type::text, longest(texts)};
    }
    RecordField operator()(const Column::Flags&) const {
        return {name, RecordField::Type::flag, 0};
    }
    RecordField operator()(const Column::CodedNumbers& v) const { return (*this)(v.values); }
    RecordField operator()(const Column::CodedTexts& v) const { return (*this)(v.values); }
};

std::string type_name(const RecordField& field) {
    if (field.type == RecordField::Type::number) return "<f8";
    return field.type == RecordField::Type::flag ? "|b1" : "<U" + std::to_string(field.width);
}

/// As a Python literal of ASCII.
std::string in_quotes(const std::string& name) {
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

}  // namespace

std::string npy_head(const RecordLayout& layout, std::uint64_t rows, bool is_open) {
    std::string type = "[";
    for (const RecordField& field : layout)
        type += "(" + in_quotes(field.name) + ", '" + type_name(field) + "'), ";
    const std::string count = std::to_string(rows);
    return npy_header(type + "]", "(" + count + ",)", is_open ? kDigits - count.size() : 0);
}

std::string npy_header(const std::string& type, const std::string& shape, std::size_t spare) {
    std::string text = "{'descr': " + type + ", 'fortran_order': False, 'shape': " + shape + ", }";
    const auto padded = [&](std::size_t preamble) {
        const std::size_t least = preamble + text.size() + spare + 1;
        return (least + kAlignment - 1) / kAlignment * kAlignment - preamble;
    };
    const bool is_long = padded(10) > 0xFFFF;
    const std::size_t length_bytes = is_long ? 4 : 2, size = padded(8 + length_bytes);
    text.append(size - 1 - text.size(), ' ');
    text += '\n';
    std::string out("\x93NUMPY", 6);
    out += is_long ? '\2' : '\1';
    out += '\0';
    for (std::size_t i = 0; i < length_bytes; ++i) out += static_cast<char>(size >> (8 * i) & 0xFF);
    return out + text;
}

std::string write_npy(const Records& records) {
    RecordLayout layout;
    for (const Column& column : records.columns)
        layout.push_back(std::visit(FieldOf{column.name}, column.values));
    return npy_head(layout, records.rows(), false) + packed_rows(layout, records, TextCode::utf32);
}

}  // namespace irido
