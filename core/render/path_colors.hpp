#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/render/color_nodes.hpp"
#include "core/render/reflected_colors.hpp"
#include "core/render/stack_spectra.hpp"

namespace irido {

/// Where a path of sight meets the stack.
struct PathStep {
    FilmPoint at;
    bool inside = false;  ///< meets the stack from its substrate
    /// Whether `light` is seen here: by reflection where the stack is met from outside, by
    /// transmission from inside; the path goes on the other way. Else it goes on by reflection.
    bool leaves = true;
    Triple light{};
};

/// Linear sRGB along paths that meet a stack several times, as walls of a bubble: reflectances and
/// transmittances are multiplied wavelength by wavelength, s and p apart (paths stay in one plane),
/// and then integrated; the RGB of a light multiplies the channels of what it passes. What is left
/// inside after the last step of a path leaves with the light of that step.
/// Safe from many threads; a colour depends on its path alone.
class PathColors {
public:
    /// Integrates with as many wavelengths as the thickest layer needs, and with more for paths
    /// near grazing incidence, where a free film is a resonator. `tables` only for the time of the
    /// call. is_opaque: no path meets the stack from inside. Throws DomainError if fringes are too
    /// fine, and as IndexTable does.
    PathColors(const ColorTables& tables, const RgbTransform& to_srgb, const SurfaceStack& stack,
               bool is_opaque, const ColorPlan& plan);
    ~PathColors();

    /// Memory of calls on one thread.
    class Scratch {
        friend class PathColors;
        std::array<StackSpectra::Memory, 4> memories_;
        std::vector<float> powers_, through_;
    };

    Triple operator()(std::span<const PathStep> path, Scratch& scratch) const;

    const ColorReport& report() const { return report_; }

private:
    struct Face;
    /// Paths of certain angles: wavelengths, and what the stack does at them.
    struct Regime;

    std::unique_ptr<Regime> regime(const Sensitivity& sensitivity, const RgbTransform& to_srgb,
                                   const ShownRange& range, double tolerance) const;
    void make_tables(const ColorPlan& plan);

    std::vector<SurfaceStack> stacks_;  ///< from outside, from inside
    SimdLevel simd_;
    std::vector<std::unique_ptr<Regime>> regimes_;  ///< all but the last near grazing, the last
    ColorReport report_;
};

}  // namespace irido
