#include "core/color/stack_color.hpp"

#include <algorithm>
#include <cmath>

#include "core/color/baselines/approximation.hpp"
#include "core/color/baselines/landmark_color.hpp"
#include "core/color/bloch/bloch_color.hpp"
#include "core/color/bloch/one_mirror.hpp"
#include "core/color/fourier/film_color.hpp"
#include "core/color/quadrature/quadrature_color.hpp"
#include "core/color/spread_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "core/math/lazy.hpp"
#include "core/math/parallel.hpp"

namespace irido {

namespace {

/// Angles that one thread takes at a time.
constexpr std::size_t kAnglesTogether = 16;

/// Microseconds that each method takes for one film of constant indices, as `irido bench pareto`
/// and ./dev bench find them, on AVX-512: only their ratios decide.
///   path_um  the film's optical path there and back
double series_us(double colors) {
    constexpr double kTable = 13000, kColor = 0.2;
    return kTable + kColor * colors;
}
double quadrature_us(double colors, double path_um) {
    constexpr double kRules = 500, kRulesPerPath = 50, kColor = 0.7, kColorPerPath = 0.1;
    return kRules + kRulesPerPath * path_um + colors * (kColor + kColorPerPath * path_um);
}

/// Optical thickness of a standard deviation from which on the series with its closed forms
/// is quicker than the means of spread_color().
constexpr double kWideSpread_nm = 150;

/// Errors are measured against colours of this tolerance.
constexpr double kMeasuringTolerance = 1e-9;

/// Whether the series is the better way; over spread thicknesses it has closed forms.
bool is_for_series(const Stack& stack, const ColorRequest& request) {
    if (!is_one_film(stack) || has_dispersion(stack)) return false;
    const Layer film = only_film(stack);
    const double index = index_at(stack.materials[film.material], 550).real();
    const auto colors = static_cast<double>(request.colors);
    if (film.thickness_sigma_nm > 0) return index * film.thickness_sigma_nm > kWideSpread_nm;
    return series_us(colors) < quadrature_us(colors, 2e-3 * index * film.thickness_nm);
}

/// Fringes of all periods in the visible range from which on Bloch waves are quicker than
/// quadrature at 1e-6, and the points that they may take for one before quadrature would have been
/// done: it takes about 36 points a fringe, of 25 to 80 ns; Bloch waves fewer the more there are,
/// of 4 to 8 ns. That is under D65, of which 5e-6 is left for fringes of 1 mm; as this falls with
/// the square of the path, smaller tolerances and spikier lights need more points of Bloch waves.
constexpr double kFewestFringes = 150, kPointsPerFringe = 100, kFewestBlochPoints = 8192;
constexpr double kUsualTolerance = 1e-6, kUsualPath_nm = 1e6, kUsualDecay = 5e-6;

/// Visible fringes of a mirror at normal incidence.
double fringes_of(const OneMirror& mirror, WavelengthRange visible) {
    const double path_nm =
        mirror.first.n * mirror.first.thickness_nm + mirror.second.n * mirror.second.thickness_nm;
    return 2 * static_cast<double>(mirror.repeat) * path_nm *
           (1 / visible.first_nm - 1 / visible.last_nm);
}

/// The fringes, if Bloch waves are the better way; else 0.
double fringes_for_bloch(const ColorTables& tables, const Stack& stack,
                         const ColorRequest& request) {
    if (!mirror_fault(stack).empty()) return 0;
    const double fringes = fringes_of(one_mirror("bloch", stack), tables.sensitivity().support());
    if (!(fringes >= kFewestFringes)) return 0;
    const double more =
        kUsualTolerance / request.tolerance * tables.decay()(kUsualPath_nm) / kUsualDecay;
    return fringes >= kFewestFringes * std::sqrt(std::max(1.0, more)) ? fringes : 0;
}

ColorRequest bloch_request(const ColorRequest& request, double fringes) {
    ColorRequest result = request;
    const double most = std::max(kFewestBlochPoints, kPointsPerFringe * fringes);
    if (most < static_cast<double>(request.evaluations))
        result.evaluations = static_cast<std::size_t>(most);
    return result;
}

/// A special method, and quadrature where it cannot promise the tolerance.
class SpecialColor : public ColorAlgorithm {
public:
    SpecialColor(const ColorTables& tables, const Stack& stack, const ColorRequest& request,
                 std::unique_ptr<ColorAlgorithm> special)
        : tables_(tables), stack_(stack), request_(request), special_(std::move(special)) {}

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const std::size_t sides = request_.sides.size();
        const bool all = try_special(stack, angles_deg, colors);
        for (std::size_t i = 0; i < angles_deg.size(); ++i) {
            const std::span<StackColor> of_angle = colors.subspan(i * sides, sides);
            const bool is_there = all || try_special(stack, angles_deg.subspan(i, 1), of_angle);
            if (is_there && std::ranges::all_of(of_angle, [&](const StackColor& color) {
                    return color.error <= request_.tolerance;
                }))
                continue;
            const ColorAlgorithm& exact = *quadrature_.get(lock_, [&] {
                return std::make_unique<std::unique_ptr<ColorAlgorithm>>(
                    quadrature_color(tables_, stack_, request_));
            });
            exact(stack, angles_deg.subspan(i, 1), of_angle);
        }
    }

private:
    /// False if it does not take an angle.
    bool try_special(const Stack& stack, std::span<const double> angles_deg,
                     std::span<StackColor> colors) const {
        try {
            (*special_)(stack, angles_deg, colors);
            return true;
        } catch (const DomainError&) {
            return false;
        }
    }

