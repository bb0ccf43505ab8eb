#include "core/scratch/scratched_scattering.hpp"

#include <algorithm>
#include <cmath>

#include "core/color/held_stack.hpp"
#include "core/colorimetry/sensitivity_transform.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/math/parallel.hpp"
#include "core/math/transform.hpp"
#include "core/math/vector_math.hpp"
#include "core/scratch/light_points.hpp"
#include "core/scratch/rough_base.hpp"
#include "core/scratch/slit_color.hpp"
#include "core/scratch/vectors.hpp"
#include "core/spectrum/spectrum.hpp"

namespace irido {

namespace {

constexpr double kNanometres = 1000;  // in a micrometre
constexpr double kShortest_nm = 1, kLongest_nm = 1e7;

double half_cosine(const SkyPair& pair) {
    return std::sqrt(std::clamp((1 + dot(pair.light, pair.view)) / 2, 0.0, 1.0));
}

/// Reflectance of unpolarized light, [angle][wavelength].
std::vector<double> base_reflectance(const Stack& stack, const std::vector<double>& wavelength_nm,
                                     std::span<const double> cosines, const Execution& execution) {
    const StackPower power(stack);
    const IndexTable table(stack, wavelength_nm);
    const Needs needs{.T = false, .A = false};
    Spectra both = spectra(power, table, cosines, needs, execution);
    for (std::size_t i = 0; i < both.s.R.size(); ++i) both.s.R[i] = (both.s.R[i] + both.p.R[i]) / 2;
    return std::move(both.s.R);
}

Triple weighted(const std::array<std::vector<double>, 3>& weight, std::span<const double> values) {
    Triple sum{};
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < values.size(); ++i) sum[c] += weight[c][i] * values[i];
    return sum;
}

/// Values of a smooth function of 1/lambda: from the polynomial through Chebyshev points whose last
/// coefficients are rounding, if these are fewer than the wavelengths, else each by itself.
template <class F>
std::vector<double> smooth_values(const F& at, const std::vector<double>& wavelength_nm) {
    constexpr double kNothing = 1e-14;
    constexpr std::size_t kFewest = 32;
    const std::size_t count = wavelength_nm.size();
    std::vector<double> values(count);
    const auto [shortest, longest] = std::ranges::minmax(wavelength_nm);
    const double middle = (1 / shortest + 1 / longest) / 2, half = (1 / shortest - 1 / longest) / 2;
    for (std::size_t degree = kFewest; 4 * degree < count; degree *= 2) {
        std::vector<double> points(degree + 1), coefficients(degree + 1);
        for (std::size_t j = 0; j <= degree; ++j)
            points[j] = at(1 / (middle + half * std::cos(kPi * static_cast<double>(j) /
                                                         static_cast<double>(degree))));
        chebyshev_transform(degree)(points, coefficients);
        double last = 0, largest = 0;
        for (std::size_t k = 0; k <= degree; ++k) {
            const double size = std::abs(coefficients[k]);
            largest = std::max(largest, size);
            if (4 * k > 3 * degree) last = std::max(last, size);
        }
        if (last > kNothing * largest) continue;
        for (std::size_t i = 0; i < count; ++i) {
            const double x = (1 / wavelength_nm[i] - middle) / half;
            double b = 0, next = 0;  // Clenshaw's recurrence
            for (std::size_t k = degree; k > 0; --k) {
                const double one = coefficients[k] + 2 * x * b - next;
                next = b;
                b = one;
            }
            values[i] = coefficients[0] + x * b - next;
        }
        return values;
    }
    for (std::size_t i = 0; i < count; ++i) values[i] = at(wavelength_nm[i]);
    return values;
}

}  // namespace

std::vector<ScratchEnsemble> ensembles_of(const ScratchField& field) {
    constexpr double kPerMm2 = 1e-6;
    require_valid(field);
    const auto points = [](const DrawnRange& range) {
        std::vector<GaussNode> nodes;
        if (range.low == range.high) return std::vector<GaussNode>{{range.low, 1}};
        for (const GaussNode& node : gauss_legendre<16>())
            nodes.push_back(
                {range.low + (range.high - range.low) * (1 + node.x) / 2, node.weight / 2});
        return nodes;
    };
    const double length = (field.length_um.low + field.length_um.high) / 2;
    std::vector<ScratchEnsemble> parts;
    for (const GaussNode& width : points(field.width_um))
        for (const GaussNode& depth : points(field.depth_um)) {
            ScratchEnsemble part;
            part.width_um = width.x;
            part.depth_um = depth.x;
            part.share =
                field.count_per_mm2 * kPerMm2 * length * width.x * width.weight * depth.weight;
            part.angle_low_deg = field.angle_deg.low;
            part.angle_high_deg = field.angle_deg.high;
            parts.push_back(part);
        }
    return parts;
}

