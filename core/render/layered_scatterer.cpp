#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/angle_of_cosine.hpp"
#include "core/math/constants.hpp"
#include "core/render/as_array.hpp"
#include "core/render/facet.hpp"
#include "core/render/reflected_colors.hpp"
#include "core/render/scatterer.hpp"
#include "core/render/spectral_table.hpp"
#include "core/rough/ggx.hpp"
#include "core/rough/layered/layered_scattering.hpp"

namespace irido {

namespace {

constexpr Vector3 kUp{0, 0, 1};
/// Samples of a table that is worth making.
constexpr std::size_t kMostTableSamples = 1U << 16U;
/// Angles of the probabilities that draws are made by, and the least of a part that is seen.
constexpr std::size_t kProbabilityAngles = 129;
constexpr double kLeastProbability = 0.02;

/// A direction behind a smooth face, of the same azimuth.
Vector3 bent(const Vector3& direction, double ratio, double cosine) {
    return {ratio * direction.x, ratio * direction.y, cosine};
}

class LayeredScatterer final : public Scatterer {
public:
    LayeredScatterer(const LayeredScattering& scattering, Paths paths, const LayerPlace& varied,
                     const ShownRange& range, const TablePlan& plan);

    bool mirrors() const override { return coating_.is_there(); }
    bool scatters() const override { return !parts_.empty(); }
    void mirror(const FilmPoint& at, std::span<float> s_and_p, Memory& memory) const override;
    std::optional<Vector3> draw(const Vector3& to, double pick, double u, double v) const override;
    double density(const Vector3& to, const Vector3& from) const override;
    void scatter(const Vector3& to, const Vector3& from, double thickness_nm,
                 std::span<float> spectrum, Memory& memory) const override;

    const ColorReport& report() const override { return report_; }

private:
    /// A layer, or the base.
    struct Part {
        double alpha = 0;                     ///< of a layer
        std::optional<StackSpectra> spectra;  ///< of a layer
        std::optional<GridTable> R;           ///< over theta_d; none: computed each time
        std::optional<GridTable> straight;    ///< tau/G1 of a layer that is crossed
        bool is_base = false;
    };
    void add_layer(const LayeredScattering& scattering, std::size_t l, const LayerPlace& varied,
                   const ShownRange& range, const TablePlan& plan);
    void set_probabilities();
    double inside_cosine(double cosine) const;
    /// Of each part, reached from a cosine outside; sums to 1.
    double probability(std::size_t part, double cosine) const;
    void pass(const Part& part, double cosine, std::span<float> spectrum, Memory& memory) const;

    Coating coating_;
    double ratio_;  ///< index outside over that inside
    std::size_t count_;
    std::vector<Part> parts_;
    std::vector<float> base_;  ///< albedo of the base over pi, between all it meets if so asked
    std::vector<float> probabilities_;  ///< [cosine][part]
    ColorReport report_;
};

}  // namespace

ColorNodes layered_nodes(const LayeredScattering& scattering, const Sensitivity& sensitivity,
                         const RgbTransform& to_srgb) {
    constexpr std::array<double, 3> kMiddles_deg{0, 35, 60};
    constexpr std::size_t kFacets = 9;
    constexpr double kDrawnTolerance = 0.1;
    ColorNodes nodes = enough_nodes(
        sensitivity, to_srgb,
        [&](const ColorNodes& some) {
            const std::size_t count = some.wavelength_nm.size();
            std::vector<Triple> colors;
            const auto add = [&](const std::vector<double>& spectrum) {
                Triple rgb{};
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t w = 0; w < count; ++w)
                        rgb[c] += some.weight[c][w] * spectrum[w];
                colors.push_back(rgb);
            };
            std::vector<double> base;
            for (const double nm : some.wavelength_nm) base.push_back(scattering.base_albedo(nm));
            std::vector<std::vector<double>> through(kMiddles_deg.size(),
                                                     std::vector<double>(count, 1));
            for (std::size_t l = 0; l < scattering.layers(); ++l) {
                // light from one direction to another meets facets that tilt by about alpha
                std::vector<double> angles;
                for (const double middle : kMiddles_deg)
                    for (std::size_t f = 0; f < kFacets; ++f)
                        angles.push_back(std::abs(
                            middle + (2 * static_cast<double>(f) / (kFacets - 1) - 1) *
                                         std::min(20.0, scattering.layer(l).alpha() / kDegree)));
                const std::vector<double> both =
                    scattering.layer(l).facets().values(angles, some.wavelength_nm);
                for (std::size_t a = 0; a < kMiddles_deg.size(); ++a) {
                    std::vector<double> spectrum(count), passed(count);
                    for (std::size_t f = 0; f < kFacets; ++f)
                        for (std::size_t w = 0; w < count; ++w) {
                            const std::size_t k = (a * kFacets + f) * count + w;
                            spectrum[w] += through[a][w] * both[k] / kFacets;
                            passed[w] += both[angles.size() * count + k] / kFacets;
                        }
                    for (std::size_t w = 0; w < count; ++w) through[a][w] *= passed[w] * passed[w];
                    add(spectrum);
                }
            }
            if (scattering.has_base())
                for (std::vector<double>& spectrum : through) {
                    for (std::size_t w = 0; w < count; ++w) spectrum[w] *= base[w];
                    add(spectrum);
                }
            return colors;
        },
        kDrawnTolerance);
    if (!nodes.are_enough)
        throw DomainError("the fringes of the surface are too fine for " +
                          std::to_string(nodes.wavelength_nm.size()) + " wavelengths");
    return nodes;
}

