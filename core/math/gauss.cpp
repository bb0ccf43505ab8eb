#include "core/math/gauss.hpp"

#include <boost/math/quadrature/gauss.hpp>

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
