#include <algorithm>
#include <array>
#include <memory>

#include "cli/bench/bench_layered.hpp"
#include "cli/stopwatch.hpp"
#include "core/coherent/coherent.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/remapped_film.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/film/film.hpp"
#include "core/material/library.hpp"
#include "core/math/constants.hpp"
#include "core/rough/layered/lobe.hpp"
#include "core/rough/layered/refracted_light.hpp"
#include "core/stack/builder.hpp"

namespace irido::cli {

namespace {

constexpr double kExactTolerance = 1e-9;

struct NamedWay {
    const char* name;
    ColorMethod method;
};

const ColorTables& daylight() {
    static const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    return tables;
}

/// One film in air.
Stack bench_film(double film_n, double thickness_nm, Complex base, double sigma_nm = 0) {
    StackBuilder builder{Complex(1)};
    Element film = builder.layer(Complex(film_n), thickness_nm);
    std::get<Layer>(film.value).thickness_sigma_nm = sigma_nm;
    builder.add(std::move(film));
    return builder.over(base);
}

/// The lobe that facets of a stack reflect, X, Y, Z of pi times the BRDF.
class ReflectedLobe {
public:
    ReflectedLobe(Stack stack, double alpha) : stack_(std::move(stack)) {
        for (const ScatterPair& pair : bench_pairs()) {
            const MirrorFacet facet =
                mirror_facet(pair.theta_i_deg, pair.theta_o_deg, pair.phi_deg);
            theta_d_deg_.push_back(facet.theta_d_deg);
            scale_.push_back(kPi * lobe(alpha, facet));
        }
    }

    std::vector<Triple> operator()(const ColorMethod& method, double tolerance) const {
        ColorRequest request;
        request.tolerance = tolerance;
        request.colors = theta_d_deg_.size();
        std::vector<Triple> xyz;
        for (const StackColor& color :
             stack_color(daylight(), stack_, method, request, theta_d_deg_))
            xyz.push_back(color.xyz);
        return scaled(std::move(xyz));
    }

