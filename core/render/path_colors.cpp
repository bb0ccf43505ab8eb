#include "core/render/path_colors.hpp"

#include <algorithm>
#include <cmath>

#include "core/color/held_stack.hpp"
#include "core/error.hpp"
#include "core/render/as_array.hpp"

namespace irido {

namespace {

/// Where the rest of a path is not worth computing: a part of white.
constexpr float kDim = 2e-3F;
/// Cosine of the angle beyond which faces of a film are mirrors, and resonances narrow.
constexpr double kNearGrazing = 0.15;
/// The cosine at which the wavelengths for these angles are chosen: nearer to grazing lies a
/// thousandth of a sphere's disc.
constexpr double kGrazing = 0.03;
/// Of colours by one number of wavelengths and by twice as many, CIEDE2000.
constexpr double kNodesTolerance = 0.03, kGrazingTolerance = 0.1;
/// Tables that take more than this part of the places do not pay.
constexpr std::size_t kTablePart = 8;

}  // namespace

/// A stack at the wavelengths of a regime.
struct PathColors::Face {
    StackSpectra spectra;
    std::optional<GridTable> table{};
};

struct PathColors::Regime {
    std::size_t count() const { return nodes.wavelength_nm.size(); }
    std::size_t width() const { return 4 * count(); }  ///< of [R, T][s, p][node]

    /// Linear sRGB of a spectrum [s, p][node].
    Triple integral(std::span<const float> s_and_p) const {
        const auto s = as_array(s_and_p.first(count())),
                   p = as_array(s_and_p.subspan(count(), count()));
        Triple rgb{};
        for (std::size_t c = 0; c < 3; ++c)
            rgb[c] = static_cast<double>((as_array(weights[c]) * (s + p)).sum());
        return rgb;
    }

    /// Of reflected or of transmitted light, the larger one.
    double distance(std::span<const float> a, std::span<const float> b) const {
        const std::size_t half = width() / 2;
        const auto off = [&](std::size_t from) {
            return srgb_difference(integral(a.subspan(from, half)),
                                   integral(b.subspan(from, half)));
        };
        return std::max(off(0), off(half));
    }

    /// Colours of single and of repeated reflection and transmission where fringes are finest.
    std::vector<Triple> trials(const ShownRange& range) const {
        const std::size_t half = width() / 2;
        std::vector<float> powers(width()), product(half);
        std::vector<Triple> colors;
        const StackSpectra& spectra = faces.front().spectra;
        StackSpectra::Memory memory;
        for (const double nm : {range.largest_nm, range.least_nm})
            for (const double cosine :
                 {range.largest_cosine, std::lerp(range.least_cosine, range.largest_cosine, 0.2),
                  range.least_cosine}) {
                spectra({cosine, nm}, powers, memory);
                const auto R = std::span(powers).first(half), T = std::span(powers).last(half);
                colors.push_back(integral(R));
                for (std::size_t k = 0; k < half; ++k) product[k] = T[k] * T[k];
                colors.push_back(integral(product));
                for (std::size_t k = 0; k < half; ++k) product[k] *= R[k];
                colors.push_back(integral(product));
            }
        return colors;
    }

