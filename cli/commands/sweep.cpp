#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/interrupt.hpp"
#include "cli/options/command.hpp"
#include "cli/options/long_work.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/shard.hpp"
#include "cli/progress.hpp"
#include "cli/sweep/engine.hpp"
#include "cli/sweep/scatter.hpp"
#include "cli/sweep/summary.hpp"
#include "core/error.hpp"
#include "core/nearest.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/files/hash.hpp"
#include "tables/resume/collected_rows.hpp"

namespace irido::cli {

namespace {

struct SweepCommand {
    schemas::StackRequest stack;
    std::vector<std::string> vary;
    std::string points;
    ScatterOptions scatter;
    const QueryKind* kind = nullptr;
    std::unique_ptr<QueryOptions> typed;  ///< options of the kind
    std::string compute;
    OutputOptions output;
    PictureOptions picture;
    std::string shard;
    std::vector<std::string> merge;
    bool resume = false, keep_going = false, stats = false, quiet = false;
    bool has_angles = false, has_wavelengths = false;  ///< given as options of the kind
    unsigned threads = 0;
};

/// Whether stacks that differ only in this column have the same structure.
bool is_shared(const SweptColumn& column) {
    return !column.is_of_stack() || schemas::VariedStack::is_thickness(column.path);
}

/// Number of stacks per structure, as far as it is known in advance.
double stacks_of_structure(const SweepSpace& space) {
    double stacks = 1, points = 1, samples = 1;
    bool points_share = true, samples_share = true;
    for (const SweptColumn& column : space.columns()) {
        if (column.of_points) {
            points = static_cast<double>(column.size());
            points_share = points_share && is_shared(column);
        } else if (column.scattered) {
            samples = static_cast<double>(column.size());
            samples_share = samples_share && is_shared(column);
        } else if (is_shared(column)) {
            stacks *= static_cast<double>(column.size());
        }
    }
    return stacks * (points_share ? points : 1) * (samples_share ? samples : 1);
}

std::size_t structures_together(const SweepSpace& space) {
    double structures = 1;
    for (const SweptColumn& column : space.columns())
        if (!is_shared(column)) structures *= static_cast<double>(column.size());
    return static_cast<std::size_t>(
        std::min(structures, static_cast<double>(SweptStacks::kMostStructures)));
}

std::vector<LayerPlace> varied_layers(const SweepSpace& space) {
    std::vector<LayerPlace> places;
    for (const SweptColumn& column : space.columns())
        if (schemas::VariedStack::is_thickness(column.path))
            places.push_back(schemas::VariedStack::place_of(column.path));
    return places;
}

/// Rejects angles or wavelengths that are given twice.
void require_once(const SweepCommand& command, const SweepSpace& space) {
    for (const SweptColumn& column : space.columns()) {
        if (column.path == kSweptAngle && command.has_angles)
            throw UsageError("--angles: cannot be combined with a varied angle_deg");
        if (column.path == kSweptWavelength && command.has_wavelengths)
            throw UsageError("--wavelengths: cannot be combined with a varied wavelength_nm");
    }
}

bool varies_wavelength(const SweepSpace& space) {
    return std::ranges::find(space.columns(), kSweptWavelength, &SweptColumn::path) !=
           space.columns().end();
}

/// Hash of everything that the rows depend on, except the machine.
std::string request_hash(const SweepCommand& command, const Query& query,
                         const schemas::StackSource& source, const schemas::StackDocument& first,
                         const SweepSpace& space) {
    nlohmann::json vary = nlohmann::json::array();
    for (const SweptColumn& column : space.columns()) {
        vary.push_back({column.path, column.numbers, column.texts, column.codes, column.of_points});
        if (!column.scattered) continue;
        const ScatteredValue& drawn = *column.scattered;
        vary.back().push_back({drawn.nominal, drawn.sigma, drawn.lowest, drawn.highest, drawn.seed,
                               drawn.stream, drawn.samples});
    }
    const nlohmann::json request{{"compute", command.kind->name},
                                 {"options", command.typed->typed()},
                                 {"data", query.data()},
                                 {"stack", source.document},
                                 {"first", schemas::canonical_stack(first.stack)},
                                 {"vary", std::move(vary)}};
    return tables::sha256_of(
        request.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string in_words(double seconds) {
    std::array<char, 32> text{};
    const auto whole = static_cast<long>(std::min(seconds, 1e9));
    if (whole < 3600) {
        std::snprintf(text.data(), text.size(), "%ld:%02ld", whole / 60, whole % 60);
    } else {
        std::snprintf(text.data(), text.size(), "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60,
                      whole % 60);
    }
    return text.data();
}

/// "950", "38.9 k", "1.2 M"
std::string short_number(double number) {
    std::array<char, 32> text{};
    const char* const unit = number < 1e3 ? "" : number < 1e6 ? " k" : number < 1e9 ? " M" : " G";
    const double scale = number < 1e3 ? 1 : number < 1e6 ? 1e3 : number < 1e9 ? 1e6 : 1e9;
    std::snprintf(text.data(), text.size(), scale == 1 ? "%.0f%s" : "%.1f%s", number / scale, unit);
    return text.data();
}

/// Shows rows done, rate and remaining time.
class SweepProgress {
public:
    SweepProgress(bool quiet, std::uint64_t units, const SweepCounts& counts)
        : progress_(quiet), units_(units), counts_(counts) {}

    void set(std::uint64_t done) {
        const double passed = seconds(),
                     part = static_cast<double>(done) /
                            static_cast<double>(std::max<std::uint64_t>(1, units_));
        progress_.set(part, short_number(static_cast<double>(counts_.rows)) + " rows, " +
                                short_number(rows_per_second()) + "/s, " +
                                (part > 0 ? in_words(passed / part - passed) : "?") + " left");
    }
    void clear() { progress_.clear(); }
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    double rows_per_second() const {
        return static_cast<double>(counts_.rows) / std::max(seconds(), 1e-9);
    }

private:
    Progress progress_;
    std::uint64_t units_;
    const SweepCounts& counts_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void print_stats(const SweepEngine& engine, const SweptStacks& stacks,
                 const SweepProgress& progress) {
    const SweepCounts& counts = engine.counts();
    std::fprintf(stderr, "irido: stats: %llu rows in %.3g s, %.3g rows/s\n",
                 static_cast<unsigned long long>(counts.rows), progress.seconds(),
                 progress.rows_per_second());
    std::fprintf(stderr, "irido: stats: %llu stacks; %llu structures prepared\n",
                 static_cast<unsigned long long>(counts.stacks),
                 static_cast<unsigned long long>(stacks.prepared()));
}

std::unique_ptr<tables::RecordStream> open_stream(const SweepCommand& command,
                                                  const tables::RecordFormat& format,
                                                  const SweepEngine& engine,
                                                  const tables::StreamIdentity& identity) {
    const bool is_known = engine.rows_per_unit() > 0 && !command.keep_going;
    const std::uint64_t rows =
        is_known ? engine.rows_per_unit() * (identity.end - identity.begin) : 0;
    if (!command.output.file.empty())
        return tables::record_file(command.output.file, format, engine.layout(), identity,
                                   command.resume, rows);
    if (command.resume) throw UsageError("--resume: requires --output FILE");
    const tables::RecordLayout layout = engine.layout();
    const bool counts = format.head(layout, 0, tables::HeadKind::final) !=
                        format.head(layout, 1, tables::HeadKind::final);
    if (counts && !is_known)
        throw UsageError(
            "--format: " + std::string(format.name) +
            " requires --output FILE where the number of rows is not known in advance");
    return tables::record_output(format, engine.layout(), rows);
}

/// --resume and shards require a file of rows.
void require_no_parts(const SweepCommand& command) {
    if (command.resume) throw UsageError("--resume: a picture is drawn in one go");
    if (!command.shard.empty())
        throw UsageError("--shard: a picture needs all rows: merge shards of them first");
}

/// A stream whose rows are drawn when all are there.
std::unique_ptr<tables::RecordStream> open_picture(const SweepCommand& command,
                                                   const tables::PictureFormat& picture,
                                                   const SweepEngine& engine,
                                                   const SweepSpace& space, const Query& query,
                                                   const schemas::StackDocument& first,
                                                   Notes& notes) {
    constexpr std::uint64_t most_rows = 20'000'000;
    if (engine.rows_per_unit() * engine.units() > most_rows)
        throw UsageError("--output: a picture of " +
                         std::to_string(engine.rows_per_unit() * engine.units()) +
                         " rows, at most " + std::to_string(most_rows));
    std::vector<std::string> varied;
    for (const SweptColumn& column : space.columns())
        if (!column.is_light()) varied.push_back(column.path);
    const std::string title = title_of(first, command.stack, varied);
    const auto draw = [&command, &picture, &query, &notes, varied,
                       title](const tables::Records& rows) {
        const auto figure = [&] {
            return figure_of_rows(query, rows, varied, title, parse_gamut(command.picture),
                                  [&](const std::string& text) { notes(text); });
        };
        write_picture(figure, command.picture, picture, command.output);
    };
    return tables::collected_rows(engine.layout(), draw);
}

/// A stream that writes statistics of the samples when all rows are there.
std::unique_ptr<tables::RecordStream> open_summary(const SweepCommand& command,
                                                   const SweepEngine& engine,
                                                   const SweepSpace& space, const Query& query) {
    return sample_summary(
        engine.layout(), space, query, parse_limits(command.scatter.limits),
        [&command](const tables::Records& records) { write_records(records, command.output); });
}

/// A summary needs all samples and is not a file of rows.
void require_whole(const SweepCommand& command) {
    if (!command.scatter.limits.empty() && !command.scatter.summary)
        throw UsageError("--limit: requires --summary");
    if (!command.scatter.summary) return;
    if (command.resume) throw UsageError("--resume: a summary is computed in one go");
    if (!command.shard.empty())
        throw UsageError("--shard: a summary is of all samples; shards hold rows");
}

int run_merge(const SweepCommand& command) {
    if (command.output.file.empty()) throw UsageError("--merge: requires --output FILE");
    tables::merge_streams(command.merge, command.output.file,
                          resolved_record_format(command.output, RecordTarget::any));
    return 0;
}

/// Computes and writes the remaining units of a stream. Returns the exit status.
int write_rows(const SweepCommand& command, SweepEngine& engine, SweptStacks& stacks,
               const tables::RecordFormat& format, const tables::StreamIdentity& identity,
               tables::RecordStream& stream, const OrderlyEnd* orderly) {
    const std::uint64_t begin = identity.begin + stream.units_done();
    SweepProgress progress(command.quiet, identity.end - begin, engine.counts());
    const auto proceed = [&](std::uint64_t done) {
        progress.set(done);
        return !orderly || orderly->signal() == 0;
    };
    const bool is_whole = engine.run(begin, identity.end, format, stream, command.threads, proceed);
    progress.clear();
    if (!is_whole) {
        stream.suspend();
        note("interrupted; rerun with --resume to continue", command.quiet);
        return 128 + orderly->signal();
    }
    const std::uint64_t left_out = engine.counts().left_out, all = identity.end - begin;
    if (left_out > 0 && left_out == all && stream.rows_done() == 0 && identity.shards == 1) {
        stream.discard();
        throw CheckFailed("nothing is left: none of " + std::to_string(all) +
                          " combinations can be computed; the first fails " +
                          engine.first_left_out());
    }
    stream.finish();
    if (left_out > 0)
        note("left out " + std::to_string(left_out) + " of " + std::to_string(all) +
                 "; the first fails " + engine.first_left_out(),
             command.quiet);
    if (command.stats) print_stats(engine, stacks, progress);
    return 0;
}

int run_sweep(const SweepCommand& command) {
    if (!command.merge.empty()) return run_merge(command);
    if (command.stack.stack.empty()) throw UsageError("STACK is required (see irido sweep --help)");
    if (!command.kind) throw UsageError("--compute: is required: spectrum, color, bands or cm");
    const tables::PictureFormat* const picture = asked_picture(command.output, command.picture);
    if (picture) require_no_parts(command);
    if (picture && !command.scatter.paths.empty())
        throw UsageError("--output: samples are not drawn; choose csv, json, npy or h5");
    require_whole(command);
    const bool is_summary = command.scatter.summary;
    if (is_summary) resolved_record_format(command.output);
    const tables::RecordFormat& format =
        picture || is_summary
            ? tables::packed_format()
            : resolved_record_format(command.output, RecordTarget::any_or_picture);
    const Shard shard = parse_shard(command.shard);
    check_writable(command.output);
    Notes notes(command.quiet);
    schemas::StackSource source = schemas::load_stack(command.stack);
    const SweepSpace space(command.vary, command.points,
                           scattered_columns(command.scatter, command.vary, source));
    require_once(command, space);
    const Execution machine{1, execution_of(command.threads).simd};
    const auto query = command.typed->parse(
        {.execution = machine,
         .note = [&](const std::string& text) { notes(text); },
         .stacks = stacks_of_structure(space),
         .varied = command.stack.reverse ? std::vector<LayerPlace>{} : varied_layers(space),
         .structures = structures_together(space),
         .varies_wavelength = varies_wavelength(space),
         .is_silent = true});
    SweptStacks stacks(source, space, *query);
    SweepEngine engine(stacks, space, *query, command.keep_going);
    const std::vector<std::uint64_t> ends =
        shard.of > 1 ? engine.shard_ends(shard.of) : std::vector<std::uint64_t>{0, engine.units()};
    const tables::StreamIdentity identity{
        request_hash(command, *query, source, stacks.first(), space),
        std::string(name_of(machine.simd)),
        shard.number,
        shard.of,
        ends[shard.number - 1],
        ends[shard.number],
        engine.units(),
        !command.shard.empty()};
    std::optional<OrderlyEnd> orderly;
    if (!command.output.file.empty() && !picture && !is_summary)
        orderly.emplace();  // before a part exists
    std::error_code ignored;
    const bool is_discarding =
        !command.resume && std::filesystem::exists(command.output.file + ".part", ignored);
    const std::unique_ptr<tables::RecordStream> stream =
        picture      ? open_picture(command, *picture, engine, space, *query, stacks.first(), notes)
        : is_summary ? open_summary(command, engine, space, *query)
                     : open_stream(command, format, engine, identity);
    if (is_discarding)  // not while another process writes it
        note("discarding " + command.output.file +
                 ".part of an earlier run (use --resume to continue it)",
             command.quiet);
    if (stream->is_complete()) return 0;
    if (stream->rows_done() > 0)
        note("resuming after " + std::to_string(stream->rows_done()) + " rows", command.quiet);
    note_long_work(
        engine.seconds_of(identity.begin + stream->units_done(), identity.end, command.threads),
        false, [&](const std::string& text) { notes(text); });
    try {
        return write_rows(command, engine, stacks, format, identity, *stream,
                          orderly ? &*orderly : nullptr);
    } catch (...) {
        // with --resume, finished rows are kept after any error
        if (command.resume) {
            stream->suspend();
        } else {
            stream->discard();
        }
        throw;
    }
}

/// The kind named after --compute on the command line; nullptr without --compute.
const QueryKind* typed_kind(std::span<char* const> arguments) {
    for (std::size_t i = 2; i < arguments.size(); ++i) {
        std::string_view argument = arguments[i];
        constexpr std::string_view option = "--compute";
        if (argument == option && i + 1 < arguments.size()) {
            argument = arguments[i + 1];
        } else if (argument.starts_with("--compute=")) {
            argument.remove_prefix(option.size() + 1);
        } else {
            continue;
        }
        for (const QueryKind& kind : query_kinds())
            if (kind.name == argument) return &kind;
        throw UsageError("--compute: " + not_one_of(query_names(), std::string(argument)));
    }
    return nullptr;
}

void add_sweep_options(CLI::App& command, SweepCommand& typed) {
    add_stack_options(command, typed.stack);
    command.get_option("STACK")->required(false);
    command
        .add_option("--vary", typed.vary,
                    "vary a value of the stack, by dotted path, over a LIST\n"
                    "(layers.0.thickness_nm=0:1000:10) or over names and other values\n"
                    "(substrate=Ag,Au,1.9+1.5i,{\"n\":2}); also angle_deg and, for\n"
                    "spectrum, wavelength_nm. Repeatable; the last --vary changes fastest")
        ->type_name("PATH=LIST")
        ->allow_extra_args(false);
    command
        .add_option("--points", typed.points,
                    "CSV file of combinations, its columns named by path; each is\n"
                    "computed with every combination of --vary")
        ->type_name("FILE");
    add_scatter_options(command, typed.scatter);
    command
        .add_option("--compute", typed.compute,
                    "spectrum, color, bands or cm, with the options of that command;\n"
                    "see irido sweep --compute color --help")
        ->type_name("COMMAND");
    offer(command, "compute", query_names);
    command
        .add_option("--shard", typed.shard,
                    "compute part K of N only, K in [1, N], parts being of about equal\n"
                    "cost; keep FILE.sweep, which holds its checksum, for --merge")
        ->type_name("K/N");
    command.add_flag("--resume", typed.resume,
                     "continue an earlier run of the same command; if this run ends\n"
                     "early, its finished rows are kept, too");
    command
        .add_option("--merge", typed.merge,
                    "join the files of all shards, in any order, instead of computing:\n"
                    "byte-identical to a single run. Refuses files that were changed,\n"
                    "or written by another build of irido (--version) or at another\n"
                    "SIMD level (IRIDO_SIMD=avx2 forces one)")
        ->type_name("FILE");
    command.add_flag("--keep-going", typed.keep_going,
                     "leave out combinations that cannot be computed, and report how many;\n"
                     "if none is left, the exit status is 1 and FILE stays as it was");
    if (!command.get_option_no_throw("--stats")) {
        command.add_flag("--stats", typed.stats, "print reuse statistics on standard error");
    } else {
        command.get_option("--stats")->description(
            "add columns method,evaluations,error_estimate; the error of\n"
            "approximate methods is measured against quadrature. Also print\n"
            "reuse statistics on standard error");
    }
}

}  // namespace

void add_sweep_command(CLI::App& program, Run& run, std::span<char* const> arguments) {
    CLI::App* command = program.add_subcommand(
        "sweep",
        "Compute all combinations of varied values into one file: streamed, resumable, sharded.");
    const auto options = std::make_shared<SweepCommand>();
    const bool is_typed = arguments.size() > 1 && std::string_view(arguments[1]) == "sweep";
    options->kind = is_typed ? typed_kind(arguments) : nullptr;
    if (options->kind) options->typed = options->kind->add_options(*command);
    add_sweep_options(*command, *options);
    add_output_options(*command, options->output,
                       record_formats_text(RecordTarget::any_or_picture));
    add_picture_options(*command, options->picture);
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet, "no notes and no progress");
    set_examples(
        *command,
        {"irido sweep \"air | TiO2@35 | Ti\" --vary layers.0.thickness_nm=0:200:1 --compute color",
         "irido sweep stack.json --vary substrate=Ag,Au,Cu --vary layers.0.thickness_nm=0:500:5 "
         "--compute spectrum -w 400:700:10 -o sweep.npy",
         "irido sweep \"air | TiO2@0 | Ti\" --vary layers.0.thickness_nm=0:200:1 --vary "
         "angle_deg=0:85:1 --compute color -o map.png",
         "irido sweep \"air | MgF2@99.6 | BK7\" --scatter layers.0.thickness_nm=2% --compute "
         "spectrum -w 550 --summary --limit \"R<=0.014\"",
         "irido sweep --merge part-1.csv part-2.csv part-3.csv -o all.csv"},
        "Columns are the varied values, named by path, then those of the command. With -o, rows\n"
        "are in FILE.part until all are done; after Ctrl-C or a crash, --resume continues it.");
    command->callback([options, command, &run] {
        const auto is_given = [&](const std::string& name) {
            const CLI::Option* const option = command->get_option_no_throw(name);
            return option && option->count() > 0;
        };
        options->stats = is_given("--stats");  // possibly that of color
        options->has_angles = is_given("--angles");
        options->has_wavelengths = is_given("--wavelengths");
        run = [options] { return run_sweep(*options); };
    });
}

}  // namespace irido::cli
