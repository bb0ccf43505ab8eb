#include "core/rough/filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/vector_math.hpp"
#include "core/rough/filter_row.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

namespace {

constexpr double kHalfDegree = std::numbers::pi / 360;

double checked(const char* name, double theta_deg) {
    require_in_range(name, theta_deg, 0, 90);
    return theta_deg;
}

/// J1 + J2 for one sign of x. `end` is s sqrt(A B) with the sign of -q; `slope` is sqrt(A B) / A.
double both_integrals(double P, double M, double end, double slope) {
    const double PM = P * M, root = std::sqrt(PM);
    const double J1 = (kPi - 2 * std::atan(P * slope / root)) / root;
    return J1 + (0.5 * (P + M) * J1 + end) / PM;
}

}  // namespace

HalfAngles::HalfAngles(double theta_deg)
    : deg(theta_deg),
      sin(std::sin(theta_deg * kHalfDegree)),
      cos(std::cos(theta_deg * kHalfDegree)),
      sin_left(std::sin((90 - theta_deg) * kHalfDegree)),
      cos_left(std::cos((90 - theta_deg) * kHalfDegree)) {}

FilterAxis::FilterAxis(std::span<const double> theta_deg, const char* name, SimdLevel level)
    : count_(theta_deg.size()), stride_(theta_deg.size() + kMostLanes), values_(5 * stride_) {
    for (const double theta : theta_deg) require_in_range(name, theta, 0, 90);
    const auto row = [&](std::size_t i) {
        return std::span(values_).subspan(i * stride_, stride_);
    };
    std::ranges::copy(theta_deg, row(0).begin());
    if (level == SimdLevel::plain) {
        for (std::size_t i = 0; i < stride_; ++i) {
            const HalfAngles half(values_[i]);
            row(1)[i] = half.sin;
            row(2)[i] = half.cos;
            row(3)[i] = half.sin_left;
            row(4)[i] = half.cos_left;
        }
        return;
    }
    std::vector<double> half(stride_), left(stride_);
    for (std::size_t i = 0; i < stride_; ++i) {
        half[i] = values_[i] * kHalfDegree;
        left[i] = (90 - values_[i]) * kHalfDegree;
    }
    sin_cos(half, row(1), row(2), level);
    sin_cos(left, row(3), row(4), level);
}

TransmissionFilter::TransmissionFilter(double alpha) : alpha_(alpha) {
    require_in_range("alpha", alpha, kSmoothest, kRoughest);
    s_ = std::sqrt((1 - alpha) * (1 + alpha));
    rest_ = alpha * alpha / (1 + s_);
}

double TransmissionFilter::scale(const HalfAngles& theta_i) const {
    const double ci = 2 * theta_i.sin_left * theta_i.cos_left;
    const double tilt = 2 * alpha_ * theta_i.sin * theta_i.cos;
    const double seen = 2 / (ci + std::sqrt(ci * ci + tilt * tilt));  // G1 / cos ti
    return 2 * seen * seen * ci * alpha_ * alpha_ / (4 * kPi);
}

double TransmissionFilter::operator()(double theta_i_deg, double theta_d_deg) const {
    return (*this)(HalfAngles(checked("theta_i_deg", theta_i_deg)),
                   HalfAngles(checked("theta_d_deg", theta_d_deg)));
}

TransmissionFilter::Rings TransmissionFilter::rings(const HalfAngles& i,
                                                    const HalfAngles& d) const {
    const double difference = std::sin((i.deg - d.deg) * kHalfDegree);
    const double sin_sum = i.sin * d.cos + i.cos * d.sin;
    const double cos_sum = i.sin_left * d.cos_left + i.cos_left * d.sin_left;
    const double P = rest_ + 2 * s_ * difference * difference;
    const double M_minus = rest_ + 2 * s_ * sin_sum * sin_sum;
    const double M_plus = rest_ + 2 * s_ * cos_sum * cos_sum;

    // sin(ti + td - 90) as 2 sin cos of half the angle
    const double past = (std::max(i.deg, d.deg) - 90) + std::min(i.deg, d.deg);
    const double B =
        std::max(0.0, std::numbers::sqrt2 * std::sin(past * kHalfDegree) * (sin_sum + cos_sum));
    const double A =
        4 * (i.sin_left * i.cos_left * d.sin_left * d.cos_left + i.sin * i.cos * d.sin * d.cos);
    const double mean = std::sqrt(A * B), slope = B > 0 ? mean / A : 0;
    return {both_integrals(P, M_minus, s_ * mean, slope) +
                both_integrals(2 - P, M_plus, -s_ * mean, slope),
            B > 0 ? both_integrals(P, M_minus, 0, 0) + both_integrals(2 - P, M_plus, 0, 0) : 0};
}

double TransmissionFilter::operator()(const HalfAngles& i, const HalfAngles& d) const {
    const double sin_d = 2 * d.sin * d.cos, cos_d = 2 * d.sin_left * d.cos_left;
    return scale(i) * cos_d * sin_d * rings(i, d).seen;
}

double TransmissionFilter::behind(double theta_i_deg, double theta_d_deg) const {
    const HalfAngles i(checked("theta_i_deg", theta_i_deg)), d(checked("theta_d_deg", theta_d_deg));
    const double sin_d = 2 * d.sin * d.cos, cos_d = 2 * d.sin_left * d.cos_left;
    const Rings ring = rings(i, d);
    if (ring.whole == 0) return 0;
    const double ci = 2 * i.sin_left * i.cos_left, tilt = 2 * alpha_ * i.sin * i.cos;
    const double seen = 2 / (ci + std::sqrt(ci * ci + tilt * tilt));
    return 2 * seen * alpha_ * alpha_ / (4 * kPi) * cos_d * sin_d *
           std::max(0.0, ring.whole - ring.seen);
}

void TransmissionFilter::row(double theta_i_deg, const FilterAxis& theta_d, std::span<double> out,
                             SimdLevel level) const {
    const HalfAngles i(checked("theta_i_deg", theta_i_deg));
    if (level != SimdLevel::plain)
        return filter_row({i, scale(i), s_, rest_}, theta_d, out.data(), level);
    for (std::size_t k = 0; k < theta_d.count(); ++k)
        out[k] = (*this)(i, HalfAngles(theta_d.deg()[k]));
}

}  // namespace irido
