#include "core/rough/walk/prepared_color.hpp"

#include <algorithm>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/stack_color.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/parallel.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

namespace {

/// Of R and T at single wavelengths, of the weight of light from the base, and of colours.
constexpr double kPreparedTolerance = 1e-5;

/// Samples of R's colour between the ends, and of the base's: 70 at alpha = 0.1.
constexpr std::size_t kFacetSamples = 512, kFewestBaseSamples = 32, kMostBaseSamples = 256;

/// Of the rule that integrates colours, where it resolves the fringes.
constexpr std::size_t kPreparedDegree = 128;

constexpr double kNearGrazing_deg = 90 - 1e-6;

/// The rule's wavelengths and weights of X, Y, Z.
struct PreparedRule {
    explicit PreparedRule(const ColorTables& tables)
        : rule(tables.rule(tables.sensitivity().support(), kPreparedDegree)),
          wavelength_nm(rule->wavelength_nm.begin(),
                        rule->wavelength_nm.begin() + static_cast<std::ptrdiff_t>(rule->points)) {}

    double weight(std::size_t channel, std::size_t wavelength) const {
        return rule->weights[channel * rule->stride + wavelength];
    }

    std::shared_ptr<const QuadratureRule> rule;
    std::vector<double> wavelength_nm;
};

/// Colours of R: by the rule, or by exact ones where it is not fine enough for some of these.
std::vector<Triple> facet_colors(const ColorTables& tables, const Stack& stack,
                                 std::span<const double> angles, const Execution& execution) {
    const PreparedRule rule(tables);
    const std::size_t W = rule.wavelength_nm.size();
    const FacetSeries facets(stack, Light::unpolarized, {Side::reflected}, execution.simd);
    const std::vector<double> R = facets.values(angles, rule.wavelength_nm);
    std::vector<Triple> colors(angles.size());
    for (std::size_t k = 0; k < angles.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t w = 0; w < W; ++w) colors[k][c] += rule.weight(c, w) * R[k * W + w];
    ColorRequest request;
    request.tolerance = kPreparedTolerance;
    request.simd = execution.simd;
    const auto exact_at = [&](std::span<const double> some) {
        request.colors = some.size();
        return stack_color(tables, stack, {}, request, some, execution.threads);
    };
    bool is_fine = true;
    for (const std::size_t k : {angles.size() / 9, angles.size() / 2, angles.size() * 8 / 9}) {
        const Triple exact = exact_at(angles.subspan(k, 1)).front().xyz;
        for (std::size_t c = 0; c < 3; ++c)
            is_fine = is_fine && std::abs(exact[c] - colors[k][c]) <= 2 * kPreparedTolerance;
    }
    if (is_fine) return colors;
    const std::vector<StackColor> exact = exact_at(angles);
    for (std::size_t k = 0; k < angles.size(); ++k) colors[k] = exact[k].xyz;
    return colors;
}

}  // namespace

double PreparedColor::angle_at(std::size_t sample, std::size_t samples) {
    const double u = std::abs(static_cast<double>(sample) - 1) / static_cast<double>(samples);
    if (u >= 1) return 90;
    return 2 * std::asin(u / std::sqrt(2.0)) / kDegree;
}

PreparedColor::Place PreparedColor::place_of(double u, std::size_t samples) {
    const double at = std::clamp(u, 0.0, 1.0) * static_cast<double>(samples);
    const auto first = std::min(static_cast<std::size_t>(at), samples - 1);
    const double t = at - static_cast<double>(first), a = t + 1, b = 1 - t, c = 2 - t;
    return {first, {-t * b * c / 6, a * b * c / 2, a * t * c / 2, -a * t * b / 6}};
}

PreparedColor::PreparedColor(const ColorTables& tables, LayeredSurface surface, Paths paths,
                             Crossings crossings, const Execution& execution) {
    if (surface.layers.size() != 1 || surface.is_coated())
        throw DomainError("prepared colours take one layer without a coating");
    Stack& stack = surface.layers.front().stack;
    stack = held_stack(stack, tables.sensitivity());
    const double alpha = surface.layers.front().alpha;
    alpha2_ = alpha * alpha;
    std::vector<double> angles;
    for (std::size_t k = 0; k < kFacetSamples + 3; ++k)
        angles.push_back(angle_at(k, kFacetSamples));
    for (const Triple& xyz : facet_colors(tables, stack, angles, execution))
        facets_.push_back({xyz[0], xyz[1], xyz[2], 0});
    // past grazing, where u = 1
    const std::size_t last = facets_.size() - 1;
    for (std::size_t c = 0; c < 3; ++c)
        facets_[last][c] = 3 * (facets_[last - 1][c] - facets_[last - 2][c]) + facets_[last - 3][c];
    const LayeredScattering scattering(std::move(surface), crossings, execution);
    if (scattering.has_base()) prepare_base(tables, scattering, paths, crossings, execution);
}

