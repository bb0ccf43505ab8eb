#include "tables/records/npy.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kAlignment = 64;

}  // namespace

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

}  // namespace irido::tables
