#include "core/rough/layered/layered_scattering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/material/linear_value.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/parallel.hpp"
#include "core/rough/ggx.hpp"
#include "core/rough/layered/base_exit.hpp"
#include "core/rough/layered/base_light.hpp"
#include "core/rough/layered/lobe.hpp"

namespace irido {

namespace {

/// Of straight light relative to masking, where it is integrated over.
constexpr double kExitTolerance = 1e-7;

/// Pairs whose facets are computed together.
constexpr std::size_t kPairsTogether = 16;

Coating coating_of(const LayeredSurface& surface) {
    if (!surface.is_coated()) return {1, 1};
    const auto index = [](const Material& medium) {
        return index_at(medium, kAllWavelengths.first_nm).real();
    };
    return {index(surface.outside), index(surface.inside)};
}

}  // namespace

/// prod_{k<l} f_t cos of layers at angles: [angle][l][wavelength].
struct LayeredScattering::Straight {
    std::map<double, std::vector<double>> products;
    std::size_t wavelengths = 0;

    std::span<const double> operator()(double theta_deg, std::size_t l) const {
        return std::span(products.at(theta_deg)).subspan(l * wavelengths, wavelengths);
    }
};

LayeredScattering::LayeredScattering(LayeredSurface surface, Crossings crossings,
                                     const Execution& execution)
    : surface_(std::move(surface)),
      coating_(coating_of(surface_)),
      execution_(execution),
      crossings_(crossings) {
    for (const RoughLayer& layer : surface_.layers)
        layers_.push_back(std::make_unique<const LayerTransport>(layer, execution.simd));
}

bool LayeredScattering::has_base() const {
    if (!surface_.layers.empty() && !surface_.layers.back().is_passable) return false;
    const auto* constant = std::get_if<Constant>(&surface_.base_albedo);
    return !constant || constant->value != 0;
}

bool LayeredScattering::is_closed() const {
    return layers_.empty() || (layers_.size() == 1 && !coating_.is_there());
}

void LayeredScattering::require_closed(Paths paths) const {
    if (paths == Paths::all && !is_closed())
        throw DomainError(
            "all paths have a closed form only for one layer without a coating and for a base "
            "alone");
}

/// Layers that light crosses on its way to what reflects below.
std::size_t LayeredScattering::crossed_layers() const {
    return has_base() || layers_.empty() ? layers_.size() : layers_.size() - 1;
}

double LayeredScattering::base_albedo(double wavelength_nm) const {
    if (const auto* table = std::get_if<Table>(&surface_.base_albedo))
        return linear_value(*table, wavelength_nm);
    return std::get<Constant>(surface_.base_albedo).value;
}

/// f_t cos of every layer at every angle.
LayeredScattering::Straight LayeredScattering::straight_directly(
    std::span<const double> theta_deg, std::size_t count,
    const std::vector<double>& wavelength_nm) const {
    Straight straight;
    straight.wavelengths = wavelength_nm.size();
    for (const double theta : theta_deg) straight.products.try_emplace(theta);
    for (std::size_t l = 0; l < count; ++l)
        layers_[l]->facets().prepare(wavelength_nm, execution_.threads);
    std::vector<std::pair<const double, std::vector<double>>*> all;
    for (auto& entry : straight.products) all.push_back(&entry);
    parallel_for(all.size(), execution_.threads, [&](std::size_t i) {
        auto& [theta, products] = *all[i];
        products.assign(wavelength_nm.size(), 1);
        for (std::size_t l = 0; l < count; ++l) {
            const std::vector<double> tau = layers_[l]->straight(theta, wavelength_nm, crossings_);
            for (std::size_t w = 0; w < tau.size(); ++w)
                products.push_back(products[l * tau.size() + w] * tau[w]);
        }
    });
    return straight;
}

/// The same, of very many angles from series over the angle where these are shorter: 1e-9 of what
/// is not masked.
LayeredScattering::Straight LayeredScattering::straight_through(
    std::span<const double> theta_deg, std::size_t count,
    const std::vector<double>& wavelength_nm) const {
    constexpr std::size_t kMany = 2000;
    constexpr double kSmoothEnough = 0.03, kTolerance = 1e-9;
    double alpha = kRoughest;
    for (std::size_t l = 0; l < count; ++l) alpha = std::min(alpha, layers_[l]->alpha());
    if (count == 0 || theta_deg.size() < kMany || alpha < kSmoothEnough)
        return straight_directly(theta_deg, count, wavelength_nm);
    const std::size_t W = wavelength_nm.size();
    Straight straight;
    straight.wavelengths = W;
    for (const double theta : theta_deg) straight.products.try_emplace(theta);
    for (auto& [theta, products] : straight.products) products.assign((count + 1) * W, 1);
    for (std::size_t l = 1; l <= count; ++l) {
        const AngleSeries series = exits(l, wavelength_nm, kTolerance);
        for (auto& [theta, products] : straight.products) {
            const std::span<double> values = std::span(products).subspan(l * W, W);
            series.values(theta, values);
            const double G1 = masking(l, theta);
            for (double& value : values) value = std::max(0.0, value * G1);
        }
    }
    return straight;
}

std::vector<double> LayeredScattering::base_factors(const std::vector<double>& wavelength_nm,
                                                    Paths paths) const {
    require_closed(paths);
    std::vector<double> factors;
    for (const double wavelength : wavelength_nm) factors.push_back(base_albedo(wavelength));
    if (paths == Paths::single) return factors;
    if (layers_.empty()) {
        const double rbar = coating_.is_there() ? coating_return(coating_) : 0;
        for (double& factor : factors) factor /= 1 - factor * rbar;
        return factors;
    }
    AngleMoments moments =
        base_light_
            .get(making_,
                 [&] {
                     return std::make_unique<BaseLight>(layers_[0]->alpha(), execution_.threads);
                 })
            .moments();
    const auto series = layers_[0]->facets()(wavelength_nm);
    for (std::size_t w = 0; w < factors.size(); ++w)
        factors[w] /= 1 - factors[w] * moments(*series[w], LayerTransport::kR).value;
    return factors;
}

std::vector<double> LayeredScattering::brdf(std::span<const ScatterPair> pairs,
                                            const std::vector<double>& wavelength_nm,
                                            Paths paths) const {
    require_closed(paths);
    const std::size_t W = wavelength_nm.size();
    struct Inside {
        double theta_i, theta_o, factor;
    };
    std::vector<Inside> inside;
    std::vector<double> angles;
    for (const ScatterPair& pair : pairs) {
        const Coating::Crossing i = coating_.inward(pair.theta_i_deg);
        const Coating::Crossing o = coating_.inward(pair.theta_o_deg);
        inside.push_back({i.theta_deg, o.theta_deg, i.T * o.T * coating_.dilution()});
        angles.insert(angles.end(), {i.theta_deg, o.theta_deg});
    }
    const Straight straight = straight_through(angles, crossed_layers(), wavelength_nm);
    std::vector<double> f(pairs.size() * W);
    const std::size_t blocks = (pairs.size() + kPairsTogether - 1) / kPairsTogether;
    for (std::size_t l = 0; l < layers_.size(); ++l) {
        parallel_for(blocks, execution_.threads, [&](std::size_t block) {
            const std::size_t begin = block * kPairsTogether;
            const std::size_t end = std::min(begin + kPairsTogether, pairs.size());
            std::vector<double> theta_d, scale;
            for (std::size_t p = begin; p < end; ++p) {
                const MirrorFacet facet =
                    mirror_facet(inside[p].theta_i, inside[p].theta_o, pairs[p].phi_deg);
                theta_d.push_back(facet.theta_d_deg);
                scale.push_back(inside[p].factor * lobe(layers_[l]->alpha(), facet));
            }
            const std::vector<double> R = layers_[l]->facets().values(theta_d, wavelength_nm);
            for (std::size_t p = begin; p < end; ++p) {
                const auto in = straight(inside[p].theta_i, l),
                           out = straight(inside[p].theta_o, l);
                for (std::size_t w = 0; w < W; ++w)
                    f[p * W + w] += scale[p - begin] * R[(p - begin) * W + w] * (in[w] * out[w]);
            }
        });
    }
    if (!has_base()) return f;
    const std::vector<double> base = base_brdf(pairs, wavelength_nm, paths);
    for (std::size_t k = 0; k < f.size(); ++k) f[k] += base[k];
    return f;
}

std::vector<double> LayeredScattering::base_brdf(std::span<const ScatterPair> pairs,
                                                 const std::vector<double>& wavelength_nm,
                                                 Paths paths, double times) const {
    require_closed(paths);
    const std::size_t W = wavelength_nm.size();
    std::vector<Coating::Crossing> crossings;
    std::vector<double> angles;
    for (const ScatterPair& pair : pairs)
        for (const double theta : {pair.theta_i_deg, pair.theta_o_deg}) {
            crossings.push_back(coating_.inward(theta));
            angles.push_back(crossings.back().theta_deg);
        }
    const Straight straight = straight_through(angles, layers_.size(), wavelength_nm);
    const std::vector<double> base = base_factors(wavelength_nm, paths);
    std::vector<double> f;
    f.reserve(pairs.size() * W);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const Coating::Crossing &i = crossings[2 * p], &o = crossings[2 * p + 1];
        const auto in = straight(i.theta_deg, layers_.size());
        const auto out = straight(o.theta_deg, layers_.size());
        const double factor = i.T * o.T * coating_.dilution() * (times / kPi);
        for (std::size_t w = 0; w < W; ++w) f.push_back(factor * (in[w] * out[w]) * base[w]);
    }
    return f;
}

