#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace irido {

/// Numbers that are the same on every machine (log_uniform: with the same math library).
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
    /// In [from, to).
    double uniform(double from, double to) {
        return from + (to - from) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }
    /// In [from, to), every decade as likely as any other; 0 < from.
    double log_uniform(double from, double to) {
        return std::exp(uniform(std::log(from), std::log(to)));
    }
    /// In [0, count).
    std::size_t below(std::size_t count) {
        return static_cast<std::size_t>(uniform(0, 1) * static_cast<double>(count));
    }
    /// True in one of `of` draws.
    bool one_in(std::size_t of) { return below(of) == 0; }

private:
    std::uint64_t state_;
};

}  // namespace irido
