#include "core/colorimetry/space.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"

namespace irido {
namespace {

constexpr Triple white_of(double x, double y) {
    return {x / y, 1, (1 - x - y) / y};
}

constexpr Triple kD65White = white_of(0.3127, 0.3290);

constexpr std::array<RgbSpace, 5> kSpaces{{
    {"srgb", {{{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}}}, kD65White, Encoding::srgb},
    {"rec2020", {{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}}}, kD65White, Encoding::bt2020},
    {"display-p3", {{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}}}, kD65White, Encoding::srgb},
    {"acescg",
     {{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}}},
     white_of(0.32168, 0.33767),
     Encoding::linear},
    {"xyz", {{{1, 0}, {0, 1}, {0, 0}}}, {1, 1, 1}, Encoding::linear},
}};

constexpr auto kSpaceNames = [] {
    std::array<std::string_view, kSpaces.size()> names;
    std::ranges::transform(kSpaces, names.begin(), &RgbSpace::name);
    return names;
}();

Eigen::Vector3d vector(const Triple& v) {
    return {v[0], v[1], v[2]};
}

Eigen::Matrix3d matrix(const ColorMatrix& rows) {
    Eigen::Matrix3d m;
    m << vector(rows[0]).transpose(), vector(rows[1]).transpose(), vector(rows[2]).transpose();
    return m;
}

ColorMatrix rows(const Eigen::Matrix3d& m) {
    ColorMatrix result;
    for (int i = 0; i < 3; ++i) {
        result[static_cast<std::size_t>(i)] = {m(i, 0), m(i, 1), m(i, 2)};
    }
    return result;
}

/// Columns x, y, 1 - x - y of the primaries.
Eigen::Matrix3d primaries(const RgbSpace& space) {
    Eigen::Matrix3d p;
    for (int j = 0; j < 3; ++j) {
        const auto [x, y] = space.primaries[static_cast<std::size_t>(j)];
        p.col(j) << x, y, 1 - x - y;
    }
    return p;
}

/// White to cone responses, with the checks that bradford() states.
Eigen::Vector3d cone_response(const Eigen::Matrix3d& cones_from_xyz, const Triple& white) {
    Eigen::Vector3d cones = cones_from_xyz * vector(white);
    for (const double component : white) require_in_range("white XYZ", component, 1e-6, 1e6);
    for (const double cone : cones) require_in_range("cone response of the white", cone, 1e-6, 1e6);
    return cones;
}

