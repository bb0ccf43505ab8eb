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
        absorbing_group,  ///< a period some of whose layers absorb, likewise; A from 1 - R - T only
        fixed_fields,     ///< fields above the lowest layers, which are stored
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
    bool shares_layers = false;  ///< layers occur often: their matrices are computed once a point
    bool absorbs = false;        ///< any layer
    bool has_absorbing_groups = false;
    double largest_thickness_nm = 0;
    std::optional<HostedMirror> mirror;  ///< where its closed form is the faster one

    bool is_one_film() const {
        return steps.size() == 1 && steps[0].count == 1 && steps[0].kind == Kind::transparent;
    }
};

/// Neighbouring elements that are the same in many stacks: what they do is computed once a point,
/// and stored as rows of numbers over the points. For s, then for p: the fields B and C (4 rows),
/// or the matrix (4 real rows, or 8), and the logarithm of a factor of it; the last row is what
/// waves that die there turn in the denominator.
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

/// What is worth to be stored of coherent elements of which those in `varied` differ from stack to
/// stack: nothing if `varied` is empty, if it would not save enough, or if some elements are better
/// left to the plain kernel.
///   varied   indices of elements, ascending
///   absorbs  one per material: whether its index has an imaginary part anywhere
FixedRuns fixed_runs(std::span<const Element> elements, std::size_t substrate,
                     const std::vector<bool>& absorbs, std::span<const std::size_t> varied);

/// The program of coherent elements, into memory that is used again; false if they are better left
/// to the plain kernel: nested groups of many layers.
///   absorbs  as above
///   needs_A  groups of a few absorbing layers are written out for their absorption
///   fixed    of these elements
bool compile(std::span<const Element> elements, std::size_t substrate,
             const std::vector<bool>& absorbs, bool needs_A, const FixedRuns& fixed,
             Program& program);

/// The mirror if its closed form is faster than its program.
///   absorbs  as above
std::optional<HostedMirror> fast_mirror(const std::optional<HostedMirror>& mirror,
                                        const std::vector<bool>& absorbs);

/// Whether a mirror's denominators come without a logarithm, as those of its layers one by one.
bool has_few_layers(const HostedMirror& mirror);

/// Operations of one point of a hosted mirror, counted as below, in bands.
double operations_of_mirror(int polarizations, bool constant);

/// Floating-point operations that the vector kernel spends on one point where all transparent
/// layers travel and all of A is 1 - R - T: additions, multiplications, fused pairs of them,
/// divisions and square roots count one each; comparisons, selections and bit operations nothing.
///   polarizations  1 or 2
///   constant       no medium varies over the points: its normal index is not computed again
/// Counted in the source of the kernel.
double operations_per_point(const Program& program, int polarizations, bool constant);

}  // namespace irido
