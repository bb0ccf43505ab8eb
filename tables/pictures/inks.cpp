#include "tables/pictures/inks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/colorimetry/observer.hpp"

namespace irido::tables {

namespace {

/// Rounding errors of a colour must not count as out of gamut.
constexpr double kGamutSlack = 1e-9;

/// Y of the primaries of sRGB.
Triple luminance_weights() {
    static const Triple weights = xyz_from_rgb(rgb_space("srgb"))[1];
    return weights;
}

double luminance(const Triple& rgb) {
    const Triple weight = luminance_weights();
    return weight[0] * rgb[0] + weight[1] * rgb[1] + weight[2] * rgb[2];
}

std::string percent(std::size_t part, std::size_t whole) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g",
                  100 * static_cast<double>(part) / static_cast<double>(whole));
    return std::string(text.data()) + " %";
}

Triple compressed(const Triple& rgb) {
    const double y = luminance(rgb);
    if (y >= 1) return {1, 1, 1};
    if (y <= 0) return {0, 0, 0};
    double part = 1;  // fraction of the colour; the rest is grey
    for (const double c : rgb) {
        if (c < 0) part = std::min(part, y / (y - c));
        if (c > 1) part = std::min(part, (1 - y) / (c - y));
    }
    Triple mixed{};
    for (std::size_t i = 0; i < 3; ++i) mixed[i] = y + part * (rgb[i] - y);
    return mixed;
}

/// Linear sRGB from CIELAB under D65.
Triple rgb_of_lab(double lightness, double a, double b) {
    const RgbSpace& srgb = rgb_space("srgb");
    const double fy = (lightness + 16) / 116;
    const auto inverse = [](double f) {
        return f > 6.0 / 29 ? f * f * f : 3 * (6.0 / 29) * (6.0 / 29) * (f - 4.0 / 29);
    };
    const Triple xyz{srgb.white[0] * inverse(fy + a / 500), srgb.white[1] * inverse(fy),
                     srgb.white[2] * inverse(fy - b / 200)};
    return RgbTransform(srgb, srgb.white, Adaptation::none)(xyz);
}

}  // namespace

Ink clipped_ink(const Triple& linear_srgb) {
    const auto component = [](double linear) {
        return static_cast<std::uint16_t>(
            std::lround(65535 * encoded(rgb_space("srgb"), std::clamp(linear, 0.0, 1.0))));
    };
    return {component(linear_srgb[0]), component(linear_srgb[1]), component(linear_srgb[2])};
}

std::string_view name_of(GamutMapping mapping) {
    return mapping == GamutMapping::clip ? "clip" : "compress";
}

Ink InkMixer::operator()(const Triple& linear_srgb) {
    const auto [least, most] = std::ranges::minmax(linear_srgb);
    ++colors_;
    if (least >= -kGamutSlack && most <= 1 + kGamutSlack) return clipped_ink(linear_srgb);
    // a shorter exposure brings the one into sRGB, nothing the other
    const bool is_bright = least >= -kGamutSlack && luminance(linear_srgb) > 1 + kGamutSlack;
    ++(is_bright ? bright_ : outside_);
    return clipped_ink(mapping_ == GamutMapping::clip ? linear_srgb : compressed(linear_srgb));
}

std::string InkMixer::note() const {
    if (outside_ + bright_ == 0) return "";
    const bool is_clipped = mapping_ == GamutMapping::clip;
    const std::string to_grey = "mixed with the grey of their luminance until they fit";
    const std::string outside = percent(outside_, colors_) + " of the colours lie outside sRGB",
                      bright = percent(bright_, colors_);
    if (bright_ == 0) return outside + " and are " + (is_clipped ? "clipped" : to_grey);
    if (outside_ == 0)
        return bright + " of the colours are brighter than white and are " +
               (is_clipped ? "clipped" : "drawn white");
    return outside + ", " + bright + " are brighter than white: " +
           (is_clipped ? "both are clipped" : "the former are " + to_grey + ", the latter white");
}

Ink value_ink(double part) {
    struct Stop {
        double lightness, a, b;
    };
    constexpr std::array stops{Stop{15, 18, -42}, Stop{34.5, 10, -45}, Stop{54, -16, -22},
                               Stop{73.5, -26, 22}, Stop{93, -12, 52}};
    const double place = std::clamp(part, 0.0, 1.0) * (stops.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double t = place - static_cast<double>(i);
    const auto mixed = [&](double Stop::*of) {
        return stops[i].*of + t * (stops[i + 1].*of - stops[i].*of);
    };
    return clipped_ink(rgb_of_lab(mixed(&Stop::lightness), mixed(&Stop::a), mixed(&Stop::b)));
}

Ink wavelength_ink(double wavelength_nm) {
    if (!(wavelength_nm >= kFirstVisible_nm && wavelength_nm <= kLastVisible_nm))
        return ink(0xffffff);
    static const RgbTransform transform(rgb_space("srgb"), rgb_space("srgb").white,
                                        Adaptation::none);
    const Observer& eye = observer(2);
    const auto row = static_cast<std::size_t>(wavelength_nm - kFirstRow_nm);
    Triple rgb = transform({eye.x[row], eye.y[row], eye.z[row]});
    const auto [least, most] = std::ranges::minmax(rgb);
    const double length = most - least;
    const double strength = 0.8 * std::min(1.0, 0.2 + std::sqrt(length));
    for (double& c : rgb) c = 1 - strength * (most - c) / length;
    return clipped_ink(rgb);
}

}  // namespace irido::tables