ScratchedScattering::ScratchedScattering(ScratchedSurface surface, const ScratchSight& sight,
                                         const ScratchSum& sum, const Execution& execution)
    : surface_(std::move(surface)), sum_(sum), execution_(execution) {
    constexpr double kReach = 6, kWaveReach = 9, kGaussianReach = 8;
    require_valid(surface_.optics);
    for (const Scratch& scratch : surface_.scratches) require_valid(scratch);
    for (const ScratchField& field : surface_.fields) require_valid(field);
    if (sum_.kind == ScratchSum::Kind::ensemble) {
        for (const ScratchField& field : surface_.fields)
            for (const ScratchEnsemble& part : ensembles_of(field)) ensembles_.push_back(part);
        return;
    }
    const auto* const footprint = std::get_if<Footprint>(&sight);
    const bool is_coherent = sum_.kind == ScratchSum::Kind::coherent;
    double radius = (is_coherent ? kWaveReach : kReach) * surface_.optics.coherence_radius_um;
    SurfacePoint center;
    if (footprint) {
        require_valid(*footprint);
        center = footprint->center;
        radius += std::max(footprint->a1_um, footprint->a2_um) *
                  (footprint->kind == Footprint::Kind::gaussian ? kGaussianReach : 1);
    } else {
        center = std::get<SurfacePoint>(sight);
    }
    std::vector<Scratch> all = surface_.scratches;
    for (std::size_t i = 0; i < surface_.fields.size(); ++i) {
        const auto drawn = scratches_near(surface_.fields[i], surface_.seed,
                                          static_cast<std::uint32_t>(i), center, radius);
        all.insert(all.end(), drawn.begin(), drawn.end());
    }
    for (const Scratch& scratch : all) {
        if (footprint)
            visible_.emplace_back(scratch, surface_.optics, *footprint);
        else
            visible_.emplace_back(scratch, surface_.optics, center);
    }
    if (!is_coherent) return;
    const std::vector<FootprintPoint> points =
        footprint ? footprint_points(*footprint, surface_.optics.coherence_radius_um)
                  : std::vector<FootprintPoint>{{center, 1}};
    const double seen = static_cast<double>(points.size()) * static_cast<double>(all.size());
    if (seen > kMostSeen)
        throw DomainError("coherent sums over " + to_text(seen) +
                          " scratches seen by points of a footprint are more than " +
                          to_text(kMostSeen));
    for (const FootprintPoint& point : points) {
        Place& place = places_.emplace_back(Place{point.weight, {}});
        for (const Scratch& scratch : all)
            place.visible.emplace_back(scratch, surface_.optics, point.at);
    }
}

double ScratchedScattering::density() const {
    double sum = 0;
    for (const VisibleScratch& scratch : visible_) sum += scratch.share();
    for (const ScratchEnsemble& part : ensembles_) sum += part.share;
    return sum;
}

bool ScratchedScattering::ends_nearby() const {
    return std::ranges::any_of(visible_, &VisibleScratch::ends_nearby);
}

std::vector<ScratchBalance> ScratchedScattering::balances(
    double view_rise, const std::vector<double>& wavelength_nm) const {
    if (!surface_.base) return std::vector(wavelength_nm.size(), ScratchBalance{0, 1});
    const double rise = surface_.optics.depth_phase == DepthPhase::vertical ? 2 : 2 * view_rise;
    std::vector<GrooveShare> grooves;
    for (const VisibleScratch& scratch : visible_)
        grooves.push_back({scratch.share(), rise * scratch.scratch().depth_um});
    for (const ScratchEnsemble& part : ensembles_)
        grooves.push_back({part.share, rise * part.depth_um});
    std::vector<ScratchBalance> all;
    for (const double wavelength : wavelength_nm)
        all.push_back(scratch_balance(grooves, kNanometres / wavelength, !surface_.fields.empty(),
                                      sum_.energy));
    return all;
}

