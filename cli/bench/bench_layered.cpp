#include <array>
#include <cmath>
#include <memory>

#include "cli/bench/bench.hpp"
#include "cli/bench/bench_layered.hpp"
#include "cli/stopwatch.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"
#include "core/math/constants.hpp"
#include "core/rough/layered/adding.hpp"
#include "core/rough/layered/lobe.hpp"
#include "core/rough/walk/prepared_color.hpp"
#include "core/rough/walk/simulation.hpp"
#include "core/stack/builder.hpp"

namespace irido::cli {

namespace {

/// A mirror of FPB24's figure 7 as facets, N = 10, n2 = 1.5, over a grey base of albedo 0.5.
/// A mirror of FPB24's figure 7 as facets, N = 10, n2 = 1.5, over a grey base of albedo 0.5.
struct MirrorCase {
    std::string name;
    double host, thickness_nm, alpha;
};

void add_mirror(const MirrorCase& of, const LayeredBench& bench, std::vector<LayeredRow>& rows);

void add_structures(const LayeredBench& bench, std::vector<LayeredRow>& rows);
void add_paths(const LayeredBench& bench, std::vector<LayeredRow>& rows);

struct LayeredCase {
    std::string_view name, summary;
    void (*add)(const LayeredBench& bench, std::vector<LayeredRow>& rows);
};

constexpr std::array kLayeredCases{
    LayeredCase{"A", "periods of 250 and 250 nm, alpha 0.1, in air",
                [](const LayeredBench& bench, std::vector<LayeredRow>& rows) {
                    add_mirror({"A", 1, 250, 0.1}, bench, rows);
                }},
    LayeredCase{"B", "periods of 494 and 494 nm, alpha 0.05, in air",
                [](const LayeredBench& bench, std::vector<LayeredRow>& rows) {
                    add_mirror({"B", 1, 494, 0.05}, bench, rows);
                }},
    LayeredCase{"A-coated", "A in a host of 1.35, under a coating (A')",
                [](const LayeredBench& bench, std::vector<LayeredRow>& rows) {
                    add_mirror({"A-coated", 1.35, 250, 0.1}, bench, rows);
                }},
    LayeredCase{"adding", "one pair of A-coated and of two rough layers by adding to 1e-3",
                add_structures},
    LayeredCase{"paths", "the albedo of A by simulation: paths in a second", add_paths},
    LayeredCase{"landmarks", "FPB24's RGB approximation on rough layers, figure 8", add_landmarks},
    LayeredCase{"film-dielectric", "a film on glass, reflected and refracted (-T)",
                add_film_dielectric},
    LayeredCase{"film-conductor", "a film on n = 1.9 + 1.5i", add_film_conductor},
    LayeredCase{"film-dispersive", "films on copper and glass BK7", add_film_dispersive},
    LayeredCase{"film-spread", "films of 400 nm with a spread of 5, 15 and 40 nm", add_film_spread},
    LayeredCase{"film-remapped", "films of 1 to 100 nm whose index is remapped within 30 nm",
                add_film_remapped},
};

struct LayeredOptions {
    std::string cases = "all";
    std::string samples = "30000";
    std::string budget = "0.5";
    OutputOptions output;
    bool quiet = false;
};

LayeredSurface surface_of(const MirrorCase& of) {
    StackBuilder builder{Complex(of.host)};
    const Element first = builder.layer(Complex(of.host), of.thickness_nm);
    const Element second = builder.layer(Complex(1.5), of.thickness_nm);
    builder.add(StackBuilder::group(10, {first, second}));
    Stack stack = builder.over(Complex(of.host));
    const Material inside = stack.materials[stack.incident];
    Material outside = inside;
    std::get<RefractiveIndex>(outside.model).n = Constant{1};
    return {outside, inside, {{std::move(stack), of.alpha, true}}, Constant{0.5}};
}

std::vector<double> bench_wavelengths() {
    std::vector<double> nm;
    for (double at = 420; at <= 700; at += 20) nm.push_back(at);
    return nm;
}

/// What does not change from pair to pair: the base, and tables over angles.
struct LayeredTables {
    AngleTable facets;    ///< R and T over theta_d; empty: R by the kernel
    AngleTable straight;  ///< f_t cos / G1
    std::vector<double> base;
};

/// The BRDF with f_t cos, or R as well, from tables: FPB24's model, or all paths by another base.
std::vector<double> with_tables(const LayeredScattering& scattering, const LayeredTables& tables,
                                std::span<const ScatterPair> pairs, const std::vector<double>& nm) {
    const LayerTransport& layer = scattering.layer(0);
    const Coating& coating = scattering.coating();
    const std::size_t W = nm.size();
    std::vector<double> theta_d, f, R;
    std::vector<MirrorFacet> facets;
    f.reserve(pairs.size() * W);
    for (const ScatterPair& pair : pairs) {
        facets.push_back(mirror_facet(coating.inward(pair.theta_i_deg).theta_deg,
                                      coating.inward(pair.theta_o_deg).theta_deg, pair.phi_deg));
        theta_d.push_back(facets.back().theta_d_deg);
    }
    const bool is_tabulated = tables.facets.steps() > 0;
    if (!is_tabulated) R = layer.facets().values(theta_d, nm);
    std::vector<double> in(W), out(W), power(2 * W);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const Coating::Crossing i = coating.inward(pairs[p].theta_i_deg);
        const Coating::Crossing o = coating.inward(pairs[p].theta_o_deg);
        const double factor = i.T * o.T * coating.dilution();
        const double shape = lobe(layer.alpha(), facets[p]);
        const double masked = facets[p].cos_i * facets[p].cos_o *
                              visibility(layer.alpha(), facets[p].cos_i, facets[p].sin_i) *
                              visibility(layer.alpha(), facets[p].cos_o, facets[p].sin_o);
        tables.straight.at(i.theta_deg, in);
        tables.straight.at(o.theta_deg, out);
        if (is_tabulated) tables.facets.at(theta_d[p], power);
        const double* const reflected = is_tabulated ? power.data() : R.data() + p * W;
        for (std::size_t w = 0; w < W; ++w)
            f.push_back(factor *
                        (shape * reflected[w] + masked * in[w] * out[w] * tables.base[w] / kPi));
    }
    return f;
}

/// What all paths add to single reflections, by Adding, over both angles and the azimuth; linear in
/// between.
class RestTable {
public:
    RestTable(const LayeredScattering& scattering, const std::vector<double>& nm,
              const Execution& execution)
        : wavelengths_(nm.size()) {
        std::vector<ScatterPair> pairs;
        for (std::size_t i = 0; i < kThetas; ++i)
            for (std::size_t o = 0; o <= i; ++o)
                for (std::size_t k = 0; k < kAzimuths; ++k)
                    pairs.push_back({kThetaStep_deg * static_cast<double>(i),
                                     kThetaStep_deg * static_cast<double>(o),
                                     kAzimuthStep_deg * static_cast<double>(k)});
        values_ = Adding(scattering, 1e-3, execution).brdf_rest(pairs, nm).values;
    }

