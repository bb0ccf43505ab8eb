#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/color/sensitivity.hpp"
#include "core/complex.hpp"

namespace irido {

/// A part of the spectrum over which the integrands are smooth, and a guess at their richness.
struct SpectralPanel {
    WavelengthRange range;
    /// Half the turn in radians of the fastest fringe over the panel: the integrands need about as
    /// many Chebyshev polynomials.
    double half_turn = 0;
};

/// A complex number exp(log_scale) value.
struct ScaledComplex {
    Complex value{1};
    double log_scale = 0;
};

/// A spectrum at one wavelength.
struct SpectrumSample {
    double value = 0;  ///< in [0, 1]
    /// Of functions without poles whose zeros are the poles of the spectrum (one a polarization):
    /// they betray a resonance that falls between two samples. Constant where nothing is known.
    std::array<ScaledComplex, 2> denominator{};
};

/// Several spectra that are wanted at the same wavelengths, such as R and T at every angle.
/// Fills samples[item * wavelengths + w] for each of the asked items, in order.
using SpectraAt =
    std::function<void(std::span<const double> wavelength_nm, std::span<const std::size_t> items,
                       std::span<SpectrumSample> samples)>;

/// X, Y, Z of one spectrum.
struct ColorIntegral {
    Triple xyz{};
    double error = 0;  ///< estimate of the largest error of X, Y, Z
    std::size_t evaluations = 0;
};

struct IntegrationLimits {
    double tolerance = 1e-6;             ///< largest error of X, Y, Z; [1e-12, 1]
    std::size_t evaluations = 1U << 20;  ///< a spectrum; past it the best value is returned
};

/// Integrals of `items` spectra times the sensitivity over adjoining panels that cover its support.
/// Each panel starts at the degree that its half_turn asks for, doubles it and then bisects until
/// the estimate is below the panel's share of the tolerance: the tail of the Chebyshev coefficients
/// against the moments, and the whole weight of every point near which a denominator has a zero
/// closer than the next point. A spectrum equal to 1 at every point gives exactly the white.
/// Spectra that run out of evaluations have error > tolerance.
std::vector<ColorIntegral> integrate_color(const Sensitivity& sensitivity,
                                           const std::vector<SpectralPanel>& panels,
                                           std::size_t items, const SpectraAt& spectra,
                                           const IntegrationLimits& limits);

}  // namespace irido