std::vector<double> LayeredScattering::through(std::size_t l, double theta_i_deg,
                                               double theta_o_deg,
                                               const std::vector<double>& wavelength_nm) const {
    const std::array<double, 2> angles{theta_i_deg, theta_o_deg};
    const Straight straight = straight_through(angles, l, wavelength_nm);
    std::vector<double> both(wavelength_nm.size());
    const auto in = straight(theta_i_deg, l), out = straight(theta_o_deg, l);
    for (std::size_t w = 0; w < both.size(); ++w) both[w] = in[w] * out[w];
    return both;
}

double LayeredScattering::masking(std::size_t count, double theta_deg) const {
    double G1 = 1;
    for (std::size_t k = 0; k < count; ++k)
        G1 *= smith_masking(layers_[k]->alpha(), cos_of_incidence(theta_deg));
    return G1;
}

/// prod_{k<count} f_t cos relative to masking(), which has the features at grazing: a function of
/// the angle inside for each wavelength.
AngleSeries LayeredScattering::exits(std::size_t count, const std::vector<double>& wavelength_nm,
                                     double tolerance) const {
    constexpr double kNearGrazing_deg = 1e-6;
    return {wavelength_nm.size(), tolerance, [&](std::span<const double> angles) {
                // at grazing both vanish: the limit from above the surface
                std::vector<double> below;
                for (const double theta : angles)
                    below.push_back(std::min(theta, 90 - kNearGrazing_deg));
                const Straight straight = straight_directly(below, count, wavelength_nm);
                std::vector<double> values;
                values.reserve(angles.size() * wavelength_nm.size());
                for (const double theta : below) {
                    const double G1 = masking(count, theta);
                    for (const double tau : straight(theta, count)) values.push_back(tau / G1);
                }
                return values;
            }};
}