    void add(const ScatterPair& pair, std::span<double> out) const {
        const auto [i, u] = place(pair.theta_i_deg / kThetaStep_deg, kThetas);
        const auto [o, v] = place(pair.theta_o_deg / kThetaStep_deg, kThetas);
        const auto [k, t] = place(pair.phi_deg / kAzimuthStep_deg, kAzimuths);
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const std::size_t a = i + (corner & 1), b = o + (corner >> 1 & 1);
            const std::size_t c = k + (corner >> 2);
            const double weight =
                (corner & 1 ? u : 1 - u) * (corner & 2 ? v : 1 - v) * (corner & 4 ? t : 1 - t);
            const std::size_t both = a > b ? a * (a + 1) / 2 + b : b * (b + 1) / 2 + a;
            const double* from = values_.data() + (both * kAzimuths + c) * wavelengths_;
            for (std::size_t w = 0; w < out.size(); ++w) out[w] += weight * from[w];
        }
    }

private:
    static constexpr std::size_t kThetas = 41, kAzimuths = 46;
    static constexpr double kThetaStep_deg = 2, kAzimuthStep_deg = 4;

    static std::pair<std::size_t, double> place(double at, std::size_t count) {
        const std::size_t below = std::min(static_cast<std::size_t>(at), count - 2);
        return {below, at - static_cast<double>(below)};
    }

    std::size_t wavelengths_;
    std::vector<double> values_;  ///< [i >= o][azimuth][wavelength]
};

