#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>

#include "cli/bench/bench.hpp"
#include "cli/stopwatch.hpp"
#include "core/error.hpp"
#include "schemas/documents/scene_document.hpp"
#include "schemas/input_error.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/lut/lut_file.hpp"
#include "tables/shaders/scene/bake.hpp"
#include "tables/shaders/scene/scene_error.hpp"

namespace irido::cli {

namespace {

namespace fs = std::filesystem;

constexpr double kMostScenePoints = 1e6;
constexpr std::size_t kFixedSize = 256;

struct SceneBenchOptions {
    std::vector<std::string> scenes;
    std::string count = "1000";
    std::string seed = "1";
    unsigned threads = 0;
    OutputOptions output;
    bool quiet = false;
};

/// The example scenes and their stacks, embedded in the program.
struct Document {
    const char* path;
    const char* text;
};

constexpr std::array<Document, 6> kExamples{{
    {
        "scenes/beetle.json",
#include "scene_beetle.inc"
    },
    {
        "scenes/soap-bubbles.json",
#include "scene_soap_bubbles.inc"
    },
    {
        "scenes/vehicle.json",
#include "scene_vehicle.inc"
    },
    {
        "jewel-beetle-green.json",
#include "jewel_beetle_green.inc"
    },
    {
        "jewel-beetle-red.json",
#include "jewel_beetle_red.inc"
    },
    {
        "jewel-beetle-purple.json",
#include "jewel_beetle_purple.inc"
    },
}};

/// A temporary folder for the bakes.
class Workplace {
public:
    Workplace() {
        std::string name = (fs::temp_directory_path() / "irido-bench-XXXXXX").string();
        if (!mkdtemp(name.data())) throw tables::OutputError(name + ": cannot be made");
        path_ = name;
    }
    ~Workplace() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

