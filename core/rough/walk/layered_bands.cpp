#include "core/rough/walk/layered_bands.hpp"

#include <algorithm>
#include <numeric>

#include "core/coherent/coherent.hpp"
#include "core/math/constants.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

namespace {

/// Linear between equally spaced angles.
double between_angles(const std::vector<double>& values, std::size_t angles, std::size_t bands,
                      std::size_t band, double theta_deg) {
    const double place = std::clamp(theta_deg / 90, 0.0, 1.0) * static_cast<double>(angles - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), angles - 2);
    const double share = place - static_cast<double>(below);
    const double a = values[below * bands + band], b = values[(below + 1) * bands + band];
    return a + share * (b - a);
}

}  // namespace

Triple LayeredBands::operator()(const LayeredScattering& scattering,
                                const ScatterPair& pair) const {
    const Coating::Crossing i = scattering.coating().inward(pair.theta_i_deg);
    const Coating::Crossing o = scattering.coating().inward(pair.theta_o_deg);
    const MirrorFacet facet = mirror_facet(i.theta_deg, o.theta_deg, pair.phi_deg);
    Triple xyz{};
    for (std::size_t b = 0; b < bands; ++b) {
        double through = 1, sum = 0;
        for (std::size_t l = 0; l < reflected.size(); ++l) {
            const double alpha = scattering.layer(l).alpha();
            sum += lobe(alpha, facet) * through *
                   between_angles(reflected[l], angles, bands, b, facet.theta_d_deg);
            for (const double theta : {i.theta_deg, o.theta_deg})
                through *= smith_masking(alpha, cos_of_incidence(theta)) *
                           between_angles(straight[l], angles, bands, b, theta);
        }
        sum += through * base[b] / kPi;
        for (std::size_t c = 0; c < 3; ++c) xyz[c] += weight[b][c] * sum;
    }
    for (double& part : xyz) part *= i.T * o.T * scattering.coating().dilution();
    return xyz;
}

LayeredBands layered_bands(const LayeredScattering& scattering, const Sensitivity& sensitivity,
                           const SampleRule& rule, Paths paths, Crossings crossings,
                           std::size_t bands, std::size_t angles, const Execution& execution) {
    const std::size_t W = rule.wavelength_nm.size();
    std::array<std::vector<double>, 3> weight;
    std::vector<double> light(W);
    for (std::size_t c = 0; c < 3; ++c) {
        const double all = std::accumulate(rule.weight[c].begin(), rule.weight[c].end(), 0.0);
        for (std::size_t w = 0; w < W; ++w) {
            weight[c].push_back(sensitivity.white()[c] * rule.weight[c][w] / all);
            light[w] += weight[c][w];
        }
    }
    LayeredBands result;
    result.bands = bands;
    result.angles = angles;
    result.weight.resize(bands);
    // the part of each wavelength's light that each band takes
    const double whole = std::accumulate(light.begin(), light.end(), 0.0);
    std::vector<std::vector<double>> share(bands, std::vector<double>(W));
    double before = 0;
    for (std::size_t w = 0; w < W; ++w) {
        const double after = before + light[w];
        for (std::size_t b = 0; b < bands; ++b) {
            const double from = whole * static_cast<double>(b) / static_cast<double>(bands);
            const double to = whole * static_cast<double>(b + 1) / static_cast<double>(bands);
            const double common = std::max(0.0, std::min(after, to) - std::max(before, from));
            if (common <= 0 || light[w] <= 0) continue;
            share[b][w] = common / light[w];
            for (std::size_t c = 0; c < 3; ++c) result.weight[b][c] += share[b][w] * weight[c][w];
        }
        before = after;
    }
    const auto mean = [&](std::span<const double> spectrum, std::size_t b) {
        double sum = 0, all = 0;
        for (std::size_t w = 0; w < W; ++w) {
            sum += share[b][w] * light[w] * spectrum[w];
            all += share[b][w] * light[w];
        }
        return all > 0 ? sum / all : 0;
    };
    result.base.assign(bands, 0);
    if (scattering.has_base()) {
        const std::vector<double> base = scattering.base_factors(rule.wavelength_nm, paths);
        for (std::size_t b = 0; b < bands; ++b) result.base[b] = mean(base, b);
    }
    std::vector<double> row(2 * W), tau(W);
    for (std::size_t l = 0; l < scattering.layers(); ++l) {
        const AngleTable facets =
            facet_table(scattering.layer(l), rule.wavelength_nm, execution.threads);
        const bool is_crossed = l + 1 < scattering.layers() || scattering.has_base();
        AngleTable through;
        if (is_crossed)
            through = straight_table(scattering.layer(l), rule.wavelength_nm, crossings,
                                     execution.threads);
        std::vector<double> R, T;
        for (std::size_t k = 0; k < angles; ++k) {
            const double theta = 90 * static_cast<double>(k) / static_cast<double>(angles - 1);
            facets.at(theta, row);
            std::ranges::fill(tau, 1);
            if (is_crossed) through.at(theta, tau);
            for (std::size_t b = 0; b < bands; ++b) {
                R.push_back(mean(std::span(row).first(W), b));
                T.push_back(mean(tau, b));
            }
        }
        result.reflected.push_back(std::move(R));
        result.straight.push_back(std::move(T));
    }
    return result;
}

}  // namespace irido
