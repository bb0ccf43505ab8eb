#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tables/lut/lut.hpp"

namespace irido::tables {

/// How the channels of a table become the components of texels: up to four are one block; a
/// multiple of three are blocks of three, side by side along x.
struct TexelBlocks {
    std::size_t count = 1;
    std::size_t channels = 1;  ///< of one block
};

/// Throws LutError for more than four channels that are no multiple of three.
TexelBlocks texel_blocks(const Lut& lut);

/// Texels of one level as bytes: rows along the last axis, first sample first; each row block by
/// block. A texel has `components` numbers: the channels of its block, then 0 and, as the fourth,
/// alpha = 1.
std::string texels_of(const Lut& lut, std::size_t level, std::size_t components);

/// The same back: values in the table's order, appended. `texels` has the level's size. Throws
/// LutError if components that are no channels are not what texels_of() writes.
void append_values(Lut& lut, std::size_t level, std::size_t components, std::string_view texels);

}  // namespace irido::tables
