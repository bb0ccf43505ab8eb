#include <algorithm>
#include <cmath>

#include "core/color/bloch/bloch_color.hpp"
#include "core/color/bloch/one_mirror.hpp"
#include "core/color/exact_color.hpp"
#include "core/color/fourier/film_color.hpp"

namespace irido {

extern const ColorMethodKind color_method_fourier, color_method_bloch;

namespace {

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

std::unique_ptr<ColorAlgorithm> automatic_color(const ColorTables& tables, const Stack& stack,
                                                const ColorMethod& method,
                                                const ColorRequest& request) {
    std::unique_ptr<ColorAlgorithm> special;
    if (is_for_series(stack, request)) {
        special = film_color(tables, stack, {&color_method_fourier}, request);
    } else if (const double fringes = fringes_for_bloch(tables, stack, request); fringes > 0) {
        special =
            bloch_color(tables, stack, {&color_method_bloch}, bloch_request(request, fringes));
    } else {
        return exact_color(tables, stack, method, request);
    }
    return or_quadrature(tables, stack, request, std::move(special));
}

}  // namespace

/// The series for a single film of constant indices, if enough colours are to come to pay for its
/// table (or if the film has a thickness distribution, which is very slow by quadrature); Bloch
/// waves for a one_mirror() with many fringes; quadrature for everything else, and where the others
/// cannot guarantee the tolerance.
extern constinit const ColorMethodKind color_method_auto = {
    .name = "auto",
    .place = 1,
    .use = MethodUse::exact,
    .help =
        "auto: the fastest exact method for the number of colours requested (--stats shows "
        "which): a row of a large sweep of one film, or of tabulated materials, may differ from "
        "that of a small one, within the tolerance; a method given by name computes the same row "
        "in every sweep "
        "[auto]",
    .trials = {.last_power = 10},
    .prepare = automatic_color,
};

}  // namespace irido