    std::string operator/(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

struct SceneRow {
    std::string scene, method;
    std::size_t tables = 0, bytes = 0;
    double seconds = 0, worst = 0, worst_of_levels = 0;
    std::size_t written = 0;
};

bool is_in_delta_e(const tables::LutPlan& plan) {
    return plan.measure.name == "delta_e_2000";
}

/// Bakes into `folder`; does not measure the worst Delta E.
SceneRow baked(const std::string& name, const schemas::Scene& scene, const std::string& folder,
               const SceneBenchOptions& options) {
    SceneRow row{name, "irido", 0, 0, 0, 0, 0, 0};
    tables::BakeResult result;
    row.seconds = seconds_of([&] {
        const schemas::Scene again = schemas::read_scene(scene.file);
        const tables::ScenePlan plan = tables::plan_scene(again, execution_of(options.threads));
        tables::BakeRequest request;
        request.place.folder = folder;
        request.threads = options.threads;
        result = tables::bake(again, plan, request);
        row.tables = plan.tables.size();
    });
    if (!result.faults.empty())
        throw DomainError(schemas::fault_text(scene, result.faults.begin()->first,
                                              result.faults.begin()->second.front()));
    row.written = result.manifest_written ? 1 : 0;
    for (const std::string& made : result.made) row.written += made.ends_with(")") ? 0 : 1;
    for (const auto& file : fs::directory_iterator(folder))
        if (file.path().filename() != "manifest.json") row.bytes += fs::file_size(file.path());
    return row;
}

/// A table of a bake, from its file or, if it has none, computed.
tables::Lut lut_of(const tables::SceneTable& table, const nlohmann::json& entry,
                   const std::string& folder) {
    if (entry.contains("file")) return tables::read_lut(folder + "/" + table.file);
    return tables::make_lut(*table.kind, table.kind->plan(table.request), table.making);
}

double worst_of_bake(const schemas::Scene& scene, const std::string& folder,
                     const Execution& execution, const tables::RandomPoints& points) {
    const tables::ScenePlan plan = tables::plan_scene(scene, execution);
    const tables::TableEntries entries = tables::baked_scene({folder}, scene).tables;
    double worst = 0;
    for (const tables::SceneTable& table : plan.tables) {
        if (table.grid) continue;  // exact
        const tables::LutPlan function = table.kind->plan(table.request);
        if (!is_in_delta_e(function)) continue;
        const tables::Lut lut = lut_of(table, entries.at(table.id), folder);
        worst = std::max(worst, tables::worst_difference(function, lut, points));
    }
    for (std::size_t m = 0; m < plan.materials.size(); ++m) {
        const tables::MaterialPlan& material = plan.materials[m];
        if (material.shading != schemas::Shading::fourier) continue;
        std::unique_ptr<tables::Lut> lut;
        for (const tables::MaterialPlan::Use& use : material.tables) {
            const tables::SceneTable& table = plan.tables[use.table];
            lut = std::make_unique<tables::Lut>(lut_of(table, entries.at(table.id), folder));
        }
        worst =
            std::max(worst, tables::worst_fourier_difference(scene, scene.materials[m], material,
                                                             lut.get(), execution, points));
    }
    return worst;
}

/// Colour tables of every material for both polarizations and both sides, with 256 samples along
/// the angle from 0 to 90 degrees and along the first varied value.
SceneRow fixed(const std::string& name, const schemas::Scene& scene,
               const SceneBenchOptions& options, const tables::RandomPoints& points) {
    SceneRow row{name, "fixed 256", 0, 0, 0, 0, 0, 0};
    const Execution execution = execution_of(options.threads);
    const tables::LutKind& kind = *tables::find_lut_kind("color");
    for (const schemas::SceneMaterial& material : scene.materials) {
        if (material.document.stack.materials.empty()) continue;
        tables::LutRequest request = tables::color_request_of(scene, material, execution);
        const std::vector<double> used = request.list("cos");
        for (const Side side : {Side::reflected, Side::transmitted})
            for (const Light light : {Light::s, Light::p}) {
                request.options["cos"] = tables::equally_spaced(0, 1, 2);
                request.color.sides = {side};
                request.color.light = light;
                tables::LutMaking making;
                making.type = tables::LutType::f16;
                making.measure = false;
                making.threads = options.threads;
                making.sizing.counts.assign(1 + request.vary.size(), kFixedSize);
                if (request.vary.size() > 1) making.sizing.counts.back() = kFixedSize / 16;
                tables::Lut lut;
                row.seconds +=
                    seconds_of([&] { lut = tables::make_lut(kind, kind.plan(request), making); });
                ++row.tables;
                ++row.written;
                // four halves per texel, and a third more for the mip levels
                row.bytes += lut.values.size() / 3 * 8 * 4 / 3;
                for (double& value : lut.values)
                    value = tables::rounded(value, tables::LutType::f16);
                request.options["cos"] = used;
                row.worst =
                    std::max(row.worst, tables::worst_difference(kind.plan(request), lut, points));
                row.worst_of_levels = row.worst;
            }
    }
    return row;
}

tables::Records to_records(const std::vector<SceneRow>& rows) {
    tables::Column::Texts cases, methods;
    for (const SceneRow& row : rows) {
        cases.push_back(row.scene);
        methods.push_back(row.method);
    }
    tables::Records records{{{"case", std::move(cases)}, {"method", std::move(methods)}}};
    const auto add = [&](std::string name, auto value) {
        add_numbers(records, std::move(name), rows, value);
    };
    add("tables", [](const SceneRow& r) { return static_cast<double>(r.tables); });
    add("bytes", [](const SceneRow& r) { return static_cast<double>(r.bytes); });
    add("seconds", [](const SceneRow& r) { return r.seconds; });
    add("worst_delta_e", [](const SceneRow& r) { return r.worst; });
    add("files_written", [](const SceneRow& r) { return static_cast<double>(r.written); });
    add("worst_delta_e_levels", [](const SceneRow& r) { return r.worst_of_levels; });
    return records;
}

/// Names and files of the scenes given, or of the examples.
std::vector<std::pair<std::string, std::string>> scenes_of(const SceneBenchOptions& options,
                                                           const Workplace& place) {
    std::vector<std::pair<std::string, std::string>> scenes;
    for (const std::string& file : options.scenes)
        scenes.emplace_back(fs::path(file).stem().string(), file);
    if (!scenes.empty()) return scenes;
    fs::create_directories(place / "scenes");
    for (const Document& example : kExamples) {
        const std::string file = place / example.path;
        tables::write_file(file, example.text);
        if (file.find("/scenes/") != std::string::npos)
            scenes.emplace_back(fs::path(file).stem().string(), file);
    }
    return scenes;
}

int run_scene(const SceneBenchOptions& options) {
    resolved_record_format(options.output);
    check_writable(options.output);
    tables::RandomPoints points;
    points.count = parse_whole_number("--count", options.count, 1, kMostScenePoints);
    points.seed = parse_whole_number("--seed", options.seed, 0, kLargestSeed);
    points.threads = options.threads;
    const Workplace place;
    std::vector<SceneRow> rows;
    const auto scenes = scenes_of(options, place);
    StepProgress progress(options.quiet, 4 * scenes.size());
    for (const auto& [name, file] : scenes) {
        progress.begin(name + ", baked");
        if (file == "-") throw UsageError("SCENE: must be a file, as it is baked twice (got -)");
        const schemas::Scene scene = schemas::read_scene(file);
        const std::string folder = place / ("tables-" + std::to_string(rows.size()));
        SceneRow first = baked(name, scene, folder, options);
        progress.begin(name + ", compared");
        points.all_levels = false;
        first.worst = worst_of_bake(scene, folder, execution_of(options.threads), points);
        points.all_levels = true;
        first.worst_of_levels = worst_of_bake(scene, folder, execution_of(options.threads), points);
        progress.begin(name + ", baked again");
        SceneRow second = baked(name, scene, folder, options);
        second.method = "irido again";
        second.worst = first.worst;
        second.worst_of_levels = first.worst_of_levels;
        rows.push_back(first);
        rows.push_back(second);
        progress.begin(name + ", tables of fixed size");
        rows.push_back(fixed(name, scene, options, points));
    }
    progress.clear();
    write_records(to_records(rows), options.output);
    return 0;
}

}  // namespace

void add_bench_scene(CLI::App& bench, Run& run) {
    CLI::App* command = bench.add_subcommand(
        "scene", "Compare the bake of a scene with fixed-size tables of all its colours.");
    const auto options = std::make_shared<SceneBenchOptions>();
    command->add_option("SCENE", options->scenes, "scene files [the built-in examples]");
    command
        ->add_option("-n,--count", options->count,
                     "random points of each table for worst_delta_e, [1, 1e6] [1000]")
        ->type_name("N");
    command
        ->add_option("-s,--seed", options->seed, "point i depends on seed + i only, [0, 2^53] [1]")
        ->type_name("S");
    add_output_options(*command, options->output, record_formats_text());
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet, "no progress");
    set_examples(
        *command, {"irido bench scene", "irido bench scene vehicle.json --count 10000 -f json"},
        "Methods: irido: a bake into an empty folder; irido again: the same bake repeated;\n"
        "fixed 256: colours of every material at 256 samples of cos(theta) from 0 to 1 and\n"
        "256 of the first varied value (16 of the second), for both polarizations and both\n"
        "sides, with all mip levels (counted, not computed), f16.\n"
        "Columns: tables; bytes of their files; seconds including planning and writing (fixed\n"
        "256: without writing); worst_delta_e: CIEDE2000 to the exact colour at random points\n"
        "of the domain that the scene uses, for tables of colours and albedos and for the\n"
        "shading fourier (tables with other measures are left out), at a single thickness;\n"
        "files_written; worst_delta_e_levels: the same including thickness distributions,\n"
        "whose mip levels are coarser and not held to the tolerance (fixed 256 has none).");
    set_run(*command, run, options, run_scene);
}

}  // namespace irido::cli