constexpr double dot(const Triple& a, const Triple& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// IEC 61966-2-1.
double srgb_curve(double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

double inverse_srgb_curve(double v) {
    return v <= 12.92 * 0.0031308 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// ITU-R BT.2020-2, table 4: value and slope of the line and of the power law agree at beta, which
/// gives alpha = 1 + 5.5 beta and alpha beta^0.45 = 10 beta. Printed there: 1.0993 and 0.0181.
constexpr double kBt2020Beta = 0.01805396851080781;
constexpr double kBt2020Alpha = 1 + 5.5 * kBt2020Beta;

double bt2020_curve(double v) {
    return v < kBt2020Beta ? 4.5 * v : kBt2020Alpha * std::pow(v, 0.45) - (kBt2020Alpha - 1);
}

double inverse_bt2020_curve(double v) {
    return v < 4.5 * kBt2020Beta ? v / 4.5
                                 : std::pow((v + (kBt2020Alpha - 1)) / kBt2020Alpha, 1 / 0.45);
}

/// The digit, 16 if it is none.
unsigned hex_digit(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10;
    if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10;
    return 16;
}

}  // namespace

const RgbSpace& rgb_space(std::string_view name) {
    const auto found = std::ranges::find(kSpaces, name, &RgbSpace::name);
    if (found != kSpaces.end()) return *found;
    throw DomainError("space " + not_one_of(kSpaceNames, name));
}

std::span<const std::string_view> rgb_space_names() {
    return kSpaceNames;
}

ColorMatrix xyz_from_rgb(const RgbSpace& space) {
    const Eigen::Matrix3d p = primaries(space);
    const Eigen::Vector3d scale = p.inverse() * vector(space.white);
    return rows(p * scale.asDiagonal());
}

ColorMatrix rgb_from_xyz(const RgbSpace& space) {
    const Eigen::Matrix3d inverse = primaries(space).inverse();
    const Eigen::Vector3d scale = inverse * vector(space.white);
    return rows(scale.cwiseInverse().asDiagonal() * inverse);
}

ColorMatrix bradford(const Triple& from, const Triple& to) {
    Eigen::Matrix3d cones_from_xyz;
    cones_from_xyz << 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296;
    const Eigen::Vector3d gain =
        cone_response(cones_from_xyz, to).cwiseQuotient(cone_response(cones_from_xyz, from));
    return rows(cones_from_xyz.inverse() * gain.asDiagonal() * cones_from_xyz);
}

RgbTransform::RgbTransform(const RgbSpace& space, const Triple& white, Adaptation adaptation)
    : adaptation_(adaptation), white_(white), matrix_(rgb_from_xyz(space)) {
    if (adaptation == Adaptation::none) return;
    matrix_ =
        rows(matrix(matrix_) * matrix(bradford(white, space.white)) * vector(white).asDiagonal());
}

/// Adapted rows sum to 1, so r = m0 x + m1 y + m2 z = y + m0 (x - y) + m2 (z - y), which rounding
/// cannot move off 1 at x = y = z = 1.
Triple RgbTransform::operator()(const Triple& xyz) const {
    const auto& [red, green, blue] = matrix_;
    if (adaptation_ == Adaptation::none) return {dot(red, xyz), dot(green, xyz), dot(blue, xyz)};
    const double x = xyz[0] / white_[0];
    const double y = xyz[1] / white_[1];
    const double z = xyz[2] / white_[2];
    const auto apply = [&](const Triple& m) { return y + m[0] * (x - y) + m[2] * (z - y); };
    return {apply(red), apply(green), apply(blue)};
}

Triple RgbTransform::xyz_of(const Triple& rgb) const {
    const Eigen::Vector3d v = matrix(matrix_).inverse() * vector(rgb);
    if (adaptation_ == Adaptation::none) return {v[0], v[1], v[2]};
    return {v[0] * white_[0], v[1] * white_[1], v[2] * white_[2]};
}

double encoded(const RgbSpace& space, double linear) {
    require_in_range("linear component", linear, 0, 1);
    if (space.encoding == Encoding::srgb) return srgb_curve(linear);
    if (space.encoding == Encoding::bt2020) return bt2020_curve(linear);
    return linear;
}

double decoded(const RgbSpace& space, double value) {
    require_in_range("encoded component", value, 0, 1);
    if (space.encoding == Encoding::srgb) return inverse_srgb_curve(value);
    if (space.encoding == Encoding::bt2020) return inverse_bt2020_curve(value);
    return value;
}

Triple rgb_of_hex(const RgbSpace& space, std::string_view text) {
    const bool is_hex =
        text.size() == 7 && text[0] == '#' &&
        std::ranges::all_of(text.substr(1), [](char c) { return hex_digit(c) < 16; });
    if (!is_hex) throw DomainError("must be #rrggbb (got '" + std::string(text) + "')");
    Triple rgb;
    for (std::size_t i = 0; i < 3; ++i)
        rgb[i] =
            decoded(space, (16 * hex_digit(text[1 + 2 * i]) + hex_digit(text[2 + 2 * i])) / 255.0);
    return rgb;
}

std::string hex(const RgbSpace& space, const Triple& linear_rgb) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const double component : linear_rgb) {
        const double level = 255 * encoded(space, std::clamp(component, 0.0, 1.0));
        const auto byte = static_cast<std::size_t>(std::lround(level));
        text += digits[byte / 16];
        text += digits[byte % 16];
    }
    return text;
}

bool in_gamut(const Triple& linear_rgb) {
    return std::ranges::all_of(linear_rgb, [](double c) { return c >= 0 && c <= 1; });
}

}  // namespace irido
