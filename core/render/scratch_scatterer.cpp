#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/render/as_array.hpp"
#include "core/render/facet.hpp"
#include "core/render/reflected_colors.hpp"
#include "core/render/scatterer.hpp"
#include "core/render/spectral_table.hpp"
#include "core/scratch/diffraction.hpp"
#include "core/scratch/energy.hpp"
#include "core/scratch/ensemble.hpp"
#include "core/scratch/scratched_scattering.hpp"

namespace irido {

namespace {

constexpr double kPerMicrometre = 1000;                 // nm
constexpr double kMostXi = 2, kMostRise = 2;            // |xi| and cos + cos
constexpr std::size_t kMostScratchSamples = 1U << 18U;  // of a table
constexpr std::size_t kXiSteps = 512;                   // chances of |xi|
constexpr double kBaseShare = 0.5;                      // of draws by the facets of a rough base
constexpr double kMiddle_um = 0.55;

double rise_of(const ScratchOptics& optics, const Vector3& a, const Vector3& b) {
    return optics.depth_phase == DepthPhase::vertical ? kMostRise : a.z + b.z;
}

/// sqrt(pi) y exp(-y^2/2) I0(y^2/2), which is 1 far from the mirror direction.
double lobe_ratio(double y) {
    constexpr double kFar = 6;
    if (y > kFar) {
        const double t = 1 / (4 * y * y);
        return 1 + t * (1 + t * (4.5 + t * 37.5));
    }
    const double z = y * y / 2;
    return std::sqrt(kPi) * y * std::exp(-z) * std::cyl_bessel_i(0.0, z);
}

/// The scratches of a field: shares of their widths, and parts of their depths, which are drawn
/// apart from each other.
struct FieldSums {
    explicit FieldSums(const ScratchField& field) {
        double whole = 0;
        for (const ScratchEnsemble& part : ensembles_of(field)) {
            widths[part.width_um] += part.share;
            depths[part.depth_um] += part.share;
            whole += part.share;
        }
        for (auto& [depth_um, share] : depths) share /= whole > 0 ? whole : 1;
    }
    /// BRDF times |xi| of all angles, away from the mirror direction.
    double far_field(double size, double rise, double nu) const {
        double across = 0, deep = 0;
        for (const auto& [width_um, share] : widths)
            across += share * width_um * slit_power(width_um, size, nu);
        for (const auto& [depth_um, share] : depths)
            deep += share * groove_power(depth_um * rise, nu);
        return across * deep * nu / kPi;
    }
    std::map<double, double> widths, depths;
};

class ScratchScatterer final : public Scatterer {
public:
    ScratchScatterer(const ScratchedSurface& surface, const TablePlan& plan);

    bool mirrors() const override { return base_ && !alpha_; }
    bool scatters() const override { return !fields_.empty() || alpha_; }
    void mirror(const FilmPoint& at, std::span<float> s_and_p, Memory& memory) const override;
    std::optional<Vector3> draw(const Vector3& to, double pick, double u, double v) const override;
    double density(const Vector3& to, const Vector3& from) const override;
    void scatter(const Vector3& to, const Vector3& from, double thickness_nm,
                 std::span<float> spectrum, Memory& memory) const override;

    const ColorReport& report() const override { return report_; }

private:
    /// Scratches whose angles spread evenly over a range.
    struct Field {
        double low, high;                ///< of their angles, rad
        std::optional<GridTable> power;  ///< BRDF times |xi| over |xi| and the rise, of all angles
        std::vector<double> sums;        ///< chances of |xi| up to each of equal steps
    };
    void add_field(const ScratchField& field, const ScratchOptics& optics, const TablePlan& plan);
    void add_balance(const ScratchedSurface& surface, const TablePlan& plan);
    double angle_share(const Field& field, double angle, double size) const;
    double field_density(const Field& field, const Vector3& to, const Vector3& from) const;

