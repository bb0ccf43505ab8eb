#include "cli/options/design_options.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "cli/options/color_options.hpp"
#include "schemas/documents/document_kind.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/number_list.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/files/atomic_file.hpp"

namespace irido::cli {

namespace {

using nlohmann::json;

double number_of(const std::string& option, const std::string& text, std::string_view part) {
    const auto value = schemas::parse_number(schemas::trimmed(part));
    if (!value)
        throw UsageError(option + " '" + text + "': '" + std::string(part) + "' is not a number");
    return *value;
}

/// The words of a text, separated by blanks.
std::vector<std::string> words_between_blanks(std::string_view text) {
    std::vector<std::string> words{""};
    for (const char c : text) {
        if (c != ' ' && c != '\t') {
            words.back() += c;
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

std::vector<double> list_of(const std::string& text, std::string_view part) {
    try {
        return schemas::read_number_list(part);
    } catch (const schemas::InputError& error) {
        throw UsageError("--target '" + text + "': " + error.message);
    }
}

json value_of_target(const std::string& text, const std::string& quantity, std::string_view value) {
    value = schemas::trimmed(value);
    if (quantity == "hex") return std::string(value);
    const std::vector<double> numbers = list_of(text, value);
    if (numbers.size() == 1) return numbers.front();
    return numbers;
}

json typed_or_file(const TaskOptions& options) {
    if (!options.refine.empty() && !options.task.empty())
        throw UsageError("--refine STACK replaces TASK: give one of them");
    const std::string& path = options.refine.empty() ? options.task : options.refine;
    if (path.empty()) throw UsageError("TASK is required, or --refine STACK (see --help)");
    if (path.find('|') != std::string::npos) return json{{"stack", path}};
    json document = schemas::parse_json(schemas::read_text(path), schemas::shown_path(path));
    if (schemas::kind_of(document) == schemas::DocumentKind::design) return document;
    if (const std::string other = schemas::other_kind(document, schemas::DocumentKind::stack);
        !other.empty())
        throw schemas::InputError(schemas::shown_path(path), "", other);
    return json{{"stack", std::move(document)}};
}

}  // namespace

void add_task_options(CLI::App& command, TaskOptions& options) {
    command.add_option("TASK", options.task,
                       "a design task (.json, see irido validate --schema design), or a\n"
                       "stack with --free and --target, or - for standard input");
    command
        .add_option("--refine", options.refine,
                    "refine this stack, instead of TASK: --method refine")
        ->type_name("STACK");
    command
        .add_option("--free", options.free,
                    "what may move, repeatable; * stands for all that fit:\n"
                    "layers.*.thickness_nm=5:300")
        ->type_name("PATH[=LO:HI]")
        ->take_all();
    command
        .add_option("--target", options.targets,
                    "QUANTITY [WAVELENGTHS] [@ANGLES] [s|p|u] = | >= | <= VALUE,\n"
                    "repeatable: \"R 400:700:5 @0,45 = 0\", \"T 500:600 s >= 0.9\",\n"
                    "\"lab @0 = 60,-15,-20\", \"hex = #ff8800\"")
        ->type_name("TARGET")
        ->take_all();
    command.add_option("--merit", options.merit, "rms, mean_abs, chi2, delta_e_76 or delta_e_2000")
        ->type_name("NAME");
    offer(command, "merit", "rms mean_abs chi2 delta_e_76 delta_e_2000");
    command.add_option("--method", options.method, "refine, global or, for design, needle")
        ->type_name("NAME");
    offer(command, "method", "refine global needle");
    command
        .add_option("--seed", options.seed,
                    "of a global search, [0, 2^53]: the same seed and evaluations give\n"
                    "the same bytes [1]")
        ->type_name("N");
    command
        .add_option("--evaluations", options.evaluations,
                    "evaluations of the merit that a search may take, [1, 1e12]\n"
                    "[300000]")
        ->type_name("N");
    command
        .add_option("--time", options.time,
                    "seconds after which a search ends with the best so far")
        ->type_name("S");
    add_strict_option(command, options.strict);
}

void add_needle_options(CLI::App& command, TaskOptions& options) {
    command
        .add_option("--materials", options.materials,
                    "needle: materials to choose from, with commas: SiO2,TiO2")
        ->type_name("MATERIALS");
    command
        .add_option("--max-layers", options.max_layers,
                    "needle: most layers that are not fixed, [1, 500] [20]")
        ->type_name("N");
    command
        .add_option("--min-thickness", options.min_thickness,
                    "needle: thinner layers vanish, nm, [0, 1e4] [2]")
        ->type_name("NM");
}

json parse_free(const std::string& text) {
    const std::size_t equals = text.find('=');
    json free{{"path", text.substr(0, equals)}};
    if (equals == std::string::npos) return free;
    const std::string bounds = text.substr(equals + 1);
    const std::size_t colon = bounds.find(':');
    if (colon == std::string::npos)
        throw UsageError("--free '" + text + "': must be PATH or PATH=LO:HI");
    free["bounds"] = {number_of("--free", text, std::string_view(bounds).substr(0, colon)),
                      number_of("--free", text, std::string_view(bounds).substr(colon + 1))};
    return free;
}

json parse_target(const std::string& text) {
    constexpr std::array<std::pair<std::string_view, const char*>, 3> kSides{
        {{">=", "ge"}, {"<=", "le"}, {"=", "eq"}}};
    std::size_t at = std::string::npos;
    json target;
    std::string value;
    for (const auto& [sign, side] : kSides) {
        at = text.find(sign);
        if (at == std::string::npos) continue;
        target["side"] = side;
        value = text.substr(at + sign.size());
        break;
    }
    const std::vector<std::string> words =
        words_between_blanks(std::string_view(text).substr(0, std::min(at, text.size())));
    if (at == std::string::npos || words.empty())
        throw UsageError("--target '" + text +
                         "': must be QUANTITY [WAVELENGTHS] [@ANGLES] [s|p|u] = VALUE");
    target["quantity"] = words[0];
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word[0] == '@') {
            target["angles_deg"] = list_of(text, std::string_view(word).substr(1));
        } else if (word.find_first_not_of("spu,") == std::string::npos) {
            target["polarization"] = word;
        } else {
            target["wavelengths_nm"] = list_of(text, word);
        }
    }
    target["target"] = value_of_target(text, words[0], value);
    return target;
}

schemas::DesignTask read_task(const TaskOptions& options) {
    json document = typed_or_file(options);
    const std::string& path = options.refine.empty() ? options.task : options.refine;
    const bool is_expression = path.find('|') != std::string::npos;
    if (!options.refine.empty()) {
        document["method"] = "refine";
        if (options.free.empty() && !document.contains("free"))
            document["free"] = {parse_free("layers.*.thickness_nm")};
    }
    const auto fill = [&](const char* key, const std::vector<std::string>& texts, auto parse) {
        if (texts.empty()) return;
        document[key] = json::array();
        for (const std::string& text : texts) document[key].push_back(parse(text));
    };
    fill("free", options.free, parse_free);
    fill("targets", options.targets, parse_target);
    if (!options.method.empty()) document["method"] = options.method;
    if (!options.merit.empty()) document["merit"] = options.merit;
    if (!options.seed.empty())
        document["seed"] = parse_one_number("--seed", options.seed, 0, 0x1p53);
    if (!options.evaluations.empty())
        document["evaluations"] = parse_one_number("--evaluations", options.evaluations, 1, 1e12);
    if (!options.time.empty())
        document["time_s"] = parse_one_number("--time", options.time, 1e-3, 1e7);
    if (!options.materials.empty()) {
        document["materials"] = json::array();
        for (const std::string_view one : schemas::split_values(options.materials))
            document["materials"].push_back(schemas::value_from_text("material", one));
    }
    if (!options.max_layers.empty())
        document["max_layers"] = parse_one_number("--max-layers", options.max_layers, 1, 500);
    if (!options.min_thickness.empty())
        document["min_thickness_nm"] =
            parse_one_number("--min-thickness", options.min_thickness, 0, 1e4);
    const std::string file = is_expression ? "\"" + path + "\"" : schemas::shown_path(path);
    if (!document.contains("free"))
        throw schemas::InputError(file, "", "must have the key \"free\", or come with --free");
    if (!document.contains("targets"))
        throw schemas::InputError(file, "", "must have the key \"targets\", or come with --target");
    return schemas::read_design(
        document, file, is_expression ? "" : std::filesystem::path(path).parent_path().string());
}

void check_result_files(const OutputOptions& stack, const std::string& report,
                        const std::optional<std::string>& plot) {
    const std::string extension = std::filesystem::path(stack.file).extension().string();
    if (!is_nameless(stack) && !extension.empty() && extension != ".json")
        throw UsageError("--output: a stack is written as .json (got " +
                         schemas::in_quotes(stack.file) + ")");
    check_writable(stack);
    check_plot(plot, stack);
    std::vector<std::string> files;
    for (const std::string& file : {stack.file, report, plot.value_or("")})
        if (!file.empty()) files.push_back(file);
    tables::check_outputs(files);
    if (report.empty()) return;
    if (std::filesystem::path(report).extension().empty())
        throw UsageError("--report: must have an extension that names the format (got " +
                         schemas::in_quotes(report) + ")");
    resolved_record_format({report, "", "--report"});
}

void note_task(const schemas::DesignTask& task, bool strict, bool quiet) {
    for (const std::string& text : task.notes) note(task.file + ": " + text, quiet);
    schemas::StackDocument document;
    document.stack = task.problem.stack;
    document.file = task.file;
    document.material_pointers.assign(document.stack.materials.size(), "/stack");
    std::set<std::string> said;
    for (const DesignTarget& target : task.problem.targets) {
        if (target.quantity != DesignQuantity::lab) continue;
        report_held_ranges(
            document, Sensitivity(observer(target.light.observer_deg), target.light.illuminant),
            strict, [&](const std::string& text) {
                if (said.insert(text).second) note(text, quiet);
            });
    }
}

}  // namespace irido::cli
