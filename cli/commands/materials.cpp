#include <algorithm>
#include <memory>

#include "cli/options/command.hpp"
#include "core/error.hpp"
#include "core/material/library.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/material_file.hpp"
#include "schemas/readers/nearest.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::cli {

namespace {

constexpr WavelengthRange kVisible{380, 780};

struct MaterialsOptions {
    std::string name;
    std::string wavelengths;
    OutputOptions output;
    bool quiet = false;
};

LibraryMaterial material_named(std::string_view name) {
    if (auto found = find_material(name)) return *std::move(found);
    throw UsageError("unknown material '" + std::string(name) + "'" +
                     schemas::did_you_mean(name, library_names_and_aliases()) +
                     "; see irido materials list");
}

int run_list(const MaterialsOptions& options) {
    tables::Column::Texts name, alias, source;
    tables::Column::Numbers first, last;
    tables::Column::Flags visible;
    for (const std::string_view entry : library_names()) {
        const LibraryMaterial found = material_named(entry);
        const WavelengthRange range = range_of(found.material);
        name.emplace_back(entry);
        alias.push_back(joined(found.aliases, " "));
        first.push_back(range.first_nm);
        last.push_back(range.last_nm);
        visible.push_back(range.first_nm <= kVisible.first_nm && range.last_nm >= kVisible.last_nm);
        source.push_back(found.source);
    }
    write_records({{{"name", name},
                    {"aliases", alias},
                    {"first_nm", first},
                    {"last_nm", last},
                    {"covers_380_780", visible},
                    {"source", source}}},
                  options.output);
    return 0;
}

/// The wavelengths typed; by default every nm from 380 to 780 within the material's range or, if
/// there are none, a hundred steps over that range.
std::vector<double> wavelengths_of(const MaterialsOptions& options, WavelengthRange range) {
    if (!options.wavelengths.empty())
        return parse_list("--wavelengths", options.wavelengths, kAllWavelengths.first_nm,
                          kAllWavelengths.last_nm);
    std::vector<double> values = parse_list("--wavelengths", "380:780:1", 1, 1e7);
    std::erase_if(values, [&](double v) { return v < range.first_nm || v > range.last_nm; });
    constexpr int kSteps = 100;
    if (values.empty() && range.first_nm == range.last_nm) return {range.first_nm};
    for (int i = 0; values.size() <= static_cast<std::size_t>(i) && i <= kSteps; ++i)
        values.push_back(range.first_nm + (range.last_nm - range.first_nm) * i / kSteps);
    return values;
}

/// A built-in material, or one read from a file.
schemas::MaterialFile shown_material(const std::string& name) {
    if (auto found = find_material(name))
        return {std::move(found->material), {}, std::move(found->source)};
    if (name == "-" || schemas::is_material_file(name))
        return schemas::read_material_file(schemas::read_text(name), schemas::shown_path(name));
    throw UsageError(
        "unknown material '" + name + "'" +
        schemas::did_you_mean(name, library_names_and_aliases()) +
        "; see irido materials list; material files end in .csv, .txt, .tsv, .dat, .nk, .mat, "
        ".yml or .yaml");
}

int run_show(const MaterialsOptions& options) {
    const schemas::MaterialFile shown = shown_material(options.name);
    const WavelengthRange range = range_of(shown.material);
    tables::Column::Numbers wavelength, n, k;
    for (const double nm : wavelengths_of(options, range)) {
        const Complex index = index_at(shown.material, nm);
        wavelength.push_back(nm);
        n.push_back(index.real());
        k.push_back(index.imag());
    }
    std::string lowest, highest;
    tables::append_number(lowest, range.first_nm);
    tables::append_number(highest, range.last_nm);
    note(shown.material.name + ", " + lowest + " to " + highest + " nm" +
             (shown.source.empty() ? "" : ": " + shown.source),
         options.quiet);
    for (const std::string& text : shown.notes)
        note(shown.material.name + ": " + text, options.quiet);
    write_records({{{"wavelength_nm", wavelength}, {"n", n}, {"k", k}}}, options.output);
    return 0;
}

void add_show(CLI::App& materials, const std::shared_ptr<MaterialsOptions>& options, Run& run) {
    CLI::App* show = materials.add_subcommand(
        "show", "Print n and k of a built-in material or a material file.");
    show->add_option("NAME", options->name,
                     "a built-in material (see irido materials list), a material file\n"
                     "(.csv, .txt, .tsv, .dat, .nk, .mat, .yml), or - for standard input")
        ->required();
    show->add_option("-w,--wavelengths", options->wavelengths,
                     "vacuum wavelengths, nm [380:780:1, within the material's range]")
        ->type_name("LIST");
    offer(*show, "NAME", library_names_and_aliases, OfferedWords::Use::one_or_file);
    add_output_options(*show, options->output, record_formats_text());
    show->add_flag("--quiet", options->quiet, "no source, range or notes on standard error");
    set_examples(*show, {"irido materials show Au -w 400:800:100",
                         "irido materials show water -w 589.3 -f json",
                         "irido materials show schemas/examples/materials/N-BK7.yml"});
    show->callback([options, &run] { run = [options] { return run_show(*options); }; });
}

}  // namespace

void add_materials_command(CLI::App& program, Run& run) {
    CLI::App* command =
        program.add_subcommand("materials", "The built-in materials, with source and valid range.");
    command->require_subcommand(1);
    const auto options = std::make_shared<MaterialsOptions>();
    CLI::App* list = command->add_subcommand(
        "list", "List names, ranges in nm, whether 380 to 780 nm is covered, and sources.");
    add_output_options(*list, options->output, record_formats_text());
    set_examples(*list, {"irido materials list", "irido materials list -f json"});
    list->callback([options, &run] { run = [options] { return run_list(*options); }; });
    add_show(*command, options, run);
    set_examples(*command, {"irido materials list", "irido materials show Au -w 400:800:100"});
}

}  // namespace irido::cli
