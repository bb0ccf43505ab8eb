#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"
#include "core/material/material.hpp"

namespace irido {

/// Weighted colour-matching functions of an observer under an illuminant, k S(lambda) {xbar, ybar,
/// zbar}: both factors are linear between their rows and zero outside, and k makes the integral of
/// the second component 1.
class Sensitivity {
public:
    /// Throws DomainError if the observer sees nothing of the illuminant.
    Sensitivity(const Observer& observer, const Table& illuminant);

    /// Overlap of observer and illuminant, nm.
    WavelengthRange support() const { return support_; }
    /// Integrals over the support: XYZ of a perfect mirror, white[1] = 1.
    const Triple& white() const { return white_; }
    /// Values per nm at a wavelength inside the support.
    Triple at(double wavelength_nm) const;
    /// Exact integrals over part of the support.
    Triple integral(WavelengthRange part) const;
    /// The ends of `part` and the rows of observer and illuminant strictly between them, sorted.
    std::vector<double> cells(WavelengthRange part) const;

private:
    const Observer& observer_;
    Table illuminant_;
    WavelengthRange support_;
    std::vector<double> rows_;
    double normalization_ = 1;
    Triple white_{};
};

/// Interpolatory quadrature of f(lambda) times the weighted colour-matching functions over one
/// panel, on Chebyshev points of the second kind in 1/lambda. The moments of the weight against
/// Chebyshev polynomials are integrated cell by cell, where it is quadratic, so that its kinks cost
/// no accuracy: convergence depends on the smoothness of f alone. The points of degree n are every
/// second point of degree 2n.
/// Source: J. P. Boyd, Chebyshev and Fourier Spectral Methods (2001), ch. 5; product integration
/// after I. H. Sloan and W. E. Smith, Numer. Math. 30, 415 (1978).
struct PanelRule {
    std::vector<double> x;                      ///< cos(pi j / degree), j = 0 .. degree
    std::vector<double> wavelength_nm;          ///< at these points, ascending
    std::array<std::vector<double>, 3> weight;  ///< per point
    std::array<std::vector<double>, 3> moment;  ///< moments of T_0 .. T_degree
};

/// `panel` must lie inside the support; degree is 8, 16, 32, 64 or 128.
PanelRule panel_rule(const Sensitivity& sensitivity, WavelengthRange panel, std::size_t degree);

/// A plain sum over samples, X = white X sum_i weight[0][i] f_i / sum_i weight[0][i], also for Y
/// and Z, so that f = 1 gives exactly the white.
struct SampleRule {
    std::vector<double> wavelength_nm;
    std::array<std::vector<double>, 3> weight;
};

/// Trapezoidal rule on equally spaced wavelengths from one end of the support to the other. Throws
/// DomainError unless count is in [2, 1e6] and every channel has a nonzero weight.
SampleRule equal_rule(const Sensitivity& sensitivity, std::size_t count);

}  // namespace irido
