#pragma once

#include <cstdint>

namespace irido {

/// The x at which the standard normal distribution has the cumulative probability p, (0, 1), to
/// 1e-15 relative. It is made of additions, multiplications, divisions and square roots alone, so
/// that every machine gives the same bits. Throws DomainError.
/// Source: M. J. Wichura, algorithm AS 241 (PPND16), Appl. Stat. 37, 477 (1988).
double normal_quantile(double p);

/// A standard normal deviate, |x| < 8.3, from 64 random bits, of which 52 are used.
double normal_deviate(std::uint64_t bits);

}  // namespace irido
