#include "core/rough/filter_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "core/complex.hpp"
#include "core/math/constants.hpp"

namespace irido {

namespace {

Feature feature_at(Complex root) {
    return {root.real(), std::abs(root.imag())};
}

}  // namespace

FilterNodes::FilterNodes(const TransmissionFilter& filter, double theta_i_deg, SimdLevel simd,
                         Facets facets)
    : filter_(filter),
      theta_i_deg_(theta_i_deg),
      kink_deg_(90 - theta_i_deg),
      simd_(simd),
      facets_(facets) {
    // zeros of P- and M-, at least alpha away from the axis
    const double alpha_deg = filter.alpha() / kDegree;
    const std::array<Feature, 2> peaks{Feature{theta_i_deg, alpha_deg},
                                       Feature{-theta_i_deg, alpha_deg}};
    if (facets == Facets::seen) before_ = graded_panels(0, kink_deg_, peaks);
    // the same, and M+ and the logarithm at theta_d = 0, in the plane of v
    const std::array<Feature, 3> past{
        feature_at(std::sqrt(Complex(theta_i_deg - kink_deg_, alpha_deg))),
        feature_at(std::sqrt(Complex(180 - theta_i_deg - kink_deg_, alpha_deg))),
        Feature{0, std::sqrt(kink_deg_)}};
    behind_ = graded_panels(0, std::sqrt(theta_i_deg), past);
}

WeightedAngles FilterNodes::operator()(double begin_deg, double end_deg) const {
    WeightedAngles nodes;
    for_each_node(before_, begin_deg, end_deg, [&](double theta, double weight) {
        nodes.theta_deg.push_back(theta);
        nodes.weight.push_back(kDegree * weight);
    });
    const auto from_kink = [&](double theta) {
        return std::sqrt(std::max(0.0, theta - kink_deg_));
    };
    for_each_node(behind_, from_kink(begin_deg), from_kink(end_deg), [&](double v, double weight) {
        nodes.theta_deg.push_back(std::min(90.0, kink_deg_ + v * v));
        nodes.weight.push_back(kDegree * 2 * v * weight);
    });
    if (facets_ == Facets::behind) {
        for (std::size_t i = 0; i < nodes.weight.size(); ++i)
            nodes.weight[i] *= filter_.behind(theta_i_deg_, nodes.theta_deg[i]);
        return nodes;
    }
    const FilterAxis axis(nodes.theta_deg, "theta_d_deg", simd_);
    std::vector<double> filter(axis.count());
    filter_.row(theta_i_deg_, axis, filter, simd_);
    for (std::size_t i = 0; i < filter.size(); ++i) nodes.weight[i] *= filter[i];
    return nodes;
}

}  // namespace irido