    std::vector<Triple> scaled(std::vector<Triple> xyz) const {
        for (std::size_t k = 0; k < xyz.size(); ++k)
            for (double& part : xyz[k]) part *= scale_[k];
        return xyz;
    }
    const std::vector<double>& theta_d_deg() const { return theta_d_deg_; }
    const Stack& stack() const { return stack_; }

private:
    Stack stack_;
    std::vector<double> theta_d_deg_, scale_;
};

/// One way to compute the colours of a case.
void add_way(const LayeredBench& bench, const std::string& name, const std::string& method,
             const std::vector<Triple>& exact, const auto& colors_by,
             std::vector<LayeredRow>& rows) {
    std::vector<Triple> colors;
    LayeredRow row;
    row.name = name;
    row.method = method;
    row.prepare_s = seconds_of([&] { colors = colors_by(); });
    row.evaluate_s = best_seconds(bench.budget_s, [&] { colors = colors_by(); });
    row.prepare_s = std::max(0.0, row.prepare_s - row.evaluate_s);
    row.evaluations = static_cast<double>(colors.size());
    set_color_errors(colors, exact, daylight().sensitivity().white(), row);
    rows.push_back(std::move(row));
}

void add_reflected(const LayeredBench& bench, const std::string& name, const ReflectedLobe& lobe,
                   std::span<const NamedWay> ways, std::vector<LayeredRow>& rows) {
    const std::vector<Triple> exact = lobe({}, kExactTolerance);
    for (const NamedWay& way : ways)
        add_way(
            bench, name, way.name, exact, [&] { return lobe(way.method, kDefaultTolerance); },
            rows);
}

void add_refracted(const LayeredBench& bench, const std::string& name, const Stack& stack,
                   double alpha, std::span<const NamedWay> ways, std::vector<LayeredRow>& rows) {
    const RefractedLight light(stack, alpha, bench.one);
    const std::vector<ScatterPair> pairs = bench_pairs();
    const auto by = [&](const ColorMethod& method, double tolerance) {
        std::vector<Triple> xyz;
        for (const SurfaceColor& color : light.color(daylight(), pairs, method, tolerance))
            xyz.push_back(color.xyz);
        return xyz;
    };
    const std::vector<Triple> exact = by({}, kExactTolerance);
    for (const NamedWay& way : ways)
        add_way(
            bench, name + "-T", way.name, exact, [&] { return by(way.method, kDefaultTolerance); },
            rows);
}

/// BB17's methods: the spectral reference at irido's own tolerance, its series with exact
/// transforms up to all orders and to 3 and 1, and with Gaussians.
std::vector<NamedWay> film_ways() {
    return {NamedWay{"spectral", {}}, NamedWay{"fourier", color_method("fourier")},
            NamedWay{"fourier/3", color_method("fourier", 3)},
            NamedWay{"fourier/1", color_method("fourier", 1)},
            NamedWay{"gaussian/3", color_method("gaussian", 3)}};
}

/// Spreads of the path that have a table.
constexpr std::array kSpreadLevels_nm{0.0, 50.0, 100.0, 200.0};

/// The film's colours as shaders have them: H from four tables of spreads of the path, two of
/// which are mixed as light of 550 nm fades. Three orders.
std::vector<Triple> by_levels(const ReflectedLobe& lobe, double film_n, double thickness_nm,
                              Complex base, double sigma_nm) {
    constexpr double kLongest_nm = 2e4;
    static const std::array transforms = [] {
        const auto level = [](double sigma) {
            return SensitivityTransform(daylight().sensitivity(), kLongest_nm, 1e-8, sigma * sigma);
        };
        return std::array{level(kSpreadLevels_nm[0]), level(kSpreadLevels_nm[1]),
                          level(kSpreadLevels_nm[2]), level(kSpreadLevels_nm[3])};
    }();
    const auto fade = [](double spread_nm) {
        const double waves = spread_nm / 550;
        return std::exp(-2 * kPi * kPi * waves * waves);
    };
    const Triple white = daylight().sensitivity().white();
    std::vector<Triple> colors;
    for (const double theta : lobe.theta_d_deg()) {
        Triple xyz{};
        for (const Polarization polarization : {Polarization::s, Polarization::p}) {
            const auto series =
                film_series({1, film_n, base, thickness_nm}, incident_angle(theta), polarization);
            Triple sum{};
            Complex power = 1;
            for (int m = 1; m <= 3; ++m) {
                power *= series->bounce;
                const double path = m * series->opd_nm;
                const double spread =
                    std::min(path * sigma_nm / thickness_nm, kSpreadLevels_nm.back());
                std::size_t low = 0;
                while (low + 2 < kSpreadLevels_nm.size() && spread > kSpreadLevels_nm[low + 1])
                    ++low;
                const double from = fade(kSpreadLevels_nm[low]),
                             to = fade(kSpreadLevels_nm[low + 1]);
                const double share =
                    std::clamp((from - fade(spread)) / std::max(from - to, 1e-9), 0.0, 1.0);
                const ComplexTriple a = transforms[low](path), b = transforms[low + 1](path);
                for (std::size_t c = 0; c < 3; ++c)
                    sum[c] += 2 * (power * (a[c] + share * (b[c] - a[c]))).real();
            }
            for (std::size_t c = 0; c < 3; ++c)
                xyz[c] += 0.5 * (white[c] * (1 - series->T) - series->T * sum[c]);
        }
        colors.push_back(xyz);
    }
    return lobe.scaled(std::move(colors));
}

}  // namespace

void set_color_errors(const std::vector<Triple>& colors, const std::vector<Triple>& exact,
                      const Triple& white, LayeredRow& row) {
    std::vector<double> values, reference;
    double sum = 0;
    row.delta_e_max = 0;
    for (std::size_t k = 0; k < colors.size(); ++k) {
        const double scale = 1 / std::max({1.0, colors[k][1], exact[k][1]});
        const auto lab_of = [&](Triple xyz) {
            for (double& part : xyz) part = std::max(0.0, scale * part);
            return lab(xyz, white);
        };
        const double difference = ciede2000(lab_of(colors[k]), lab_of(exact[k]));
        sum += difference;
        row.delta_e_max = std::max(row.delta_e_max, difference);
        values.insert(values.end(), colors[k].begin(), colors[k].end());
        reference.insert(reference.end(), exact[k].begin(), exact[k].end());
    }
    row.delta_e_mean = sum / static_cast<double>(colors.size());
    row.smape = smape(values, reference);
}

// 525 nm of 1.5 on 1.09, BB17's figure 7
void add_film_dielectric(const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    const Stack stack = bench_film(1.5, 525, 1.09);
    constexpr double kAlpha = 0.2;
    add_reflected(bench, "film-dielectric", ReflectedLobe(stack, kAlpha), film_ways(), rows);
    add_refracted(bench, "film-dielectric", stack, kAlpha, film_ways(), rows);
}

// 550 nm of 1.33 on 1.9 + 1.5i, BB17's preview
void add_film_conductor(const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    const ReflectedLobe lobe(bench_film(1.33, 550, {1.9, 1.5}), 0.2);
    add_reflected(bench, "film-conductor", lobe, film_ways(), rows);
}

// 666 nm of 1.4 on copper and on glass, BB17's figure 8
void add_film_dispersive(const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    const std::array ways{NamedWay{"spectral", {}}, NamedWay{"fourier", color_method("fourier")},
                          NamedWay{"fourier-constant/3", color_method("fourier-constant", 3)},
                          NamedWay{"gaussian/3", color_method("gaussian", 3)}};
    constexpr double kAlpha = 0.1;
    for (const char* base : {"Cu", "BK7"}) {
        StackBuilder builder{Complex(1)};
        builder.add(builder.layer(Complex(1.4), 666));
        const Stack stack =
            held_stack(builder.over_material(builder.material(find_material(base)->material)),
                       daylight().sensitivity());
        const std::string name = std::string("film-on-") + base;
        add_reflected(bench, name, ReflectedLobe(stack, kAlpha), ways, rows);
        if (std::string_view(base) == "BK7") add_refracted(bench, name, stack, kAlpha, ways, rows);
    }
}

void add_film_spread(const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    constexpr double kFilm_n = 1.5, kThickness_nm = 400;
    const Complex base(1.9, 1.5);
    for (const double sigma : {5.0, 15.0, 40.0}) {
        const ReflectedLobe lobe(bench_film(kFilm_n, kThickness_nm, base, sigma), 0.1);
        const std::string name = "film-spread-" + to_text(sigma);
        const std::vector<Triple> exact = lobe({}, kExactTolerance);
        add_way(
            bench, name, "fourier/3", exact,
            [&] { return lobe(color_method("fourier", 3), kDefaultTolerance); }, rows);
        add_way(
            bench, name, "levels", exact,
            [&] { return by_levels(lobe, kFilm_n, kThickness_nm, base, sigma); }, rows);
    }
}

// what the remapped index costs against the film as it is: 30 nm, as BB17's code has it
void add_film_remapped(const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    constexpr double kWidth_nm = 30, kAlpha = 0.2;
    for (const double thickness : {1.0, 3.0, 6.0, 10.0, 100.0}) {
        const Stack stack = bench_film(1.5, thickness, {1.9, 1.5});
        const ReflectedLobe remapped(with_remapped_film(stack, kWidth_nm), kAlpha);
        const std::vector<Triple> exact = ReflectedLobe(stack, kAlpha)({}, kExactTolerance);
        add_way(
            bench, "film-remapped-" + to_text(thickness), "spectral", exact,
            [&] { return remapped({}, kDefaultTolerance); }, rows);
    }
}

// FPB24's figure 8: ten periods of 500 nm
void add_landmarks(const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    const std::array ways{NamedWay{"spectral", {}},
                          NamedWay{"landmarks", color_method("landmarks", 1)},
                          NamedWay{"landmarks/3", color_method("landmarks", 3)},
                          NamedWay{"landmarks/6", color_method("landmarks", 6)}};
    StackBuilder builder{Complex(1)};
    const Element first = builder.layer(Complex(1), 250);
    const Element second = builder.layer(Complex(1.5), 250);
    builder.add(StackBuilder::group(10, {first, second}));
    const Stack stack = builder.over(Complex(1));
    for (const double alpha : {0.05, 0.1, 0.3})
        add_reflected(bench, "landmarks-" + to_text(alpha), ReflectedLobe(stack, alpha), ways,
                      rows);
}

}  // namespace irido::cli
