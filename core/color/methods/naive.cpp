#include <algorithm>
#include <array>

#include "core/color/baselines/adapted_srgb.hpp"
#include "core/color/baselines/sampled_color.hpp"

namespace irido {

namespace {

/// Wavelengths used for red, green and blue.
constexpr std::array kRgb_nm{650.0, 510.0, 475.0};

std::unique_ptr<ColorAlgorithm> naive_color(const ColorTables& tables, const Stack& stack,
                                            const ColorMethod&, const ColorRequest& request) {
    const Sensitivity& sensitivity = tables.sensitivity();
    const ColorMatrix rows = xyz_from_srgb(sensitivity.white());
    SampleRule rule;
    rule.wavelength_nm.assign(kRgb_nm.begin(), kRgb_nm.end());
    for (std::size_t c = 0; c < 3; ++c) rule.weight[c].assign(rows[c].begin(), rows[c].end());
    return sampled_color(sensitivity, std::make_shared<const SampleRule>(std::move(rule)), stack,
                         "naive", request);
}

}  // namespace

/// R or T at 650, 510 and 475 nm are linear sRGB r, g, b. Source: Bacterius, Thin Film Interference
/// for Computer Graphics (2013).
extern constinit const ColorMethodKind color_method_naive = {
    .name = "naive",
    .place = 8,
    .help = "naive: 650, 510, 475 nm as R, G, B",
    .trials = {.counts = kNoNumber, .what = "650, 510, 475 nm"},
    .prepare = naive_color,
};

}  // namespace irido
