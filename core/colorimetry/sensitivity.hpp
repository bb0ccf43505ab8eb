#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"
#include "core/material/material.hpp"

namespace irido {

/// An observer under an illuminant, k S(lambda) {xbar, ybar, zbar}: both factors linear between
/// their rows and zero outside them, k such that the integral of the middle one is 1.
class Sensitivity {
public:
    /// Throws DomainError if the illuminant gives the observer no light.
    Sensitivity(const Observer& observer, const Table& illuminant);

    /// Where observer and illuminant are both given, nm.
    WavelengthRange support() const { return support_; }
    /// Integrals over the support: XYZ of a perfect mirror, white[1] = 1.
    const Triple& white() const { return white_; }
    /// Per nm at one wavelength inside the support.
    Triple at(double wavelength_nm) const;
    /// Integrals over part of the support, exact.
    Triple integral(WavelengthRange part) const;
    /// Rows of observer and illuminant strictly inside `part`, between its two ends, sorted.
    std::vector<double> cells(WavelengthRange part) const;

private:
    const Observer& observer_;
    Table illuminant_;
    WavelengthRange support_;
    std::vector<double> rows_;
    double normalization_ = 1;
    Triple white_{};
};

/// Interpolatory quadrature of f(lambda) times the sensitivity over one panel, on Chebyshev points
/// of the second kind in 1/lambda. The moments of the sensitivity against Chebyshev polynomials
/// are integrated cell by cell, where it is quadratic, so its kinks cost no accuracy: the rule
/// converges as fast as f is smooth. Points of degree n are every second point of degree 2n.
/// Source: J. P. Boyd, Chebyshev and Fourier Spectral Methods (2001), ch. 5; product integration
/// after I. H. Sloan and W. E. Smith, Numer. Math. 30, 415 (1978).
struct PanelRule {
    std::vector<double> x;                      ///< cos(pi j / degree), j = 0 .. degree
    std::vector<double> wavelength_nm;          ///< of these points, ascending
    std::array<std::vector<double>, 3> weight;  ///< of the points
    std::array<std::vector<double>, 3> moment;  ///< of T_0 .. T_degree
};

/// `panel` inside the sensitivity's support; degree one of 8, 16, 32, 64, 128.
PanelRule panel_rule(const Sensitivity& sensitivity, WavelengthRange panel, std::size_t degree);

/// A plain sum over samples: X = white X sum_i weight[0][i] f_i / sum_i weight[0][i] and so on, so
/// that f = 1 is exactly the white.
struct SampleRule {
    std::vector<double> wavelength_nm;
    std::array<std::vector<double>, 3> weight;
};

/// Equally spaced wavelengths from one end of the support to the other, with the weights of the
/// trapezoid rule. count in [2, 1e6], else DomainError; the same if they give a channel no light.
SampleRule equal_rule(const Sensitivity& sensitivity, std::size_t count);

}  // namespace irido