/// Colours of one layer by tables made for that, against exact ones: what a renderer does.
void add_prepared(const MirrorCase& of, const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    const LayeredSurface surface = surface_of(of);
    std::vector<std::pair<PreparedColor::Direction, PreparedColor::Direction>> directions;
    const std::vector<ScatterPair> pairs = bench_pairs();
    for (const ScatterPair& pair : pairs) {
        const auto direction = [](double theta_deg, double phi_deg) -> PreparedColor::Direction {
            const double theta = theta_deg * kDegree, phi = phi_deg * kDegree;
            return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                    std::cos(theta)};
        };
        directions.emplace_back(direction(pair.theta_i_deg, 0),
                                direction(pair.theta_o_deg, pair.phi_deg));
    }
    std::unique_ptr<PreparedColor> prepared;
    LayeredRow row;
    row.name = of.name;
    row.method = "prepared-rgb";
    row.prepare_s = best_seconds(bench.budget_s, [&] {
        prepared = std::make_unique<PreparedColor>(tables, surface, Paths::all, Crossings::single,
                                                   bench.one);
    });
    const RgbTransform rgb(rgb_space("srgb"), tables.sensitivity().white(), Adaptation::bradford);
    std::vector<Triple> colors(pairs.size());
    row.evaluate_s = best_seconds(bench.budget_s, [&] {
        for (std::size_t k = 0; k < pairs.size(); ++k)
            colors[k] = rgb((*prepared)(directions[k].first, directions[k].second));
    });
    row.evaluations = static_cast<double>(pairs.size());
    std::vector<Triple> exact;
    const LayeredColor color(tables, surface, Crossings::single, 1e-7, bench.one);
    for (const SurfaceColor& one : color.brdf(pairs, Paths::all)) exact.push_back(one.xyz);
    for (Triple& one : colors) {
        one = rgb.xyz_of(one);
        for (double& part : one) part *= kPi;
    }
    set_color_errors(colors, exact, tables.sensitivity().white(), row);
    rows.push_back(std::move(row));
}

void add_mirror(const MirrorCase& of, const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    const std::vector<ScatterPair> pairs = bench_pairs();
    const std::vector<double> nm = bench_wavelengths();
    const Execution& one = bench.one;
    const LayeredSurface surface = surface_of(of);
    const LayeredScattering kept(surface, Crossings::single, one);
    SimulationRequest request;
    request.samples = bench.samples;
    std::vector<double> reference;
    double reference_s = 0;
    const auto add = [&](std::string method, double prepare_s, double evaluate_s, double count,
                         const std::vector<double>& values) {
        LayeredRow row;
        row.name = of.name;
        row.method = std::move(method);
        row.prepare_s = prepare_s;
        row.evaluate_s = evaluate_s;
        row.evaluations = count;
        row.smape = smape(values, reference);
        row.reference_s = reference_s;
        rows.push_back(std::move(row));
    };
    const auto count = static_cast<double>(pairs.size());
    std::vector<double> values;
    std::unique_ptr<LayeredSimulation> simulation;
    const auto simulate = [&](const std::string& name, bool is_reference) {
        const double prepare = seconds_of(
            [&] { simulation = std::make_unique<LayeredSimulation>(kept, request, nm, one); });
        const auto run = [&] { values = simulation->brdf(pairs).mean; };
        const double evaluate = is_reference ? seconds_of(run) : best_seconds(bench.budget_s, run);
        if (is_reference) {
            reference = values;
            reference_s = evaluate;
        }
        add(name, prepare, evaluate, static_cast<double>(request.samples), values);
    };
    simulate("reference", true);
    request = {.paths = Paths::single, .facets = FacetChoice::filter, .samples = 64, .seed = 2};
    simulate("simulation/64", false);

    std::unique_ptr<LayeredScattering> fresh;
    const auto restart = [&] {
        fresh = std::make_unique<LayeredScattering>(surface, Crossings::single, one);
    };
    restart();
    double prepare = seconds_of([&] { fresh->layer(0).facets().prepare(nm, 1); });
    double evaluate = seconds_of([&] { values = fresh->brdf(pairs, nm, Paths::single); });
    add("model", prepare, evaluate, count, values);

    LayeredTables tables;
    restart();
    prepare = seconds_of([&] {
        tables.straight = straight_table(fresh->layer(0), nm, Crossings::single, 1);
        tables.base = fresh->base_factors(nm, Paths::single);
    });
    evaluate =
        best_seconds(bench.budget_s, [&] { values = with_tables(*fresh, tables, pairs, nm); });
    add("model-table", prepare, evaluate, count, values);

    restart();
    if (!fresh->is_closed()) {
        evaluate = seconds_of([&] {
            values = fresh->brdf(pairs, nm, Paths::single);
            const Adding adding(*fresh, 1e-3, one);
            const std::vector<double> rest = adding.brdf_rest(pairs, nm).values;
            for (std::size_t k = 0; k < values.size(); ++k) values[k] += rest[k];
        });
        add("all", 0, evaluate, count, values);
        std::unique_ptr<RestTable> rest;
        prepare = seconds_of([&] {
            tables.facets = facet_table(fresh->layer(0), nm, 1);
            rest = std::make_unique<RestTable>(*fresh, nm, one);
        });
        evaluate = best_seconds(bench.budget_s, [&] {
            values = with_tables(*fresh, tables, pairs, nm);
            for (std::size_t p = 0; p < pairs.size(); ++p)
                rest->add(pairs[p], std::span(values).subspan(p * nm.size(), nm.size()));
        });
        add("all-table", prepare, evaluate, count, values);
        return;
    }
    prepare = seconds_of([&] { fresh->brdf(pairs, nm, Paths::all); });
    evaluate = best_seconds(bench.budget_s, [&] { values = fresh->brdf(pairs, nm, Paths::all); });
    add("all", prepare, evaluate, count, values);
    restart();
    prepare = seconds_of([&] {
        tables.facets = facet_table(fresh->layer(0), nm, 1);
        tables.straight = straight_table(fresh->layer(0), nm, Crossings::single, 1);
        tables.base = fresh->base_factors(nm, Paths::all);
    });
    evaluate =
        best_seconds(bench.budget_s, [&] { values = with_tables(*fresh, tables, pairs, nm); });
    add("all-table", prepare, evaluate, count, values);
    add_prepared(of, bench, rows);
}

