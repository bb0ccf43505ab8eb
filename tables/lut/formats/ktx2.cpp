// KTX2: textures for engines and web pages.
// - f16 or f32; 1 channel is R, 2 are RG, 3 are RGBA with alpha = 1 (readers refuse RGB), 4 are
//   RGBA. More are blocks of three channels, each RGBA with alpha = 1, side by side along x; the
//   metadata's key `blocks` gives their number.
// - The last axis is x, the one before it y, with the first sample in row 0. One axis makes a 2D
//   texture of height 1, not a 1D one: WebGL, OpenGL ES and Godot have no 1D textures, and three.js
//   turns one into an image of height 0. A third axis is the depth of a 3D texture or, if
//   requested,
//   the layers of an array (three.js reads only the first layer). With a single sample along it the
//   texture is 2D.
// - Mip levels, if the table has them, are those of 2D textures (three.js uploads none of 3D ones).
//   Level l of a texture of width w has max(1, w >> l) columns, so side-by-side blocks need counts
//   that halve evenly.
// - Zstandard supercompression if requested, one frame per level, always at the same effort. The
//   descriptor's bytesPlane0 stays that of the texels (KTX-Software 5 warns about the 0 that the
//   specification used to require).
// - The metadata is the value of the key `irido.metadata`: UTF-8 JSON without a NUL at the end.
// - The descriptor names the primaries of the colour space. three.js knows only BT.709: it warns of
//   others, and throws when it draws Display P3 unless texture.colorSpace is set to NoColorSpace.
// - Nothing depends on the time or the machine: the same table gives the same bytes.
// Only files as written here can be read back.
// Source: KTX File Format Specification 2.0; Khronos Data Format Specification 1.3.

#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "tables/lut/lut_metadata.hpp"
#include "tables/lut/lut_texels.hpp"
#include "tables/lut/lut_values.hpp"
#include "tables/version.hpp"

