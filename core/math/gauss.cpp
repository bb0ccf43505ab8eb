#include "core/math/gauss.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

namespace irido {

template <std::size_t count>
const std::array<GaussNode, count>& gauss_legendre() {
    static_assert(count % 2 == 0);
    static const std::array<GaussNode, count> rule = [] {
        using Rule = boost::math::quadrature::gauss<double, count>;
        std::array<GaussNode, count> nodes{};
        for (std::size_t i = 0; i < count / 2; ++i) {
            const double x = Rule::abscissa()[i], weight = Rule::weights()[i];
            nodes[count / 2 + i] = {x, weight};
            nodes[count / 2 - 1 - i] = {-x, weight};
        }
        return nodes;
    }();
    return rule;
}

const std::array<KronrodNode, 21>& kronrod() {
    static const std::array<KronrodNode, 21> rule = [] {
        using Kronrod = boost::math::quadrature::gauss_kronrod<double, 21>;
        using Gauss = boost::math::quadrature::gauss<double, 10>;
        std::array<KronrodNode, 21> nodes{};
        for (int i = -10; i <= 10; ++i) {
            const auto node = static_cast<std::size_t>(std::abs(i));
            nodes[static_cast<std::size_t>(i + 10)] = {
                std::copysign(Kronrod::abscissa()[node], i), Kronrod::weights()[node],
                node % 2 == 1 ? Gauss::weights()[node / 2] : 0};
        }
        return nodes;
    }();
    return rule;
}

template const std::array<GaussNode, 2>& gauss_legendre();
template const std::array<GaussNode, 4>& gauss_legendre();
template const std::array<GaussNode, 6>& gauss_legendre();
template const std::array<GaussNode, 8>& gauss_legendre();
template const std::array<GaussNode, 10>& gauss_legendre();
template const std::array<GaussNode, 16>& gauss_legendre();
template const std::array<GaussNode, 20>& gauss_legendre();
template const std::array<GaussNode, 24>& gauss_legendre();
template const std::array<GaussNode, 40>& gauss_legendre();
template const std::array<GaussNode, 60>& gauss_legendre();

}  // namespace irido
