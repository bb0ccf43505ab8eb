#pragma once

#include "core/incoherent/chain.hpp"
#include "core/vector/kernel.hpp"

namespace irido {

/// A stack for the vector kernel: one program, or one per direction for each coherent block between
/// incoherent layers.
struct ChainProgram {
    std::vector<Program> down, up;  ///< `up` has none for the last block
    std::vector<Layer> gaps;        ///< incoherent layers between the blocks
};

/// Compiles the programs of a chain, reusing memory. Returns false if compile() fails for a block
/// or an incoherent layer amplifies.
///   chain               blocks and incoherent layers
///   absorbs, amplifies  per material: whether Im(n) is nonzero, or negative, anywhere
///   needs_A             whether absorption is requested
///   fixed               fixed layers of the block, if it is the only one; else empty
///   program             result
bool compile(const Chain& chain, const std::vector<bool>& absorbs,
             const std::vector<bool>& amplifies, bool needs_A, const FixedRuns& fixed,
             ChainProgram& program);

/// run_program() with round trips between blocks summed as powers.
///   chain   compiled stack
///   run     points
///   s, p    outputs, nullptr for a polarization that is not needed
///   redo    receives the points left to the plain kernel, including those at which an incoherent
///           layer acts as coherent or its wave is modified: see incoherent.hpp
///   memory  scratch
///   level   instruction set
void run_chain(const ChainProgram& chain, const PointRun& run, const RunOutput* s,
               const RunOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
               SimdLevel level);

}  // namespace irido