    std::size_t count_;
    std::vector<float> wavenumber_;  ///< of the nodes, 1/um
    ScratchOptics optics_;
    std::optional<double> alpha_;
    std::optional<StackSpectra> base_;
    std::optional<GridTable> base_table_;  ///< mean R over theta_d
    std::optional<GridTable> balance_;     ///< [base, scratches][node] over the view's cosine
    std::vector<Field> fields_;
    ColorReport report_;
};

}  // namespace

ColorNodes scratched_nodes(const ScratchedSurface& surface, const Sensitivity& sensitivity,
                           const RgbTransform& to_srgb, SimdLevel simd) {
    constexpr double kDrawnTolerance = 0.03;
    std::vector<FieldSums> fields;
    for (const ScratchField& field : surface.fields) fields.emplace_back(field);
    ColorNodes nodes = enough_nodes(
        sensitivity, to_srgb,
        [&](const ColorNodes& some) {
            const std::size_t count = some.wavelength_nm.size();
            std::vector<float> R(4 * count, 1.0F);
            if (surface.base) {
                const StackSpectra spectra(SurfaceStack{*surface.base}, some.wavelength_nm, simd);
                StackSpectra::Memory memory;
                spectra({1, 0}, R, memory);
            }
            std::vector<Triple> colors;
            for (const FieldSums& sums : fields)
                for (const double size : {0.01, 0.3, 1.0})
                    for (const double rise : {1.0, kMostRise}) {
                        std::vector<double> values;
                        double largest = 0;
                        for (std::size_t w = 0; w < count; ++w) {
                            values.push_back(
                                sums.far_field(size, rise, kPerMicrometre / some.wavelength_nm[w]) *
                                static_cast<double>(R[w]));
                            largest = std::max(largest, values.back());
                        }
                        Triple rgb{};
                        for (std::size_t c = 0; c < 3; ++c)
                            for (std::size_t w = 0; w < count && largest > 0; ++w)
                                rgb[c] += some.weight[c][w] * values[w] / largest;
                        colors.push_back(rgb);
                    }
            return colors;
        },
        kDrawnTolerance);
    if (!nodes.are_enough)
        throw DomainError("the interference of the scratches is too fine for " +
                          std::to_string(nodes.wavelength_nm.size()) + " wavelengths");
    return nodes;
}

ScratchScatterer::ScratchScatterer(const ScratchedSurface& surface, const TablePlan& plan)
    : count_(plan.nodes->count()), optics_(surface.optics), alpha_(surface.alpha) {
    for (const double nm : plan.nodes->wavelength_nm())
        wavenumber_.push_back(static_cast<float>(kPerMicrometre / nm));
    if (surface.base) {
        base_.emplace(SurfaceStack{*surface.base}, plan.nodes->wavelength_nm(), plan.simd);
        base_table_.emplace(GridTable::Plan{.range = {0, 1, 0, 0},
                                            .channels = count_,
                                            .tolerance = plan.tolerance / 2,
                                            .most_samples = kMostScratchSamples,
                                            .threads = plan.threads},
                            mean_reflectance(*base_), spectral_distance(*plan.nodes));
        if (!base_table_->is_good())
            throw DomainError("reflectances of the scratched base take too large a table");
        add_table(*base_table_, report_);
        add_balance(surface, plan);
    }
    for (const ScratchField& field : surface.fields) add_field(field, surface.optics, plan);
    report_.wavelengths = count_;
    report_.reason = "fewer spectra than places";
}

void ScratchScatterer::add_balance(const ScratchedSurface& surface, const TablePlan& plan) {
    std::map<double, double> depths;  // shares
    for (const ScratchField& field : surface.fields)
        for (const ScratchEnsemble& part : ensembles_of(field)) depths[part.depth_um] += part.share;
    balance_.emplace(
        GridTable::Plan{.range = {0, 1, 0, 0},
                        .channels = 2 * count_,
                        .tolerance = plan.tolerance / 2,
                        .most_samples = kMostScratchSamples,
                        .threads = plan.threads},
        [&](double, std::span<const double> cosines, std::span<float> values) {
            for (std::size_t i = 0; i < cosines.size(); ++i) {
                // in the limit of grazing both vanish
                constexpr double kLeastCosine = 1e-3;
                const double rise = surface.optics.depth_phase == DepthPhase::vertical
                                        ? 2
                                        : 2 * std::max(kLeastCosine, cosines[i]);
                std::vector<GrooveShare> grooves;
                for (const auto& [depth_um, share] : depths)
                    grooves.push_back({share, rise * depth_um});
                for (std::size_t w = 0; w < count_; ++w) {
                    const ScratchBalance balance =
                        scratch_balance(grooves, static_cast<double>(wavenumber_[w]), true);
                    values[2 * i * count_ + w] = static_cast<float>(balance.base);
                    values[(2 * i + 1) * count_ + w] = static_cast<float>(balance.scratches);
                }
            }
        },
        [&](std::span<const float> a, std::span<const float> b) {
            return std::max(
                srgb_difference(plan.nodes->rgb(a.first(count_)), plan.nodes->rgb(b.first(count_))),
                srgb_difference(plan.nodes->rgb(a.subspan(count_)),
                                plan.nodes->rgb(b.subspan(count_))));
        });
    if (!balance_->is_good())
        throw DomainError("the balance of scratches and base takes too large a table");
    add_table(*balance_, report_);
}

void ScratchScatterer::add_field(const ScratchField& field, const ScratchOptics& optics,
                                 const TablePlan& plan) {
    const FieldSums sums(field);
    Field& made = fields_.emplace_back();
    made.low = field.angle_deg.low * kDegree;
    made.high = std::max(field.angle_deg.high * kDegree, made.low + 1e-3 * kDegree);
    // relative to the brightest colour at normal incidence
    double brightest = 0;
    std::vector<double> bright;
    for (std::size_t i = 0; i < kXiSteps; ++i) {
        const double size = kMostXi * (static_cast<double>(i) + 0.5) / kXiSteps;
        double sum = 0;
        for (const double rise : {1.2, 1.6, 1.9})
            for (const double nm : {450.0, 540.0, 620.0})
                sum += sums.far_field(size, rise, kPerMicrometre / nm);
        bright.push_back(sum);
        brightest = std::max(brightest, sum / 9);
    }
    const bool is_vertical = optics.depth_phase == DepthPhase::vertical;
    const auto scale = static_cast<float>(brightest > 0 ? 1 / brightest : 1);
    made.power.emplace(
        GridTable::Plan{.range = {0, kMostXi, is_vertical ? kMostRise : 0, kMostRise},
                        .channels = count_,
                        .tolerance = plan.tolerance,
                        .most_samples = kMostScratchSamples,
                        .threads = plan.threads},
        [&](double rise, std::span<const double> sizes, std::span<float> values) {
            for (std::size_t i = 0; i < sizes.size(); ++i)
                for (std::size_t w = 0; w < count_; ++w)
                    values[i * count_ + w] = static_cast<float>(
                        sums.far_field(sizes[i], rise, static_cast<double>(wavenumber_[w])));
        },
        [&](std::span<const float> a, std::span<const float> b) {
            std::vector<float> one(a.begin(), a.end()), other(b.begin(), b.end());
            as_array(std::span(one)) *= scale;
            as_array(std::span(other)) *= scale;
            return srgb_difference(plan.nodes->rgb(one), plan.nodes->rgb(other));
        });
    if (!made.power->is_good())
        throw DomainError("scratches as wide or as deep as these take too large a table");
    add_table(*made.power, report_);
    // light of |xi|, whose rings have areas that grow as |xi|: BRDF |xi| itself
    constexpr double kEven = 0.1;
    double whole = 0, sum = 0;
    for (const double value : bright) whole += value;
    for (const double value : bright)
        made.sums.push_back(sum += (1 - kEven) * (whole > 0 ? value / whole : 1.0 / kXiSteps) +
                                   kEven / kXiSteps);
    for (double& chance : made.sums) chance /= sum;
}

/// Share of the light of scratches at all angles that goes to an azimuth of xi, times 2 pi: 1 if
/// they lie at all angles alike. A scratch reflects across itself.
double ScratchScatterer::angle_share(const Field& field, double angle, double size) const {
    const double y = kTwoPi / kMiddle_um * optics_.coherence_radius_um * size;
    const double across = angle + kPi / 2;
    double sum = 0;
    for (int turn = -4; turn <= 4; ++turn)
        sum += std::erf(y * (field.high - across - turn * kPi)) -
               std::erf(y * (field.low - across - turn * kPi));
    return sum / 2 * kPi / (field.high - field.low);
}

void ScratchScatterer::mirror(const FilmPoint& at, std::span<float> s_and_p, Memory& memory) const {
    memory.powers.resize(4 * count_);
    if (memory.stacks.empty()) memory.stacks.resize(1);
    (*base_)({at.cosine, 0}, memory.powers, memory.stacks.front());
    memory.first.resize(2 * count_);
    balance_->lookup(at.cosine, 0, memory.first);
    const auto kept = as_array(std::span(memory.first).first(count_)).cwiseMax(0.0F);
    for (const std::size_t half : {std::size_t{0}, count_})
        as_array(s_and_p.subspan(half, count_)) =
            kept * as_array(std::span(memory.powers).subspan(half, count_));
}

std::optional<Vector3> ScratchScatterer::draw(const Vector3& to, double pick, double u,
                                              double v) const {
    if (alpha_) {
        if (fields_.empty() || pick < kBaseShare) {
            const Vector3 from = facet_direction({0, 0, 1}, to, *alpha_, u, v);
            return from.z > 0 ? std::optional(from) : std::nullopt;
        }
        pick = (pick - kBaseShare) / (1 - kBaseShare);
    }
    const auto number = std::min(
        fields_.size() - 1, static_cast<std::size_t>(pick * static_cast<double>(fields_.size())));
    const Field& field = fields_[number];
    const double side = pick * static_cast<double>(fields_.size()) - static_cast<double>(number);
    const auto found = std::min(std::ranges::upper_bound(field.sums, u), field.sums.end() - 1);
    const auto i = static_cast<std::size_t>(found - field.sums.begin());
    const double before = i == 0 ? 0 : field.sums[i - 1];
    const double part = std::clamp((u - before) / (*found - before), 0.0, 1.0);
    const double size = kMostXi * (static_cast<double>(i) + part) / kXiSteps;
    const double angle = std::lerp(field.low, field.high, v) + (side < 0.5 ? kPi / 2 : -kPi / 2);
    const double x = size * std::cos(angle) - to.x, y = size * std::sin(angle) - to.y;
    const double across2 = x * x + y * y;
    if (!(across2 < 1)) return std::nullopt;
    return Vector3{x, y, std::sqrt(1 - across2)};
}

double ScratchScatterer::field_density(const Field& field, const Vector3& to,
                                       const Vector3& from) const {
    const double x = to.x + from.x, y = to.y + from.y, size = std::hypot(x, y);
    const auto i = std::min(kXiSteps - 1, static_cast<std::size_t>(size / kMostXi * kXiSteps));
    const double chance = (field.sums[i] - (i == 0 ? 0 : field.sums[i - 1])) * kXiSteps / kMostXi;
    // of the angle on the whole circle: both sides of each scratch
    const double angle = std::atan2(y, x), range = field.high - field.low;
    double covered = 0;
    for (int turn = -4; turn <= 4; ++turn) {
        const double along = angle + kPi / 2 + turn * kPi;
        if (along >= field.low && along <= field.high) covered += 0.5;
    }
    return chance * covered / range / size * from.z;
}

double ScratchScatterer::density(const Vector3& to, const Vector3& from) const {
    if (!(to.z > 0 && from.z > 0)) return 0;
    double sum = 0;
    for (const Field& field : fields_)
        sum += field_density(field, to, from) / static_cast<double>(fields_.size());
    if (!alpha_) return sum;
    const double facets = facet_light({0, 0, 1}, to, from, *alpha_).density;
    return fields_.empty() ? facets : std::lerp(sum, facets, kBaseShare);
}

void ScratchScatterer::scatter(const Vector3& to, const Vector3& from, double,
                               std::span<float> spectrum, Memory& memory) const {
    as_array(spectrum) = 0;
    if (!(to.z > 0 && from.z > 0)) return;
    constexpr double kLeastXi = 1e-9;
    const double x = to.x + from.x, y = to.y + from.y;
    const double size = std::max(kLeastXi, std::hypot(x, y));
    const double rise = rise_of(optics_, to, from);
    memory.first.resize(2 * count_);
    memory.second.resize(count_);
    const std::span<float> values(memory.second);
    for (const Field& field : fields_) {
        const double share = angle_share(field, std::atan2(y, x), size) * from.z / size;
        if (!(share > 0)) continue;
        field.power->lookup(size, rise, values);
        const double per_nu = kTwoPi * optics_.coherence_radius_um * size;
        constexpr double kFar = 60;  // where the lobe is that of far away to 1e-4
        if (per_nu * static_cast<double>(wavenumber_.back()) > kFar) {
            as_array(spectrum) += static_cast<float>(share) * as_array(values).max(0.0F);
            continue;
        }
        for (std::size_t w = 0; w < count_; ++w)
            spectrum[w] +=
                static_cast<float>(share * static_cast<double>(std::max(0.0F, values[w])) *
                                   lobe_ratio(per_nu * static_cast<double>(wavenumber_[w])));
    }
    if (!base_) return;
    balance_->lookup(to.z, 0, memory.first);
    const auto kept = as_array(std::span(memory.first).first(count_));
    as_array(spectrum) *= as_array(std::span(memory.first).subspan(count_, count_));
    if (alpha_) {
        const FacetLight facet = facet_light({0, 0, 1}, to, from, *alpha_);
        as_array(spectrum) += static_cast<float>(facet.density * facet.visible_part) * kept;
    }
    base_table_->lookup(std::sqrt((1 + to.x * from.x + to.y * from.y + to.z * from.z) / 2), 0,
                        values);
    as_array(spectrum) *= as_array(values).max(0.0F);
}

std::unique_ptr<const Scatterer> scratch_scatterer(const ScratchedSurface& surface,
                                                   const TablePlan& plan) {
    return std::make_unique<ScratchScatterer>(surface, plan);
}

}  // namespace irido
