#include "core/rough/albedo.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/coherent/coherent.hpp"
#include "core/color/stack_color.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/gauss.hpp"
#include "core/math/parallel.hpp"
#include "core/rough/filter.hpp"
#include "core/rough/ggx.hpp"

// Directional albedo as an integral over the half angle.
//
// The half vector h is the facet's normal, and dw_o = 4 (i.h) dw_h:
//
//     E = integral D(h) G2(i, o) R(td) (i.h) / cos ti  dw_h,    cos td = i.h.
//
// With i as the pole, dw_h = sin td dtd dpsi, and both other cosines are linear in cos psi:
//
//     x   = cos theta_h = cos ti cos td + sin ti sin td cos psi
//     c_o = cos theta_o = cos ti cos 2td + sin ti sin 2td cos psi     (o is i turned by 2 td)
//
// R depends on td alone, so E = integral R(td) W(td) dtd, and any quantity linear in R, such as X,
// Y and Z, is integrated the same way:
//
//     W = 2 cos td sin td integral_0^psi_max D(x) (G2 / cos ti) dpsi
//     G2 / cos ti = 2 c_o / (c_o A_i + cos ti A_o),   A = sqrt(alpha^2 + (1 - alpha^2) cos^2)
//
// psi ends where o drops below the surface, c_o = 0: at tan^2(psi_max/2) = cos(ti - 2td) : -cos(ti
// + 2td). It reaches pi as long as ti + 2 td <= 90 degrees, and W ends at td = (90 + ti)/2. There x
// > 0 wherever c_o > 0, since x = (cos ti + c_o)/(2 cos td).
//
// As functions of psi, D has a pole at psi = 2 i artanh(sqrt(P-/M-)) with filter.hpp's P- and M-,
// and G2 has branch points where c_o = +-i alpha / s and where c_o = -cos ti. The variable is t =
// tan(psi/4), of which sin(psi/2) and dpsi/dt are rational functions. As a function of td,
// W has a peak of width alpha at td = ti, and near both ends of its second part it behaves as the
// power 3/2 of the distance; it is smooth in phi with td = t0 + (t1 - t0) sin^2 phi.

