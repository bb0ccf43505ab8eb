#include <cmath>
#include <memory>
#include <optional>

#include "cli/bench/bench.hpp"
#include "cli/bench/color_comparison.hpp"
#include "cli/options/color_options.hpp"
#include "cli/options/picture_options.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "tables/pictures/figure.hpp"

namespace irido::cli {

namespace {

constexpr double kMostStacks = 1e5;

struct ParetoOptions {
    std::string cases = "all";
    std::string count = "50";
    std::string seed = "1";
    std::string time = "0.01";
    std::optional<std::string> plot;
    OutputOptions output;
    bool quiet = false;
};

struct ParetoRow {
    std::string_view of;  ///< the case
    const ColorMethodKind* method = nullptr;
    double parameter = 0, tolerance = 0;
    MethodReport report;
    EqualMatch equal;
};

std::vector<ParetoRow> rows_of(const ColorCase& one, ColorComparison comparison,
                               StepProgress& progress) {
    std::vector<ParetoRow> rows;
    for (const ColorMethodKind* const method : color_methods()) {
        progress.begin(std::string(one.name) + ", " + std::string(method->name));
        const auto add = [&](std::size_t count, double tolerance) {
            const auto report = comparison.measure({method, count}, tolerance);
            if (!report) return;
            ParetoRow row{one.name,
                          method,
                          static_cast<double>(count > 0 ? count - method->number.offset : 0),
                          0,
                          *report,
                          {}};
            if (count == 0 && method->trials.last_power > 0) {
                row.tolerance = tolerance;
                if (method->use == MethodUse::exact)
                    row.equal = comparison.equal_match(report->max_error);
            }
            rows.push_back(std::move(row));
        };
        for (int power = 2; power <= method->trials.last_power; ++power)
            add(0, std::stod("1e-" + std::to_string(power)));
        for (const std::size_t count : method->trials.counts)
            add(count, method->trials.tolerance_of_counts);
    }
    return rows;
}

tables::Records to_records(const std::vector<ParetoRow>& rows) {
    tables::Column::Texts cases, methods, stacks, hexes, exact;
    for (const ParetoRow& row : rows) {
        cases.emplace_back(row.of);
        methods.emplace_back(row.method->name);
        stacks.push_back(row.report.worst_stack);
        hexes.push_back(row.report.worst_hex);
        exact.push_back(row.report.exact_hex);
    }
    tables::Records records{{{"case", std::move(cases)}, {"method", std::move(methods)}}};
    const auto add = [&](std::string name, auto value) {
        add_numbers(records, std::move(name), rows, value);
    };
    add("parameter", [](const ParetoRow& r) { return r.parameter; });
    add("tolerance", [](const ParetoRow& r) { return r.tolerance; });
    add("colors", [](const ParetoRow& r) { return r.report.colors; });
    add("evaluations", [](const ParetoRow& r) { return r.report.evaluations; });
    add("ns_per_color", [](const ParetoRow& r) { return r.report.ns_per_color; });
    add("max_dXYZ", [](const ParetoRow& r) { return r.report.max_error; });
    add("dE2000_mean", [](const ParetoRow& r) { return r.report.mean_de; });
    add("dE2000_p95", [](const ParetoRow& r) { return r.report.p95_de; });
    add("dE2000_max", [](const ParetoRow& r) { return r.report.max_de; });
    add("equal_wavelengths", [](const ParetoRow& r) { return r.equal.wavelengths; });
    add("equal_ns_per_color", [](const ParetoRow& r) { return r.equal.ns_per_color; });
    add("times_faster",
        [](const ParetoRow& r) { return r.equal.ns_per_color / r.report.ns_per_color; });
    records.columns.push_back({"worst_stack", std::move(stacks)});
    add("worst_angle_deg", [](const ParetoRow& r) { return r.report.worst_angle_deg; });
    records.columns.push_back({"worst_hex", std::move(hexes)});
    records.columns.push_back({"exact_hex", std::move(exact)});
    return records;
}

/// Smaller errors are due to rounding or to the reference.
constexpr double kSmallestError = 1e-13;

tables::Point point_of(const ParetoRow& row) {
    return {row.report.ns_per_color, std::clamp(row.report.max_error, kSmallestError, 1.0)};
}

/// The Pareto front, as steps: no point is both faster and more accurate.
std::vector<tables::Point> front(const std::vector<ParetoRow>& rows) {
    std::vector<tables::Point> points, steps;
    for (const ParetoRow& row : rows) points.push_back(point_of(row));
    std::ranges::sort(points, {}, &tables::Point::x);
    for (const tables::Point& point : points) {
        if (!steps.empty() && point.y >= steps.back().y) continue;
        if (!steps.empty()) steps.push_back({point.x, steps.back().y});
        steps.push_back(point);
    }
    return steps;
}

/// The panel of one case; new methods are appended to `names`.
tables::Panel panel_of(const std::vector<ParetoRow>& rows, std::vector<std::string>& names) {
    using enum tables::Series::Form;
    tables::Panel panel{.title = std::string(rows.front().of)};
    panel.series.push_back({"best for its time", 0, front(rows), highlight, {}});
    std::string last;
    for (const ParetoRow& row : rows) {
        const std::string name(row.method->name);
        const auto known = std::ranges::find(names, name);
        const auto style = static_cast<std::size_t>(known - names.begin());
        if (known == names.end()) names.push_back(name);
        if (name != last) panel.series.push_back({name, style, {}, line_with_points, {}});
        panel.series.back().points.push_back(point_of(row));
        last = name;
    }
    return panel;
}

tables::Figure picture(const std::vector<std::vector<ParetoRow>>& cases) {
    tables::Figure figure{.title = "Colours of thin films: run time against error"};
    double fastest = 1e9, slowest = 1;
    std::vector<std::string> names;
    for (const std::vector<ParetoRow>& rows : cases) {
        figure.panels.push_back(panel_of(rows, names));
        for (const ParetoRow& row : rows) {
            fastest = std::min(fastest, row.report.ns_per_color);
            slowest = std::max(slowest, row.report.ns_per_color);
        }
    }
    for (tables::Panel& panel : figure.panels) {
        panel.x = {.quantity = "time per colour",
                   .unit = "ns",
                   .logarithmic = true,
                   .first = std::pow(10, std::floor(std::log10(fastest))),
                   .last = std::pow(10, std::ceil(std::log10(slowest)))};
        panel.y = {.quantity = "largest error of X, Y, Z",
                   .logarithmic = true,
                   .first = kSmallestError,
                   .last = 1};
    }
    figure.notes.push_back("white has Y = 1");
    figure.columns = 4;
    figure.width = 1080;
    figure.panel_height = 170;
    figure.shared_x = figure.shared_y = true;
    return figure;
}

/// The methods, with what `parameter` is, for --help.
std::string methods_text() {
    std::vector<std::string> with_tolerance, at_counts;
    for (const ColorMethodKind* const method : color_methods()) {
        const MethodTrials& trials = method->trials;
        if (trials.last_power == 0) continue;
        with_tolerance.emplace_back(method->name);
        if (!trials.counts.empty())
            at_counts.push_back(std::string(method->name) + " also " + std::string(trials.what));
    }
    const std::string last = with_tolerance.back();
    with_tolerance.pop_back();
    std::string text = joined(with_tolerance, ", ") + " and " + last + " at their tolerances (" +
                       joined(at_counts, ", ") + ", at tolerance 0);\n";
    std::vector<std::string> others;
    for (const ColorMethodKind* const method : color_methods()) {
        if (method->trials.last_power > 0) continue;
        const bool has_parameter = method->trials.counts.size() > 1;
        others.push_back(std::string(method->name) + ": " + std::string(method->trials.what) +
                         (has_parameter ? ";\n" : "; "));
    }
    text += joined(others, "");
    text.erase(text.find_last_not_of("; \n") + 1);
    return wrapped(text + ". A method that cannot compute the stacks of a case has no rows there.",
                   kHelpNotesWidth);
}

int run_pareto(const ParetoOptions& options) {
    resolved_record_format(options.output);
    check_writable(options.output);
    check_plot(options.plot, options.output);
    const std::uint64_t count = parse_whole_number("--count", options.count, 1, kMostStacks);
    const std::uint64_t seed = parse_whole_number("--seed", options.seed, 0, kLargestSeed);
    const double seconds = parse_one_number("--time", options.time, 0.0001, 60);
    const SimdLevel simd = execution_of(1).simd;
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    std::vector<std::vector<ParetoRow>> cases;
    std::vector<ParetoRow> rows;
    const auto chosen = chosen_cases<ColorCase>(options.cases, color_cases(), "pareto");
    StepProgress progress(options.quiet, chosen.size() * color_methods().size());
    for (const ColorCase& one : chosen) {
        cases.push_back(rows_of(
            one, {tables, color_families(one, count, seed), one.is_set, seconds, simd}, progress));
        rows.insert(rows.end(), cases.back().begin(), cases.back().end());
    }
    progress.clear();
    write_records(to_records(rows), options.output);
    if (options.plot)
        write_picture([&] { return picture(cases); }, {},
                      picture_format_of("--plot", *options.plot), {*options.plot, ""});
    return 0;
}

}  // namespace

void add_bench_pareto(CLI::App& bench, Run& run) {
    CLI::App* command = bench.add_subcommand(
        "pareto", "Run time against error for every method to compute a colour.");
    const auto options = std::make_shared<ParetoOptions>();
    command->add_option("-c,--cases", options->cases, cases_help<ColorCase>(color_cases()))
        ->type_name("NAMES");
    const auto names = [] { return case_names<ColorCase>(color_cases()); };
    offer(*command, "cases", names, OfferedWords::Use::several);
    command
        ->add_option("-n,--count", options->count,
                     "stacks of each random set, one angle each, [1, 1e5] [50]")
        ->type_name("N");
    command
        ->add_option("-s,--seed", options->seed,
                     "stack i of a set depends on seed + i only, [0, 2^53] [1]")
        ->type_name("S");
    command
        ->add_option("-t,--time", options->time,
                     "seconds spent on the time of each row, [0.0001, 60] [0.01]")
        ->type_name("S");
    command
        ->add_option("--plot", options->plot,
                     "also plot the rows of every case into FILE (.svg, .png or .pdf)")
        ->type_name("FILE");
    add_output_options(*command, options->output, record_formats_text());
    add_quiet_option(*command, options->quiet, "no progress");
    set_examples(
        *command,
        {"irido bench pareto -o pareto.csv --plot pareto.svg",
         "irido bench pareto --cases dielectric,conductor --count 2000 -f json"},
        "Reflected unpolarized light, D65, 2 degrees, one thread; white Y = 1. Methods:\n" +
            methods_text() +
            "\n"
            "Columns: parameter and tolerance, 0 where there is none; evaluations: wavelengths\n"
            "per colour; ns_per_color: processor time of the fastest run, including each stack's\n"
            "preparation in the random sets; max_dXYZ: largest error of X, Y, Z against\n"
            "quadrature at 1e-11; dE2000: CIEDE2000 to the exact colours: mean, 95th percentile\n"
            "and maximum over the case's `colors`. For methods with a tolerance:\n"
            "equal_wavelengths: number of equally spaced wavelengths with the same max_dXYZ, and\n"
            "their equal_ns_per_color and times_faster; 0 for other methods, and if more than\n"
            "65536 are needed. worst_stack, worst_angle_deg: where dE2000 is largest; there\n"
            "the method gives worst_hex instead of exact_hex.");
    set_run(*command, run, options, run_pareto);
}

}  // namespace irido::cli
