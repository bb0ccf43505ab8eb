#include "core/rough/walk/facet_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/math/constants.hpp"
#include "core/math/parallel.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

namespace {

/// Steps of a quarter turn: of R, and the fewest of straight light.
constexpr std::size_t kFacetSteps = 9000, kFewestStraightSteps = 900;

}  // namespace

AngleTable::AngleTable(std::size_t steps, std::size_t count)
    : steps_(steps), count_(count), values_((steps + 2) * count) {}

void AngleTable::at(double theta_deg, std::span<double> out) const {
    const double place = std::clamp(theta_deg, 0.0, 90.0) / 90 * static_cast<double>(steps_);
    const auto below = static_cast<std::size_t>(place);
    const auto share = static_cast<float>(place - static_cast<double>(below));
    const float* a = values_.data() + below * count_;
    const float* b = a + count_;
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = static_cast<double>(a[k] + share * (b[k] - a[k]));
}

AngleTable facet_table(const LayerTransport& layer, const std::vector<double>& wavelength_nm,
                       unsigned threads) {
    const std::size_t W = wavelength_nm.size();
    AngleTable table(kFacetSteps, 2 * W);
    constexpr std::size_t kTogether = 100;
    parallel_for((kFacetSteps + kTogether) / kTogether, threads, [&](std::size_t block) {
        std::vector<double> angles;
        const std::size_t begin = block * kTogether;
        for (std::size_t k = begin; k < std::min(begin + kTogether, kFacetSteps + 1); ++k)
            angles.push_back(table.theta_deg(k));
        const std::vector<double> values = layer.facets().values(angles, wavelength_nm);
        for (std::size_t k = 0; k < angles.size(); ++k) {
            const std::span<float> row = table.row(begin + k);
            for (std::size_t w = 0; w < W; ++w) {
                row[w] = static_cast<float>(values[k * W + w]);
                row[W + w] = static_cast<float>(values[(angles.size() + k) * W + w]);
            }
        }
    });
    std::ranges::copy(table.row(kFacetSteps), table.row(kFacetSteps + 1).begin());
    return table;
}

AngleTable straight_table(const LayerTransport& layer, const std::vector<double>& wavelength_nm,
                          Crossings crossings, unsigned threads) {
    constexpr double kNearGrazing_deg = 1e-6;
    const auto enough = static_cast<std::size_t>(16 * 0.5 * kPi / layer.alpha());
    const std::size_t steps = std::clamp<std::size_t>(enough, kFewestStraightSteps, 20000);
    AngleTable table(steps, wavelength_nm.size());
    layer.facets().prepare(wavelength_nm, threads);
    parallel_for(steps + 1, threads, [&](std::size_t k) {
        const double theta = std::min(table.theta_deg(k), 90 - kNearGrazing_deg);
        const double G1 = smith_masking(layer.alpha(), cos_of_incidence(theta));
        const std::vector<double> tau = layer.straight(theta, wavelength_nm, crossings);
        for (std::size_t w = 0; w < tau.size(); ++w)
            table.row(k)[w] = static_cast<float>(tau[w] / G1);
    });
    std::ranges::copy(table.row(steps), table.row(steps + 1).begin());
    return table;
}

}  // namespace irido