std::vector<double> ScratchedScattering::separate(const SkyPair& pair,
                                                  const std::vector<double>& wavelength_nm) const {
    constexpr double kDark = 27;     // y from which on exp(-y^2) is 0
    constexpr double kSlack = 1e-3;  // of y, for a single wavelength
    constexpr std::size_t kWorthATable = 32;
    const std::size_t count = wavelength_nm.size();
    std::vector<double> sums(count, 0.0), nu(count), angle(count), slit(count), sine(count),
        cosine(count);
    const auto [shortest, longest] = std::ranges::minmax(wavelength_nm);
    for (const double end : {shortest, longest})
        require_in_range("wavelength_nm", end, kShortest_nm, kLongest_nm);
    for (std::size_t i = 0; i < count; ++i) nu[i] = kNanometres / wavelength_nm[i];
    for (const VisibleScratch& scratch : visible_) {
        const ScratchPair seen =
            pair_of(scratch, surface_.optics.depth_phase, pair.light, pair.view);
        const double per_nu = kTwoPi * scratch.coherence_radius_um() * std::abs(seen.xi1);
        const double first = per_nu * kNanometres / longest, last = per_nu * kNanometres / shortest;
        if (!scratch.has_ends() && first > kDark) continue;
        const bool is_tabled = count * scratch.places().size() > kWorthATable;
        const LobeTable lobe(scratch, is_tabled ? first : 0, is_tabled ? last + kSlack : 0,
                             kInfinity);
        const double width = scratch.scratch().width_um;
        for (std::size_t i = 0; i < count; ++i) angle[i] = kPi * width * seen.xi2 * nu[i];
        sin_cos(angle, sine, cosine, execution_.simd);
        for (std::size_t i = 0; i < count; ++i)
            slit[i] = width * nu[i] * sinc_of(angle[i], sine[i]);
        for (std::size_t i = 0; i < count; ++i) angle[i] = kPi * seen.path_um * nu[i];
        sin_cos(angle, sine, cosine, execution_.simd);
        for (std::size_t i = 0; i < count; ++i) {
            const double amplitude = slit[i] * sine[i];
            sums[i] += 8 * amplitude * amplitude * lobe(per_nu * nu[i]);
        }
    }
    return sums;
}

double ScratchedScattering::coherent(const SkyPair& pair, double wavelength_um) const {
    double sum = 0;
    for (const Place& place : places_)
        sum += place.weight * coherent_brdf(place.visible, surface_.optics.depth_phase, pair.light,
                                            pair.view, wavelength_um);
    return sum;
}

double ScratchedScattering::ensemble(const SkyPair& pair, double wavelength_um) const {
    double sum = 0;
    for (const ScratchEnsemble& part : ensembles_)
        sum += ensemble_brdf(part, surface_.optics, pair.light, pair.view, wavelength_um);
    return sum;
}

std::vector<double> ScratchedScattering::pair_brdf(const SkyPair& pair,
                                                   const std::vector<double>& wavelength_nm) const {
    std::vector<double> reflectance;
    if (surface_.base) {
        const double cosine = half_cosine(pair);
        reflectance =
            base_reflectance(*surface_.base, wavelength_nm, std::span(&cosine, 1), execution_);
    }
    const double rough = surface_.alpha ? facet_brdf(*surface_.alpha, pair.light, pair.view) : 0;
    std::vector<double> values;
    if (sum_.kind == ScratchSum::Kind::separate) {
        values = separate(pair, wavelength_nm);
    } else if (sum_.kind == ScratchSum::Kind::ensemble) {
        values = smooth_values([&](double nm) { return ensemble(pair, nm / kNanometres); },
                               wavelength_nm);
    } else {
        values.resize(wavelength_nm.size());
    }
    const std::vector<ScratchBalance> shares = balances(pair.view[2], wavelength_nm);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double wavelength_um = wavelength_nm[i] / kNanometres;
        if (sum_.kind == ScratchSum::Kind::coherent) values[i] = coherent(pair, wavelength_um);
        if (!surface_.base) continue;
        values[i] = reflectance[i] * (shares[i].scratches * values[i] + shares[i].base * rough);
    }
    return values;
}

std::vector<double> ScratchedScattering::brdf(std::span<const SkyPair> pairs,
                                              const std::vector<double>& wavelength_nm) const {
    const std::size_t count = wavelength_nm.size();
    std::vector<double> values(pairs.size() * count);
    parallel_for(pairs.size(), execution_.threads, [&](std::size_t i) {
        std::ranges::copy(pair_brdf(pairs[i], wavelength_nm),
                          values.begin() + static_cast<std::ptrdiff_t>(i * count));
    });
    return values;
}