    const ColorTables& tables_;
    Stack stack_;
    ColorRequest request_;
    std::unique_ptr<ColorAlgorithm> special_;
    mutable std::mutex lock_;
    mutable Lazy<std::unique_ptr<ColorAlgorithm>> quadrature_;
};

/// Quadrature of spectra, or of spectra without spread where that suffices.
///   method  of stacks without spread
std::unique_ptr<ColorAlgorithm> exact_color(const ColorTables& tables, const Stack& stack,
                                            const ColorMethod& method,
                                            const ColorRequest& request) {
    if (auto special = spread_color(tables, stack, method, request))
        return std::make_unique<SpecialColor>(tables, stack, request, std::move(special));
    return quadrature_color(tables, stack, request);
}

std::unique_ptr<ColorAlgorithm> automatic_color(const ColorTables& tables, const Stack& stack,
                                                const ColorRequest& request) {
    std::unique_ptr<ColorAlgorithm> special;
    if (is_for_series(stack, request)) {
        special = film_color(tables, stack, {ColorMethod::Kind::fourier}, request);
    } else if (const double fringes = fringes_for_bloch(tables, stack, request); fringes > 0) {
        special =
            bloch_color(tables, stack, {ColorMethod::Kind::bloch}, bloch_request(request, fringes));
    } else {
        return exact_color(tables, stack, {}, request);
    }
    return std::make_unique<SpecialColor>(tables, stack, request, std::move(special));
}

}  // namespace

std::unique_ptr<ColorAlgorithm> color_algorithm(const ColorTables& tables, const Stack& stack,
                                                const ColorMethod& method,
                                                const ColorRequest& request) {
    using enum ColorMethod::Kind;
    require_in_range("tolerance", request.tolerance, kSmallestTolerance, 1);
    switch (method.kind) {
        case automatic:
            return automatic_color(tables, stack, request);
        case quadrature:
            return exact_color(tables, stack, method, request);
        case fourier:
        case fourier_constant:
            return film_color(tables, stack, method, request);
        case bloch:
            return bloch_color(tables, stack, method, request);
        case landmarks:
            return landmark_color(tables, stack, method, request);
        default:
            return approximate_color(tables, stack, method, request);
    }
}

std::vector<StackColor> stack_color(const ColorAlgorithm& algorithm, const Stack& stack,
                                    std::size_t sides, std::span<const double> angles_deg,
                                    unsigned threads) {
    std::vector<StackColor> colors(angles_deg.size() * sides);
    const std::size_t blocks = (angles_deg.size() + kAnglesTogether - 1) / kAnglesTogether;
    parallel_for(blocks, threads, [&](std::size_t block) {
        const std::size_t begin = block * kAnglesTogether;
        const std::size_t count = std::min(kAnglesTogether, angles_deg.size() - begin);
        algorithm(stack, angles_deg.subspan(begin, count),
                  std::span(colors).subspan(begin * sides, count * sides));
    });
    return colors;
}

std::vector<StackColor> stack_color(const ColorTables& tables, const Stack& stack,
                                    const ColorMethod& method, const ColorRequest& request,
                                    std::span<const double> angles_deg, unsigned threads) {
    return stack_color(*color_algorithm(tables, stack, method, request), stack,
                       request.sides.size(), angles_deg, threads);
}

bool measure_errors(const ColorTables& tables, const Stack& stack, const ColorRequest& request,
                    std::span<const double> angles_deg, unsigned threads,
                    std::span<StackColor> colors) {
    if (std::ranges::all_of(colors, [](const StackColor& c) { return std::isfinite(c.error); }))
        return false;
    ColorRequest exactly = request;
    exactly.tolerance = std::min(request.tolerance, kMeasuringTolerance);
    const std::vector<StackColor> exact =
        stack_color(tables, stack, {}, exactly, angles_deg, threads);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        if (std::isfinite(colors[i].error)) continue;
        colors[i].error = exact[i].error + largest_difference(colors[i].xyz, exact[i].xyz);
    }
    return true;
}

}  // namespace irido