std::vector<double> LayeredScattering::base_exit(const std::vector<double>& wavelength_nm) const {
    double alpha = kRoughest;
    for (const auto& layer : layers_) alpha = std::min(alpha, layer->alpha());
    const AngleSeries series = exits(layers_.size(), wavelength_nm, kExitTolerance);
    return exit_from_below(coating_, alpha, series,
                           [&](double theta) { return masking(layers_.size(), theta); });
}

/// Moments of the lobe of one angle of the first layer, for one thread at a time.
struct LayeredScattering::Moments {
    Moments(double alpha, double theta_deg, const Coating& coating)
        : nodes(alpha, theta_deg, coating.top_deg()),
          moments([this, &coating](double begin, double end) {
              WeightedAngles weighted = nodes.over_theta_d(begin, end);
              for (std::size_t k = 0; k < weighted.weight.size(); ++k)
                  weighted.weight[k] *= nodes.weight(weighted.theta_deg[k], [&](double cos_o) {
                      return coating.outward_transmittance(cos_o);
                  });
              return weighted;
          }) {}
    LobeNodes nodes;
    std::mutex lock;
    AngleMoments moments;
};

std::shared_ptr<LayeredScattering::Moments> LayeredScattering::first_moments(
    double theta_deg) const {
    const std::scoped_lock guard(lock_);
    auto& moments = first_moments_[theta_deg];
    if (!moments) moments = std::make_shared<Moments>(layers_[0]->alpha(), theta_deg, coating_);
    return moments;
}

