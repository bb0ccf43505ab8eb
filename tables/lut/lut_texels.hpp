#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tables/lut/lut.hpp"

namespace irido::tables {

/// How the channels of a table map to the components of texels: up to four channels are one block;
/// a multiple of three becomes blocks of three, side by side along x.
struct TexelBlocks {
    std::size_t count = 1;
    std::size_t channels = 1;  ///< per block
};

/// Throws LutError for more than four channels unless they are a multiple of three.
TexelBlocks texel_blocks(const Lut& lut);

/// Texels of one level as bytes: rows along the last axis, first sample first; each row block by
/// block. A texel has `components` numbers: the channels of its block, then 0 and, as the fourth,
/// alpha = 1.
std::string texels_of(const Lut& lut, std::size_t level, std::size_t components);

/// Appends the values of a level, in the table's order. Throws LutError if padding components
/// differ from those of texels_of().
/// lut         the table, to whose values they are appended
/// level       the mip level
/// components  numbers per texel, 1 to 4
/// texels      bytes in the order of texels_of(), of the level's size
void append_values(Lut& lut, std::size_t level, std::size_t components, std::string_view texels);

}  // namespace irido::tables
