#include "core/rough/layered/lobe_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/complex.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/rough/layered/lobe.hpp"

namespace irido {

namespace {

/// Radians below which features near an end are not resolved: they affect only as narrow a range.
constexpr double kNarrowestLobe = 1e-6;

Feature feature_beside(Complex root) {
    return {root.real(), std::max(std::abs(root.imag()), kNarrowestLobe)};
}

}  // namespace

LobeNodes::LobeNodes(double alpha, double theta_i_deg, double top_deg)
    : alpha_(alpha), theta_i_deg_(std::min(theta_i_deg, top_deg)), top_deg_(top_deg) {
    s_ = std::sqrt((1 - alpha) * (1 + alpha));
    rest_ = alpha * alpha / (1 + s_);
    si_ = sin_deg(theta_i_deg_);
    seen_i_ = visibility(alpha, sin_deg(90 - theta_i_deg_), si_);
    c_top_ = sin_deg(90 - top_deg);
    whole_deg_ = 0.5 * (top_deg - theta_i_deg_);
    end_deg_ = 0.5 * (top_deg + theta_i_deg_);

    const double wide = alpha / kDegree;
    const double narrow =
        0.5 / kDegree *
        (top_deg < 90 ? 1e-5
                      : std::min(alpha, std::max(sin_deg(90 - theta_i_deg_), kNarrowestLobe)));
    const std::array<Feature, 3> first{Feature{theta_i_deg_, wide}, Feature{-theta_i_deg_, wide},
                                       Feature{whole_deg_, narrow}};
    before_ = graded_panels(0, whole_deg_, first);
    if (theta_i_deg_ == 0) return;
    std::vector<Feature> second;  // the same in phi, theta_d = whole + theta_i sin^2 phi
    for (const auto& [at, width] : {Feature{theta_i_deg_, wide}, Feature{whole_deg_, narrow},
                                    Feature{end_deg_, narrow}, Feature{0, 0}}) {
        const Complex phi = std::asin(std::sqrt((Complex(at, width) - whole_deg_) / theta_i_deg_));
        second.push_back(feature_beside(phi));
    }
    behind_ = graded_panels(0, 0.5 * kPi, second);
}

double LobeNodes::angle_behind(double theta_d_deg) const {
    return std::asin(std::sqrt(std::clamp((theta_d_deg - whole_deg_) / theta_i_deg_, 0.0, 1.0)));
}

LobeNodes::Ring LobeNodes::ring_at(double theta_d_deg) const {
    Ring ring{};
    const double sd = sin_deg(theta_d_deg), cd = sin_deg(90 - theta_d_deg);
    const double difference = sin_deg(0.5 * (theta_i_deg_ - theta_d_deg));
    ring.P = rest_ + 2 * s_ * difference * difference;
    ring.swing = 2 * s_ * si_ * sd;  // 1 - s cos theta_m = P + swing sin^2(psi/2)
    ring.b = 2 * si_ * sin_deg(2 * theta_d_deg);
    ring.c_last = sin_deg(90 - theta_i_deg_ - 2 * theta_d_deg);
    ring.c_first = sin_deg(90 + theta_i_deg_ - 2 * theta_d_deg);
    ring.c_top = c_top_;
    // cos a - cos top = 2 sin((top + a)/2) sin((top - a)/2)
    const auto above_top = [&](double angle_deg) {
        return 2 * sin_deg(0.5 * (top_deg_ + angle_deg)) * sin_deg(0.5 * (top_deg_ - angle_deg));
    };
    const double first = above_top(std::abs(2 * theta_d_deg - theta_i_deg_));
    const double last = above_top(theta_i_deg_ + 2 * theta_d_deg);
    ring.psi_max =
        last >= 0 ? kPi : 2 * std::atan2(std::sqrt(std::max(first, 0.0)), std::sqrt(-last));
    if (first <= 0) ring.c_first = ring.c_top;
    // D = alpha^2 / (pi spread^2)
    ring.scale = 2 * cd * sd * alpha_ * alpha_ / kPi * seen_i_;
    return ring;
}

std::vector<double> LobeNodes::panels_of(const Ring& ring) const {
    const double end = std::sqrt(ring.psi_max);
    const double peak =
        ring.swing > 0 ? 2 * std::atanh(std::sqrt(ring.P / (ring.P + ring.swing))) : kPi;
    // cos o - top is roughly left + tilt x + b/4 x^2 at a distance x = u^2 from the end
    const double left = std::max(0.0, ring.c_last - ring.c_top);
    const double tilt = 0.5 * ring.b * std::sin(ring.psi_max);
    const auto distance = [&](double rise) {
        return ring.b > 0 ? 2 * rise / (tilt + std::sqrt(tilt * tilt + ring.b * rise)) : kPi;
    };
    const double masking = distance(std::hypot(left + ring.c_top, alpha_));
    std::vector<Feature> features{
        feature_beside(std::sqrt(Complex(ring.psi_max, std::min(peak, kPi)))),
        {0, std::sqrt(std::clamp(masking, kNarrowestLobe, kPi))}};
    if (top_deg_ < 90) {  // the root of E, and its continuation on the other side
        const double far = ring.b > 0 ? 4 * tilt / ring.b : kPi;
        const double near = left > 0 ? distance(left) : far;
        features.push_back({0, std::sqrt(std::clamp(near, kNarrowestLobe, kPi))});
    }
    return graded_panels(0, end, features);
}

LobeNodes::Node LobeNodes::node_at(const Ring& ring, double u) const {
    const double sine = std::sin(0.5 * (ring.psi_max - u * u));
    const double drop = sine * sine;
    const double cos_o = std::max(ring.c_first - ring.b * drop, ring.c_top);
    const double near = ring.P + ring.swing * drop, spread = near * (2 - near);
    const double seen_o =
        visibility(alpha_, cos_o, std::sqrt(std::max(0.0, (1 - cos_o) * (1 + cos_o))));
    return {cos_o, ring.scale * 2 * u * cos_o * seen_o / (spread * spread)};
}

double LobeNodes::weight(double theta_d_deg,
                         const std::function<double(double cos_o)>& exit) const {
    double sum = 0;
    over_psi(theta_d_deg, [&](double cos_o, double weight) { sum += weight * exit(cos_o); });
    return sum;
}

WeightedAngles LobeNodes::over_theta_d(double begin_deg, double end_deg) const {
    WeightedAngles nodes;
    const auto add = [&](double theta, double weight_deg) {
        nodes.theta_deg.push_back(theta);
        nodes.weight.push_back(kDegree * weight_deg);
    };
    for_each_node(before_, begin_deg, end_deg, add);
    if (behind_.empty()) return nodes;
    const double from = angle_behind(begin_deg), to = angle_behind(end_deg);
    for_each_node(behind_, from, to, [&](double phi, double weight_phi) {
        const double sine = std::sin(phi);
        add(whole_deg_ + theta_i_deg_ * sine * sine,
            2 * theta_i_deg_ * sine * std::cos(phi) * weight_phi);
    });
    return nodes;
}

}  // namespace irido
