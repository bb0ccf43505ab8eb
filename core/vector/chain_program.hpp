#pragma once

#include "core/incoherent/chain.hpp"
#include "core/vector/kernel.hpp"

namespace irido {

/// A stack for the vector kernel: one program, or one for each direction through each coherent
/// block where incoherent layers part them.
struct ChainProgram {
    std::vector<Program> down, up;  ///< `up` has none for the last block
    std::vector<Layer> gaps;        ///< incoherent layers between the blocks
};

/// The programs of a chain, into memory that is used again; false if compile() has none for a block
/// or a gap amplifies.
///   absorbs, amplifies  one per material: whether Im(n) is not 0, or is negative, anywhere
///   needs_A             as of compile() of program.hpp
///   fixed               of the block, if it is the only one; else empty
bool compile(const Chain& chain, const std::vector<bool>& absorbs,
             const std::vector<bool>& amplifies, bool needs_A, const FixedRuns& fixed,
             ChainProgram& program);

/// As run_program(), with the bounces between blocks summed as powers. `redo` also receives the
/// points at which a gap is coherent, or has not its medium's wave: see incoherent.hpp.
void run_chain(const ChainProgram& chain, const PointRun& run, const RunOutput* s,
               const RunOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
               SimdLevel level);

}  // namespace irido