namespace irido::tables {

namespace {

constexpr std::string_view kIdentifier("\xABKTX 20\xBB\r\n\x1A\n", 12);
constexpr std::size_t kHeaderBytes = 80, kLevelIndexBytes = 24;
constexpr std::uint32_t kZstandard = 2;
constexpr int kZstandardEffort = 12;
/// A block of at most 128 KiB takes at least 4 bytes.
constexpr std::size_t kZstandardLargestRatio = 1U << 15U, kZstandardBlock = 1U << 17U;
constexpr std::string_view kMetadataKey = "irido.metadata";

/// The header's description of the texels.
struct Texture {
    std::uint32_t vk_format = 0, type_size = 0;
    std::uint32_t width = 0, height = 0, depth = 0, layers = 0, faces = 1, levels = 1, scheme = 0;
    bool operator==(const Texture&) const = default;
};

std::size_t components_of(const Lut& lut) {
    const std::size_t channels = texel_blocks(lut).channels;
    return channels == 3 ? 4 : channels;
}

std::uint32_t vk_format_of(LutType type, std::size_t components) {
    constexpr std::uint32_t r16 = 76, rg16 = 83, rgba16 = 97, r32 = 100, rg32 = 103, rgba32 = 109;
    if (type == LutType::f16) return components == 1 ? r16 : components == 2 ? rg16 : rgba16;
    return components == 1 ? r32 : components == 2 ? rg32 : rgba32;
}

std::uint32_t checked_size(std::size_t size) {
    if (size > std::numeric_limits<std::int32_t>::max())
        throw LutError("a texture cannot be " + std::to_string(size) + " texels wide");
    return static_cast<std::uint32_t>(size);
}

void check_mips_halve(const Lut& lut, const Texture& texture) {
    const std::uint32_t largest = std::max(texture.width, texture.height);
    if (lut.levels() > 31 || (largest >> (lut.levels() - 1)) == 0)
        throw LutError("a texture of " + std::to_string(texture.width) + " x " +
                       std::to_string(texture.height) + " has no " + std::to_string(lut.levels()) +
                       " mip levels");
    const std::size_t blocks = texel_blocks(lut).count;
    for (std::size_t level = 0; level < lut.levels(); ++level)
        if (blocks * lut.axes_of_level(level).back().count() !=
            std::max<std::size_t>(1, texture.width >> level))
            throw LutError("the mip levels of " + std::to_string(blocks) +
                           " blocks side by side need a count along " + lut.axes.back().name +
                           " that can be halved " + std::to_string(lut.levels() - 1) + " times");
}

/// Throws LutError, which names what a texture cannot represent.
Texture texture_of(const Lut& lut, const LutLayout& layout) {
    if (lut.type == LutType::f64) throw LutError("ktx2 holds f16 and f32, not f64");
    const std::vector<LutAxis> axes = lut.axes_of_level(0);
    if (layout.layers && axes.size() != 3)
        throw LutError("array layers need a table of three axes without mip levels");
    if (lut.mips && axes.size() > 2) throw LutError("irido writes no mip levels of 3D textures");
    Texture texture;
    texture.vk_format = vk_format_of(lut.type, components_of(lut));
    texture.type_size = static_cast<std::uint32_t>(bytes_of(lut.type));
    texture.width = checked_size(texel_blocks(lut).count * axes.back().count());
    texture.height = axes.size() > 1 ? checked_size(axes[axes.size() - 2].count()) : 1;
    if (layout.layers)
        texture.layers = checked_size(axes.front().count());
    else if (axes.size() == 3 && axes.front().count() > 1)
        texture.depth = checked_size(axes.front().count());
    texture.levels = static_cast<std::uint32_t>(lut.levels());
    texture.scheme = layout.zstd ? kZstandard : 0;
    if (lut.mips) check_mips_halve(lut, texture);
    return texture;
}

std::size_t texel_bytes(const Lut& lut) {
    return components_of(lut) * bytes_of(lut.type);
}

std::size_t level_bytes(const Lut& lut, std::size_t level) {
    return lut.values_of_level(level) / lut.channels.size() * texel_blocks(lut).count *
           texel_bytes(lut);
}

void append_u32(std::string& out, std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void append_u64(std::string& out, std::uint64_t number) {
    out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void pad(std::string& out, std::size_t alignment) {
    out.append((alignment - out.size() % alignment) % alignment, '\0');
}

/// Code of the Khronos Data Format Specification.
std::size_t primaries_of(const Lut& lut) {
    struct Primaries {
        std::string_view space;
        std::size_t number;
    };
    constexpr std::array known{Primaries{"srgb", 1}, Primaries{"rec2020", 4}, Primaries{"xyz", 5},
                               Primaries{"acescg", 7},  // ACEScc's: AP1. 6 is AP0
                               Primaries{"display-p3", 10}};
    const auto space = lut.facts.find("color_space");
    if (space == lut.facts.end() || !space->is_string()) return 0;
    for (const Primaries& primaries : known)
        if (*space == primaries.space) return primaries.number;
    return 0;
}

std::string descriptor_of(const Lut& lut) {
    constexpr std::size_t fixed = 24, sample = 16, rgb_model = 1, linear = 1, version = 2;
    constexpr std::size_t signed_float = 0xC0, alpha = 15, minus_one = 0xBF800000, one = 0x3F800000;
    const std::size_t components = components_of(lut), bits = 8 * bytes_of(lut.type);
    const std::size_t block = fixed + sample * components;
    std::string out;
    append_u32(out, sizeof(std::uint32_t) + block);
    append_u32(out, 0);
    append_u32(out, version | block << 16U);
    append_u32(out, rgb_model | primaries_of(lut) << 8U | linear << 16U);
    append_u32(out, 0);  // blocks of 1 x 1 x 1 x 1 texels
    append_u32(out, texel_bytes(lut));
    append_u32(out, 0);
    for (std::size_t c = 0; c < components; ++c) {
        const std::size_t channel = signed_float | (c == 3 ? alpha : c);
        append_u32(out, c * bits | (bits - 1) << 16U | channel << 24U);
        append_u32(out, 0);
        append_u32(out, minus_one);
        append_u32(out, one);
    }
    return out;
}

void append_entry(std::string& out, std::string_view key, std::string_view value) {
    append_u32(out, key.size() + 1 + value.size());
    out.append(key).append(1, '\0').append(value);
    pad(out, 4);
}

std::string key_values_of(const Lut& lut, const Texture& texture) {
    using namespace std::string_view_literals;
    nlohmann::json metadata = metadata_of(lut);
    if (texel_blocks(lut).count > 1) metadata["blocks"] = texel_blocks(lut).count;
    std::string out;  // keys sorted by code point
    append_entry(out, "KTXorientation", texture.depth > 0 ? "rdi\0"sv : "rd\0"sv);
    append_entry(out, "KTXwriter", "irido " + this_build().version + '\0');
    append_entry(out, kMetadataKey, metadata_text(metadata));
    return out;
}

std::string compressed(const std::string& bytes) {
    std::string out(ZSTD_compressBound(bytes.size()), '\0');
    const std::size_t size =
        ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kZstandardEffort);
    if (ZSTD_isError(size) != 0)
        throw LutError(std::string("Zstandard: ") + ZSTD_getErrorName(size));
    out.resize(size);
    return out;
}

std::vector<LutFile> write(const Lut& lut, const LutLayout& layout) {
    const Texture texture = texture_of(lut, layout);
    check_values(lut);
    const std::string descriptor = descriptor_of(lut);
    const std::string key_values = key_values_of(lut, texture);

    std::string out(kIdentifier);
    for (const std::uint32_t field :
         {texture.vk_format, texture.type_size, texture.width, texture.height, texture.depth,
          texture.layers, texture.faces, texture.levels, texture.scheme})
        append_u32(out, field);
    const std::size_t descriptor_at = kHeaderBytes + kLevelIndexBytes * lut.levels();
    append_u32(out, descriptor_at);
    append_u32(out, descriptor.size());
    append_u32(out, descriptor_at + descriptor.size());
    append_u32(out, key_values.size());
    append_u64(out, 0);  // no global data
    append_u64(out, 0);
    const std::size_t index_at = out.size();
    out.append(kLevelIndexBytes * lut.levels(), '\0');
    out += descriptor;
    out += key_values;
    for (std::size_t level = lut.levels(); level-- > 0;) {
        std::string texels = texels_of(lut, level, components_of(lut));
        std::string index;
        const std::size_t size = texels.size();
        if (layout.zstd)
            texels = compressed(texels);
        else
            pad(out, std::max<std::size_t>(4, texel_bytes(lut)));
        append_u64(index, out.size());
        append_u64(index, texels.size());
        append_u64(index, size);
        out.replace(index_at + kLevelIndexBytes * level, kLevelIndexBytes, index);
        out += texels;
    }
    std::vector<LutFile> files;
    files.push_back({"", std::move(out)});
    return files;
}

// --- reading --------------------------------------------------------------------------------

template <class Number>
Number number_in(std::string_view bytes, std::size_t at) {
    Number number{};
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

/// `length` bytes starting at `offset`. Throws LutError if the file is too short.
std::string_view part_of(std::string_view bytes, std::uint64_t offset, std::uint64_t length,
                         const std::string& what) {
    if (offset > bytes.size() || length > bytes.size() - offset)
        throw LutError("the file is truncated: " + what + " ends at byte " +
                       std::to_string(offset) + " + " + std::to_string(length) + " of " +
                       std::to_string(bytes.size()));
    return bytes.substr(offset, length);
}

std::string_view metadata_in(std::string_view key_values) {
    while (key_values.size() >= sizeof(std::uint32_t)) {
        const auto length = number_in<std::uint32_t>(key_values, 0);
        const std::string_view entry =
            part_of(key_values, sizeof(std::uint32_t), length, "a key with its value");
        const std::size_t end = entry.find('\0');
        if (end != std::string_view::npos && entry.substr(0, end) == kMetadataKey)
            return entry.substr(end + 1);
        const std::size_t padded = sizeof(std::uint32_t) + (std::size_t{length} + 3) / 4 * 4;
        key_values.remove_prefix(std::min(padded, key_values.size()));
    }
    throw LutError("not a texture made by irido: it has no " + std::string(kMetadataKey));
}

Texture texture_in(std::string_view bytes) {
    std::array<std::uint32_t, 9> field{};
    for (std::size_t i = 0; i < field.size(); ++i)
        field[i] = number_in<std::uint32_t>(bytes, kIdentifier.size() + i * sizeof field[i]);
    return {field[0], field[1], field[2], field[3], field[4],
            field[5], field[6], field[7], field[8]};
}

std::string decompressed(std::string_view frame, std::size_t size) {
    if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != size ||
        size > kZstandardLargestRatio * frame.size() + kZstandardBlock)
        throw LutError("a level's Zstandard frame must hold " + std::to_string(size) + " bytes");
    std::string out(size, '\0');
    const std::size_t result = ZSTD_decompress(out.data(), size, frame.data(), frame.size());
    if (ZSTD_isError(result) != 0)
        throw LutError(std::string("Zstandard: ") + ZSTD_getErrorName(result));
    if (result != size) throw LutError("Zstandard: a level is too short");
    return out;
}

void read_level(std::string_view bytes, std::size_t level, const Texture& texture, Lut& lut) {
    const std::size_t index = kHeaderBytes + kLevelIndexBytes * level;
    const std::size_t expected = level_bytes(lut, level);
    const std::string_view data =
        part_of(bytes, number_in<std::uint64_t>(bytes, index),
                number_in<std::uint64_t>(bytes, index + 8), "level " + std::to_string(level));
    const bool is_plain = texture.scheme == 0;
    if (number_in<std::uint64_t>(bytes, index + 16) != expected ||
        (is_plain && data.size() != expected))
        throw LutError("level " + std::to_string(level) + " must have " + std::to_string(expected) +
                       " bytes");
    if (is_plain) return append_values(lut, level, components_of(lut), data);
    append_values(lut, level, components_of(lut), decompressed(data, expected));
}

Lut read(std::string_view bytes, std::string_view /*companion*/) {
    if (!bytes.starts_with(kIdentifier)) throw LutError("not a KTX2 file");
    part_of(bytes, 0, kHeaderBytes, "the header");
    const Texture texture = texture_in(bytes);
    constexpr std::size_t descriptor_field = 48, key_value_field = 56;
    const auto part_named = [&](std::size_t field, const std::string& what) {
        return part_of(bytes, number_in<std::uint32_t>(bytes, field),
                       number_in<std::uint32_t>(bytes, field + 4), what);
    };
    Lut lut = lut_from_metadata(metadata_in(part_named(key_value_field, "the key/value data")));
    const LutLayout layout{texture.scheme == kZstandard, texture.layers > 0};
    if (!(texture == texture_of(lut, layout)) ||
        part_named(descriptor_field, "the data format descriptor") != descriptor_of(lut))
        throw LutError("the header does not match the metadata");
    part_of(bytes, kHeaderBytes, kLevelIndexBytes * lut.levels(), "the level index");
    for (std::size_t level = 0; level < lut.levels(); ++level)
        read_level(bytes, level, texture, lut);
    return lut;
}

}  // namespace

extern const LutFormat lut_format_ktx2{
    .name = "ktx2",
    .summary = "texture for engines, f16 or f32, with mip levels where the kind has them",
    .write = write,
    .read = read,
};

}  // namespace irido::tables
