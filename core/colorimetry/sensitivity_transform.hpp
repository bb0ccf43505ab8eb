#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/complex.hpp"

namespace irido {

/// One complex number for each of X, Y, Z.
using ComplexTriple = std::array<Complex, 3>;

/// Quadrature of the weighted colour-matching functions over their support: Gauss points in each
/// cell, where they are quadratic, enough for waves of optical path difference up to `opd_max_nm`
/// (to 1e-14 of the white).
struct SensitivityPoints {
    std::vector<double> wavenumber;             ///< nu = 1 / wavelength, 1/nm
    std::array<std::vector<double>, 3> weight;  ///< for X, Y, Z
};

/// opd_max_nm in [0, 2e7], else DomainError.
SensitivityPoints sensitivity_points(const Sensitivity& sensitivity, double opd_max_nm);

/// One channel's weight over the wavenumber reduced to its two-point Gauss rule, which preserves
/// the first four moments. Their centroid stands for both where a single point is needed.
struct ChannelPoints {
    std::array<double, 2> nu{}, weight{};
    double centroid() const { return weight[0] * nu[0] + weight[1] * nu[1]; }
};

std::array<ChannelPoints, 3> channel_points(const Sensitivity& sensitivity);

/// H_j(D) of SensitivityTransform, summed over the points for one optical path difference.
///   points        made for optical path differences up to at least opd_nm
///   opd_nm        D, nm
///   variance_nm2  variance of a Gaussian distribution of D, nm^2
ComplexTriple transform_at(const SensitivityPoints& points, double opd_nm, double variance_nm2 = 0);

/// Fourier transform of the weighted colour-matching functions over the wavenumber nu = 1/lambda,
///     H_j(D) = integral s_j(lambda) exp(2 pi i D / lambda) exp(-2 pi^2 var / lambda^2) dlambda,
/// with D the optical path difference in nm and j = X, Y, Z: the contribution of a fringe with that
/// path difference to the colour; H_j(0) is the white. A Gaussian distribution of D with variance
/// var (nm^2) enters the integral, not the table.
///
/// Tabulated for fast look-up: the carrier exp(2 pi i D nu_mid), with nu_mid the middle of the
/// support, is divided out, and the remainder is interpolated by polynomials on short intervals of
/// D.
/// Source: BB17 section 4 (eq. 10) and, for the distribution, section 5.
class SensitivityTransform {
public:
    /// Throws DomainError for an argument out of range.
    ///   sensitivity   weighted colour-matching functions
    ///   opd_max_nm    largest optical path difference of the table, [0, 1e7]
    ///   accuracy      largest interpolation error, [1e-13, 1e-2]
    ///   variance_nm2  variance of the optical path difference, [0, 1e14]
    SensitivityTransform(const Sensitivity& sensitivity, double opd_max_nm, double accuracy,
                         double variance_nm2 = 0);

    /// H_X, H_Y, H_Z at an optical path difference in [0, opd_max_nm], else DomainError; within
    /// error().
    ComplexTriple operator()(double opd_nm) const;

    /// One of them at a complex path difference, whose imaginary part describes an amplitude
    /// growing or decaying exponentially with nu. Re in [-opd_max_nm, opd_max_nm] and |Im| <=
    /// kSteepest_nm, beyond which the polynomials lose accuracy, else DomainError.
    Complex channel(std::size_t channel, Complex opd_nm) const;

    double opd_max_nm() const { return opd_max_; }
    /// Error bound of a value: interpolation and rounding.
    double error() const { return error_; }
    /// Upper bound on all |H_j| at this path difference and beyond. Inside the table it is the
    /// largest value there; beyond, J/(2 pi D) + V/(2 pi D)^2 from the jumps J of g_j = s_j
    /// dlambda/dnu and the total variation V of its derivative.
    double bound(double opd_nm) const;

    /// Coefficients of one power of x = 2 (D - middle) / kInterval_nm on one interval: real and
    /// imaginary parts for X, Y, Z, and two zeros.
    struct alignas(64) Row {
        std::array<double, 8> value{};
    };
    static constexpr double kInterval_nm = 500;
    static constexpr double kSteepest_nm = kInterval_nm / 2;

    /// Direct access to the table, for loops over many path differences.
    double carrier() const { return carrier_; }  ///< nu_mid
    /// [interval][row]; the intervals are centred on the multiples of kInterval_nm.
    std::span<const Row> table() const { return table_; }
    std::size_t rows() const { return rows_; }                    ///< per interval, x^0 first
    std::span<const double> largest() const { return largest_; }  ///< bound() per interval

private:
    void set_tail(const Sensitivity& sensitivity, double variance_nm2);
    void choose_rows(const SensitivityPoints& points, double accuracy);
    void fill_table(const SensitivityPoints& points);
    void set_largest();
    double tail(double opd_nm) const;  ///< bound() beyond the table

    double opd_max_, carrier_;
    double error_ = 0, at_zero_ = 0;   ///< at_zero_: integral of |s_j|, the largest
    double jump_ = 0, variation_ = 0;  ///< J and V, the largest of the channels
    std::size_t rows_ = 0;
    std::vector<Row> table_;
    std::vector<double> largest_;
};

}  // namespace irido
