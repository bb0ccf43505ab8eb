#include <memory>

#include "cli/comparison/asset.hpp"
#include "cli/comparison/figures.hpp"
#include "cli/comparison/films.hpp"
#include "cli/comparison/fit.hpp"
#include "cli/comparison/table.hpp"
#include "cli/options/command.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/queries/comparison_query.hpp"
#include "cli/sweep/engine.hpp"
#include "core/error.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/resume/collected_rows.hpp"

namespace irido::cli {

namespace {

struct CompareCommand {
    schemas::StackRequest stack;
    ComparisonQueryOptions typed;
    std::vector<std::string> vary;
    std::string films, random, seed, base, weights, gltf, lut;
    OutputOptions output;
    PictureOptions picture;
    bool rows = false, fit = false, quiet = false;
    unsigned threads = 0;
};

constexpr double kMostFilms = 1e6, kMostRows = 2e7;

/// Rows for all combinations of varied values.
tables::Records varied_rows(const CompareCommand& command, const SweepSpace& space,
                            const ComparisonQuery& query, SweptStacks& stacks) {
    SweepEngine engine(stacks, space, query, false);
    if (static_cast<double>(engine.units()) * static_cast<double>(engine.rows_per_unit()) >
        kMostRows)
        throw UsageError("--vary: at most " + to_text(kMostRows) + " rows");
    tables::Records rows;
    const auto stream = tables::collected_rows(engine.layout(),
                                               [&](tables::Records all) { rows = std::move(all); });
    engine.run(0, engine.units(), tables::packed_format(), *stream, command.threads,
               [](std::uint64_t) { return true; });
    stream->finish();
    return rows;
}

/// Layers whose thickness varies.
std::vector<LayerPlace> varied_places(const SweepSpace& space) {
    std::vector<LayerPlace> places;
    for (const SweptColumn& column : space.columns())
        if (schemas::VariedStack::is_thickness(column.path))
            places.push_back(schemas::VariedStack::place_of(column.path));
    return places;
}

constexpr const char* kFitAngles = "0:80:5";

int fit_stack(const CompareCommand& command) {
    const std::string format = resolved_format(command.output);
    if (!is_material_format(format)) resolved_record_format(command.output);
    if (!command.vary.empty()) throw UsageError("--vary: cannot be combined with --fit");
    Notes notes(command.quiet);
    const auto say = [&](const std::string& text) { notes(text); };
    ComparisonQueryOptions typed = command.typed;
    if (typed.angles.empty()) typed.angles = kFitAngles;
    if (typed.comparison.engines == "all") typed.comparison.engines = formula_names();
    const ComparisonQuery query(typed, {.execution = execution_of(command.threads), .note = say});
    if (is_material_format(format)) {
        if (query.engines().size() > 1)
            throw UsageError("--format: " + format + " requires one --engine");
        check_material_format(format, query.engines().front().name);
    }
    const std::vector<double> weights = parse_weights(command.weights, query.angles_deg().size());
    const auto prepared = query.prepare(read_noted_stack(command.stack, command.quiet));
    check_writable(command.output);
    const std::vector<NamedFit> fits = fits_of(query, *prepared, weights, command.threads, say);
    if (is_material_format(format)) {
        const std::string name = title_of(prepared->document, command.stack);
        write_bytes(material_text(format, fits.front(), name), command.output, false);
    } else {
        write_records(fit_rows(fits), command.output);
    }
    return 0;
}

int compare_stack(const CompareCommand& command) {
    const tables::PictureFormat* const picture = asked_picture(command.output, command.picture);
    if (!picture) resolved_record_format(command.output, RecordTarget::stream_or_picture);
    Notes notes(command.quiet);
    const auto say = [&](const std::string& text) { notes(text); };
    QueryRun run{.execution = execution_of(command.threads), .note = say};
    std::vector<std::string> varied;
    tables::Records rows;
    std::string title;
    std::unique_ptr<ComparisonQuery> query;
    if (command.vary.empty()) {
        query = std::make_unique<ComparisonQuery>(command.typed, run);
        const auto prepared = query->prepare(read_noted_stack(command.stack, command.quiet));
        check_writable(command.output);
        rows = records_of(*query, *prepared);
        title = title_of(prepared->document, command.stack);
    } else {
        const SweepSpace space(command.vary, "");
        for (const SweptColumn& column : space.columns()) {
            if (!column.is_light()) varied.push_back(column.path);
            if (column.path == kSweptAngle && !command.typed.angles.empty())
                throw UsageError("--angles: cannot be combined with a varied angle_deg");
        }
        run.stacks = static_cast<double>(space.size());
        if (!command.stack.reverse) run.varied = varied_places(space);
        query = std::make_unique<ComparisonQuery>(command.typed, run);
        SweptStacks stacks(schemas::load_stack(command.stack), space, *query);
        check_writable(command.output);
        rows = varied_rows(command, space, *query, stacks);
        title = title_of(stacks.first(), command.stack, varied);
    }
    if (!picture) {
        write_records(rows, command.output);
        return 0;
    }
    const tables::GamutMapping gamut = parse_gamut(command.picture);
    const auto figure = [&] {
        return command.vary.empty() ? strip_figure(rows, title, gamut)
                                    : figure_of_rows(*query, rows, varied, title, gamut, say);
    };
    write_picture(figure, command.picture, *picture, command.output);
    return 0;
}

std::uint64_t seed_of(const CompareCommand& command) {
    constexpr double kLargestSeed = 9e15;
    return command.seed.empty() ? 1 : parse_whole_number("--seed", command.seed, 0, kLargestSeed);
}

std::vector<ComparedFilm> films_of(const CompareCommand& command, const ColorTables& tables) {
    if (!command.films.empty()) {
        if (!command.seed.empty() || !command.base.empty())
            throw UsageError("--seed and --base require --random");
        return read_films(command.films);
    }
    const auto count =
        static_cast<std::size_t>(parse_whole_number("--random", command.random, 1, kMostFilms));
    std::optional<BaseKind> base;
    if (!command.base.empty() && command.base != "all") {
        try {
            base = base_kind(command.base);
        } catch (const DomainError&) {
            constexpr std::array<std::string_view, 4> names{"dielectric", "conductor", "colored",
                                                            "all"};
            throw UsageError("--base: " + not_one_of(names, command.base));
        }
    }
    return random_films(tables, count, seed_of(command), base);
}

int compare_film_set(const CompareCommand& command) {
    const tables::PictureFormat* const picture = asked_picture(command.output, command.picture);
    if (!picture) resolved_record_format(command.output, RecordTarget::stream_or_picture);
    if (!command.films.empty() && !command.random.empty())
        throw UsageError("--films and --random are mutually exclusive");
    const std::vector<ComparedEngine> engines = parse_engines(command.typed.comparison.engines);
    const ColorTables tables(parse_sensitivity(command.typed.comparison));
    const Triple& white = tables.sensitivity().white();
    const EngineDifference difference = parse_difference(command.typed.comparison, white);
    const std::vector<ComparedFilm> films = films_of(command, tables);
    check_writable(command.output);
    ColorRequest request;
    request.tolerance = kComparisonTolerance;
    request.simd = execution_of(command.threads).simd;
    const std::vector<EngineColor> colors =
        compare_films(tables, engines, difference, films, request, command.threads);
    for (std::size_t i = 0; i < colors.size(); ++i)
        require_exact("film " + films[i / engines.size()].id, colors[i].exact_error);
    if (picture) {
        const std::string title = command.films.empty() ? command.random + " random films"
                                                        : schemas::shown_path(command.films);
        const auto figure = [&] {
            return histogram_figure(film_rows(white, engines, films, colors), title);
        };
        write_picture(figure, command.picture, *picture, command.output);
        return 0;
    }
    write_records(command.rows ? film_rows(white, engines, films, colors)
                               : film_statistics(engines, films, colors),
                  command.output);
    return 0;
}

int compare_asset(const CompareCommand& command) {
    resolved_record_format(command.output);
    Notes notes(command.quiet);
    const tables::Records rows =
        asset_rows(command.gltf, command.typed, execution_of(command.threads),
                   [&](const std::string& text) { notes(text); });
    check_writable(command.output);
    write_records(rows, command.output);
    return 0;
}

int compare_table(const CompareCommand& command) {
    resolved_record_format(command.output);
    TableComparison typed{.file = command.lut, .stack = command.stack};
    if (!command.random.empty())
        typed.points =
            static_cast<std::size_t>(parse_whole_number("--random", command.random, 1, kMostFilms));
    typed.seed = seed_of(command);
    typed.rows = command.rows;
    typed.threads = command.threads;
    typed.simd = execution_of(command.threads).simd;
    const tables::Records rows = table_rows(typed);
    check_writable(command.output);
    write_records(rows, command.output);
    return 0;
}

int run_compare(const CompareCommand& command) {
    const bool has_films = !command.films.empty() || !command.random.empty();
    if (command.stack.stack == "list") {
        write_records(engine_list(), command.output);
        return 0;
    }
    if (!command.lut.empty()) {
        if (!command.films.empty() || !command.gltf.empty() || command.fit ||
            !command.vary.empty() || !command.typed.angles.empty())
            throw UsageError("--lut: can be combined with STACK, --random, --seed and --rows only");
        return compare_table(command);
    }
    if (!command.gltf.empty()) {
        if (has_films || command.fit || !command.vary.empty() || !command.stack.stack.empty())
            throw UsageError("--gltf: cannot be combined with a STACK or other films");
        return compare_asset(command);
    }
    if (!has_films) {
        if (command.rows) throw UsageError("--rows: requires --films or --random");
        if (!command.seed.empty() || !command.base.empty())
            throw UsageError("--seed and --base require --random");
        if (command.stack.stack.empty())
            throw UsageError("STACK is required (see irido compare --help)");
        if (!command.weights.empty() && !command.fit) throw UsageError("--weights: requires --fit");
        return command.fit ? fit_stack(command) : compare_stack(command);
    }
    if (command.fit || !command.weights.empty())
        throw UsageError("--fit and --weights require a STACK");
    if (!command.stack.stack.empty())
        throw UsageError("--films and --random cannot be combined with a STACK");
    if (!command.typed.angles.empty() || !command.vary.empty())
        throw UsageError("--angles and --vary require a STACK");
    return compare_film_set(command);
}

void add_film_options(CLI::App& command, CompareCommand& typed) {
    command
        .add_option("--films", typed.films,
                    "CSV file of films instead of a STACK: id,film_n,film_d_nm,angle_deg, then\n"
                    "base_n,base_k or base_n_r,base_n_g,base_n_b,base_k_r,base_k_g,base_k_b;\n"
                    "prints statistics for each engine and kind of base")
        ->type_name("FILE");
    command
        .add_option("--random", typed.random,
                    "that many random films instead, [1, 1e6]; the same on every machine")
        ->type_name("N");
    command.add_option("--seed", typed.seed, "of --random [1]")->type_name("S");
    command
        .add_option("--base", typed.base,
                    "bases of --random: dielectric, conductor, colored (Au, Cu, brass, TiN) or\n"
                    "all [all]")
        ->type_name("KIND");
    offer(command, "base", "dielectric conductor colored all");
    command
        .add_option("--gltf", typed.gltf,
                    "iridescent materials of a .gltf or .glb file instead, both ends of a\n"
                    "texture's range of thickness; engines gltf, three, babylon, unity and\n"
                    "materialx-gltf")
        ->type_name("FILE");
    command
        .add_option("--lut", typed.lut,
                    "a table of irido lut color, read between its samples, against the exact\n"
                    "colours of STACK [the table's own] at random points, --random of them\n"
                    "[1000]: statistics, or with --rows the points")
        ->type_name("FILE");
    command.add_flag("--rows", typed.rows, "one row for each film and engine, no statistics");
}

}  // namespace

void add_compare_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "compare", "Thin films as renderers compute them, compared with their exact colours.");
    const auto options = std::make_shared<CompareCommand>();
    add_stack_options(*command, options->stack);
    command->get_option("STACK")->required(false);
    add_comparison_options(*command, options->typed.comparison);
    add_angles_option(*command, options->typed.angles);
    command
        ->add_option("--vary", options->vary,
                     "vary a value of the stack over a LIST, as in irido sweep; repeatable:\n"
                     "--vary layers.0.thickness_nm=0:1000:10")
        ->type_name("PATH=LIST")
        ->allow_extra_args(false);
    command->add_flag("--fit", options->fit,
                      "find the parameters of each engine that minimize the mean Delta E over\n"
                      "the angles [0:80:5]; --format or -o FILE also takes gltf, mtlx and py\n"
                      "(Blender) for the material of one engine");
    command
        ->add_option("--weights", options->weights,
                     "weights of the angles for --fit, as many as there are, >= 0 [equal]")
        ->type_name("LIST");
    add_film_options(*command, *options);
    add_output_options(*command, options->output,
                       record_formats_text(RecordTarget::stream_or_picture));
    add_picture_options(*command, options->picture);
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet);
    set_examples(
        *command,
        {"irido compare \"air | 1.3@300 | Au\" --engine gltf,cycles -a 0:85:5",
         "irido compare --random 2000 --seed 1",
         "irido compare schemas/examples/anodized-titanium.json --engine gltf --fit",
         "irido compare list -f json"},
        "Each row has the engine's r, g, b, the exact ones in linear sRGB and their\n"
        "CIEDE2000 difference. Engines take the first layer with its index at 550 nm over\n"
        "the substrate; notes name the properties left out. STACK may be the word list.");
    set_run(*command, run, options, run_compare);
}

}  // namespace irido::cli