double ScratchedScattering::longest_path_um(const SkyPair& pair) const {
    double longest = 0, nearest = 0, farthest = 0;
    for (const VisibleScratch& scratch : visible_) {
        const ScratchPair seen =
            pair_of(scratch, surface_.optics.depth_phase, pair.light, pair.view);
        longest = std::max(longest, scratch.scratch().width_um * std::abs(seen.xi2) + seen.path_um);
    }
    for (const Place& place : places_)
        for (const VisibleScratch& scratch : place.visible) {
            constexpr double kSeen = 9;
            if (std::abs(scratch.offset_um()) > kSeen * scratch.coherence_radius_um()) continue;
            const double phase =
                scratch.offset_um() *
                pair_of(scratch, surface_.optics.depth_phase, pair.light, pair.view).xi2;
            nearest = std::min(nearest, phase);
            farthest = std::max(farthest, phase);
        }
    for (const ScratchEnsemble& part : ensembles_)
        longest = std::max(longest, 2 * (part.width_um + part.depth_um));
    return longest + (farthest - nearest);
}

std::vector<Triple> ScratchedScattering::colors(std::span<const SkyPair> pairs,
                                                const Sensitivity& sensitivity) const {
    ScratchedScattering held = *this;
    if (held.surface_.base) held.surface_.base = held_stack(*surface_.base, sensitivity);
    double longest_um = 0;
    for (const SkyPair& pair : pairs) longest_um = std::max(longest_um, longest_path_um(pair));
    const SensitivityPoints points = sensitivity_points(sensitivity, kNanometres * longest_um);
    std::vector<double> wavelength_nm;
    for (const double nu : points.wavenumber) wavelength_nm.push_back(1 / nu);
    std::vector<Triple> colors(pairs.size());
    parallel_for(pairs.size(), execution_.threads, [&](std::size_t i) {
        colors[i] = weighted(points.weight, held.pair_brdf(pairs[i], wavelength_nm));
    });
    return colors;
}

std::vector<double> ScratchedScattering::light_ratios(std::span<const LightCone> lights,
                                                      std::span<const UnitVector> views,
                                                      const std::vector<double>& wavelength_nm,
                                                      const LightIntegral& method) const {
    if (sum_.kind != ScratchSum::Kind::separate)
        throw DomainError(
            "area lights require scratches that are added one by one, not an ensemble or a "
            "coherent sum");
    const std::size_t count = wavelength_nm.size();
    std::vector<std::vector<LightSlices>> slices(lights.size());  // [light][scratch]
    std::vector<int> orders(lights.size(), 0);
    if (method.kind == LightIntegral::Kind::exact)
        std::ranges::transform(lights, orders.begin(), [&](const LightCone& light) {
            return order_of(light, wavelength_nm);
        });
    for (std::size_t l = 0; l < lights.size(); ++l)
        if (orders[l] == 0)
            for (const VisibleScratch& scratch : visible_)
                slices[l].emplace_back(lights[l], scratch.tangent());
    std::vector<double> nu;
    for (const double wavelength : wavelength_nm) nu.push_back(kNanometres / wavelength);
    std::vector<double> values;
    for (const UnitVector& view : views) {
        std::vector<double> scratches(count, 0.0), facets(count, 0.0);
        std::vector<double> points(count, 0.0);
        for (std::size_t l = 0; l < lights.size(); ++l) {
            if (const int order = orders[l]; order > 0) {
                add_points(lights[l].light(), order, view, wavelength_nm, points);
                continue;
            }
            CosineSeries reflectance;
            if (surface_.base) {
                const CosineRange range = half_cosines(lights[l], view);
                const std::vector<double> at_nodes = base_reflectance(
                    *surface_.base, wavelength_nm, CosineSeries::nodes(range), execution_);
                reflectance = {range, at_nodes};
                if (surface_.alpha) {
                    const FacetWeights weights =
                        facet_weights(*surface_.alpha, lights[l], view, range);
                    for (std::size_t k = 0; k < weights.size(); ++k)
                        for (std::size_t i = 0; i < count; ++i)
                            facets[i] += weights[k] * at_nodes[k * count + i];
                }
            }
            add_light(slices[l], view, nu, method, reflectance, scratches);
        }
        const std::vector<ScratchBalance> shares = balances(view[2], wavelength_nm);
        for (std::size_t i = 0; i < count; ++i)
            values.push_back(shares[i].scratches * scratches[i] + shares[i].base * facets[i] +
                             points[i]);
    }
    return values;
}

