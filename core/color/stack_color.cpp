#include "core/color/stack_color.hpp"

#include <algorithm>
#include <cmath>

#include "core/color/approximation.hpp"
#include "core/color/difference.hpp"
#include "core/color/film_color.hpp"
#include "core/color/quadrature_color.hpp"
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

/// Errors are measured against colours of this tolerance.
constexpr double kMeasuringTolerance = 1e-9;

/// Whether the series is the better way; quadrature takes very long over spread thicknesses.
bool is_for_series(const Stack& stack, const ColorRequest& request) {
    if (!is_one_film(stack) || has_dispersion(stack)) return false;
    const Layer film = only_film(stack);
    const double index = index_at(stack.materials[film.material], 550).real();
    const auto colors = static_cast<double>(request.colors);
    return film.thickness_sigma_nm > 0 ||
           series_us(colors) < quadrature_us(colors, 2e-3 * index * film.thickness_nm);
}

/// The series, and quadrature where it cannot promise the tolerance.
class FilmColor : public ColorAlgorithm {
public:
    FilmColor(const ColorTables& tables, const Stack& stack, const ColorRequest& request)
        : tables_(tables),
          stack_(stack),
          request_(request),
          series_(film_color(tables, stack, {ColorMethod::Kind::fourier}, request)) {}

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const std::size_t sides = request_.sides.size();
        const bool all = try_series(stack, angles_deg, colors);
        for (std::size_t i = 0; i < angles_deg.size(); ++i) {
            const std::span<StackColor> of_angle = colors.subspan(i * sides, sides);
            const bool is_there = all || try_series(stack, angles_deg.subspan(i, 1), of_angle);
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
    /// False if an angle has no series.
    bool try_series(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const {
        try {
            (*series_)(stack, angles_deg, colors);
            return true;
        } catch (const DomainError&) {
            return false;
        }
    }

    const ColorTables& tables_;
    Stack stack_;
    ColorRequest request_;
    std::unique_ptr<ColorAlgorithm> series_;
    mutable std::mutex lock_;
    mutable Lazy<std::unique_ptr<ColorAlgorithm>> quadrature_;
};

}  // namespace

std::unique_ptr<ColorAlgorithm> color_algorithm(const ColorTables& tables, const Stack& stack,
                                                const ColorMethod& method,
                                                const ColorRequest& request) {
    using enum ColorMethod::Kind;
    require_in_range("tolerance", request.tolerance, 1e-12, 1);
    switch (method.kind) {
        case automatic:
            if (is_for_series(stack, request))
                return std::make_unique<FilmColor>(tables, stack, request);
            [[fallthrough]];
        case quadrature:
            return quadrature_color(tables, stack, request);
        case fourier:
        case fourier_constant:
            return film_color(tables, stack, method, request);
        default:
            return approximate_color(tables, stack, method, request);
    }
}

std::vector<StackColor> stack_color(const ColorTables& tables, const Stack& stack,
                                    const ColorMethod& method, const ColorRequest& request,
                                    std::span<const double> angles_deg, unsigned threads) {
    const std::unique_ptr<ColorAlgorithm> algorithm =
        color_algorithm(tables, stack, method, request);
    const std::size_t sides = request.sides.size();
    std::vector<StackColor> colors(angles_deg.size() * sides);
    const std::size_t blocks = (angles_deg.size() + kAnglesTogether - 1) / kAnglesTogether;
    parallel_for(blocks, threads, [&](std::size_t block) {
        const std::size_t begin = block * kAnglesTogether;
        const std::size_t count = std::min(kAnglesTogether, angles_deg.size() - begin);
        (*algorithm)(stack, angles_deg.subspan(begin, count),
                     std::span(colors).subspan(begin * sides, count * sides));
    });
    return colors;
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