void LayeredScattering::add_first_layer_albedo(std::span<const double> theta_deg,
                                               const std::vector<double>& wavelength_nm,
                                               std::span<double> out) const {
    layers_[0]->facets().prepare(wavelength_nm, execution_.threads);
    const auto series = layers_[0]->facets()(wavelength_nm);
    parallel_for(theta_deg.size(), execution_.threads, [&](std::size_t i) {
        const std::shared_ptr<Moments> kept = first_moments(theta_deg[i]);
        const std::scoped_lock guard(kept->lock);
        for (std::size_t w = 0; w < series.size(); ++w)
            out[i * series.size() + w] += kept->moments(*series[w], LayerTransport::kR).value;
    });
}

void LayeredScattering::add_lower_layer_albedo(std::size_t l, std::span<const double> theta_deg,
                                               const std::vector<double>& wavelength_nm,
                                               std::span<double> out) const {
    const std::size_t W = wavelength_nm.size();
    const Straight in = straight_through(theta_deg, l, wavelength_nm);
    const AngleSeries above = exits(l, wavelength_nm, kExitTolerance);
    layers_[l]->facets().prepare(wavelength_nm, execution_.threads);
    const auto series = layers_[l]->facets()(wavelength_nm);
    parallel_for(theta_deg.size(), execution_.threads, [&](std::size_t i) {
        const LobeNodes nodes(layers_[l]->alpha(), theta_deg[i], coating_.top_deg());
        std::vector<double> sums(W);
        const auto exit = [&](double cos_o, std::span<double> values) {
            const double theta = std::min(90.0, std::acos(cos_o) / kDegree);
            above.values(theta, values);
            const double scale = masking(l, theta) * coating_.outward_transmittance(cos_o);
            for (double& value : values) value *= scale;
        };
        reflected_share(nodes, exit, series, LayerTransport::kR, sums);
        const auto through = in(theta_deg[i], l);
        for (std::size_t w = 0; w < W; ++w) out[i * W + w] += through[w] * sums[w];
    });
}

