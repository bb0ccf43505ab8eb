#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

/// Degrees of the rules for integrating colours, each double the previous one.
inline constexpr std::array<std::size_t, 6> kDegrees{4, 8, 16, 32, 64, 128};

/// Assumed decay rates of the Chebyshev coefficients beyond the last one: exp(-rate k/degree). The
/// first rate holds for every spectrum whose poles are farther away than the spacing of the points.
inline constexpr std::array<double, 6> kFallRates{2, 4, 8, 12, 16, 24};

/// Largest |D'|/|D| of a denominator whose zeros are as far away as a rate of kFallRates requires:
/// twice as far as the ellipse around the panel on which coefficients decay at that rate.
double steepest_of(double rate, double degree);

/// A panel's rule with the data for its error estimate.
struct QuadratureRule {
    QuadratureRule(const Sensitivity& sensitivity, WavelengthRange panel, std::size_t degree);

    std::vector<double> x, wavelength_nm;  ///< of the points, see PanelRule
    std::size_t points;                    ///< degree + 1
    std::size_t stride;                    ///< of rows: points, rounded up to kMostLanes
    std::size_t middle;           ///< number of coefficients up to the one of half the degree,
    std::size_t tail;             ///< and of the last ones, that tell how large those left out are
    std::vector<double> weights;  ///< rows for X, Y, Z; zero past the points
    std::span<const double> coefficients;  ///< rows that make these coefficients, of the degree
    std::vector<double> inverse_spacing;   ///< of each point to the next in x; 0 from the last on
    /// Error of the integrals per unit of the last coefficient, for each of kFallRates.
    std::array<Triple, kFallRates.size()> per_coefficient;
    std::array<double, kFallRates.size()> step;      ///< from one coefficient to the next
    std::array<double, kFallRates.size()> steepest;  ///< steepest_of() each rate
    Triple light;                                    ///< part of the white that is in the panel
    Triple per_coefficient_with_root;  ///< error per unit of the last one, see error_with_root()

    std::size_t sum_count() const { return 3 + middle + tail; }
    /// X, Y, Z, then the middle and the last Chebyshev coefficients of values - reference.
    ///   values  at the points; as many are read as the stride
    ///   sums    room for sum_count() numbers
    void sum(const double* values, double reference, double* sums, SimdLevel simd) const;
    /// Ratio of the middle coefficients' size to that of the last ones; for degrees from 16.
    double fall_seen(std::span<const double> sums) const;
    /// Of the integrals, `sums` being those of sum(). `rate` is an index into kFallRates that
    /// is known to hold; half of the fall from the middle to the last coefficients counts as well,
    /// up to the rate `most`.
    Triple error(std::span<const double> sums, std::size_t rate,
                 std::size_t most = kFallRates.size() - 1) const;
    /// The same with a square root in or next to the panel, whose coefficients fall as cos(k theta
    /// + phi) k^-3/2.
    Triple error_with_root(std::span<const double> sums) const;
};

}  // namespace irido
