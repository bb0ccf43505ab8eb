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

/// One point of a Kronrod rule on [-1, 1].
struct KronrodNode {
    double x;
    double weight;
    double gauss;  ///< weight in the Gauss rule inside, 0 if it lacks the point
};

/// Kronrod's 21 points around Gauss's 10, ascending; their difference is an error of the latter.
const std::array<KronrodNode, 21>& kronrod();

}  // namespace irido