LayeredScatterer::LayeredScatterer(const LayeredScattering& scattering, Paths paths,
                                   const LayerPlace& varied, const ShownRange& range,
                                   const TablePlan& plan)
    : coating_(scattering.coating()),
      ratio_(std::sqrt(coating_.dilution())),
      count_(plan.nodes->count()) {
    for (std::size_t l = 0; l < scattering.layers(); ++l)
        add_layer(scattering, l, varied, range, plan);
    if (scattering.has_base()) {
        parts_.emplace_back().is_base = true;
        for (const double albedo : scattering.base_factors(plan.nodes->wavelength_nm(), paths))
            base_.push_back(static_cast<float>(albedo / kPi));
    }
    set_probabilities();
    report_.wavelengths = count_;
    report_.reason = "fewer spectra than places";
}

void LayeredScatterer::add_layer(const LayeredScattering& scattering, std::size_t l,
                                 const LayerPlace& varied, const ShownRange& range,
                                 const TablePlan& plan) {
    const LayerTransport& layer = scattering.layer(l);
    Part& part = parts_.emplace_back();
    part.alpha = layer.alpha();
    part.spectra.emplace(SurfaceStack{layer.facets().stack(), varied}, plan.nodes->wavelength_nm(),
                         plan.simd);
    const bool is_uniform = varied.empty();
    part.R.emplace(GridTable::Plan{.range = {0, 1, is_uniform ? 0 : range.least_nm,
                                             is_uniform ? 0 : range.largest_nm},
                                   .channels = count_,
                                   .tolerance = plan.tolerance / 2,
                                   .most_samples = kMostTableSamples,
                                   .threads = plan.threads},
                   mean_reflectance(*part.spectra), spectral_distance(*plan.nodes));
    if (part.R->is_good())
        add_table(*part.R, report_);
    else
        part.R.reset();
    const bool is_last = l + 1 == scattering.layers() && !scattering.has_base();
    if (is_last) return;
    part.straight.emplace(
        GridTable::Plan{.range = {inside_cosine(0), 1, 0, 0},
                        .channels = count_,
                        .tolerance = plan.tolerance / 2,
                        .most_samples = kMostTableSamples,
                        .threads = plan.threads},
        [&](double, std::span<const double> cosines, std::span<float> values) {
            constexpr double kNearGrazing_deg = 90 - 1e-6;
            std::vector<double> angles;
            for (const double cosine : cosines)
                angles.push_back(std::min(kNearGrazing_deg, angle_of_cosine(cosine)));
            const std::vector<double> tau =
                scattering.straight(l, angles, plan.nodes->wavelength_nm());
            for (std::size_t i = 0; i < tau.size(); ++i)
                values[i] = static_cast<float>(
                    tau[i] / smith_masking(part.alpha, std::cos(angles[i / count_] * kDegree)));
        },
        spectral_distance(*plan.nodes));
    if (!part.straight->is_good())
        throw DomainError("transmittances of layer " + std::to_string(l + 1) +
                          " take too large a table");
    add_table(*part.straight, report_);
}

double LayeredScatterer::inside_cosine(double cosine) const {
    const double sine2 = ratio_ * ratio_ * (1 - cosine * cosine);
    return std::sqrt(std::max(0.0, 1 - sine2));
}

/// Of reflection by each part, FPB24 eqs. 31 and 35 with means of tau over the wavelengths, without
/// the coating.
void LayeredScatterer::set_probabilities() {
    std::vector<float> tau(count_);
    for (std::size_t i = 0; i < kProbabilityAngles; ++i) {
        const double cosine = static_cast<double>(i) / (kProbabilityAngles - 1);
        const double inside = inside_cosine(cosine);
        std::vector<double> chances;
        double left = 1, sum = 0;
        for (const Part& part : parts_) {
            double on = 0;
            if (part.straight) {
                part.straight->lookup(inside, 0, tau);
                const double G1 = smith_masking(part.alpha, inside);
                on = std::clamp(
                    2 * G1 * static_cast<double>(as_array(std::span(tau)).mean()) / (1 + G1), 0.0,
                    1.0);
            }
            chances.push_back(std::max(kLeastProbability, (1 - on) * left));
            left *= on;
            sum += chances.back();
        }
        for (const double chance : chances)
            probabilities_.push_back(static_cast<float>(chance / sum));
    }
}

