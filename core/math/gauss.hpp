#pragma once

#include <array>
#include <boost/math/quadrature/gauss.hpp>

namespace irido {

/// One point of a quadrature rule on [-1, 1].
struct GaussNode {
    double x;
    double weight;
};

/// Gauss-Legendre rule with an even number `count` of points on [-1, 1], exact for polynomials of
/// degree below 2 count.
template <int count>
const std::array<GaussNode, count>& gauss_legendre() {
    static_assert(count % 2 == 0);
    static const std::array<GaussNode, count> rule = [] {
        using Rule = boost::math::quadrature::gauss<double, count>;
        std::array<GaussNode, count> nodes{};
        for (int i = 0; i < count / 2; ++i) {
            const auto half = static_cast<std::size_t>(i);
            const auto mirror = static_cast<std::size_t>(count / 2 - 1 - i);
            const double x = Rule::abscissa()[half], weight = Rule::weights()[half];
            nodes[count / 2 + half] = {x, weight};
            nodes[mirror] = {-x, weight};
        }
        return nodes;
    }();
    return rule;
}

}  // namespace irido