int ScratchedScattering::order_of(const LightCone& light,
                                  const std::vector<double>& wavelength_nm) const {
    // where its directions are too near each other for the arcs of LightSlices
    constexpr double kSmall = 1e-4, kFewTurns = 12;
    constexpr double kSeen = 6;  // coherence radii to the farthest end that counts
    if (!(light.half_angle() < kSmall) || wavelength_nm.empty()) return 0;
    double length_um = 0;
    for (const VisibleScratch& scratch : visible_)
        length_um =
            std::max(length_um, kSeen * scratch.coherence_radius_um() + scratch.scratch().width_um +
                                    2 * scratch.scratch().depth_um);
    const double turn =
        kTwoPi * kNanometres / std::ranges::min(wavelength_nm) * length_um * light.half_angle();
    if (turn > kFewTurns) return 0;
    return turn < 1e-3 ? 2 : turn < 0.3 ? 4 : 8 + static_cast<int>(turn);
}

void ScratchedScattering::add_points(const AreaLight& light, int order, const UnitVector& view,
                                     const std::vector<double>& wavelength_nm,
                                     std::vector<double>& sums) const {
    const std::vector<LightPoint> points = light_points(light, order);
    std::vector<std::vector<double>> parts(points.size());
    parallel_for(points.size(), execution_.threads, [&](std::size_t i) {
        if (points[i].direction[2] > 0)
            parts[i] = pair_brdf({points[i].direction, view}, wavelength_nm);
    });
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double weight = points[i].solid_angle * points[i].direction[2];
        for (std::size_t w = 0; w < parts[i].size(); ++w) sums[w] += weight * parts[i][w];
    }
}

void ScratchedScattering::add_light(const std::vector<LightSlices>& slices, const UnitVector& view,
                                    const std::vector<double>& nu, const LightIntegral& method,
                                    const CosineSeries& reflectance,
                                    std::vector<double>& sums) const {
    if (nu.empty()) return;
    const double shortest_um = 1 / std::ranges::max(nu);
    const std::size_t size = nu.size();
    const auto each = [&](const LightIntegral& how, std::span<const double> whole) {
        std::vector<double> parts(visible_.size() * size);
        parallel_for(visible_.size(), execution_.threads, [&](std::size_t s) {
            const LitView lit{slices[s], surface_.optics.depth_phase, view};
            const LobeTable lobe = how.kind == LightIntegral::Kind::exact
                                       ? lobe_under(visible_[s], slices[s], view, shortest_um)
                                       : LobeTable(visible_[s], 0, 0);
            std::ranges::copy(
                irido::light_ratios(visible_[s], lit, nu, how, reflectance, lobe, whole),
                parts.begin() + static_cast<std::ptrdiff_t>(s * size));
        });
        std::vector<double> all(size, 0.0);
        for (std::size_t i = 0; i < parts.size(); ++i) all[i % size] += parts[i];
        return all;
    };
    std::vector<double> whole;
    if (method.kind == LightIntegral::Kind::exact && visible_.size() > 1) {
        whole = each({LightIntegral::Kind::points, 2}, {});
        if (std::ranges::any_of(whole, [](double one) { return !(one > 0); })) whole.clear();
    }
    const std::vector<double> all = each(method, whole);
    for (std::size_t i = 0; i < size; ++i) sums[i] += all[i];
}

std::vector<Triple> ScratchedScattering::light_colors(std::span<const LightCone> lights,
                                                      std::span<const UnitVector> views,
                                                      const Sensitivity& sensitivity,
                                                      const LightIntegral& method) const {
    constexpr double kPathOfBase_um = 12;  // for what its films and tables do
    ScratchedScattering held = *this;
    if (held.surface_.base) held.surface_.base = held_stack(*surface_.base, sensitivity);
    double largest_q = 0, longest_um = 0;
    for (const LightCone& light : lights)
        for (const UnitVector& view : views) {
            const HalfSpace& bound = light.bound();
            const double reach = std::acos(std::clamp(bound.least, -1.0, 1.0));
            const double middle = std::hypot(bound.normal[0] + view[0], bound.normal[1] + view[1]);
            largest_q = std::max(largest_q, middle + 2 * std::sin(reach / 2));
        }
    for (const VisibleScratch& scratch : visible_)
        longest_um = std::max(longest_um, scratch.scratch().width_um * std::min(2.0, largest_q) +
                                              2 * scratch.scratch().depth_um);
    const SpectralNodes nodes =
        spectral_nodes(sensitivity, longest_um + (surface_.base ? kPathOfBase_um : 0));
    std::vector<double> wavelength_nm;
    for (const double nu : nodes.nu_per_um) wavelength_nm.push_back(kNanometres / nu);
    const std::vector<double> ratios = held.light_ratios(lights, views, wavelength_nm, method);
    std::vector<Triple> colors;
    for (std::size_t v = 0; v < views.size(); ++v)
        colors.push_back(
            weighted(nodes.weight, std::span(ratios).subspan(v * nodes.size(), nodes.size())));
    return colors;
}

}  // namespace irido