double LayeredScatterer::probability(std::size_t part, double cosine) const {
    const double place = std::clamp(cosine, 0.0, 1.0) * (kProbabilityAngles - 1);
    const auto i = std::min(kProbabilityAngles - 2, static_cast<std::size_t>(place));
    return std::lerp(static_cast<double>(probabilities_[i * parts_.size() + part]),
                     static_cast<double>(probabilities_[(i + 1) * parts_.size() + part]),
                     place - static_cast<double>(i));
}

void LayeredScatterer::mirror(const FilmPoint& at, std::span<float> s_and_p, Memory&) const {
    const double R = coating_.inward(angle_of_cosine(at.cosine)).R;
    as_array(s_and_p) = static_cast<float>(R);
}

std::optional<Vector3> LayeredScatterer::draw(const Vector3& to, double pick, double u,
                                              double v) const {
    std::size_t part = 0;
    for (double left = pick; part + 1 < parts_.size(); ++part) {
        left -= probability(part, to.z);
        if (left < 0) break;
    }
    if (parts_[part].is_base) {
        const double across = std::sqrt(u), phi = kTwoPi * v;
        return Vector3{across * std::cos(phi), across * std::sin(phi), std::sqrt(1 - u)};
    }
    const Vector3 inside = bent(to, ratio_, inside_cosine(to.z));
    const Vector3 from = facet_direction(kUp, inside, parts_[part].alpha, u, v);
    if (!(from.z > 0)) return std::nullopt;
    if (!coating_.is_there()) return from;
    const double sine2 = (1 - from.z * from.z) / (ratio_ * ratio_);
    if (!(sine2 < 1)) return std::nullopt;
    return normalized(bent(from, 1 / ratio_, std::sqrt(1 - sine2)));
}

double LayeredScatterer::density(const Vector3& to, const Vector3& from) const {
    if (!(to.z > 0 && from.z > 0)) return 0;
    const double to_cosine = inside_cosine(to.z), from_cosine = inside_cosine(from.z);
    const Vector3 inside_to = bent(to, ratio_, to_cosine);
    const Vector3 inside_from = bent(from, ratio_, from_cosine);
    const double stretch = ratio_ * ratio_ * from.z / from_cosine;
    double sum = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Part& part = parts_[i];
        const double density =
            part.is_base ? from.z / kPi
                         : facet_light(kUp, inside_to, inside_from, part.alpha).density * stretch;
        sum += probability(i, to.z) * density;
    }
    return sum;
}

void LayeredScatterer::pass(const Part& part, double cosine, std::span<float> spectrum,
                            Memory& memory) const {
    memory.second.resize(count_);
    part.straight->lookup(cosine, 0, memory.second);
    as_array(spectrum) *= static_cast<float>(smith_masking(part.alpha, std::min(1.0, cosine))) *
                          as_array(std::span(memory.second)).max(0.0F);
}

void LayeredScatterer::scatter(const Vector3& to, const Vector3& from, double thickness_nm,
                               std::span<float> spectrum, Memory& memory) const {
    as_array(spectrum) = 0;
    if (!(to.z > 0 && from.z > 0)) return;
    const double to_cosine = inside_cosine(to.z), from_cosine = inside_cosine(from.z);
    const Vector3 inside_to = bent(to, ratio_, to_cosine);
    const Vector3 inside_from = bent(from, ratio_, from_cosine);
    const double entry = coating_.is_there()
                             ? coating_.outward_transmittance(to_cosine) *
                                   coating_.outward_transmittance(from_cosine) * coating_.dilution()
                             : 1;
    memory.powers.resize(std::max(memory.powers.size(), 4 * count_));
    memory.first.assign(count_, 1.0F);
    const std::span<float> through(memory.first);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Part& part = parts_[i];
        if (part.is_base) {
            as_array(spectrum) += static_cast<float>(entry * from.z) * as_array(std::span(base_)) *
                                  as_array(std::span(std::as_const(through)));
            return;
        }
        const FacetLight facet = facet_light(kUp, inside_to, inside_from, part.alpha);
        const double scale = entry * facet.density * facet.visible_part * (from.z / from_cosine);
        if (scale > 0) {
            const std::span<float> R = std::span(memory.powers).first(count_);
            if (part.R) {
                part.R->lookup(facet.cosine, thickness_nm, R);
            } else {
                if (memory.stacks.size() < parts_.size()) memory.stacks.resize(parts_.size());
                (*part.spectra)({facet.cosine, thickness_nm},
                                std::span(memory.powers).first(4 * count_), memory.stacks[i]);
                as_array(R) = 0.5F * (as_array(R) +
                                      as_array(std::span(memory.powers).subspan(count_, count_)));
            }
            as_array(spectrum) +=
                static_cast<float>(scale) * as_array(R).max(0.0F) * as_array(through);
        }
        if (!part.straight) return;
        pass(part, to_cosine, through, memory);
        pass(part, from_cosine, through, memory);
    }
}

std::unique_ptr<const Scatterer> layered_scatterer(const LayeredScattering& scattering, Paths paths,
                                                   const LayerPlace& varied,
                                                   const ShownRange& range, const TablePlan& plan) {
    return std::make_unique<LayeredScatterer>(scattering, paths, varied, range, plan);
}

}  // namespace irido
