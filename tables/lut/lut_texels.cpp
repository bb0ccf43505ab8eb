#include "tables/lut/lut_texels.hpp"

#include "tables/lut/lut_format.hpp"
#include "tables/lut/lut_values.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kMostOfOneBlock = 4, kChannelsOfBlocks = 3, kAlpha = 3;

double filler(std::size_t component) {
    return component == kAlpha ? 1 : 0;
}

/// Calls visit with each texel component's index into the values of the level, or none for padding.
template <class Visit>
void visit_components(const Lut& lut, std::size_t level, std::size_t components, Visit visit) {
    const auto [blocks, channels] = texel_blocks(lut);
    const std::size_t width = lut.axes_of_level(level).back().count();
    const std::size_t row_values = width * lut.channels.size();
    const std::size_t rows = lut.values_of_level(level) / row_values;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t block = 0; block < blocks; ++block)
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t texel =
                    row * row_values + x * lut.channels.size() + block * channels;
                for (std::size_t c = 0; c < components; ++c) visit(c < channels, texel + c, c);
            }
}

}  // namespace

TexelBlocks texel_blocks(const Lut& lut) {
    const std::size_t channels = lut.channels.size();
    if (channels <= kMostOfOneBlock) return {1, channels};
    if (channels % kChannelsOfBlocks != 0)
        throw LutError("texels hold up to 4 channels or a multiple of 3, not " +
                       std::to_string(channels));
    return {channels / kChannelsOfBlocks, kChannelsOfBlocks};
}

std::string texels_of(const Lut& lut, std::size_t level, std::size_t components) {
    std::size_t start = 0;
    for (std::size_t l = 0; l < level; ++l) start += lut.values_of_level(l);
    std::string bytes;
    bytes.reserve(lut.values_of_level(level) / lut.channels.size() * texel_blocks(lut).count *
                  components * bytes_of(lut.type));
    visit_components(lut, level, components, [&](bool is_channel, std::size_t i, std::size_t c) {
        append_bytes(bytes, is_channel ? lut.values[start + i] : filler(c), lut.type);
    });
    return bytes;
}

void append_values(Lut& lut, std::size_t level, std::size_t components, std::string_view texels) {
    const std::size_t start = lut.values.size();
    lut.values.resize(start + lut.values_of_level(level));
    const char* at = texels.data();
    visit_components(lut, level, components, [&](bool is_channel, std::size_t i, std::size_t c) {
        const double value = number_at(at, lut.type);
        at += bytes_of(lut.type);
        if (is_channel)
            lut.values[start + i] = value;
        else if (value != filler(c))
            throw LutError("a padding component of a texel was modified");
    });
}

}  // namespace irido::tables
