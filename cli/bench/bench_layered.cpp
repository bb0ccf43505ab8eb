#include <array>
#include <cmath>
#include <memory>

#include "cli/bench/bench.hpp"
#include "cli/stopwatch.hpp"
#include "core/math/constants.hpp"
#include "core/rough/layered/adding.hpp"
#include "core/rough/layered/lobe.hpp"
#include "core/rough/walk/simulation.hpp"
#include "core/stack/builder.hpp"

namespace irido::cli {

namespace {

/// Facets with the mirror of FPB24's figure 7, N = 10, n2 = 1.5, over a grey base of albedo 0.5.
struct LayeredCase {
    std::string_view name, summary;
    double host, thickness_nm, alpha;
};

constexpr std::array kLayeredCases{
    LayeredCase{"A", "periods of 250 and 250 nm, alpha 0.1, in air", 1, 250, 0.1},
    LayeredCase{"B", "periods of 494 and 494 nm, alpha 0.05, in air", 1, 494, 0.05},
    LayeredCase{"A-coated", "A in a host of 1.35, under a coating", 1.35, 250, 0.1},
};

struct LayeredOptions {
    std::string cases = "all";
    std::string samples = "30000";
    std::string budget = "0.5";
    OutputOptions output;
};

struct LayeredRow {
    std::string name, method;
    double prepare_s = 0, evaluate_s = 0, smape = 0;
};

LayeredSurface surface_of(const LayeredCase& of) {
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

/// Viewing directions for a beam at 30 degrees.
std::vector<ScatterPair> bench_pairs() {
    std::vector<ScatterPair> pairs;
    for (double theta = 2.5; theta < 80; theta += 5)
        for (double phi = 6; phi < 180; phi += 12) pairs.push_back({30, theta, phi});
    return pairs;
}

std::vector<double> bench_wavelengths() {
    std::vector<double> nm;
    for (double at = 420; at <= 700; at += 20) nm.push_back(at);
    return nm;
}

/// Symmetric mean absolute percentage error.
double smape(const std::vector<double>& values, const std::vector<double>& reference) {
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double whole = std::abs(values[k]) + std::abs(reference[k]);
        if (whole > 0) sum += 2 * std::abs(values[k] - reference[k]) / whole;
    }
    return 100 * sum / static_cast<double>(values.size());
}

/// FPB24's model with f_t cos from a table.
std::vector<double> with_table(const LayeredScattering& scattering, const AngleTable& straight,
                               std::span<const ScatterPair> pairs, const std::vector<double>& nm) {
    const LayerTransport& layer = scattering.layer(0);
    const Coating& coating = scattering.coating();
    std::vector<double> theta_d, f;
    std::vector<MirrorFacet> facets;
    for (const ScatterPair& pair : pairs) {
        facets.push_back(mirror_facet(coating.inward(pair.theta_i_deg).theta_deg,
                                      coating.inward(pair.theta_o_deg).theta_deg, pair.phi_deg));
        theta_d.push_back(facets.back().theta_d_deg);
    }
    const std::vector<double> R = layer.facets().values(theta_d, nm);
    std::vector<double> in(nm.size()), out(nm.size());
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const Coating::Crossing i = coating.inward(pairs[p].theta_i_deg);
        const Coating::Crossing o = coating.inward(pairs[p].theta_o_deg);
        const double factor = i.T * o.T * coating.dilution();
        const double shape = lobe(layer.alpha(), facets[p]);
        const double masked = facets[p].cos_i * facets[p].cos_o *
                              visibility(layer.alpha(), facets[p].cos_i, facets[p].sin_i) *
                              visibility(layer.alpha(), facets[p].cos_o, facets[p].sin_o);
        straight.at(i.theta_deg, in);
        straight.at(o.theta_deg, out);
        for (std::size_t w = 0; w < nm.size(); ++w)
            f.push_back(factor * (shape * R[p * nm.size() + w] +
                                  masked * in[w] * out[w] * scattering.base_albedo(nm[w]) / kPi));
    }
    return f;
}

void add_case(const LayeredCase& of, std::uint64_t samples, double budget,
              std::vector<LayeredRow>& rows) {
    const std::vector<ScatterPair> pairs = bench_pairs();
    const std::vector<double> nm = bench_wavelengths();
    const Execution one(1, execution_of().simd);
    const LayeredSurface surface = surface_of(of);
    const LayeredScattering kept(surface, Crossings::single, one);
    SimulationRequest request;
    request.samples = samples;
    const std::vector<double> reference =
        LayeredSimulation(kept, request, nm, one).brdf(pairs).mean;
    const auto add = [&](std::string method, double prepare_s, double evaluate_s,
                         const std::vector<double>& values) {
        rows.push_back({std::string(of.name), std::move(method), prepare_s, evaluate_s,
                        smape(values, reference)});
    };
    std::vector<double> values;

    request = {.paths = Paths::single, .facets = FacetChoice::filter, .samples = 64, .seed = 2};
    std::unique_ptr<LayeredSimulation> simulation;
    double prepare = seconds_of(
        [&] { simulation = std::make_unique<LayeredSimulation>(kept, request, nm, one); });
    double evaluate = best_seconds(budget, [&] { values = simulation->brdf(pairs).mean; });
    add("simulation/64", prepare, evaluate, values);

    std::unique_ptr<LayeredScattering> fresh;
    const auto restart = [&] {
        fresh = std::make_unique<LayeredScattering>(surface, Crossings::single, one);
    };
    restart();
    prepare = seconds_of([&] { fresh->layer(0).facets().prepare(nm, 1); });
    evaluate = seconds_of([&] { values = fresh->brdf(pairs, nm, Paths::single); });
    add("model", prepare, evaluate, values);

    restart();
    AngleTable straight;
    prepare =
        seconds_of([&] { straight = straight_table(fresh->layer(0), nm, Crossings::single, 1); });
    evaluate = best_seconds(budget, [&] { values = with_table(*fresh, straight, pairs, nm); });
    add("model-table", prepare, evaluate, values);

    restart();
    if (fresh->is_closed()) {
        prepare = seconds_of([&] { fresh->brdf(pairs, nm, Paths::all); });
        evaluate = best_seconds(budget, [&] { values = fresh->brdf(pairs, nm, Paths::all); });
        add("all", prepare, evaluate, values);
        return;
    }
    evaluate = seconds_of([&] {
        values = fresh->brdf(pairs, nm, Paths::single);
        const Adding adding(*fresh, 1e-2, one);
        const std::vector<double> rest = adding.brdf_rest(pairs, nm).values;
        for (std::size_t k = 0; k < values.size(); ++k) values[k] += rest[k];
    });
    add("all", 0, evaluate, values);
}

int run_bench_layered(const LayeredOptions& options) {
    resolved_record_format(options.output);
    const std::uint64_t samples = parse_whole_number("--samples", options.samples, 2, 1e9);
    const double budget = parse_one_number("--budget", options.budget, 0, 3600);
    std::vector<LayeredRow> rows;
    for (const LayeredCase& one :
         chosen_cases<LayeredCase>(options.cases, kLayeredCases, "layered"))
        add_case(one, samples, budget, rows);
    tables::Column::Texts names, methods;
    for (const LayeredRow& row : rows) {
        names.push_back(row.name);
        methods.push_back(row.method);
    }
    tables::Records records{{{"case", std::move(names)}, {"method", std::move(methods)}}};
    add_numbers(records, "prepare_s", rows, [](const LayeredRow& row) { return row.prepare_s; });
    add_numbers(records, "evaluate_s", rows, [](const LayeredRow& row) { return row.evaluate_s; });
    add_numbers(records, "smape_percent", rows, [](const LayeredRow& row) { return row.smape; });
    add_numbers(records, "efficiency", rows, [](const LayeredRow& row) {
        const double error = row.smape / 100;
        return 1 / (error * error * row.evaluate_s);
    });
    write_records(records, options.output);
    return 0;
}

}  // namespace

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
    set_examples(*command,
                 {"irido bench layered", "irido bench layered --cases A --samples 1e5 -f json"},
                 "240 directions of view under a beam from 30 degrees at 15 wavelengths, on one\n"
                 "thread. simulation/64: single reflections, 64 paths, FPB24's sampling; model:\n"
                 "their eq. 34 (corrected), f_t cos integrated for every direction; model-table:\n"
                 "the same with a table of f_t cos; all: all paths, by the closed form or by\n"
                 "adding. smape_percent: symmetric mean absolute error against the reference,\n"
                 "which has all paths; efficiency: 1 / (error^2 evaluate_s).");
    command->callback([options, &run] { run = [options] { return run_bench_layered(*options); }; });
}

}  // namespace irido::cli
