#pragma once

#include <cstdint>

namespace irido {

/// The nearest number that IEEE 754 binary16 holds, ties to even; infinite beyond 65504.
double rounded_to_half(double value);

/// Bits of a double that binary16 holds, as rounded_to_half() returns it.
std::uint16_t half_bits(double value);

/// What the bits of a binary16 stand for.
double half_value(std::uint16_t bits);

}  // namespace irido
