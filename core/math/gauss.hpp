#pragma once

#include <array>
#include <cstddef>

namespace irido {

/// One point of a quadrature rule on [-1, 1].
struct GaussNode {
    double x;
    double weight;
};

/// Gauss-Legendre rule with `count` points on [-1, 1], exact for polynomials of degree below
/// 2 count.
///   count  even; one of those at the end of gauss.cpp, the only reader of Boost's tables
template <std::size_t count>
const std::array<GaussNode, count>& gauss_legendre();

}  // namespace irido
