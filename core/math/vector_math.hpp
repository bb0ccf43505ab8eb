#pragma once

#include <cstdint>
#include <span>

#include "core/math/simd_level.hpp"

namespace irido {

/// Sine and cosine of many angles, radians, |x| <= 2^40, each within 1 ulp.
/// `sine` and `cosine` are as long as `x`.
void sin_cos(std::span<const double> x, std::span<double> sine, std::span<double> cosine,
             SimdLevel level);

/// Floating-point operations that both take together, as counted by operations_per_point() of
/// vector/program.hpp.
inline constexpr double kSinCosOperations = 33;

/// exp(x) - 1 of many x <= 0, within 2 ulp.
void expm1(std::span<const double> x, std::span<double> out, SimdLevel level);

/// Lanes of a vector.
std::size_t lanes(SimdLevel level);

/// Does `count` fused multiply-adds of whole vectors (of plain doubles where there are none), as
/// many at a time as hide their latency: the measure of what a core can do. The result depends on
/// all of them.
double multiply_adds(std::uint64_t count, SimdLevel level);

}  // namespace irido
