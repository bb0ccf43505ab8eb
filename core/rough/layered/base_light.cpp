#include "core/rough/layered/base_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/parallel.hpp"
#include "core/rough/ggx.hpp"
#include "core/rough/layered/lobe.hpp"

namespace irido {

namespace {

/// Tolerance from which on rules of fewer nodes do.
constexpr double kCoarse = 1e-6;

/// The integral over psi for facets of tilt tm; `rise` = 90 - tm - td, in degrees.
template <int points>
double over_ring(double alpha, double cm, double sm, double cd, double sd, double rise_deg) {
    // cos o = level - swing cos psi; it ends where that is 0
    const double level = cm * cd, swing = sm * sd;
    const double lowest = sin_deg(rise_deg);  // cos(tm + td)
    const bool is_whole = lowest >= 0;
    const double begin = is_whole ? 0 : std::acos(std::clamp(level / swing, 0.0, 1.0));
    // cos o as a function of x = psi - begin rises as lowest + tilt x + swing/2 x^2
    const double tilt = swing * std::sin(begin);
    const double rise = alpha + std::max(0.0, lowest);
    const double width = 2 * rise / (tilt + std::sqrt(tilt * tilt + 2 * swing * rise) + 1e-300);
    const std::array<Feature, 1> foot{Feature{begin, std::clamp(width, 1e-6, kPi)}};
    double sum = 0, from = begin;
    for (const double to : graded_panels(begin, 0.5 * kPi, foot)) {
        for (const GaussNode& node : gauss_legendre<points>()) {
            const double psi = 0.5 * ((from + to) + (to - from) * node.x);
            const double half = std::sin(0.5 * psi);
            const double ci = std::min(1.0, level + swing * std::cos(psi));
            const double co = lowest + 2 * swing * half * half;
            if (co <= 0) continue;
            const auto masked = [&](double c) {
                return c * visibility(alpha, c, std::sqrt(std::max(0.0, (1 - c) * (1 + c))));
            };
            sum += 0.5 * (to - from) * node.weight * masked(ci) * masked(co);
        }
        from = to;
    }
    return sum;
}

template <int points, int ring_points>
double base_light(double alpha, double theta_d_deg) {
    if (theta_d_deg <= 0 || theta_d_deg >= 90) return 0;
    const double cd = sin_deg(90 - theta_d_deg), sd = sin_deg(theta_d_deg);
    const double kink = 90 - theta_d_deg;
    const double narrow = 0.5 * alpha * std::min(1.0, 1 / sd) / kDegree;
    const std::array<Feature, 2> features{Feature{0, alpha / kDegree}, Feature{kink, narrow}};
    double sum = 0;
    const auto add = [&](double begin_deg, double end_deg) {
        const std::vector<double> ends = graded_panels(begin_deg, end_deg, features);
        for_each_node<points>(ends, begin_deg, end_deg, [&](double tm_deg, double weight_deg) {
            const double cm = sin_deg(90 - tm_deg), sm = sin_deg(tm_deg);
            const double spread = alpha * alpha * cm * cm + sm * sm;
            const double D = alpha * alpha / (kPi * spread * spread);
            sum += kDegree * weight_deg * sm * D *
                   over_ring<ring_points>(alpha, cm, sm, cd, sd, kink - tm_deg);
        });
    };
    add(0, kink);
    add(kink, 90);
    return 8 * cd * sd * sum;
}

}  // namespace

BaseLight::BaseLight(double alpha, unsigned threads, double tolerance)
    : series_(1, tolerance, [&](std::span<const double> theta_deg) {
          require_in_range("alpha", alpha, kSmoothest, kRoughest);
          std::vector<double> values(theta_deg.size());
          parallel_for(values.size(), threads, [&](std::size_t i) {
              values[i] = tolerance < kCoarse ? base_light<16, 10>(alpha, theta_deg[i])
                                              : base_light<8, 6>(alpha, theta_deg[i]);
          });
          return values;
      }) {}

AngleMoments BaseLight::moments() const {
    return AngleMoments([this](double begin_deg, double end_deg) {
        WeightedAngles nodes;
        for (const AngleSeries::Panel& panel : series_.panels()) {
            const double from = std::max(begin_deg, panel.begin_deg());
            const double to = std::min(end_deg, panel.end_deg());
            if (!(from < to)) continue;
            for (const GaussNode& node : gauss_legendre<20>()) {
                const double theta = 0.5 * ((from + to) + (to - from) * node.x);
                nodes.theta_deg.push_back(theta);
                nodes.weight.push_back(kDegree * 0.5 * (to - from) * node.weight * weight(theta));
            }
        }
        return nodes;
    });
}

}  // namespace irido
