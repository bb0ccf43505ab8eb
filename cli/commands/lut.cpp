#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/commands/lut_brdf.hpp"
#include "cli/exit_status.hpp"
#include "cli/options/color_options.hpp"
#include "cli/options/long_work.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/progress.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/lut/lut_figure.hpp"
#include "tables/lut/lut_file.hpp"
#include "tables/lut/lut_kind.hpp"
#include "tables/lut/lut_maker.hpp"
#include "tables/shaders/shader.hpp"

namespace irido::cli {

namespace {

constexpr double kMostSamples = 8192;
constexpr std::size_t kMostVaried = 2;

/// Options of one kind of table, as typed.
struct LutCommand {
    schemas::StackRequest stack;
    ColorOptions color;
    std::vector<std::string> vary;
    std::map<std::string, std::string, std::less<>> options;  ///< of the kind
    std::map<std::string, bool, std::less<>> flags;
    OutputOptions output;
    PictureOptions picture;
    std::string type, size, tolerance;
    bool any_size = false;
    tables::LutLayout layout;
    unsigned threads = 0;
    bool quiet = false;
};

std::vector<std::string_view> format_names() {
    std::vector<std::string_view> names;
    for (const tables::LutFormat* format : tables::lut_formats()) names.push_back(format->name);
    for (const tables::PictureFormat* format : tables::picture_formats())
        names.push_back(format->name);
    return names;
}

const tables::LutFormat& resolved_lut_format(const OutputOptions& output) {
    const std::string name = resolved_format(output);
    const std::size_t dot = output.file.find_last_of('.');
    const std::string extension = dot == std::string::npos ? "" : output.file.substr(dot + 1);
    if (!output.format.empty() && extension != name && tables::find_lut_format(extension))
        throw UsageError("--format: " + name + " contradicts the extension ." + extension);
    if (const tables::LutFormat* format = tables::find_lut_format(name)) return *format;
    throw UsageError((output.format.empty() ? "--output: the extension " : "--format: ") +
                     not_one_of(format_names(), name));
}

tables::LutType parse_type(std::string_view text) {
    for (const tables::LutType type :
         {tables::LutType::f16, tables::LutType::f32, tables::LutType::f64})
        if (name_of(type) == text) return type;
    throw UsageError("--dtype: must be one of f16, f32, f64 (got '" + std::string(text) + "')");
}

/// "64x512": one number for each axis; one number alone is for all.
std::vector<std::size_t> parse_size(std::string text, std::size_t axes) {
    std::vector<std::size_t> counts;
    if (text.empty()) return counts;
    std::ranges::replace(text, 'x', ',');
    for (const std::string_view part : comma_separated(text))
        counts.push_back(
            static_cast<std::size_t>(parse_whole_number("--size", part, 1, kMostSamples)));
    if (counts.size() == 1) counts.resize(axes, counts.front());
    return counts;
}

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
        report_held_ranges(request.document, *request.sensitivity, false,
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

tables::LutMaking making_of(const tables::LutKind& kind, const LutCommand& command,
                            const tables::LutFormat* format, std::size_t axes) {
    tables::LutMaking making;
    making.sizing.counts = parse_size(command.size, axes);
    making.sizing.power_of_two = !command.any_size;
    if (command.any_size && command.tolerance.empty())
        throw UsageError("--any-size: requires --tolerance");
    if (!command.tolerance.empty()) {
        if (!making.sizing.counts.empty())
            throw UsageError("--tolerance: cannot be combined with --size");
        making.sizing.tolerance = parse_one_number("--tolerance", command.tolerance, 1e-12, 1e3);
    }
    const std::string_view usual = format && format->name == "csv" ? kind.text_type : "f32";
    making.type = parse_type(command.type.empty() ? usual : command.type);
    making.mips = format && format->name == "ktx2" && !command.layout.layers;
    making.measure = !command.output.file.empty();
    making.threads = command.threads;
    return making;
}

void draw_lut(const LutCommand& command, const tables::LutKind& kind,
              const tables::LutRequest& request, const tables::PictureFormat& picture,
              const tables::Lut& lut) {
    const std::string_view summary = kind.summary.substr(0, kind.summary.find_last_not_of('.') + 1);
    const std::string title =
        kind.stack ? title_of(request.document, command.stack) : std::string(summary);
    const auto figure = [&] {
        tables::Figure drawn = tables::lut_figure(lut, title, parse_gamut(command.picture));
        for (const std::string& text : drawn.notes) note(text, command.quiet);
        return drawn;
    };
    write_picture(figure, command.picture, picture, command.output);
}

int run_lut(const tables::LutKind& kind, const LutCommand& command) {
    const tables::PictureFormat* const picture = asked_picture(command.output, command.picture);
    const tables::LutFormat* const format =
        picture ? nullptr : &resolved_lut_format(command.output);
    const tables::LutRequest request = parse(kind, command);
    check_writable(command.output);
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    if (is_slow(kind, request)) say(kSlowNote);
    tables::LutPlan plan = plan_of(kind, request);
    tables::LutMaking making = making_of(kind, command, format, plan.axes.size());
    if (!is_slow(kind, request))
        note_long_work(least_seconds(plan, making), making.sizing.tolerance.has_value(), say);
    Progress progress(command.quiet);
    making.progress = [&progress](double done, const std::string& what) {
        progress.set(done, what);
    };
    tables::Lut lut;
    try {
        lut = tables::make_lut(kind, std::move(plan), making);
    } catch (const ToleranceError& error) {
        progress.clear();
        print_error(error.what());
        return kCheckFailed;
    }
    progress.clear();
    for (const auto& text : lut.facts["notes"]) note(text.get<std::string>(), command.quiet);
    if (picture) {
        draw_lut(command, kind, request, *picture, lut);
        return 0;
    }
    if (command.output.file.empty()) {
        const std::vector<tables::LutFile> files = format->write(lut, command.layout);
        const auto table = std::ranges::find(files, std::string(), &tables::LutFile::suffix);
        write_bytes(table->bytes, command.output, format->is_binary);
    } else {
        tables::write_lut(lut, command.output.file, *format, command.layout);
    }
    if (command.layout.layers)
        note("three.js reads only the first array layer of a file", command.quiet);
    if (format->name == "ktx2" || format->name == "exr")
        for (const tables::LutAxis& axis : lut.axes)
            if (!axis.is_linear() && axis.half_at == 0 && !(lut.mips && &axis == &lut.axes.front()))
                note(axis.name + ": samples are not equally spaced: fetch texels, do not filter",
                     command.quiet);
    return 0;
}

std::string formats_text() {
    std::string text;
    for (const std::string_view name : format_names())
        text.append(text.empty() ? "" : ", ").append(name);
    return text + " [csv]; pictures are for\nlooking only";
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
    if (kind.space) typed->color.space = "xyz";
    if (kind.color || kind.space) add_space_options(*command, typed->color);
    command
        ->add_option("--dtype", typed->type,
                     kind.text_type == "f32" ? "number format: f16, f32 or f64 [f32]"
                                             : "number format: f16, f32 or f64 [f32; csv: f64]")
        ->type_name("NAME");
    offer(*command, "dtype", "f16 f32 f64");
    command
        ->add_option("--size", typed->size,
                     "samples per axis, [1, 8192]: 64x512, in the order of the axes, or one\n"
                     "number for all [as many as the axes' lists have]")
        ->type_name("SIZE");
    command
        ->add_option("--tolerance", typed->tolerance,
                     "choose the smallest size with this interpolation error (in CIEDE2000\n"
                     "for colours, else as defined below); an axis along which the table\n"
                     "is constant gets one sample. Exit status 1 if it cannot be met")
        ->type_name("E");
    command->add_flag("--any-size", typed->any_size,
                      "with --tolerance: allow sizes other than powers of two");
    static const std::string formats = formats_text();
    add_output_options(*command, typed->output, formats);
    if (kind.color) add_picture_options(*command, typed->picture);
    command->add_flag("--zstd", typed->layout.zstd, "ktx2: compress with Zstandard");
    command->add_flag("--layers", typed->layout.layers,
                      "ktx2: store a third axis as array layers, not as depth or mip levels");
    add_threads_option(*command, typed->threads);
    command->add_flag("--quiet", typed->quiet, "no notes on standard error");
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
    for (const tables::LutKind* kind : tables::lut_kinds()) {
        names.emplace_back(kind->name);
        axes.emplace_back(kind->axes);
        summaries.emplace_back(kind->summary);
    }
    write_records({{{"kind", names}, {"axes", axes}, {"summary", summaries}}}, output);
    return 0;
}

void add_list(CLI::App& lut, Run& run) {
    CLI::App* command = lut.add_subcommand("list", "List the kinds of tables.");
    const auto output = std::make_shared<OutputOptions>();
    add_output_options(*command, *output, "csv or json [csv]");
    set_examples(*command, {"irido lut list", "irido lut list -f json"});
    command->callback([output, &run] { run = [output] { return list_kinds(*output); }; });
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
        if (!kind && lut.kind != "layered")
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
    info->callback([file, &run] { run = [file] { return show_info(*file); }; });
}

void add_check(CLI::App& lut, Run& run) {
    CLI::App* check = lut.add_subcommand(
        "check", "Verify a table's checksum, its numbers and the invariants of its kind.");
    const auto files = std::make_shared<std::vector<std::string>>();
    check->add_option("FILE", *files, "files that irido lut wrote")->required();
    set_examples(*check, {"irido lut check film.ktx2", "irido lut check baked/*.exr"},
                 "Prints FILE: ok, or every problem, with exit status 1.");
    check->callback([files, &run] { run = [files] { return check_files(*files); }; });
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
    shader
        ->add_option("--language", typed->language,
                     "glsl, hlsl or, for scratch and scratch-nodes, wgsl [glsl]")
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
            const auto written = tables::shader_names_in(typed->language);
            if (std::ranges::find(written, typed->name) == written.end())
                throw UsageError("NAME: in " + typed->language + " " +
                                 not_one_of(written, typed->name));
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
    add_lut_brdf(*lut, run);
    add_lut_layered(*lut, run);
    add_list(*lut, run);
    add_info(*lut, run);
    add_check(*lut, run);
    add_shader(*lut, run);
    set_examples(*lut, {"irido lut color \"air | 1.33@400 | 1.9+1.5i\" --vary "
                        "layers.0.thickness_nm=0:1000/512 --dtype f16 -o film.ktx2",
                        "irido lut falpha --alpha 0.1 -o falpha.exr", "irido lut KIND --help"});
}

}  // namespace irido::cli
