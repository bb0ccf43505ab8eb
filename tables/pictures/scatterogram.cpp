#include "tables/pictures/scatterogram.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/constants.hpp"

namespace irido::tables {

namespace {

constexpr std::array kCircles_deg{5.0, 30.0, 60.0, 90.0};
constexpr std::size_t kMargin = 8;  ///< pixels

/// Darkens or brightens by half.
Ink circle_ink(const Ink& below) {
    const bool is_bright = int{below.r} + int{below.g} + int{below.b} > 3 * 30000;
    const auto mixed = [&](std::uint16_t part) {
        return static_cast<std::uint16_t>(is_bright ? part / 2 : part / 2 + 32767);
    };
    return {mixed(below.r), mixed(below.g), mixed(below.b)};
}

}  // namespace

Pixels scatterogram(std::size_t rows, std::size_t columns, std::size_t diameter,
                    const std::function<Ink(std::size_t row, std::size_t column, double theta_deg,
                                            double phi_deg)>& ink) {
    Pixels pixels;
    const std::size_t step = diameter + kMargin;
    pixels.width = columns * step + kMargin;
    pixels.height = rows * step + kMargin;
    pixels.inks.resize(pixels.width * pixels.height);
    const double radius = 0.5 * static_cast<double>(diameter);
    for (std::size_t down = 0; down < rows * diameter; ++down)
        for (std::size_t right = 0; right < columns * diameter; ++right) {
            const std::size_t row = down / diameter, column = right / diameter;
            const std::size_t py = down % diameter, px = right % diameter;
            const double x = (static_cast<double>(px) + 0.5 - radius) / radius;
            const double y = (radius - static_cast<double>(py) - 0.5) / radius;
            const double theta = 90 * std::hypot(x, y);
            if (theta > 90) continue;
            const double turn = std::atan2(y, x) / kDegree;
            Ink color = ink(row, column, theta, turn < 0 ? turn + 360 : turn);
            const double half = 45 / radius;  // of a pixel, in degrees
            for (const double circle : kCircles_deg)
                if (std::abs(theta - std::min(circle, 90 - half)) <= half)
                    color = circle_ink(color);
            pixels.inks[(row * step + kMargin + py) * pixels.width + kMargin + column * step + px] =
                color;
        }
    return pixels;
}

}  // namespace irido::tables
