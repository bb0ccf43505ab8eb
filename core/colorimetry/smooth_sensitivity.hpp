#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"

namespace irido {

/// The sensitivity over the wavenumber nu = 1/lambda without what turns faster than waves of an
/// optical path: its Fourier integral H_j(D) (see SensitivityTransform), cut off smoothly between
/// kFlat opd_nm and opd_nm. What a spectrum without faster fringes integrates to is the same, but
/// the kinks between the rows are gone, so that a sum over equally spaced points is exact as soon
/// as it resolves both. Tabulated over nu, for cubic interpolation.
class SmoothSensitivity {
public:
    /// opd_nm  [1e3, 1e7], else DomainError
    SmoothSensitivity(const Sensitivity& sensitivity, double opd_nm);

    double opd_nm() const { return opd_; }

    /// Per unit of nu, nm: integrals over nu are those of Sensitivity over the wavelength. Its
    /// tails reach beyond the support; nu inside reach(), else DomainError.
    Triple at(double nu) const;

    /// X, Y, Z and a zero.
    struct alignas(32) Row {
        std::array<double, 4> value{};
    };
    /// What a loop over many points reads: rows at nu = first + i / per_nu.
    const std::vector<Row>& rows() const { return rows_; }
    double first() const { return first_; }
    double per_nu() const { return per_nu_; }

    struct Reach {
        double low, high;
    };
    /// Of nu: the support and kTail of its width on either side.
    Reach reach() const { return reach_; }

    static constexpr double kFlat = 0.6;
    static constexpr double kTail = 0.08;

private:
    double opd_, first_ = 0, per_nu_ = 0;
    Reach reach_{};
    std::vector<Row> rows_;
};

/// Bounds of the sensitivity's Fourier integral.
class SensitivityDecay {
public:
    explicit SensitivityDecay(const Sensitivity& sensitivity);

    /// No |H_j| is larger at this path, nm, or a longer one: the largest seen up to kLongest_nm,
    /// beyond it falling as 1/D at least.
    double operator()(double opd_nm) const;

    static constexpr double kLongest_nm = 4e6;

private:
    double step_nm_ = 0;
    std::vector<double> largest_;
};

}  // namespace irido
