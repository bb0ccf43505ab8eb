#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <utility>

#include "tables/lut/lut_values.hpp"
#include "tests/support/sample_luts.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;

namespace {

std::uint32_t u32_at(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

std::uint64_t u64_at(const std::string& bytes, std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

}  // namespace

TEST_CASE("the bytes of a small ktx2 file are those of the specification", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f16, 3, {1, 2});
    lut.values = {1, 2, 3, 4, 5, 6};
    lut.facts["color_space"] = "rec2020";
    const std::string bytes = files_of(lut, "ktx2").bytes;
    CHECK(bytes.substr(0, 12) == std::string("\xABKTX 20\xBB\r\n\x1A\n"));
    // vkFormat, typeSize, width, height, depth, layers, faces, levels, supercompression
    const std::array<std::uint32_t, 9> fields{97, 2, 2, 1, 0, 0, 1, 1, 0};
    for (std::size_t i = 0; i < fields.size(); ++i) CHECK(u32_at(bytes, 12 + 4 * i) == fields[i]);
    const std::uint32_t descriptor = u32_at(bytes, 48), keys = u32_at(bytes, 56);
    CHECK(descriptor == 80 + 24);
    CHECK(u32_at(bytes, 52) == 4 + 24 + 16 * 4);
    CHECK(keys == descriptor + u32_at(bytes, 52));
    CHECK(u64_at(bytes, 64) == 0);
    CHECK(u64_at(bytes, 72) == 0);
    const std::array<std::uint32_t, 23> words{
        92,
        0,
        2U | 88U << 16U,            // KDF 1.3, block of 24 + 4 * 16 bytes
        1U | 4U << 8U | 1U << 16U,  // RGBSDA, BT.2020, linear
        0,
        8,
        0,  // 1 x 1 texels of 8 bytes
        0xC00F0000U,
        0,
        0xBF800000U,
        0x3F800000U,  // R: bits 0 to 15, signed float
        0xC10F0010U,
        0,
        0xBF800000U,
        0x3F800000U,  // G
        0xC20F0020U,
        0,
        0xBF800000U,
        0x3F800000U,  // B
        0xCF0F0030U,
        0,
        0xBF800000U,
        0x3F800000U};  // alpha
    for (std::size_t i = 0; i < words.size(); ++i)
        CHECK(u32_at(bytes, descriptor + 4 * i) == words[i]);
    CHECK(u32_at(bytes, keys) == 18);
    CHECK(bytes.substr(keys + 4, 18) == std::string("KTXorientation\0rd\0", 18));
    const std::string writer("KTXwriter\0irido ", 16);
    CHECK(bytes.substr(keys + 4 + 20 + 4, writer.size()) == writer);
    CHECK(bytes.find(std::string("irido.metadata\0{", 16)) != std::string::npos);
    const std::uint64_t level = u64_at(bytes, 80);
    CHECK(level % 8 == 0);
    CHECK(u64_at(bytes, 88) == 16);
    CHECK(u64_at(bytes, 96) == 16);
    CHECK(bytes.substr(level) ==
          std::string("\0\x3C\0\x40\0\x42\0\x3C\0\x44\0\x45\0\x46\0\x3C", 16));
}

TEST_CASE("ktx2 levels are aligned, the smallest first", "[tables][lut]") {
    const Lut lut = sample_lut(LutType::f32, 3, {3, 4, 8}, true);
    const std::string bytes = files_of(lut, "ktx2").bytes;
    CHECK(u32_at(bytes, 40) == 3);
    std::uint64_t after = bytes.size();
    for (std::size_t level = 0; level < 3; ++level) {
        const std::uint64_t at = u64_at(bytes, 80 + 24 * level);
        const std::uint64_t length = u64_at(bytes, 88 + 24 * level);
        CHECK(at % 16 == 0);
        CHECK(length == std::uint64_t{16} * (8U >> level) * (4U >> level));
        CHECK(at + length <= after);
        after = at;
    }
}

TEST_CASE("ktx2 primaries are those of the colour space", "[tables][lut]") {
    const std::vector<std::pair<std::string, std::uint32_t>> expected{
        {"srgb", 1}, {"rec2020", 4}, {"xyz", 5}, {"acescg", 7}, {"display-p3", 10}, {"other", 0}};
    Lut lut = sample_lut(LutType::f16, 3, {2});
    for (const auto& [space, primaries] : expected) {
        lut.facts["color_space"] = space;
        const std::string bytes = files_of(lut, "ktx2").bytes;
        CHECK((u32_at(bytes, u32_at(bytes, 48) + 12) >> 8U & 0xFFU) == primaries);
    }
}

TEST_CASE("a third axis is the depth of a texture or its layers", "[tables][lut]") {
    const Lut lut = sample_lut(LutType::f16, 1, {3, 4, 8});
    const std::string depth = files_of(lut, "ktx2").bytes;
    const std::string layers = files_of(lut, "ktx2", {false, true}).bytes;
    CHECK(u32_at(depth, 28) == 3);
    CHECK(u32_at(depth, 32) == 0);
    CHECK(u32_at(layers, 28) == 0);
    CHECK(u32_at(layers, 32) == 3);
    CHECK(depth.find("rdi") != std::string::npos);
    const std::size_t size = std::size_t{2} * 3 * 4 * 8;
    CHECK(depth.substr(depth.size() - size) == layers.substr(layers.size() - size));
    CHECK(depth.substr(depth.size() - size) == value_bytes(lut));
}

TEST_CASE("blocks of three channels lie side by side", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f32, 6, {2, 2});
    for (std::size_t i = 0; i < 24; ++i) lut.values[i] = static_cast<double>(i);
    const std::string bytes = files_of(lut, "ktx2").bytes;
    CHECK(u32_at(bytes, 20) == 4);
    CHECK(bytes.find("\"blocks\":2") != std::string::npos);
    const std::vector<double> expected{0,  1,  2,  1, 6,  7,  8,  1, 3,  4,  5,  1, 9,  10, 11, 1,
                                       12, 13, 14, 1, 18, 19, 20, 1, 15, 16, 17, 1, 21, 22, 23, 1};
    CHECK(values_from_bytes(bytes.substr(u64_at(bytes, 80)), LutType::f32) == expected);
}

TEST_CASE("one sample along a third axis is no depth", "[tables][lut]") {
    const Lut lut = sample_lut(LutType::f16, 1, {1, 4, 8});
    const std::string plain = files_of(lut, "ktx2").bytes;
    CHECK(u32_at(plain, 28) == 0);
    CHECK(u32_at(plain, 32) == 0);
    CHECK(plain.find(std::string("KTXorientation\0rd\0", 18)) != std::string::npos);
    CHECK(find_lut_format("ktx2")->read(plain, "").values == lut.values);
    const std::string layers = files_of(lut, "ktx2", {false, true}).bytes;  // requested
    CHECK(u32_at(layers, 28) == 0);
    CHECK(u32_at(layers, 32) == 1);
}
