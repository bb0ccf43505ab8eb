#include "core/render/environment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace irido {

namespace {

constexpr std::array<std::string_view, 4> kNames{"studio", "sky", "white", "none"};

/// 0 below `from`, 1 above `to`, smooth in between.
double step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

Triple scaled(double factor, const Triple& color) {
    return {factor * color[0], factor * color[1], factor * color[2]};
}

Triple sum(const Triple& a, const Triple& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Triple mixed(double part, const Triple& a, const Triple& b) {
    return sum(scaled(1 - part, a), scaled(part, b));
}

/// A rectangular lamp, seen from the origin.
struct SoftBox {
    Vector3 middle;           ///< direction of its centre, of unit length
    Vector3 right, up;        ///< of unit length, perpendicular to it
    double half_width = 0.5;  ///< tangents of its angles
    double half_height = 0.5;
    double edge = 0.1;  ///< part of it that is a soft edge
    Triple radiance;

    Triple operator()(const Vector3& d) const {
        const double ahead = dot(d, middle);
        if (ahead <= 0) return {};
        const double u = std::abs(dot(d, right) / ahead) / half_width;
        const double v = std::abs(dot(d, up) / ahead) / half_height;
        const double inside = (1 - step(1 - edge, 1, u)) * (1 - step(1 - edge, 1, v));
        // somewhat brighter in its middle, as a diffuser over a lamp is
        return scaled(inside * (1 - 0.25 * std::min(1.0, (u * u + v * v) / 2)), radiance);
    }
};

SoftBox soft_box(const Vector3& toward, double half_width, double half_height, double edge,
                 const Triple& radiance) {
    const Vector3 middle = normalized(toward);
    const Vector3 right =
        std::abs(middle.y) > 0.99 ? Vector3{1, 0, 0} : normalized({middle.z, 0, -middle.x});
    const Vector3 up{middle.y * right.z - middle.z * right.y,
                     middle.z * right.x - middle.x * right.z,
                     middle.x * right.y - middle.y * right.x};
    return {middle, right, up, half_width, half_height, edge, radiance};
}

Triple studio(const Vector3& d) {
    static const std::array boxes{
        soft_box({-0.9, 0.8, 0.75}, 0.62, 0.62, 0.12, {6, 6, 6}),      // key, left above
        soft_box({1.0, 0.15, 0.25}, 0.22, 1.1, 0.3, {3.2, 3.2, 3.2}),  // strip, right
        soft_box({0, 1, -0.15}, 1.0, 0.55, 0.3, {3.2, 3.2, 3.2}),      // ceiling
        soft_box({-0.6, 0.1, -1}, 0.5, 0.9, 0.5, {1, 1, 1}),           // rim, behind
    };
    // walls that fade upwards, over a table that is lit from above
    const double wall = 0.13 - 0.07 * d.y;
    const double table = 0.08 + 0.3 * std::exp(-4 * (1 + d.y));
    const double room = d.y < 0 ? std::lerp(wall, table, step(0, 0.06, -d.y)) : wall;
    Triple light{room, room, room};
    for (const SoftBox& box : boxes) light = sum(light, box(d));
    return light;
}

Triple sky(const Vector3& d) {
    static const Vector3 sun = normalized({-0.55, 0.62, 0.45});
    constexpr Triple kZenith{0.16, 0.34, 0.86}, kHorizon{0.86, 0.97, 1.12};
    constexpr Triple kGround{0.26, 0.22, 0.17}, kHaze{0.52, 0.5, 0.46};
    constexpr Triple kSun{60, 56, 48}, kGlow{1.3, 1.15, 0.9};
    const double toward = dot(d, sun);
    if (d.y < 0) return mixed(step(0, 0.35, -d.y), kHaze, kGround);
    Triple light = mixed(std::pow(d.y, 0.55), kHorizon, kZenith);
    light = sum(light, scaled(std::pow(std::max(0.0, toward), 24), kGlow));
    // a disc of 2.5 degrees with a soft edge: the true one would be lost between pixels
    return sum(light, scaled(step(0.99862, 0.99935, toward), kSun));
}

}  // namespace

std::span<const std::string_view> environment_names() {
    return kNames;
}

Environment named_environment(std::string_view name) {
    if (name == "studio") return studio;
    if (name == "sky") return sky;
    if (name == "white") return [](const Vector3&) { return Triple{1, 1, 1}; };
    if (name == "none") return [](const Vector3&) { return Triple{}; };
    throw DomainError(not_one_of(kNames, name));
}

Environment image_environment(std::shared_ptr<const EnvironmentImage> image) {
    if (image->width == 0 || image->width != 2 * image->height)
        throw DomainError("an environment must be twice as wide as high (got " +
                          std::to_string(image->width) + " x " + std::to_string(image->height) +
                          ")");
    for (std::size_t i = 0; i < image->rgb.size(); ++i)
        if (!(image->rgb[i] >= 0 && std::isfinite(image->rgb[i])))
            throw DomainError("radiance must be finite and not below 0 (got " +
                              to_text(static_cast<double>(image->rgb[i])) + " in row " +
                              std::to_string(i / 3 / image->width) + ", column " +
                              std::to_string(i / 3 % image->width) + ")");
    return [image](const Vector3& d) {
        const auto columns = static_cast<double>(image->width);
        const auto rows = static_cast<double>(image->height);
        const double turn = std::atan2(d.x, -d.z) / (2 * std::numbers::pi);
        const double x = (0.5 + turn) * columns - 0.5;
        const double y = std::acos(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi * rows - 0.5;
        const double left = std::floor(x), top = std::clamp(std::floor(y), 0.0, rows - 1);
        const double fx = x - left, fy = std::clamp(y - top, 0.0, 1.0);
        const auto column = [&](double at) {
            return static_cast<std::size_t>(at < 0          ? at + columns
                                            : at >= columns ? at - columns
                                                            : at);
        };
        const std::array<std::size_t, 2> xs{column(left), column(left + 1)};
        const auto row = static_cast<std::size_t>(top);
        const std::array<std::size_t, 2> ys{row, std::min(row + 1, image->height - 1)};
        Triple light{};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto at = [&](std::size_t j, std::size_t i) {
                return static_cast<double>(image->rgb[(ys[j] * image->width + xs[i]) * 3 + c]);
            };
            light[c] =
                std::lerp(std::lerp(at(0, 0), at(0, 1), fx), std::lerp(at(1, 0), at(1, 1), fx), fy);
        }
        return light;
    };
}

}  // namespace irido
