#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/color/color_request.hpp"
#include "core/color/quadrature/branch_points.hpp"
#include "core/color/quadrature/hidden_lines.hpp"
#include "core/color/quadrature/index_effect.hpp"
#include "core/color/quadrature/panel_tree.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

/// Spectra at common points, in rows readable kMostLanes + 1 past their last point.
class Samples {
public:
    /// Resizes, keeping allocated memory.
    ///   spectra       such as R and T
    ///   denominators  pole-free complex functions, one per polarization, whose zeros are the poles
    ///                 of the spectra; they reveal a resonance between two points
    ///   points        number of points
    void resize(std::size_t spectra, std::size_t denominators, std::size_t points);
    std::size_t points() const { return points_; }
    std::size_t rows() const { return rows_; }

    /// Row of a spectrum, with values in [0, 1]; after the spectra, each denominator has three
    /// rows: real part, imaginary part and logarithm of a common factor.
    double* row(std::size_t row) { return numbers_.data() + row * stride_; }
    const double* row(std::size_t row) const { return numbers_.data() + row * stride_; }

private:
    std::size_t rows_ = 0, points_ = 0, stride_ = 0;
    std::vector<double> numbers_;
};

/// Fills `samples`, already sized, at the points of all parts in sequence.
using SampleAt =
    std::function<void(std::span<const SpectralPoints* const> parts, Samples& samples)>;

/// Scratch buffers, reusable between calls.
struct IntegrationMemory {
    /// A panel at one degree, an index into kDegrees.
    struct Job {
        PanelTree::Node* node = nullptr;
        std::size_t degree = 0;
        double half_turn = 0;
        double share = 0;                              ///< of the tolerance
        std::optional<Samples> coarse = std::nullopt;  ///< at the points of the previous degree
        /// Denominators at the points of a degree that resolves them, and the largest error of the
        /// spectra that follow from these. See Transmission.
        std::optional<Samples> known = std::nullopt;
        std::size_t known_degree = 0;
        double unseen = 0;
        const QuadratureRule& rule() const { return node->rule(degree); }
    };
    DenominatorSlopes zeros;
    /// Slopes of the parts of both denominators, where these are known and at other points.
    std::array<std::vector<double>, 4> known_slopes, slopes;
    std::vector<bool> marked;
    std::vector<Job> now, next;
    std::vector<const SpectralPoints*> parts;
    std::vector<double> reference, sums;
    std::vector<Triple> errors, panel_errors;
    std::vector<Samples> spare;
};

/// X, Y, Z of one spectrum.
struct ColorIntegral {
    Triple xyz{};
    double error = 0;  ///< estimated largest error of X, Y, Z
    std::size_t evaluations = 0;
};

/// Transmittances that follow from denominators, T = flux / |D|^2, as those of stacks in which all
/// waves travel and nothing absorbs: D then has half the frequencies of the fringes, and no narrow
/// lines, and is interpolated between points that do not resolve T.
struct Transmission {
    std::array<double, 2> flux{};   ///< of each denominator; known after the first call of `sample`
    bool holds = false;             ///< so are all the samples
    std::span<const Side> sides{};  ///< of the spectra, the means of T or 1 - T
};

struct IntegrationLimits {
    double tolerance = 1e-6;             ///< largest error of X, Y, Z; [1e-12, 1]
    std::size_t evaluations = 1U << 20;  ///< limit per spectrum; past it the best value is returned
    SimdLevel simd = best_simd_level();
    /// Per material the largest |n| / |kz/k0|^2 over the spectrum; empty if no index is fitted. See
    /// index_effect().
    std::span<const double> index_effects{};
    /// nullptr where spectra do not follow from denominators.
    const Transmission* transmission = nullptr;
    std::span<const BranchPoint> branch_points{};  ///< near the spectrum
    /// False for means of spectra: the zeros of their denominators tell where lines are, but not
    /// that no other spectrum of the mean has some that are closer.
    bool has_all_poles = true;
};

/// Integrates spectra that are computed together, times the weighted colour-matching functions,
/// over adjoining panels that cover the support. Each panel doubles its degree or is bisected,
/// whichever promises more, until the estimate is below its share of the tolerance. The estimate
/// combines the last Chebyshev coefficients with the moments, and counts the full weight of every
/// point near which a denominator has a zero closer than the next point. Next to branch points,
/// later coefficients are taken to be those of a square root. Where the denominators are known
/// between the points, finer ones follow from these. A spectrum equal to 1 at every point gives
/// exactly the white. If the evaluations run out, error > tolerance.
///   sensitivity   weighted colour-matching functions
///   start         initial panels
///   denominators  number in the samples, 0 to 2
///   sample        computes spectra and denominators
///   limits        tolerance and effort
///   memory        scratch
///   integrals     results, one per spectrum
void integrate_color(const Sensitivity& sensitivity, const PanelTree::Start& start,
                     std::size_t denominators, const SampleAt& sample,
                     const IntegrationLimits& limits, IntegrationMemory& memory,
                     std::span<ColorIntegral> integrals);

}  // namespace irido