namespace irido {

namespace {

/// Angle from grazing, radians, below which the features of G2 are not resolved: they affect only
/// as narrow a range.
constexpr double kNarrowest = 1e-6;

/// A cosine above 0.
constexpr double kSmallest = 1e-300;

/// Tolerance from which on there are few nodes.
constexpr double kForFew = 1e-6;

/// for_each_node() over all of the panels or a part, of a rule of few or many points each.
template <int few, int many, class Add>
void for_each_node_of(bool are_few, std::span<const double> ends, double begin, double end,
                      const Add& add) {
    if (are_few)
        for_each_node<few>(ends, begin, end, add);
    else
        for_each_node<many>(ends, begin, end, add);
}

}  // namespace

AlbedoNodes::AlbedoNodes(double alpha, double theta_i_deg, double tolerance)
    : alpha_(alpha), theta_i_deg_(theta_i_deg), are_few_(tolerance >= kForFew) {
    require_in_range("alpha", alpha, kSmoothest, kRoughest);
    require_in_range("theta_i_deg", theta_i_deg, 0, 90);
    s_ = std::sqrt((1 - alpha) * (1 + alpha));
    rest_ = alpha * alpha / (1 + s_);
    ci_ = sin_deg(90 - theta_i_deg);
    si_ = sin_deg(theta_i_deg);
    seen_i_ = std::hypot(alpha, s_ * ci_);
    whole_deg_ = 0.5 * (90 - theta_i_deg);
    end_deg_ = 0.5 * (90 + theta_i_deg);

    const double wide = alpha / kDegree;
    const double narrow = 0.5 * std::min(alpha, std::max(ci_, kNarrowest)) / kDegree;
    const std::array<Feature, 3> first{Feature{theta_i_deg, wide}, Feature{-theta_i_deg, wide},
                                       Feature{whole_deg_, narrow}};
    before_ = graded_panels(0, whole_deg_, first);
    if (theta_i_deg == 0) return;
    // the same features in phi, and the logarithm at theta_d = 0
    std::vector<Feature> second;
    for (const auto& [at, width] : {Feature{theta_i_deg, wide}, Feature{whole_deg_, narrow},
                                    Feature{end_deg_, narrow}, Feature{0, 0}}) {
        const Complex phi = std::asin(std::sqrt((Complex(at, width) - whole_deg_) / theta_i_deg));
        second.push_back({phi.real(), std::max(std::abs(phi.imag()), kNarrowest)});
    }
    behind_ = graded_panels(0, 0.5 * kPi, second);
}

double AlbedoNodes::weight(double theta_d_deg) const {
    const double sd = sin_deg(theta_d_deg), cd = sin_deg(90 - theta_d_deg);
    const double difference = sin_deg(0.5 * (theta_i_deg_ - theta_d_deg));
    const double P = rest_ + 2 * s_ * difference * difference;
    const double swing = 2 * s_ * si_ * sd;               // 1 - s x = P + swing sin^2(psi/2)
    const double b = 2 * si_ * sin_deg(2 * theta_d_deg);  // twice the slope of c_o in cos psi
    const double c_last = sin_deg(90 - theta_i_deg_ - 2 * theta_d_deg);  // c_o at psi = pi
    const double c_first = sin_deg(90 + theta_i_deg_ - 2 * theta_d_deg);
    if (c_first <= 0) return 0;
    const bool is_whole = c_last >= 0;
    // t at psi_max, and sin psi_max
    const double root_first = std::sqrt(c_first), root_last = std::sqrt(std::max(-c_last, 0.0));
    const double t_max = is_whole ? 1 : root_first / (root_last + std::sqrt(c_first - c_last));
    const double sine_max = is_whole ? 0 : 2 * root_first * root_last / (c_first - c_last);

    // where D and G2 vary
    const double peak = swing > 0 ? std::sqrt(P) / (std::sqrt(P + swing) + std::sqrt(swing)) : 1;
    const double low = std::min(alpha_, std::max(ci_, kNarrowest)) + std::max(c_last, 0.0);
    const double tilt = 0.5 * b * sine_max;
    const double foot =
        b > 0 ? 0.5 * (1 + t_max * t_max) * low / (tilt + std::sqrt(tilt * tilt + b * low)) : 1;
    const std::array<Feature, 2> features{Feature{0, peak}, Feature{t_max, std::min(foot, 1.0)}};
    const std::vector<double> ends = graded_panels(0, t_max, features);
    double sum = 0;
    const auto add = [&](double t, double weight) {
        const double slope = 4 / (1 + t * t);              // of psi
        const double drop = 0.25 * t * t * slope * slope;  // sin^2(psi/2)
        const double c_o = std::max(c_first - b * drop, kSmallest);
        const double near = P + swing * drop, spread = near * (2 - near);
        const double seen_o = std::sqrt(alpha_ * alpha_ + s_ * s_ * c_o * c_o);
        sum += weight * slope * c_o / ((c_o * seen_i_ + ci_ * seen_o) * spread * spread);
    };
    for_each_node_of<6, 10>(are_few_, ends, 0, t_max, add);
    // D = alpha^2 / (pi spread^2), G2/cos ti = 2 c_o / (...)
    return 4 * cd * sd * alpha_ * alpha_ / kPi * sum;
}

WeightedAngles AlbedoNodes::operator()(double begin_deg, double end_deg) const {
    WeightedAngles nodes;
    const auto add = [&](double theta, double weight_deg) {
        nodes.theta_deg.push_back(theta);
        nodes.weight.push_back(kDegree * weight_deg * weight(theta));
    };
    for_each_node_of<10, 16>(are_few_, before_, begin_deg, end_deg, add);
    const auto phi_of = [&](double theta) {
        const double part = (theta - whole_deg_) / theta_i_deg_;
        return std::asin(std::sqrt(std::clamp(part, 0.0, 1.0)));
    };
    if (behind_.empty()) return nodes;
    const auto add_behind = [&](double phi, double weight_phi) {
        const double sine = std::sin(phi);
        add(whole_deg_ + theta_i_deg_ * sine * sine,
            2 * theta_i_deg_ * sine * std::cos(phi) * weight_phi);
    };
    for_each_node_of<10, 16>(are_few_, behind_, phi_of(begin_deg), phi_of(end_deg), add_behind);
    return nodes;
}

double AlbedoNodes::error() const {
    return are_few_ ? 1e-7 : 1e-11;  // measured: 7e-8, and at grazing 1e-12
}

RoughAlbedo::RoughAlbedo(const ColorTables& tables, const Stack& stack, const ColorRequest& request,
                         unsigned threads)
    : tolerance_(request.tolerance), colors_([&] {
          // the series cannot be more accurate than its colours
          ColorRequest exactly = request;
          exactly.sides = {Side::reflected};
          exactly.tolerance = std::max(1e-12, 0.1 * request.tolerance);
          exactly.colors = 200;
          const auto algorithm = color_algorithm(tables, stack, {}, exactly);
          return AngleSeries(3, 0.5 * request.tolerance, [&](std::span<const double> theta_deg) {
              constexpr std::size_t kTogether = 16;
              std::vector<StackColor> colors(theta_deg.size());
              parallel_for((colors.size() + kTogether - 1) / kTogether, threads,
                           [&](std::size_t block) {
                               const std::size_t begin = block * kTogether;
                               const std::size_t count = std::min(kTogether, colors.size() - begin);
                               (*algorithm)(stack, theta_deg.subspan(begin, count),
                                            std::span(colors).subspan(begin, count));
                           });
              std::vector<double> xyz;
              for (const StackColor& color : colors) {
                  xyz.insert(xyz.end(), color.xyz.begin(), color.xyz.end());
                  color_error_ = std::max(color_error_, color.error);
              }
              return xyz;
          });
      }()) {}

std::vector<RoughAlbedo::Value> RoughAlbedo::operator()(double alpha,
                                                        std::span<const double> cos_theta_i) const {
    std::vector<Value> values;
    for (const double cosine : cos_theta_i) {
        require_in_range("cos_theta_i", cosine, 0, 1);
        const double theta_deg = std::acos(cosine) / kDegree;
        Value& value = values.emplace_back();
        if (alpha == 0) {
            for (std::size_t c = 0; c < 3; ++c)
                value.xyz[c] = std::max(0.0, colors_.value(c, theta_deg));
            value.error = color_error_ + colors_.error_at(theta_deg);
            continue;
        }
        const AlbedoNodes nodes(alpha, std::min(theta_deg, 90.0), tolerance_);
        AngleMoments moments(nodes);
        for (std::size_t c = 0; c < 3; ++c) {
            const AngleMoments::Integral integral = moments(colors_, c);
            value.xyz[c] = std::max(0.0, integral.value);
            value.error = std::max(value.error,
                                   integral.error + color_error_ * integral.weight + nodes.error());
        }
    }
    return values;
}

}  // namespace irido
