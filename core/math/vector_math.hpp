#pragma once

#include <cstdint>
#include <span>

#include "core/math/simd_level.hpp"

namespace irido {

/// Sine and cosine of many angles in radians, |x| <= 2^40, each within 1 ulp.
///   x             angles
///   sine, cosine  results, as long as `x`
///   level         instruction set to use
void sin_cos(std::span<const double> x, std::span<double> sine, std::span<double> cosine,
             SimdLevel level);

/// Floating-point operations per sine and cosine pair, as counted by operations_per_point() of
/// vector/program.hpp.
inline constexpr double kSinCosOperations = 33;

/// exp(x) - 1 for many x <= 0, within 2 ulp.
void expm1(std::span<const double> x, std::span<double> out, SimdLevel level);

/// Doubles per vector.
std::size_t lanes(SimdLevel level);

/// Performs `count` fused multiply-adds of full vectors (scalars if the level has none), with
/// enough of them in flight to hide their latency: a measure of a core's peak throughput. The
/// result depends on all of them.
double multiply_adds(std::uint64_t count, SimdLevel level);

}  // namespace irido
