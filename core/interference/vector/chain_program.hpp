#pragma once

#include <optional>

#include "core/interference/chain.hpp"
#include "core/interference/vector/kernel.hpp"

namespace irido {

/// A stack for the vector kernel: one program, or one for each direction through each coherent
/// block where incoherent layers part them.
struct ChainProgram {
    std::vector<Program> down, up;  ///< `up` has none for the last block
    std::vector<Layer> gaps;        ///< incoherent layers between the blocks
};

/// The programs of a chain, or nothing if compile() has none for a block or a gap amplifies.
///   absorbs, amplifies  one per material: whether Im(n) is not 0, or is negative, anywhere
std::optional<ChainProgram> compile(const Chain& chain, const std::vector<bool>& absorbs,
                                    const std::vector<bool>& amplifies);

/// As run_program(), with the bounces between blocks summed as powers.
void run_chain(const ChainProgram& chain, const PointRun& run, const RunOutput* s,
               const RunOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
               SimdLevel level);

}  // namespace irido
