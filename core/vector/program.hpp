#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/coherent/hosted_mirror.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Coherent layers as steps of the vector kernel, from the substrate up.
struct Program {
    enum class Kind {
        transparent,      ///< layers in real arithmetic
        absorbing,        ///< layers in complex arithmetic
        group,            ///< a transparent period, raised to its power in closed form
        absorbing_group,  ///< a period with absorbing layers, likewise; A from 1 - R - T only
        fixed_fields,     ///< stored fields above the lowest layers
        fixed_real,       ///< the stored matrix of transparent layers
        fixed_complex     ///< the stored matrix of layers some of which absorb
    };
    struct Step {
        Kind kind;
        std::uint32_t first, count;  ///< in `order`; of what is stored: rows, see FixedRun
        std::uint32_t repeat = 1;    ///< of a group
    };
    struct PlainLayer {
        std::uint32_t medium;  ///< in `media`
        double thickness_nm;
    };
    /// Stands for the incident medium, which does not absorb.
    static constexpr std::size_t kIncident = static_cast<std::size_t>(-1);
    struct UsedMedium {
        std::size_t material;  ///< index into Stack::materials, or kIncident
        bool absorbs;          ///< somewhere in the table: Im(n) != 0
    };
    std::vector<UsedMedium> media;     ///< of layers; the substrate last
    std::vector<PlainLayer> layers;    ///< each combination of medium and thickness once
    std::vector<std::uint32_t> order;  ///< of `layers`, from the substrate up
    std::vector<Step> steps;
    bool shares_layers = false;  ///< layers recur: matrices are computed once per point
    bool absorbs = false;        ///< any layer
    bool has_absorbing_groups = false;
    double largest_thickness_nm = 0;
    std::optional<HostedMirror> mirror;  ///< if its closed form is faster

    bool is_one_film() const {
        return steps.size() == 1 && steps[0].count == 1 && steps[0].kind == Kind::transparent;
    }
};

/// Coherent layers with groups written out, to find the absorption of each.
struct LayerProgram {
    Program program;
    std::vector<std::uint32_t> owners;   ///< per entry of `order`: the listed layer it is part of
    std::vector<std::uint32_t> without;  ///< listed layers of no thickness
};

/// Neighbouring elements shared by many stacks: evaluated once per point and stored as rows of
/// numbers over the points. For s, then for p: the fields B and C (4 rows) or the matrix (4 rows if
/// real, else 8), and the logarithm of a common factor; the last row is the phase of the damped
/// waves, see slab_response.cpp.
struct FixedRun {
    std::size_t first, count;  ///< among the elements
    Program program;
    Program::Step step;  ///< that stands for them

    static std::uint32_t rows_of(Program::Kind kind) {
        return kind == Program::Kind::fixed_complex ? 9 : 5;  ///< of one polarization
    }
};
struct FixedRuns {
    std::vector<FixedRun> runs;  ///< from the substrate up
    std::size_t rows = 0;
};

/// Runs of elements worth caching when only `varied` change between stacks. Empty if `varied` is
/// empty, if too little would be saved, or if some elements are better left to the plain kernel.
///   elements   coherent elements, from the incident side
///   substrate  index of its material
///   absorbs    per material: whether its index has an imaginary part anywhere
///   varied     indices of elements, ascending
FixedRuns fixed_runs(std::span<const Element> elements, std::size_t substrate,
                     const std::vector<bool>& absorbs, std::span<const std::size_t> varied);

/// Compiles coherent elements, reusing memory. Returns false if they are better left to the plain
/// kernel: nested groups of many layers.
///   elements   from the incident side
///   substrate  index of its material
///   absorbs    per material: whether its index has an imaginary part anywhere
///   needs_A    expands groups of a few absorbing layers to get their absorption
///   fixed      fixed runs of these elements
///   program    result
bool compile(std::span<const Element> elements, std::size_t substrate,
             const std::vector<bool>& absorbs, bool needs_A, const FixedRuns& fixed,
             Program& program);

/// Compiles layers for the absorption of each, reusing memory.
///   layers     from the incident side, with groups written out
///   listed     per layer, the listed one that it is part of; empty: itself
///   substrate  index of its material
///   absorbs    per material: whether its index has an imaginary part anywhere
///   program    result
void compile_layers(std::span<const Layer> layers, std::span<const std::size_t> listed,
                    std::size_t substrate, const std::vector<bool>& absorbs, LayerProgram& program);

/// The mirror, if its closed form is faster than its program. `absorbs` tells per material whether
/// its index has an imaginary part anywhere.
std::optional<HostedMirror> fast_mirror(const std::optional<HostedMirror>& mirror,
                                        const std::vector<bool>& absorbs);

/// Whether a mirror's denominators need no logarithm, as if computed layer by layer.
bool has_few_layers(const HostedMirror& mirror);

/// Operations per point of an embedded mirror in bands; see operations_per_point().
double operations_of_mirror(int polarizations, bool constant);

/// Floating-point operations of the vector kernel per point, if light travels in all transparent
/// layers and all of A is 1 - R - T. Additions, multiplications, fused pairs of them, divisions and
/// square roots count as one each; comparisons, selections and bit operations as none. Counted in
/// the kernel's source.
///   program        compiled layers
///   polarizations  1 or 2
///   constant       no medium varies over the points, so normal indices are not recomputed
double operations_per_point(const Program& program, int polarizations, bool constant);

}  // namespace irido