/// All paths of one pair at four wavelengths, and of its colour, made from nothing.
void add_structures(const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    const std::vector<double> nm{450, 500, 550, 650};
    const std::vector<ScatterPair> pairs{{45, 45, 180}};
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    LayeredSurface two = surface_of({"", 1, 250, 0.1});
    two.layers.push_back(surface_of({"", 1, 180, 0.1}).layers.front());
    const auto add = [&](const char* name, const char* method, const auto& work) {
        LayeredRow row;
        row.name = name;
        row.method = method;
        row.evaluate_s = best_seconds(bench.budget_s, work);
        row.evaluations = 1;
        rows.push_back(std::move(row));
    };
    for (const auto& structure :
         {std::pair("adding-coated", surface_of({"", 1.35, 250, 0.1})), {"adding-two", two}}) {
        const auto& name = structure.first;
        const auto& surface = structure.second;
        add(name, "brdf", [&] {
            const LayeredScattering scattering(surface, Crossings::single, bench.one);
            Adding(scattering, 1e-3, bench.one).brdf_rest(pairs, nm);
        });
        add(name, "albedo", [&] {
            const LayeredScattering scattering(surface, Crossings::single, bench.one);
            Adding(scattering, 1e-3, bench.one).albedo_rest(std::vector<double>{45}, nm);
        });
        add(name, "color", [&] {
            LayeredColor(tables, surface, Crossings::single, 1e-3, bench.one)
                .brdf(pairs, Paths::all);
        });
    }
}

void add_paths(const LayeredBench& bench, std::vector<LayeredRow>& rows) {
    const LayeredScattering scattering(surface_of({"", 1, 250, 0.1}), Crossings::single, bench.one);
    SimulationRequest request;
    request.samples = 100000;
    for (const auto& [method, facets] :
         {std::pair("sampled", FacetChoice::sampled), {"filter", FacetChoice::filter}}) {
        request.facets = facets;
        std::unique_ptr<LayeredSimulation> simulation;
        LayeredRow row;
        row.name = "paths";
        row.method = method;
        row.prepare_s = seconds_of([&] {
            simulation = std::make_unique<LayeredSimulation>(
                scattering, request, std::vector<double>{450, 550, 650}, bench.one);
        });
        row.evaluate_s =
            best_seconds(bench.budget_s, [&] { simulation->albedo(std::vector<double>{30}); });
        row.evaluations = static_cast<double>(request.samples);
        rows.push_back(std::move(row));
    }
}

