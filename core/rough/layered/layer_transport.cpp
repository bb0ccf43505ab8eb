#include "core/rough/layered/layer_transport.hpp"

#include <algorithm>

#include "core/coherent/coherent.hpp"
#include "core/rough/filter_nodes.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

namespace {

/// Panels of 90 / 2^5 degrees for a series of many wavelengths.
constexpr unsigned kPowersLevel = 5;

/// Angles whose moments are kept: 100 MB.
constexpr std::size_t kMostKept = 8192;

}  // namespace

/// Moments of one angle, for one thread at a time.
struct LayerTransport::Moments {
    explicit Moments(FilterNodes nodes) : moments(std::move(nodes)) {}
    std::mutex lock;
    AngleMoments moments;
};

LayerTransport::LayerTransport(const RoughLayer& layer, SimdLevel simd)
    : simd_(simd),
      filter_(layer.alpha),
      facets_(layer.stack, Light::unpolarized, {Side::reflected, Side::transmitted}, simd) {}

std::shared_ptr<LayerTransport::Moments> LayerTransport::moments_of(double theta_deg,
                                                                    bool behind) const {
    const auto facets = behind ? FilterNodes::Facets::behind : FilterNodes::Facets::seen;
    const auto made = [&] {
        return std::make_shared<Moments>(FilterNodes(filter_, theta_deg, simd_, facets));
    };
    const std::scoped_lock guard(lock_);
    const auto found = moments_.find({theta_deg, behind});
    if (found != moments_.end()) return found->second;
    if (moments_.size() >= kMostKept) return made();
    return moments_[{theta_deg, behind}] = made();
}

std::vector<double> LayerTransport::straight(double theta_deg,
                                             std::span<const double> wavelength_nm,
                                             Crossings crossings) const {
    const auto series = facets_(wavelength_nm);
    const auto mean_of = [&](bool behind) {
        const std::shared_ptr<Moments> kept = moments_of(theta_deg, behind);
        const std::scoped_lock guard(kept->lock);
        std::vector<double> values;
        values.reserve(series.size());
        for (const auto& of_wavelength : series)
            values.push_back(std::max(0.0, kept->moments(*of_wavelength, kT).value));
        return values;
    };
    std::vector<double> tau = mean_of(false);
    if (crossings == Crossings::single) return tau;
    const double G1 = smith_masking(alpha(), cos_of_incidence(theta_deg));
    const std::vector<double> behind = mean_of(true);  // (1 - G1) Tb
    if (G1 > 0)
        for (std::size_t w = 0; w < tau.size(); ++w) tau[w] /= 1 - behind[w] * tau[w] / G1;
    return tau;
}

AngleSeries LayerTransport::powers(const std::vector<double>& wavelength_nm) const {
    const std::size_t W = wavelength_nm.size();
    return {2 * W, kPowersLevel, [&](std::span<const double> theta_deg) {
                const std::size_t angles = theta_deg.size();
                const std::vector<double> values = facets_.values(theta_deg, wavelength_nm);
                std::vector<double> both;
                both.reserve(values.size());
                for (std::size_t i = 0; i < angles; ++i)
                    for (const std::size_t side : {kR, kT}) {
                        const auto from =
                            values.begin() + static_cast<std::ptrdiff_t>((side * angles + i) * W);
                        both.insert(both.end(), from, from + static_cast<std::ptrdiff_t>(W));
                    }
                return both;
            }};
}

std::vector<double> LayerTransport::straight(const AngleSeries& powers, double theta_deg,
                                             Crossings crossings) const {
    const std::size_t W = powers.functions() / 2;
    const auto mean_of = [&](FilterNodes::Facets facets) {
        std::vector<double> T(W);
        AngleMoments(FilterNodes(filter_, theta_deg, simd_, facets)).values(powers, W, T);
        for (double& value : T) value = std::max(0.0, value);
        return T;
    };
    std::vector<double> tau = mean_of(FilterNodes::Facets::seen);
    const double G1 = smith_masking(alpha(), cos_of_incidence(theta_deg));
    if (crossings == Crossings::single || !(G1 > 0)) return tau;
    const std::vector<double> behind = mean_of(FilterNodes::Facets::behind);
    for (std::size_t w = 0; w < W; ++w) tau[w] /= 1 - behind[w] * tau[w] / G1;
    return tau;
}

}  // namespace irido
