#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/commands/surface_table.hpp"
#include "cli/exit_status.hpp"
#include "cli/options/color_options.hpp"
#include "cli/options/long_work.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/table_options.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/lut/lut_file.hpp"
#include "tables/lut/lut_kind.hpp"
#include "tables/shaders/shader.hpp"

namespace irido::cli {

namespace {

constexpr std::size_t kMostVaried = 2;

/// Options of one kind of table, as given on the command line.
struct LutCommand : TableOutput {
    schemas::StackRequest stack;
    ColorOptions color;
    std::vector<std::string> vary;
    std::map<std::string, std::string, std::less<>> options;  ///< those of the kind
    std::map<std::string, bool, std::less<>> flags;
};

void parse_option(const tables::LutOption& option, const std::string& text,
                  tables::LutOptions& values) {
    const std::string typed = "--" + std::string(option.name), name(option.name);
    if (option.type == tables::LutOption::Type::list) {
        values[name] = parse_list(typed, text, option.lowest, option.highest);
    } else if (option.type == tables::LutOption::Type::number) {
        values[name] = parse_one_number(typed, text, option.lowest, option.highest);
    } else if (option.type == tables::LutOption::Type::whole) {
        values[name] =
            static_cast<double>(parse_whole_number(typed, text, option.lowest, option.highest));
    } else if (option.type == tables::LutOption::Type::range) {
        const auto [low, high] = parse_range(typed, text, option.lowest, option.highest);
        values[name] = std::vector{low, high};
    } else {
        if (std::ranges::find(option.words, text) == option.words.end())
            throw UsageError(typed + ": " + not_one_of(option.words, text));
        values[name] = text;
    }
}

tables::LutOptions parse_options(const tables::LutKind& kind, const LutCommand& command) {
    tables::LutOptions values;
    for (const tables::LutOption& option : kind.options) {
        if (option.type == tables::LutOption::Type::flag) {
            const auto flag = command.flags.find(option.name);
            if (flag != command.flags.end() && flag->second)
                values[std::string(option.name)] = std::string("true");
            continue;
        }
        const std::string& text = command.options.find(option.name)->second;
        if (option.name == "theta" && !text.empty() && !command.options.find("cos")->second.empty())
            throw UsageError("--theta: cannot be combined with --cos");
        const std::string used = text.empty() ? std::string(option.fallback) : text;
        if (!used.empty()) parse_option(option, used, values);
    }
    return values;
}

tables::VariedValue parse_vary(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError(
            "--vary: must be PATH=LIST, as in layers.0.thickness_nm=0:1000/256 (got '" + text +
            "')");
    const std::string path = text.substr(0, equals);
    std::vector<double> values = parse_list("--vary " + path, text.substr(equals + 1), -1e9, 1e9);
    if (!std::ranges::is_sorted(values, std::ranges::less_equal()))
        throw UsageError("--vary " + path + ": values must ascend");
    return {path, std::move(values)};
}

nlohmann::json name_or_rows(const std::string& typed, const Table& illuminant) {
    if (std::ranges::find(illuminant_names(), typed) != illuminant_names().end()) return typed;
    nlohmann::json rows = nlohmann::json::array();
    for (std::size_t i = 0; i < illuminant.value.size(); ++i)
        rows.push_back({illuminant.wavelength_nm[i], illuminant.value[i]});
    return {{"table", std::move(rows)}};
}

void parse_color(const tables::LutKind& kind, const LutCommand& command,
                 tables::LutRequest& request) {
    const ColorOptions& typed = command.color;
    if (kind.light) {
        request.observer = typed.observer;
        const Table light = parse_illuminant(typed.illuminant);
        request.illuminant = name_or_rows(typed.illuminant, light);
        request.sensitivity = std::make_shared<Sensitivity>(parse_observer(typed.observer), light);
    }
    if (kind.color || kind.space) {
        request.space = &parse_space(typed.space);
        request.adaptation = parse_adaptation(typed.adaptation);
    }
    if (!kind.color) return;
    request.color.sides = parse_sides(typed.sides);
    if (request.color.sides.size() != 1)
        throw UsageError("--side: must be R or T for a table (got '" + typed.sides + "')");
    request.color.light = parse_light(typed.polarization);
    request.color.simd = request.execution.simd;
}

tables::LutRequest parse(const tables::LutKind& kind, const LutCommand& command) {
    tables::LutRequest request;
    request.execution = execution_of(command.threads);
    request.options = parse_options(kind, command);
    parse_color(kind, command, request);
    for (const std::string& text : command.vary) request.vary.push_back(parse_vary(text));
    if (request.vary.size() > kMostVaried) throw UsageError("--vary: must be given at most twice");
    if (!kind.stack) return request;
    request.source = schemas::load_stack(command.stack);
    for (const tables::VariedValue& vary : request.vary)
        schemas::set_value(request.source.document, vary.path, vary.values.front());
    request.document = schemas::read_source(request.source);
    for (const std::string& text : request.document.notes) note(text, command.quiet);
    if (kind.light)
        report_held_ranges(request.document, *request.sensitivity, command.color.strict,
                           [&](const std::string& text) { note(text, command.quiet); });
    return request;
}

tables::LutPlan plan_of(const tables::LutKind& kind, const tables::LutRequest& request) {
    try {
        return kind.plan(request);
    } catch (const DomainError& error) {
        throw schemas::InputError(kind.stack ? request.document.file : std::string(kind.name), "",
                                  error.what());
    }
}

int run_lut(const tables::LutKind& kind, const LutCommand& command) {
    const OutputOptions& output = command.output;
    if (!asked_picture(output, command.picture)) resolved_lut_format(output);
    const tables::LutRequest request = parse(kind, command);
    check_writable(output);
    const bool slow = is_slow(kind, request);
    if (slow) note(kSlowNote, command.quiet);
    const std::string_view summary = kind.summary.substr(0, kind.summary.find_last_not_of('.') + 1);
    std::vector<std::string> varied;
    for (const tables::VariedValue& vary : request.vary) varied.push_back(vary.path);
    const std::string title =
        kind.stack ? title_of(request.document, command.stack, varied) : std::string(summary);
    return make_table(kind, plan_of(kind, request), command, title, !slow);
}

void add_kind_options(CLI::App& command, const tables::LutKind& kind, LutCommand& typed) {
    for (const tables::LutOption& option : kind.options) {
        const std::string name(option.name);
        const std::string spelled =
            (option.letter ? std::string("-") + option.letter + "," : "") + "--" + name;
        if (option.type == tables::LutOption::Type::flag) {
            command.add_flag(spelled, typed.flags[name], std::string(option.help));
            continue;
        }
        constexpr std::array<const char*, 5> types{"LIST", "NUMBER", "N", "NAME", "LO:HI"};
        command.add_option(spelled, typed.options[name], std::string(option.help))
            ->type_name(types[static_cast<std::size_t>(option.type)]);
        if (!option.words.empty())
            offer(command, option.name, [&option] { return std::span(option.words); });
    }
}

void add_lut_kind(CLI::App& lut, const tables::LutKind& kind, Run& run) {
    CLI::App* command = lut.add_subcommand(std::string(kind.name), std::string(kind.summary));
    const auto typed = std::make_shared<LutCommand>();
    if (kind.stack) add_stack_options(*command, typed->stack);
    if (kind.vary)
        command
            ->add_option("--vary", typed->vary,
                         "vary a number of the stack, by dotted path; at most twice:\n"
                         "layers.0.thickness_nm=0:1000/256")
            ->type_name("PATH=LIST")
            ->allow_extra_args(false);
    add_kind_options(*command, kind, *typed);
    if (kind.color)
        add_side_options(*command, typed->color,
                         kind.name == "albedo"
                             ? "R (reflected), the only side that this table has [R]"
                             : "R (reflected) or T (transmitted) [R]");
    if (kind.color) offer(*command, "side", kind.name == "albedo" ? "R" : "R T");
    if (kind.light) add_light_options(*command, typed->color);
    if (kind.light && kind.stack) add_strict_option(*command, typed->color.strict);
    if (kind.space) typed->color.space = "xyz";
    if (kind.color || kind.space) add_space_options(*command, typed->color);
    add_table_size_options(*command, typed->table,
                           kind.text_type == "f32" ? "[f32]" : "[f32; csv: f64]");
    add_output_options(*command, typed->output, table_formats_text());
    if (kind.color) add_picture_options(*command, typed->picture);
    add_table_layout_options(*command, typed->table);
    add_threads_option(*command, typed->threads);
    add_quiet_option(*command, typed->quiet);
    std::vector<std::string> examples;
    for (const std::string_view example : kind.examples)
        examples.push_back("irido lut " + std::string(example));
    set_examples(*command, examples,
                 "Axes: " + std::string(kind.axes) + ".\n" + std::string(kind.notes));
    command->callback(
        [&kind, typed, &run] { run = [&kind, typed] { return run_lut(kind, *typed); }; });
}

int list_kinds(const OutputOptions& output) {
    tables::Column::Texts names, axes, summaries;
    const auto add = [&](const auto& kind) {
        names.emplace_back(kind.name);
        axes.emplace_back(kind.axes);
        summaries.emplace_back(kind.summary);
    };
    for (const tables::LutKind* kind : tables::lut_kinds()) add(*kind);
    for (const SurfaceTableKind* kind : surface_table_kinds()) add(*kind);
    write_records({{{"kind", names}, {"axes", axes}, {"summary", summaries}}}, output);
    return 0;
}

void add_list(CLI::App& lut, Run& run) {
    CLI::App* command = lut.add_subcommand("list", "List the kinds of tables.");
    const auto output = std::make_shared<OutputOptions>();
    add_output_options(*command, *output, "csv or json [csv]");
    set_examples(*command, {"irido lut list", "irido lut list -f json"});
    set_run(*command, run, output, list_kinds);
}

int show_info(const std::string& file) {
    const tables::Lut lut = tables::read_lut(file);
    tables::write_stdout(tables::metadata_of(lut).dump(2) + "\n");
    return 0;
}

/// The problems of a file, one line each.
std::vector<std::string> problems_of_table(const std::string& file) {
    try {
        const tables::Lut lut = tables::read_lut(file);
        std::vector<std::string> problems = tables::lut_problems(lut);
        const tables::LutKind* const kind = tables::find_lut_kind(lut.kind);
        const bool is_of_surface = std::ranges::any_of(
            surface_table_kinds(), [&](const auto* one) { return one->name == lut.kind; });
        if (!kind && !is_of_surface)
            problems.push_back("unknown kind '" + lut.kind + "'");
        else if (kind && problems.empty() && kind->problems)
            problems = kind->problems(lut);
        return problems;
    } catch (const tables::LutError& error) {
        const std::string text = error.what(), name = file + ": ";
        return {text.starts_with(name) ? text.substr(name.size()) : text};
    } catch (const nlohmann::json::exception&) {
        return {"the metadata lacks keys that its kind requires"};
    }
}

int check_files(const std::vector<std::string>& files) {
    int status = 0;
    std::string text;
    for (const std::string& file : files) {
        try {
            const std::vector<std::string> problems = problems_of_table(file);
            if (problems.empty()) text += escaped(file) + ": ok\n";
            for (const std::string& problem : problems)
                text += message_line(file + ": " + problem) + "\n";
            if (!problems.empty()) status = std::max(status, kCheckFailed);
        } catch (const schemas::InputError& error) {
            print_error(error.what());
            status = kBadInput;
        }
    }
    tables::write_stdout(text);
    return status;
}

void add_info(CLI::App& lut, Run& run) {
    CLI::App* info = lut.add_subcommand("info", "Print the metadata of a table file as JSON.");
    const auto file = std::make_shared<std::string>();
    info->add_option("FILE", *file, "a file that irido lut wrote")->required();
    set_examples(*info, {"irido lut info film.ktx2", "irido lut info film.exr | jq .error"});
    set_run(*info, run, file, show_info);
}

void add_check(CLI::App& lut, Run& run) {
    CLI::App* check = lut.add_subcommand(
        "check", "Verify a table's checksum, its numbers and the invariants of its kind.");
    const auto files = std::make_shared<std::vector<std::string>>();
    check->add_option("FILE", *files, "files that irido lut wrote")->required();
    set_examples(*check, {"irido lut check film.ktx2", "irido lut check baked/*.exr"},
                 "Prints FILE: ok, or every problem, with exit status 1.");
    set_run(*check, run, files, check_files);
}

void add_shader(CLI::App& lut, Run& run) {
    struct Typed {
        std::string name, language = "glsl";
    };
    CLI::App* shader = lut.add_subcommand("shader", "Print shader code that reads a table.");
    const auto typed = std::make_shared<Typed>();
    std::string names;
    for (const std::string_view name : tables::shader_names())
        names += (names.empty() ? "" : ", ") + std::string(name);
    shader->add_option("NAME", typed->name, "one of " + names)->required();
    shader->add_option("--language", typed->language, "glsl, hlsl or wgsl [glsl]")
        ->type_name("NAME");
    offer(*shader, "NAME", tables::shader_names);
    offer(*shader, "language", tables::shader_languages);
    set_examples(*shader,
                 {"irido lut shader color > color.glsl",
                  "irido lut shader --language hlsl falpha-closed > falpha.hlsl"},
                 "The code is licensed under MIT-0: paste it anywhere. bragg, falpha-closed and\n"
                 "fourier evaluate closed forms; the others look up the table of their name.");
    shader->callback([typed, &run] {
        run = [typed] {
            const auto known = tables::shader_names(), languages = tables::shader_languages();
            if (std::ranges::find(known, typed->name) == known.end())
                throw UsageError("NAME: " + not_one_of(known, typed->name));
            if (std::ranges::find(languages, typed->language) == languages.end())
                throw UsageError("--language: " + not_one_of(languages, typed->language));
            tables::write_stdout(tables::shader_source(typed->name, typed->language));
            return 0;
        };
    });
}

}  // namespace

void add_lut_command(CLI::App& program, Run& run) {
    CLI::App* lut = program.add_subcommand("lut", "Look-up tables for shaders and renderers.");
    lut->require_subcommand(1);
    for (const tables::LutKind* kind : tables::lut_kinds()) add_lut_kind(*lut, *kind, run);
    for (const SurfaceTableKind* kind : surface_table_kinds())
        kind->add(*lut->add_subcommand(std::string(kind->name), std::string(kind->summary)), run);
    add_list(*lut, run);
    add_info(*lut, run);
    add_check(*lut, run);
    add_shader(*lut, run);
    set_examples(*lut, {"irido lut color \"air | 1.33@400 | 1.9+1.5i\" --vary "
                        "layers.0.thickness_nm=0:1000/512 --dtype f16 -o film.ktx2",
                        "irido lut falpha --alpha 0.1 -o falpha.exr", "irido lut KIND --help"});
}

}  // namespace irido::cli
