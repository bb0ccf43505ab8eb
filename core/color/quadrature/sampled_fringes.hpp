#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/coherent/coherent.hpp"
#include "core/color/color_request.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// X, Y, Z of one side, the mean of the polarizations.
struct SampledSum {
    Triple xyz{};
    double error = 0;  ///< estimated largest error of X, Y, Z
    std::size_t evaluations = 0;
};

struct SampleLimits {
    double tolerance = 1e-6;
    /// Per spectrum, and eight times as many where that probably suffices; past it the error is
    /// larger.
    std::size_t evaluations = 1U << 22;
    double path_nm = 0;  ///< of the fringes sampled, there and back
};

/// What is sampled: the mean over polarizations.
struct SampledStack {
    const Stack& materials;  ///< without held ranges
    const Stack& stack;      ///< its elements
    IncidentAngle incidence;
    std::span<const Polarization> polarizations;
    /// Elements over whose phases R and T are averaged, see fringe_mean(): none, or the one of the
    /// longest path.
    std::span<const std::size_t> fast;
};

/// Sums over spectra with more fringes than can be resolved one by one: equally spaced points see
/// each fringe at another phase, and what they miss of one they find in others. Between the band
/// edges of groups, where fringes crowd and sharpen, points crowd as well, as x^4 at both ends; the
/// trapezoidal rule then converges as the harmonics of the fringes fall, as 1/points^2 where each
/// fringe has edges of its own. The error is twice what the last doubling changed, or a quarter of
/// what the one before did. Lines that take less than a part in the number of points of every
/// fringe may be missed.
/// Source: L. N. Trefethen and J. A. C. Weideman, SIAM Review 56, 385 (2014), on the rule's
/// aliases.
///   sensitivity  weighted colour-matching functions
///   of           coherent stack without gain
///   sides        of the sums
///   limits       tolerance and effort
std::vector<SampledSum> sampled_fringes(const Sensitivity& sensitivity, const SampledStack& of,
                                        std::span<const Side> sides, const SampleLimits& limits);

}  // namespace irido
