#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/commands/table_check.hpp"
#include "cli/exit_status.hpp"
#include "cli/options/command.hpp"
#include "schemas/documents/design_document.hpp"
#include "schemas/documents/document_kind.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/scene_document.hpp"
#include "schemas/documents/surface_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/material_file.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/lut/lut_metadata.hpp"
#include "tables/shaders/scene/bake.hpp"
#include "tables/shaders/scene/manifest.hpp"
#include "tables/shaders/scene/plan_file.hpp"
#include "tables/shaders/scene/scene_problems.hpp"

namespace irido::cli {

namespace {

using nlohmann::json;

struct SchemaText {
    std::string_view name;
    const char* (*text)();
};

constexpr std::array<SchemaText, 7> kSchemas{{{"stack", schemas::stack_schema_text},
                                              {"surface", schemas::surface_schema_text},
                                              {"design", schemas::design_schema_text},
                                              {"scene", schemas::scene_schema_text},
                                              {"plan", tables::plan_schema_text},
                                              {"manifest", tables::manifest_schema_text},
                                              {"lut", tables::lut_schema_text}}};

std::vector<std::string> table_problems(const std::string& text, const std::string& path) {
    std::string of_material;
    try {
        schemas::read_material_file(text, schemas::shown_path(path));
        return {};
    } catch (const schemas::InputError& error) {
        of_material = error.what();
    }
    try {
        if (!check_other_table(text, path)) return {of_material};
    } catch (const schemas::InputError& error) {
        return {error.what()};
    } catch (const DomainError& error) {
        return {error.what()};
    }
    return {};
}

std::vector<std::string> expression_problems(const std::string& expression) {
    try {
        const schemas::StackSource source = schemas::load_stack({expression, {}});
        return schemas::stack_problems(source.document, source.file, source.folder);
    } catch (const schemas::InputError& error) {
        return {error.what()};
    }
}

std::vector<std::string> problems_of(const std::string& path) {
    if (path.find('|') != std::string::npos) return expression_problems(path);
    const std::string text = schemas::read_bytes(path), file = schemas::shown_path(path);
    const std::string folder = std::filesystem::path(path).parent_path().string();
    json document;
    try {
        schemas::require_no_utf16(text, file);
        if (schemas::is_material_file(path)) return table_problems(text, path);
        document = schemas::parse_json(text, file);
    } catch (const schemas::InputError& error) {
        return {error.what()};
    }
    using Kind = schemas::DocumentKind;
    switch (schemas::kind_of(document)) {
        case Kind::surface:
            return schemas::surface_problems(document, file, folder);
        case Kind::design:
            return schemas::design_problems(document, file, folder);
        case Kind::scene:
            return tables::problems_of_scene(document, file, folder, execution_of());
        case Kind::plan:
            return tables::plan_problems(document, file);
        case Kind::manifest:
            return tables::manifest_problems(document, file,
                                             path == "-"      ? ""
                                             : folder.empty() ? "."
                                                              : folder);
        case Kind::stack:
            break;
    }
    return schemas::stack_problems(document, file, folder);
}

int run_validate(const std::vector<std::string>& files) {
    std::string out;
    int status = 0;
    for (const std::string& file : files) {
        try {
            const std::vector<std::string> problems = problems_of(file);
            for (const std::string& line : problems) out += message_line(line) + '\n';
            if (problems.empty()) out += escaped(file) + ": ok\n";
            if (!problems.empty()) status = std::max(status, kCheckFailed);
        } catch (const schemas::InputError& error) {
            print_error(error.what());
            status = kBadInput;
        }
    }
    tables::write_stdout(out);
    return status;
}

std::vector<std::string_view> schema_names() {
    std::vector<std::string_view> names;
    for (const SchemaText& schema : kSchemas) names.push_back(schema.name);
    return names;
}

int print_schema(const std::string& name) {
    const auto found = std::ranges::find(kSchemas, name, &SchemaText::name);
    if (found == kSchemas.end()) throw UsageError("--schema: " + not_one_of(schema_names(), name));
    tables::write_stdout(found->text());
    return 0;
}

}  // namespace

void add_validate_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "validate",
        "Check stacks, surfaces, designs, scenes, plans, manifests and text tables: print every "
        "error, or FILE: ok.");
    const auto files = std::make_shared<std::vector<std::string>>();
    const auto schema = std::make_shared<std::string>();
    CLI::Option* option =
        command
            ->add_option("--schema", *schema,
                         "print a JSON Schema, which explains every key: stack, surface,\n"
                         "design, scene, plan, manifest or lut (the metadata of a table) [stack]")
            ->type_name("[NAME]")
            ->expected(0, 1);
    offer(*command, "schema", schema_names);
    command
        ->add_option("FILE", *files,
                     "stacks, surfaces, designs, scenes, plans or manifests (.json); files of\n"
                     "materials (.csv, .txt, .tsv, .dat, .nk, .mat, .yml); tables of\n"
                     "measurements, films, points, directions and lamps (.csv, .txt, .tsv,\n"
                     ".dat); expressions, or - for JSON on standard input")
        ->excludes(option);
    set_examples(*command, {"irido validate schemas/examples/*.json",
                            "irido validate - < stack.json", "irido validate --schema scene"});
    command->footer(
        command->get_footer() +
        "\n\nScenes are checked as far as is possible without computing their tables; for a\n"
        "manifest, the table files in its folder are read, too.\n\n"
        "Exit status: 0 if all files are valid, 1 if not, 2 if one cannot be read.");
    command->callback([files, schema, option, &run] {
        if (option->count() > 0 || !option->empty()) {
            run = [schema] { return print_schema(schema->empty() ? "stack" : *schema); };
        } else if (files->empty()) {
            throw UsageError("validate: FILE is required (see irido validate --help)");
        } else {
            run = [files] { return run_validate(*files); };
        }
    });
}

}  // namespace irido::cli
