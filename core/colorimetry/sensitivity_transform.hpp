#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/complex.hpp"

namespace irido {

/// Of X, Y, Z.
using ComplexTriple = std::array<Complex, 3>;

/// Quadrature of the sensitivity over its support: Gauss points in every cell, where it is
/// quadratic, as many as waves of optical paths up to `opd_max_nm` need (to 1e-14 of the white).
struct SensitivityPoints {
    std::vector<double> wavenumber;             ///< nu = 1 / wavelength, 1/nm
    std::array<std::vector<double>, 3> weight;  ///< of X, Y, Z
};

/// opd_max_nm  [0, 2e7], else DomainError
SensitivityPoints sensitivity_points(const Sensitivity& sensitivity, double opd_max_nm);

/// One channel's part of the spectrum as two points, those of its Gauss rule: they have its first
/// four moments. One point stands for both where nothing may vary.
struct ChannelPoints {
    std::array<double, 2> nu{}, weight{};
    double centroid() const { return weight[0] * nu[0] + weight[1] * nu[1]; }
};

std::array<ChannelPoints, 3> channel_points(const Sensitivity& sensitivity);

/// H_j(D) of SensitivityTransform summed over the points, for one path; the points must reach it.
ComplexTriple transform_at(const SensitivityPoints& points, double opd_nm, double variance_nm2 = 0);

/// Fourier transform of the sensitivity over the wavenumber nu = 1/lambda,
///     H_j(D) = integral s_j(lambda) exp(2 pi i D / lambda) exp(-2 pi^2 var / lambda^2) dlambda,
/// of an optical path D in nm, j = X, Y, Z: what a fringe of that path adds to the colour, H_j(0)
/// being the white. A Gaussian spread of the path with variance var (in nm^2) is part of the
/// integral, not of the table.
///
/// Tabulated for fast look-up: the carrier exp(2 pi i D nu_mid), nu_mid being the middle of the
/// support, is divided out and what is left interpolated by polynomials on short intervals of D.
/// Source: BB17 section 4 (eq. 10) and, for the spread, section 5.
class SensitivityTransform {
public:
    /// opd_max_nm    longest path of the table, [0, 1e7]
    /// accuracy      largest error of the interpolation, [1e-13, 1e-2]
    /// variance_nm2  [0, 1e14]
    /// Throws DomainError.
    SensitivityTransform(const Sensitivity& sensitivity, double opd_max_nm, double accuracy,
                         double variance_nm2 = 0);

    /// H_X, H_Y, H_Z at a path in [0, opd_max_nm], else DomainError; within error().
    ComplexTriple operator()(double opd_nm) const;

    /// One of them at a complex path, whose imaginary part is an amplitude that grows or falls
    /// exponentially with nu: Re in [-opd_max_nm, opd_max_nm], |Im| <= kSteepest_nm,
    /// beyond which the polynomials lose their accuracy, else DomainError.
    Complex channel(std::size_t channel, Complex opd_nm) const;

    double opd_max_nm() const { return opd_max_; }
    /// Bound of the error of a value: interpolation and rounding.
    double error() const { return error_; }
    /// No |H_j| is larger at this path or a longer one. In the table: the largest value there;
    /// beyond it, from the jumps J of g_j = s_j dlambda/dnu and the total variation V of its
    /// derivative, J/(2 pi D) + V/(2 pi D)^2.
    double bound(double opd_nm) const;

    /// Coefficients of one power of x = 2 (D - middle) / kInterval_nm on one interval: real and
    /// imaginary parts of X, Y, Z, and two zeros.
    struct alignas(64) Row {
        std::array<double, 8> value{};
    };
    static constexpr double kInterval_nm = 500;
    static constexpr double kSteepest_nm = kInterval_nm / 2;

    /// What a loop over many paths reads.
    double carrier() const { return carrier_; }  ///< nu_mid
    /// [interval][row]; the middles of the intervals are the multiples of kInterval_nm.
    std::span<const Row> table() const { return table_; }
    std::size_t rows() const { return rows_; }                    ///< of an interval, x^0 first
    std::span<const double> largest() const { return largest_; }  ///< bound() of each interval

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
