#pragma once

#include <cstdint>

namespace irido {

/// Quantile of the standard normal distribution for a probability p in (0, 1), to 1e-15 relative.
/// Uses only additions, multiplications, divisions and square roots, so the bits are the same on
/// every machine. Throws DomainError.
/// Source: M. J. Wichura, algorithm AS 241 (PPND16), Appl. Stat. 37, 477 (1988).
double normal_quantile(double p);

/// Standard normal deviate, |x| < 8.3, from 64 random bits, 52 of which are used.
double normal_deviate(std::uint64_t bits);

}  // namespace irido
