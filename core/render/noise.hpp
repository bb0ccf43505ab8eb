#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace irido {

/// Improved Perlin noise: smooth, 0 at whole coordinates, [-1, 1] but for rare excursions of 4 %.
/// The same bits on every machine: sums, products and floor() only.
/// Source: K. Perlin, Improving Noise, Proc. SIGGRAPH 2002; seed 0 has that paper's permutation,
/// others shuffle it.
class PerlinNoise {
public:
    explicit PerlinNoise(std::uint64_t seed = 0);

    /// Coordinates in [-1e12, 1e12].
    double operator()(double x, double y, double z) const;

    /// Of 0 .. 255.
    std::span<const std::uint8_t> permutation() const { return std::span(permutation_).first(256); }

private:
    std::array<std::uint8_t, 512> permutation_;  ///< of 0 .. 255, twice
};

/// A thickness that varies in space, between `least` and `most`:
///     d(p) = least + (most - least) n(scale p),
/// n being Perlin noise of several octaves, each of twice the frequency and half the weight of the
/// one before, mapped linearly from [-1, 1] to [0, 1] and clamped to it.
/// Source: Erskine and Poon, Rendering Iridescence in Multilayer Structures (2025), eq. 12.
struct ThicknessNoise {
    static constexpr double kLargestScale = 1e6;
    static constexpr unsigned kMostOctaves = 16;

    double least_nm = 0, most_nm = 0;  ///< [0, 1e9], least <= most
    double scale = 1;                  ///< [0, 1e6]
    std::uint64_t seed = 0;
    unsigned octaves = 1;  ///< [1, 16]

    bool operator==(const ThicknessNoise&) const = default;
};

/// Thicknesses by a ThicknessNoise.
class ThicknessField {
public:
    /// Throws DomainError, which names the argument.
    explicit ThicknessField(const ThicknessNoise& noise);

    /// Thickness in nm at a point whose coordinates are in [-1, 1] or about that.
    double operator()(double x, double y, double z) const;

private:
    ThicknessNoise of_;
    PerlinNoise noise_;
};

}  // namespace irido
