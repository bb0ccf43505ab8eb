#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace irido {

/// Random numbers, the same on every machine (log_uniform: with the same math library).
/// Source: splitmix64, G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    }
    /// Uniform in [from, to).
    double uniform(double from, double to) {
        return from + (to - from) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }
    /// Log-uniform in [from, to); 0 < from.
    double log_uniform(double from, double to) {
        return std::exp(uniform(std::log(from), std::log(to)));
    }
    /// Integer in [0, count).
    std::size_t below(std::size_t count) {
        return static_cast<std::size_t>(uniform(0, 1) * static_cast<double>(count));
    }
    /// True with probability 1 / of.
    bool one_in(std::size_t of) { return below(of) == 0; }

private:
    std::uint64_t state_;
};

}  // namespace irido