std::vector<double> LayeredScattering::albedo(std::span<const double> theta_i_deg,
                                              const std::vector<double>& wavelength_nm,
                                              Paths paths) const {
    require_closed(paths);
    const std::size_t W = wavelength_nm.size();
    std::vector<Coating::Crossing> crossings;
    std::vector<double> inside;
    for (const double theta : theta_i_deg) {
        crossings.push_back(coating_.inward(theta));
        inside.push_back(crossings.back().theta_deg);
    }
    std::vector<double> a(theta_i_deg.size() * W);
    if (!layers_.empty()) add_first_layer_albedo(inside, wavelength_nm, a);
    for (std::size_t l = 1; l < layers_.size(); ++l)
        add_lower_layer_albedo(l, inside, wavelength_nm, a);
    if (has_base()) {
        const Straight straight = straight_through(inside, layers_.size(), wavelength_nm);
        const std::vector<double> base = base_factors(wavelength_nm, paths);
        const std::vector<double> exit = base_exit(wavelength_nm);
        for (std::size_t i = 0; i < inside.size(); ++i) {
            const auto in = straight(inside[i], layers_.size());
            for (std::size_t w = 0; w < W; ++w) a[i * W + w] += in[w] * base[w] * exit[w];
        }
    }
    for (std::size_t i = 0; i < inside.size(); ++i)
        for (std::size_t w = 0; w < W; ++w)
            a[i * W + w] = crossings[i].R + crossings[i].T * a[i * W + w];
    return a;
}

std::vector<double> LayeredScattering::straight(std::size_t layer,
                                                std::span<const double> theta_deg,
                                                const std::vector<double>& wavelength_nm) const {
    layers_[layer]->facets().prepare(wavelength_nm, execution_.threads);
    std::vector<double> values(theta_deg.size() * wavelength_nm.size());
    parallel_for(theta_deg.size(), execution_.threads, [&](std::size_t i) {
        std::ranges::copy(layers_[layer]->straight(theta_deg[i], wavelength_nm, crossings_),
                          values.begin() + static_cast<std::ptrdiff_t>(i * wavelength_nm.size()));
    });
    return values;
}

double LayeredScattering::passing(std::size_t layer, double theta_deg, double straight) const {
    const double G1 = smith_masking(layers_[layer]->alpha(), cos_of_incidence(theta_deg));
    return std::min(1.0, 2 * straight / (1 + G1));
}

std::vector<double> LayeredScattering::sampling(std::span<const double> theta_i_deg,
                                                const std::vector<double>& wavelength_nm) const {
    std::vector<double> inside;
    for (const double theta : theta_i_deg) inside.push_back(coating_.inward(theta).theta_deg);
    std::vector<std::vector<double>> tau;
    for (std::size_t l = 0; l < layers_.size(); ++l)
        tau.push_back(straight(l, inside, wavelength_nm));
    std::vector<double> probabilities;
    for (std::size_t i = 0; i < inside.size(); ++i)
        for (std::size_t w = 0; w < wavelength_nm.size(); ++w) {
            const Coating::Crossing at = coating_.inward(theta_i_deg[i]);
            probabilities.push_back(at.R);
            double left = at.T;
            for (std::size_t l = 0; l < layers_.size(); ++l) {
                const double p = passing(l, inside[i], tau[l][i * wavelength_nm.size() + w]);
                probabilities.push_back((1 - p) * left);
                left *= p;
            }
            probabilities.push_back(left);
        }
    return probabilities;
}

std::vector<double> LayeredScattering::multiplexed_sampling(
    std::span<const double> theta_i_deg, const std::vector<double>& wavelength_nm) const {
    std::vector<double> probabilities;
    for (const double theta : theta_i_deg) {
        const Coating::Crossing at = coating_.inward(theta);
        probabilities.push_back(at.R);
        double left = at.T;
        for (std::size_t l = 0; l < layers_.size(); ++l) {
            const std::vector<double> tau = straight(l, {&at.theta_deg, 1}, wavelength_nm);
            const double mean =
                std::accumulate(tau.begin(), tau.end(), 0.0) / static_cast<double>(tau.size());
            const double p = passing(l, at.theta_deg, mean);
            probabilities.push_back((1 - p) * left);
            left *= p;
        }
        probabilities.push_back(left);
    }
    return probabilities;
}

}  // namespace irido
