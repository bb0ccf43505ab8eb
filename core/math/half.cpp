#include "core/math/half.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irido {

namespace {

constexpr double kLargestHalf = 65504;
constexpr std::uint16_t kHalfSign = 0x8000, kHalfInfinity = 0x7C00, kHalfNan = 0x7E00;
constexpr int kHalfDigits = 10, kHalfBias = 15, kSmallestHalfExponent = -14;

}  // namespace

double rounded_to_half(double value) {
    if (value == 0 || !std::isfinite(value)) return value;
    const int exponent = std::max(std::ilogb(value), kSmallestHalfExponent) - kHalfDigits;
    const double half = std::ldexp(std::nearbyint(std::ldexp(value, -exponent)), exponent);
    return std::abs(half) > kLargestHalf
               ? std::copysign(std::numeric_limits<double>::infinity(), half)
               : half;
}

std::uint16_t half_bits(double value) {
    const unsigned sign = std::signbit(value) ? kHalfSign : 0U;
    if (std::isnan(value)) return kHalfNan;
    if (std::isinf(value)) return static_cast<std::uint16_t>(sign | kHalfInfinity);
    if (value == 0) return static_cast<std::uint16_t>(sign);
    const int exponent = std::max(std::ilogb(value), kSmallestHalfExponent);
    // 1024 to 2047, whose leading bit adds 1 to the exponent; less for subnormal numbers
    const auto digits = static_cast<unsigned>(std::ldexp(std::abs(value), kHalfDigits - exponent));
    const auto biased = static_cast<unsigned>(exponent + kHalfBias - 1) << unsigned{kHalfDigits};
    return static_cast<std::uint16_t>(sign | (biased + digits));
}

double half_value(std::uint16_t bits) {
    const unsigned digits = bits & 0x3FFU;
    const int exponent = static_cast<int>((bits & kHalfInfinity) >> unsigned{kHalfDigits});
    double value = 0;
    if (exponent == 31)
        value = digits == 0 ? std::numeric_limits<double>::infinity()
                            : std::numeric_limits<double>::quiet_NaN();
    else if (exponent == 0)
        value = std::ldexp(digits, kSmallestHalfExponent - kHalfDigits);
    else
        value = std::ldexp(digits + 1024U, exponent - kHalfBias - kHalfDigits);
    return (bits & kHalfSign) != 0 ? -value : value;
}

}  // namespace irido
