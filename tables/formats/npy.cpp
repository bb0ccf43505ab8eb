#include "tables/formats/npy.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

namespace irido {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kAlignment = 64, kCharacterBytes = 4;

std::size_t longest(const Column::Texts& texts) {
    std::size_t length = 1;
    for (const std::string& text : texts) length = std::max(length, text.size());
    return length;
}

/// NumPy's name of a column's type and its size in bytes.
struct FieldType {
    std::string name;
    std::size_t bytes;
};

struct TypeOf {
    FieldType operator()(const Column::Numbers&) const { return {"<f8", sizeof(double)}; }
    FieldType operator()(const Column::Texts& v) const {
        return {"<U" + std::to_string(longest(v)), kCharacterBytes * longest(v)};
    }
    FieldType operator()(const Column::Flags&) const { return {"|b1", 1}; }
    FieldType operator()(const Column::CodedNumbers& v) const { return (*this)(v.values); }
    FieldType operator()(const Column::CodedTexts& v) const { return (*this)(v.values); }
};

void store(char* to, double value) {
    std::memcpy(to, &value, sizeof(double));
}
void store(char* to, const std::string& text) {  // ASCII, one code point in four bytes
    for (std::size_t i = 0; i < text.size(); ++i) to[kCharacterBytes * i] = text[i];
}
void store(char* to, bool flag) {
    *to = flag ? 1 : 0;
}

std::string header(const Records& records, const std::vector<FieldType>& types) {
    std::string type = "[";
    for (std::size_t c = 0; c < types.size(); ++c)
        type += "('" + records.columns[c].name + "', '" + types[c].name + "'), ";
    return npy_header(type + "]", "(" + std::to_string(records.rows()) + ",)");
}

}  // namespace

std::string npy_header(const std::string& type, const std::string& shape) {
    std::string text = "{'descr': " + type + ", 'fortran_order': False, 'shape': " + shape + ", }";
    constexpr std::size_t preamble = 10;
    text.append((kAlignment - (preamble + text.size() + 1) % kAlignment) % kAlignment, ' ');
    text += '\n';
    std::string out("\x93NUMPY\x01\x00", 8);
    out += static_cast<char>(text.size() & 0xFF);
    out += static_cast<char>(text.size() >> 8);
    return out + text;
}

std::string write_npy(const Records& records) {
    std::vector<FieldType> types;
    std::size_t record_bytes = 0;
    for (const Column& column : records.columns) {
        types.push_back(std::visit(TypeOf{}, column.values));
        record_bytes += types.back().bytes;
    }
    std::string out = header(records, types);
    std::size_t at = out.size();
    const std::size_t rows = records.rows();
    out.resize(at + rows * record_bytes, '\0');
    for (std::size_t c = 0; c < types.size(); ++c) {
        std::visit(
            [&](const auto& values) {
                char* to = out.data() + at;
                for (std::size_t row = 0; row < rows; ++row, to += record_bytes)
                    store(to, values[row]);
            },
            records.columns[c].values);
        at += types[c].bytes;
    }
    return out;
}

}  // namespace irido
