#include "core/render/color_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "core/render/as_array.hpp"

namespace irido {

namespace {

/// Of panels that are equally wide in 1/wavelength, as fringes are.
ColorNodes nodes_of(const Sensitivity& sensitivity, WavelengthRange range,
                    const RgbTransform& to_srgb, std::size_t panels, std::size_t degree) {
    ColorNodes nodes;
    nodes.panels = panels;
    nodes.degree = degree;
    const std::array rows{to_srgb({1, 0, 0}), to_srgb({0, 1, 0}), to_srgb({0, 0, 1})};
    const auto end = [&](std::size_t i) {
        const double part = static_cast<double>(i) / static_cast<double>(panels);
        if (i == 0) return range.first_nm;
        if (i == panels) return range.last_nm;
        return 1 / std::lerp(1 / range.first_nm, 1 / range.last_nm, part);
    };
    for (std::size_t i = 0; i < panels; ++i) {
        const PanelRule rule = panel_rule(sensitivity, {end(i), end(i + 1)}, degree);
        for (std::size_t k = 0; k < rule.wavelength_nm.size(); ++k) {
            nodes.wavelength_nm.push_back(
                std::clamp(rule.wavelength_nm[k], range.first_nm, range.last_nm));
            for (std::size_t c = 0; c < 3; ++c)
                nodes.weight[c].push_back(rows[0][c] * rule.weight[0][k] +
                                          rows[1][c] * rule.weight[1][k] +
                                          rows[2][c] * rule.weight[2][k]);
        }
    }
    return nodes;
}

}  // namespace

double srgb_difference(std::span<const double> a, std::span<const double> b) {
    static const RgbSpace& space = rgb_space("srgb");
    static const ColorMatrix to_xyz = xyz_from_rgb(space);
    const auto in_lab = [](std::span<const double> rgb) {
        Triple xyz{};
        for (std::size_t i = 0; i < 3; ++i)
            xyz[i] = to_xyz[i][0] * rgb[0] + to_xyz[i][1] * rgb[1] + to_xyz[i][2] * rgb[2];
        return lab(xyz, space.white);
    };
    return ciede2000(in_lab(a), in_lab(b));
}

PictureNodes::PictureNodes(ColorNodes nodes, WavelengthRange range,
                           std::span<const Sensitivity* const> others, const RgbTransform& to_srgb)
    : wavelength_nm_(std::move(nodes.wavelength_nm)) {
    const auto add = [&](const std::array<std::vector<double>, 3>& weight) {
        auto& added = weights_.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            for (const double value : weight[c]) added[c].push_back(static_cast<float>(value));
    };
    add(nodes.weight);
    for (const Sensitivity* const other : others) {
        const auto [first, last] = other->support();
        if (first > range.first_nm || last < range.last_nm)
            throw DomainError("the illuminant of a light must be given from " +
                              to_text(range.first_nm) + " to " + to_text(range.last_nm) +
                              " nm, as that of the picture is (got " + to_text(first) + " to " +
                              to_text(last) + " nm)");
        add(nodes_of(*other, range, to_srgb, nodes.panels, nodes.degree).weight);
    }
}

Triple PictureNodes::rgb(std::span<const float> spectrum, std::size_t illuminant) const {
    const auto values = as_array(spectrum.first(count()));
    Triple rgb{};
    for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = static_cast<double>((as_array(weights_[illuminant][c]) * values).sum());
    return rgb;
}

ColorNodes enough_nodes(const Sensitivity& sensitivity, const RgbTransform& to_srgb,
                        const std::function<std::vector<Triple>(const ColorNodes&)>& colors,
                        double tolerance, std::size_t most) {
    struct Size {
        std::size_t panels, degree;
    };
    constexpr std::array<Size, 7> sizes{
        {{1, 16}, {1, 32}, {1, 64}, {1, 128}, {2, 128}, {4, 128}, {8, 128}}};
    ColorNodes nodes;
    std::vector<Triple> before;
    for (const auto& [panels, degree] : sizes) {
        ColorNodes more = nodes_of(sensitivity, sensitivity.support(), to_srgb, panels, degree);
        const std::vector<Triple> now = colors(more);
        nodes.are_enough = !before.empty();
        for (std::size_t i = 0; i < before.size(); ++i)
            nodes.are_enough = nodes.are_enough && srgb_difference(before[i], now[i]) < tolerance;
        if (nodes.are_enough || more.wavelength_nm.size() > most) return nodes;
        before = now;
        nodes = std::move(more);
    }
    return nodes;
}

}  // namespace irido