int run_bench_layered(const LayeredOptions& options) {
    resolved_record_format(options.output);
    const LayeredBench bench{parse_whole_number("--samples", options.samples, 2, 1e9),
                             parse_one_number("--budget", options.budget, 0, 3600),
                             Execution(1, execution_of().simd)};
    std::vector<LayeredRow> rows;
    const auto cases = chosen_cases<LayeredCase>(options.cases, kLayeredCases, "layered");
    StepProgress progress(options.quiet, cases.size());
    for (const LayeredCase& one : cases) {
        progress.begin(std::string(one.name));
        one.add(bench, rows);
    }
    progress.clear();
    tables::Column::Texts names, methods;
    for (const LayeredRow& row : rows) {
        names.push_back(row.name);
        methods.push_back(row.method);
    }
    tables::Records records{{{"case", std::move(names)}, {"method", std::move(methods)}}};
    const auto add = [&](const char* name, const auto& value) {
        add_numbers(records, name, rows, value);
    };
    add("prepare_s", [](const LayeredRow& row) { return row.prepare_s; });
    add("evaluate_s", [](const LayeredRow& row) { return row.evaluate_s; });
    add("smape_percent", [](const LayeredRow& row) { return 100 * row.smape; });
    add("efficiency", [](const LayeredRow& row) {
        return row.smape > 0 ? row.reference_s / (row.evaluate_s * row.smape) : LayeredRow::kNone;
    });
    add("per_second", [](const LayeredRow& row) { return row.evaluations / row.evaluate_s; });
    add("delta_e_mean", [](const LayeredRow& row) { return row.delta_e_mean; });
    add("delta_e_max", [](const LayeredRow& row) { return row.delta_e_max; });
    write_records(records, options.output);
    return 0;
}

}  // namespace

std::vector<ScatterPair> bench_pairs() {
    std::vector<ScatterPair> pairs;
    for (double theta = 2.5; theta < 80; theta += 5)
        for (double phi = 6; phi < 180; phi += 12) pairs.push_back({30, theta, phi});
    return pairs;
}

double smape(const std::vector<double>& values, const std::vector<double>& reference) {
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double whole = std::abs(values[k]) + std::abs(reference[k]);
        if (whole > 0) sum += 2 * std::abs(values[k] - reference[k]) / whole;
    }
    return sum / static_cast<double>(values.size());
}

void add_bench_layered(CLI::App& bench, Run& run) {
    CLI::App* command = bench.add_subcommand(
        "layered", "Rough layered surfaces: time and error of ways to evaluate their BRDF.");
    const auto options = std::make_shared<LayeredOptions>();
    command
        ->add_option("--cases", options->cases,
                     cases_help(std::span<const LayeredCase>(kLayeredCases)))
        ->type_name("NAMES");
    offer(
        *command, "cases", [] { return case_names(std::span<const LayeredCase>(kLayeredCases)); },
        OfferedWords::Use::several);
    command
        ->add_option("--samples", options->samples,
                     "paths of the reference, a simulation of all paths, [2, 1e9] [30000]")
        ->type_name("N");
    command
        ->add_option("--budget", options->budget,
                     "seconds for repeating each measurement, [0, 3600] [0.5]")
        ->type_name("S");
    add_output_options(*command, options->output, record_formats_text());
    add_threads_option(*command);
    add_quiet_option(*command, options->quiet, "no progress");
    set_examples(
        *command, {"irido bench layered", "irido bench layered --cases A --samples 1e5 -f json"},
        "240 directions of view under a beam from 30 degrees, on one thread; mirrors at 15\n"
        "wavelengths. reference: all paths by simulation. simulation/64: single\n"
        "reflections, 64 paths, FPB24's sampling; model: their eq. 34 (corrected), f_t cos\n"
        "integrated for every direction; model-table: the same with a table of f_t cos;\n"
        "all: all paths, by the closed form or by adding; all-table: with tables of R and\n"
        "f_t cos; prepared-rgb: colours from tables made for them. Films: spectral is\n"
        "exact; fourier/M, gaussian/M: Belcour and Barla's series to order M; levels:\n"
        "their tables of spreads. per_second: pairs (paths of a simulation) in a second;\n"
        "smape_percent: symmetric mean absolute error, of mirrors against the reference,\n"
        "of colours against exact ones; efficiency: the reference's time / (evaluate_s\n"
        "smape), as FPB24's table 2 has it; delta_e: CIEDE2000 of pi times the BRDF.");
    set_run(*command, run, options, run_bench_layered);
}

}  // namespace irido::cli