    ColorNodes nodes;
    std::array<std::vector<float>, 3> weights;  ///< of the nodes, of s and p alike
    std::vector<Face> faces;                    ///< from outside, from inside
};

PathColors::~PathColors() = default;

PathColors::PathColors(const ColorTables& tables, const RgbTransform& to_srgb,
                       const SurfaceStack& stack, bool is_opaque, const ColorPlan& plan)
    : simd_(plan.simd) {
    const Sensitivity& sensitivity = tables.sensitivity();
    stacks_.push_back({held_stack(stack.stack, sensitivity), stack.varied});
    if (!is_opaque) stacks_.push_back(reversed_surface(stacks_[0]));
    ShownRange range = plan.range;
    if (range.largest_cosine > kNearGrazing) {
        range.least_cosine = std::max(range.least_cosine, kNearGrazing);
        regimes_.push_back(regime(sensitivity, to_srgb, range, kNodesTolerance));
        if (!regimes_.back()->nodes.are_enough)
            throw DomainError("the fringes of the stack are too fine for " +
                              std::to_string(regimes_.back()->count()) + " wavelengths");
    }
    if (plan.range.least_cosine < kNearGrazing) {
        range.least_cosine = std::max(plan.range.least_cosine, kGrazing);
        range.largest_cosine = std::min(plan.range.largest_cosine, kNearGrazing);
        regimes_.push_back(regime(sensitivity, to_srgb, range, kGrazingTolerance));
    }
    report_.wavelengths = regimes_.front()->count();
    if (plan.exact)
        report_.reason = "asked for";
    else
        make_tables(plan);
}

std::unique_ptr<PathColors::Regime> PathColors::regime(const Sensitivity& sensitivity,
                                                       const RgbTransform& to_srgb,
                                                       const ShownRange& range,
                                                       double tolerance) const {
    auto made = std::make_unique<Regime>();
    const auto use = [&](ColorNodes nodes) {
        made->nodes = std::move(nodes);
        for (std::size_t c = 0; c < 3; ++c) {
            made->weights[c].clear();
            for (const double weight : made->nodes.weight[c])
                made->weights[c].push_back(static_cast<float>(weight / 2));
        }
        made->faces.clear();
        for (const SurfaceStack& stack : stacks_)
            made->faces.push_back({{stack, made->nodes.wavelength_nm, simd_}});
    };
    use(enough_nodes(
        sensitivity, to_srgb,
        [&](const ColorNodes& nodes) {
            use(nodes);
            return made->trials(range);
        },
        tolerance));
    return made;
}

/// Near grazing they would not pay.
void PathColors::make_tables(const ColorPlan& plan) {
    ShownRange range = plan.range;
    if (range.largest_cosine <= kNearGrazing) {
        report_.reason = "near grazing incidence";
        return;
    }
    range.least_cosine = std::max(range.least_cosine, kNearGrazing);
    Regime& regime = *regimes_.front();
    for (Face& face : regime.faces) {
        face.table.emplace(
            GridTable::Plan{.range = range,
                            .channels = regime.width(),
                            .tolerance = plan.tolerance / 2,
                            .most_samples = plan.points / kTablePart,
                            .threads = plan.threads},
            [&](double nm, std::span<const double> cosines, std::span<float> values) {
                StackSpectra::Memory memory;
                for (std::size_t i = 0; i < cosines.size(); ++i)
                    face.spectra({cosines[i], nm},
                                 values.subspan(i * regime.width(), regime.width()), memory);
            },
            [&](std::span<const float> a, std::span<const float> b) {
                return regime.distance(a, b);
            });
        report_.evaluations += face.table->evaluations();
        report_.error = std::max(report_.error, face.table->error());
        if (!face.table->is_good()) break;
    }
    if (std::ranges::all_of(regime.faces,
                            [](const Face& face) { return face.table && face.table->is_good(); })) {
        report_.cosines = regime.faces[0].table->cosines();
        report_.thicknesses = regime.faces[0].table->thicknesses();
        report_.reason = "fewer spectra than places";
        return;
    }
    for (Face& face : regime.faces) face.table.reset();
    report_.reason = "a table would take as long";
}

Triple PathColors::operator()(std::span<const PathStep> path, Scratch& scratch) const {
    double least_cosine = 1;
    for (const PathStep& step : path) least_cosine = std::min(least_cosine, step.at.cosine);
    const bool is_grazing = regimes_.size() > 1 && least_cosine < kNearGrazing;
    const Regime& regime = is_grazing ? *regimes_.back() : *regimes_.front();
    const std::size_t half = regime.width() / 2;
    scratch.powers_.resize(regime.width());
    scratch.through_.assign(half, 1.0F);
    auto through = as_array(std::span(scratch.through_));
    auto reflected = as_array(std::span(scratch.powers_).first(half));
    auto transmitted = as_array(std::span(scratch.powers_).subspan(half, half));
    Triple color{};
    for (std::size_t step = 0; step < path.size(); ++step) {
        const PathStep& now = path[step];
        const std::size_t side = now.inside ? 1 : 0;
        const Face& face = regime.faces[side];
        if (face.table) {
            face.table->lookup(now.at.cosine, now.at.thickness_nm, scratch.powers_);
        } else {
            face.spectra(now.at, scratch.powers_,
                         scratch.memories_[2 * (is_grazing ? 1 : 0) + side]);
        }
        auto& goes_on = now.leaves && !now.inside ? transmitted : reflected;
        if (!now.leaves) {
            through *= goes_on;
            continue;
        }
        auto& leaving = now.inside ? transmitted : reflected;
        leaving *= through;
        through *= goes_on;
        const bool is_last = step + 1 == path.size() || through.maxCoeff() < kDim;
        // the rest goes to and fro: its sum, as if thickness and angle stayed
        if (is_last && now.inside)
            leaving = (goes_on < 1.0F).select(leaving / (1.0F - goes_on), through);
        const Triple seen = regime.integral({leaving.data(), half});
        for (std::size_t c = 0; c < 3; ++c) color[c] += seen[c] * now.light[c];
        if (is_last) break;
    }
    return color;
}

}  // namespace irido
