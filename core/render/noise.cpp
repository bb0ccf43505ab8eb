#include "core/render/noise.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/random.hpp"
#include "core/stack/stack.hpp"

namespace irido {

namespace {

constexpr std::array<std::uint8_t, 256> kPerlinPermutation{
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180};

/// Its first and second derivative vanish at 0 and 1.
double faded(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

double between(double part, double a, double b) {
    return a + part * (b - a);
}

/// Dot product with one of the vectors to the twelve edges of a cube, four of them twice.
double along_edge(unsigned hash, double x, double y, double z) {
    const unsigned edge = hash & 15U;
    const double u = edge < 8 ? x : y;
    const double v = edge < 4 ? y : edge == 12 || edge == 14 ? x : z;
    return (edge & 1U ? -u : u) + (edge & 2U ? -v : v);
}

/// A coordinate's cell, modulo 256, and its place in it.
struct Cell {
    explicit Cell(double at) : place(at - std::floor(at)) {
        const auto whole = static_cast<std::int64_t>(std::floor(at));
        index = static_cast<std::size_t>(static_cast<std::uint64_t>(whole) & 255U);
    }
    std::size_t index;
    double place;
};

}  // namespace

PerlinNoise::PerlinNoise(std::uint64_t seed) {
    std::array<std::uint8_t, 256> once = kPerlinPermutation;
    if (seed != 0) {
        Random random(seed);
        for (std::size_t i = once.size() - 1; i > 0; --i)
            std::swap(once[i], once[random.below(i + 1)]);
    }
    std::ranges::copy(once, permutation_.begin());
    std::ranges::copy(once, permutation_.begin() + once.size());
}

double PerlinNoise::operator()(double x, double y, double z) const {
    const Cell cx(x), cy(y), cz(z);
    const auto& p = permutation_;
    // hash of the corner (i, j, k) of the cell, and what its vector gives at the point
    const auto corner = [&](std::size_t i, std::size_t j, std::size_t k) {
        const std::size_t hash = p[p[p[cx.index + i] + cy.index + j] + cz.index + k];
        return along_edge(static_cast<unsigned>(hash), cx.place - static_cast<double>(i),
                          cy.place - static_cast<double>(j), cz.place - static_cast<double>(k));
    };
    const double u = faded(cx.place), v = faded(cy.place), w = faded(cz.place);
    const auto edge = [&](std::size_t j, std::size_t k) {
        return between(u, corner(0, j, k), corner(1, j, k));
    };
    return between(w, between(v, edge(0, 0), edge(1, 0)), between(v, edge(0, 1), edge(1, 1)));
}

ThicknessField::ThicknessField(const ThicknessNoise& noise) : of_(noise), noise_(noise.seed) {
    require_in_range("least thickness_nm", noise.least_nm, 0, kLargestThickness_nm);
    require_in_range("largest thickness_nm", noise.most_nm, noise.least_nm, kLargestThickness_nm);
    require_in_range("noise scale", noise.scale, 0, ThicknessNoise::kLargestScale);
    require_in_range("octaves", noise.octaves, 1, ThicknessNoise::kMostOctaves);
}

double ThicknessField::operator()(double x, double y, double z) const {
    double sum = 0, weights = 0, weight = 1, frequency = of_.scale;
    for (unsigned octave = 0; octave < of_.octaves; ++octave) {
        sum += weight * noise_(frequency * x, frequency * y, frequency * z);
        weights += weight;
        weight /= 2;
        frequency *= 2;
    }
    const double part = std::clamp(0.5 + 0.5 * (sum / weights), 0.0, 1.0);
    return of_.least_nm + (of_.most_nm - of_.least_nm) * part;
}

}  // namespace irido
