#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/interference/hosted_mirror.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Coherent layers as steps of the vector kernel, from the substrate up.
struct Program {
    enum class Kind {
        transparent,  ///< layers in real arithmetic
        absorbing,    ///< layers in complex arithmetic
        group,        ///< a transparent period, raised to its power in closed form
    };
    struct Step {
        Kind kind;
        std::uint32_t first, count;  ///< in `order`
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
    double largest_thickness_nm = 0;
    std::optional<HostedMirror> mirror;  ///< where its closed form is the faster one

    bool is_one_film() const {
        return steps.size() == 1 && steps[0].count == 1 && steps[0].kind == Kind::transparent;
    }
};

/// The program of coherent elements, or nothing if they are better left to the plain kernel: groups
/// of absorbing layers of many periods and nested groups of many layers.
///   absorbs  one per material: whether its index has an imaginary part anywhere
std::optional<Program> compile(std::span<const Element> elements, std::size_t substrate,
                               const std::vector<bool>& absorbs);

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
