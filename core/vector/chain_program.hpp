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

/// The layers of a stack for the absorption of each, block by block.
struct ChainLayers {
    struct Block {
        LayerProgram down, up;     ///< owners count the block's own listed layers, from the top
        std::uint32_t first, end;  ///< its listed layers; the incoherent one below is `end`
    };
    std::vector<Block> blocks;
};

/// Compiles the layers of a chain, reusing memory.
///   chain    blocks and incoherent layers
///   listed   per layer written out, the listed one that it is part of; empty: itself
///   absorbs  per material: whether Im(n) is nonzero anywhere
///   layers   result
void compile_layers(const Chain& chain, std::span<const std::size_t> listed,
                    const std::vector<bool>& absorbs, ChainLayers& layers);

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

/// run_layers() with round trips between blocks summed as powers.
///   chain   compiled stack
///   layers  its layers
///   run     points
///   s, p    outputs, nullptr for a polarization that is not needed
///   redo    receives the points left to the plain kernel, as in run_chain()
///   memory  scratch
///   level   instruction set
void run_chain_layers(const ChainProgram& chain, const ChainLayers& layers, const PointRun& run,
                      const LayerOutput* s, const LayerOutput* p, std::vector<std::size_t>& redo,
                      RunMemory& memory, SimdLevel level);

}  // namespace irido
