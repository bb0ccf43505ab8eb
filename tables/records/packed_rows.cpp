#include "tables/records/packed_rows.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "schemas/readers/utf8.hpp"

namespace irido::tables {

namespace {

static_assert(std::endian::native == std::endian::little);

using Type = RecordField::Type;

constexpr std::size_t kCharacterBytes = sizeof(char32_t);

/// Decodes the code point at text[at] and moves `at` past it.
char32_t code_point(const std::string& text, std::size_t& at) {
    const auto point = schemas::next_code_point(text, at);
    if (!point) throw std::invalid_argument("a text must be UTF-8 (got '" + text + "')");
    return *point;
}

void store(char* to, double value, TextCode) {
    std::memcpy(to, &value, sizeof value);
}
void store(char* to, bool flag, TextCode) {
    *to = flag ? 1 : 0;
}
void store(char* to, const std::string& text, TextCode code) {
    if (code == TextCode::utf8) {
        std::memcpy(to, text.data(), text.size());
        return;
    }
    for (std::size_t at = 0; at < text.size(); to += kCharacterBytes) {
        const char32_t point = code_point(text, at);
        std::memcpy(to, &point, kCharacterBytes);
    }
}

/// Whether a column matches its field.
struct IsOf {
    const RecordField& field;

    bool operator()(const Column::Numbers&) const { return field.type == Type::number; }
    bool operator()(const Column::Flags&) const { return field.type == Type::flag; }
    bool operator()(const Column::Texts& texts) const {
        return field.type == Type::text && std::ranges::all_of(texts, [&](const auto& text) {
                   return text.size() <= field.width;
               });
    }
    bool operator()(const Column::CodedNumbers&) const { return field.type == Type::number; }
    bool operator()(const Column::CodedTexts& coded) const { return (*this)(coded.values); }
};

}  // namespace

std::u32string code_points(const std::string& text) {
    std::u32string points;
    for (std::size_t at = 0; at < text.size();) points += code_point(text, at);
    return points;
}

std::size_t packed_bytes(const RecordField& field, TextCode code) {
    if (field.type == Type::number) return sizeof(double);
    if (field.type == Type::flag) return 1;
    return field.width * (code == TextCode::utf32 ? kCharacterBytes : 1);
}

std::size_t packed_bytes(const RecordLayout& layout, TextCode code) {
    std::size_t bytes = 0;
    for (const RecordField& field : layout) bytes += packed_bytes(field, code);
    return bytes;
}

void check_columns(const RecordLayout& layout, const Records& records) {
    if (records.columns.size() != layout.size())
        throw std::logic_error("records have other columns than their layout");
    for (std::size_t c = 0; c < layout.size(); ++c)
        if (records.columns[c].name != layout[c].name ||
            !std::visit(IsOf{layout[c]}, records.columns[c].values))
            throw std::logic_error("column " + records.columns[c].name +
                                   ": of another name or type, or wider than its layout says");
}

std::string packed_rows(const RecordLayout& layout, const Records& records, TextCode code) {
    check_columns(layout, records);
    const std::size_t record_bytes = packed_bytes(layout, code), rows = records.rows();
    std::string out(rows * record_bytes, '\0');
    char* column = out.data();
    for (std::size_t c = 0; c < layout.size(); ++c) {
        std::visit(
            [&](const auto& values) {
                char* to = column;
                for (std::size_t row = 0; row < rows; ++row, to += record_bytes)
                    store(to, values[row], code);
            },
            records.columns[c].values);
        column += packed_bytes(layout[c], code);
    }
    return out;
}

Records unpacked_rows(const RecordLayout& layout, std::string_view bytes) {
    const std::size_t record_bytes = packed_bytes(layout, TextCode::utf8);
    Records records;
    std::size_t offset = 0;
    for (const RecordField& field : layout) {
        const std::size_t width = packed_bytes(field, TextCode::utf8);
        Column::Numbers numbers;
        Column::Texts texts;
        Column::Flags flags;
        for (std::size_t at = offset; at < bytes.size(); at += record_bytes) {
            const std::string_view value = bytes.substr(at, width);
            if (field.type == Type::number) {
                double number = 0;
                std::memcpy(&number, value.data(), sizeof number);
                numbers.push_back(number);
            } else if (field.type == Type::flag) {
                flags.push_back(value.front() != 0);
            } else {
                texts.emplace_back(value.substr(0, value.find('\0')));
            }
        }
        offset += width;
        Column& column = records.columns.emplace_back(Column{field.name, {}});
        if (field.type == Type::number) column.values = std::move(numbers);
        if (field.type == Type::flag) column.values = std::move(flags);
        if (field.type == Type::text) column.values = std::move(texts);
    }
    return records;
}

}  // namespace irido::tables
