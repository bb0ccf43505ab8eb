#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace irido {

/// Philox4x32-10: four 32-bit random words from a counter and a key, the same on every machine.
/// Every counter is an independent draw, so samples need neither order nor state.
/// Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel Random Numbers: As Easy as
/// 1, 2, 3, SC11 (2011), section 3.3.
constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                              std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t first = std::uint64_t{0xD2511F53U} * counter[0];
        const std::uint64_t second = std::uint64_t{0xCD9E8D57U} * counter[2];
        counter = {static_cast<std::uint32_t>(second >> 32) ^ counter[1] ^ key[0],
                   static_cast<std::uint32_t>(second),
                   static_cast<std::uint32_t>(first >> 32) ^ counter[3] ^ key[1],
                   static_cast<std::uint32_t>(first)};
        key[0] += 0x9E3779B9U;
        key[1] += 0xBB67AE85U;
    }
    return counter;
}

/// A 64-bit seed as a key of two words.
constexpr std::array<std::uint32_t, 2> philox_key(std::uint64_t seed) {
    return {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
}

/// Uniform in (0, 1): one of 2^32 equally spaced values.
constexpr double unit_number(std::uint32_t word) {
    return (static_cast<double>(word) + 0.5) * 0x1p-32;
}

/// Uniform in (0, 1): one of 2^53 equally spaced values (the last is the largest double below 1).
constexpr double unit_number(std::uint32_t high, std::uint32_t low) {
    const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 11;
    const double value = (static_cast<double>(bits) + 0.5) * 0x1p-53;
    return value < 1 ? value : 1 - 0x1p-53;
}

/// Sequence of 53-bit uniform numbers in (0, 1) for one path, sample or cell; `stream` tells it
/// apart from others with the same key. One call of philox() yields two numbers.
class PhiloxSequence {
public:
    constexpr PhiloxSequence(std::array<std::uint32_t, 2> key,
                             std::array<std::uint32_t, 3> stream = {})
        : key_(key), stream_(stream) {}

    constexpr double next() {
        if (used_ == 2) {
            const auto words = philox({block_++, stream_[0], stream_[1], stream_[2]}, key_);
            numbers_ = {unit_number(words[0], words[1]), unit_number(words[2], words[3])};
            used_ = 0;
        }
        return numbers_[used_++];
    }
    /// Uniform between `from` and `to`.
    constexpr double uniform(double from, double to) { return from + (to - from) * next(); }

private:
    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 3> stream_;
    std::uint32_t block_ = 0;
    std::size_t used_ = 2;
    std::array<double, 2> numbers_{};
};

}  // namespace irido
