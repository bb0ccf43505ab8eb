#pragma once

#include <cstdint>

namespace irido {

/// Nearest IEEE 754 binary16 value, ties to even; infinite beyond 65504.
double rounded_to_half(double value);

/// Bits of rounded_to_half(value) as a binary16.
std::uint16_t half_bits(double value);

/// Value of a binary16 given by its bits.
double half_value(std::uint16_t bits);

}  // namespace irido
