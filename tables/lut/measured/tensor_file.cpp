#include "tables/lut/measured/tensor_file.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace irido::tables {

namespace {

template <class Number>
void append_little(std::string& out, Number value) {
    static_assert(std::endian::native == std::endian::little);
    const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    out.append(bytes.data(), bytes.size());
}

std::size_t aligned(std::size_t offset) {
    return (offset + 7) / 8 * 8;
}

}  // namespace

std::string tensor_file(const std::vector<TensorField>& fields) {
    constexpr std::uint8_t kByteType = 1, kFloatType = 10;
    const std::string magic("tensor_file", 12);  // with its zero byte
    std::size_t offset = magic.size() + 2 + 4;
    for (const TensorField& field : fields)
        offset += 2 + field.name.size() + 2 + 1 + 8 + 8 * field.shape.size();
    std::string head = magic;
    head += '\x01';
    head += '\0';
    append_little(head, static_cast<std::uint32_t>(fields.size()));
    for (const TensorField& field : fields) {
        const bool is_float = !field.numbers.empty();
        offset = aligned(offset);
        append_little(head, static_cast<std::uint16_t>(field.name.size()));
        head += field.name;
        append_little(head, static_cast<std::uint16_t>(field.shape.size()));
        append_little(head, is_float ? kFloatType : kByteType);
        append_little(head, static_cast<std::uint64_t>(offset));
        for (const std::uint64_t count : field.shape) append_little(head, count);
        offset += is_float ? 4 * field.numbers.size() : field.bytes.size();
    }
    std::string bytes = head;
    for (const TensorField& field : fields) {
        bytes.resize(aligned(bytes.size()));
        for (const float number : field.numbers) append_little(bytes, number);
        if (field.numbers.empty())
            bytes.append(reinterpret_cast<const char*>(field.bytes.data()), field.bytes.size());
    }
    return bytes;
}

}  // namespace irido::tables
