#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"

namespace irido {

/// Weighted colour-matching functions over the wavenumber nu = 1/lambda, low-pass filtered: their
/// Fourier integral H_j(D) (see SensitivityTransform) is cut off smoothly between kFlat opd_nm and
/// opd_nm. A spectrum without faster fringes integrates to the same value, but the kinks between
/// rows are gone, so a sum over equally spaced points is exact as soon as it resolves both.
/// Tabulated over nu for cubic interpolation.
class SmoothSensitivity {
public:
    /// opd_nm in [1e3, 1e7], else DomainError.
    SmoothSensitivity(const Sensitivity& sensitivity, double opd_nm);

    double opd_nm() const { return opd_; }

    /// Per unit of nu, in nm: integrals over nu equal those of Sensitivity over the wavelength. The
    /// tails extend beyond the support; nu must be inside reach(), else DomainError.
    Triple at(double nu) const;

    /// X, Y, Z and a zero.
    struct alignas(32) Row {
        std::array<double, 4> value{};
    };
    /// Direct access for loops over many points: rows at nu = first + i / per_nu.
    const std::vector<Row>& rows() const { return rows_; }
    double first() const { return first_; }
    double per_nu() const { return per_nu_; }

    struct Reach {
        double low, high;
    };
    /// Range of nu: the support plus kTail of its width on either side.
    Reach reach() const { return reach_; }

    static constexpr double kFlat = 0.6;
    static constexpr double kTail = 0.08;

private:
    double opd_, first_ = 0, per_nu_ = 0;
    Reach reach_{};
    std::vector<Row> rows_;
};

/// Decaying upper bound on the Fourier integral of the weighted colour-matching functions.
class SensitivityDecay {
public:
    explicit SensitivityDecay(const Sensitivity& sensitivity);

    /// Upper bound on all |H_j| at this optical path difference (nm) and beyond: the largest
    /// sampled up to kLongest_nm, beyond that decaying at least as 1/D.
    double operator()(double opd_nm) const;

    static constexpr double kLongest_nm = 4e6;

private:
    double step_nm_ = 0;
    std::vector<double> largest_;
};

}  // namespace irido