void PreparedColor::prepare_base(const ColorTables& tables, const LayeredScattering& scattering,
                                 Paths paths, Crossings crossings, const Execution& execution) {
    const PreparedRule rule(tables);
    const std::vector<double>& wavelengths = rule.wavelength_nm;
    const std::size_t W = wavelengths.size();
    const LayerTransport& layer = scattering.layer(0);
    const AngleSeries series = layer.powers(wavelengths);
    std::vector<double> albedo, returned(W);
    for (const double wavelength : wavelengths)
        albedo.push_back(scattering.base_albedo(wavelength));
    if (paths == Paths::all) {
        BaseLight(layer.alpha(), execution.threads, kPreparedTolerance)
            .moments()
            .values(series, 0, returned);
        for (std::size_t w = 0; w < W; ++w) albedo[w] /= 1 - albedo[w] * returned[w];
    }
    const auto enough = static_cast<std::size_t>(7 / layer.alpha());
    base_samples_ = std::clamp(enough, kFewestBaseSamples, kMostBaseSamples);
    const std::size_t rows = base_samples_ + 3;
    std::vector<double> tau(rows * W);  // f_t cos / G1
    parallel_for(rows, execution.threads, [&](std::size_t k) {
        const double theta = std::min(angle_at(k, base_samples_), kNearGrazing_deg);
        const double G1 = smith_masking(layer.alpha(), cos_of_incidence(theta));
        const std::vector<double> of_angle = layer.straight(series, theta, crossings);
        for (std::size_t w = 0; w < W; ++w) tau[k * W + w] = of_angle[w] / G1;
    });
    for (std::size_t w = 0; w < W; ++w) {
        const auto before = [&](std::size_t k) { return tau[(rows - 1 - k) * W + w]; };
        tau[(rows - 1) * W + w] = 3 * (before(1) - before(2)) + before(3);
    }
    std::array<std::vector<double>, 3> weight;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t w = 0; w < W; ++w)
            weight[c].push_back(rule.weight(c, w) * albedo[w] / kPi);
    base_.resize(rows * rows);
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t o = 0; o <= i; ++o) {
            Cell cell{};
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t w = 0; w < W; ++w)
                    cell[c] += weight[c][w] * tau[i * W + w] * tau[o * W + w];
            base_[i * rows + o] = base_[o * rows + i] = cell;
        }
}

Triple PreparedColor::operator()(const Direction& i, const Direction& o) const {
    const double x = i[0] + o[0], y = i[1] + o[1], z = i[2] + o[2];
    const double flat2 = x * x + y * y, length2 = flat2 + z * z;
    const auto visibility_of = [&](double c) {
        return 2 / (c + std::sqrt(c * c + alpha2_ * (1 - c * c)));
    };
    const double Vi = visibility_of(i[2]), Vo = visibility_of(o[2]);
    // opposite grazing directions: of all facets between them the upright one
    const double spread = length2 > 0 ? (alpha2_ * z * z + flat2) / length2 : alpha2_;
    const double scale = 0.25 * alpha2_ * Vi * Vo / (kPi * spread * spread);
    const auto u_of = [](double c) { return std::sqrt(std::max(0.0, 1 - c)); };
    const Place d = place_of(u_of(0.5 * std::sqrt(length2)), kFacetSamples);
    Cell sum{};
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t c = 0; c < 4; ++c) sum[c] += d.weight[k] * facets_[d.first + k][c];
    for (double& part : sum) part *= scale;
    if (!base_.empty()) {
        const double masked = Vi * i[2] * Vo * o[2];
        const Place a = place_of(u_of(i[2]), base_samples_),
                    b = place_of(u_of(o[2]), base_samples_);
        for (std::size_t k = 0; k < 4; ++k) {
            const Cell* const row = base_.data() + (a.first + k) * (base_samples_ + 3) + b.first;
            for (std::size_t j = 0; j < 4; ++j) {
                const double share = masked * a.weight[k] * b.weight[j];
                for (std::size_t c = 0; c < 4; ++c) sum[c] += share * row[j][c];
            }
        }
    }
    return {sum[0], sum[1], sum[2]};
}

}  // namespace irido
