#include "schemas/documents/design_document.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.hpp"
#include "schemas/documents/design_parts.hpp"
#include "schemas/documents/inner_stack.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

constexpr std::array<std::pair<std::string_view, MeritKind>, 5> kMerits{
    {{"rms", MeritKind::rms},
     {"mean_abs", MeritKind::mean_abs},
     {"chi2", MeritKind::chi2},
     {"delta_e_76", MeritKind::delta_e_76},
     {"delta_e_2000", MeritKind::delta_e_2000}}};

std::vector<Problem> broken_design_rules(const json& document) {
    static const Schema schema(json::parse(design_schema_text()));
    return check(schema, document);
}

/// The task's stack. Needle materials are registered by reading it with one extra layer of each;
/// these layers are then removed.
StackDocument read_stack_of(const json& document, const std::string& file, DesignTask& task) {
    StackSource source = task.source;
    if (document.contains("materials"))
        task.material_documents = document["materials"].get<std::vector<json>>();
    for (const json& material : task.material_documents)
        source.document["layers"].push_back({{"material", material}, {"thickness_nm", 0}});
    try {
        StackDocument stack = read_source(source);
        for (std::size_t i = 0; i < task.material_documents.size(); ++i) {
            const Element& last = stack.stack.elements.back();
            task.materials.insert(task.materials.begin(), std::get<Layer>(last.value).material);
            stack.stack.elements.pop_back();
        }
        return stack;
    } catch (const InputError& error) {
        if (error.file != "/stack") throw;
        throw InputError(file, "/stack" + error.where, error.message);
    }
}

DesignTask read_checked(const json& document, const std::string& file, const std::string& folder) {
    DesignTask task;
    task.file = file;
    task.name = document.value("name", "");
    task.method = document.value("method", task.method);
    task.has_method = document.contains("method");
    task.seed = static_cast<std::uint64_t>(document.value("seed", 1.0));
    if (document.contains("time_s")) task.time_s = document["time_s"].get<double>();
    if (document.contains("evaluations"))
        task.evaluations = static_cast<std::size_t>(document["evaluations"].get<double>());
    task.has_merit = document.contains("merit");
    if (task.has_merit) {
        const std::string name = document["merit"].get<std::string>();
        task.problem.merit =
            std::ranges::find(kMerits, name, &decltype(kMerits)::value_type::first)->second;
    }
    try {
        task.source = inner_stack(document["stack"], "/stack", folder);
    } catch (const InputError& error) {
        throw InputError(file, error.where, error.message);
    }
    task.max_layers = static_cast<std::size_t>(document.value("max_layers", 20.0));
    task.min_thickness_nm = document.value("min_thickness_nm", task.min_thickness_nm);
    StackDocument stack = read_stack_of(document, file, task);
    task.notes = stack.notes;
    task.problem.stack = std::move(stack.stack);
    read_free(document["free"], task);
    read_targets(document["targets"], folder, task);
    if (task.method == "needle" && task.materials.empty())
        throw InputError(file, "", "must have the key \"materials\" for the method needle");
    return task;
}

}  // namespace

DesignTask read_design(const json& document, const std::string& file, const std::string& folder) {
    for (const Problem& problem : broken_design_rules(document))
        throw InputError(file, problem.pointer, problem.message);
    return read_checked(document, file, folder);
}

json designed_stack(const DesignTask& task, const std::vector<double>& values) {
    json document = task.source.document;
    for (std::size_t i = 0; i < values.size(); ++i)
        for (const std::string& path : task.paths[i]) {
            const double value = values[i];
            set_value(document, path,
                      task.problem.free[i].is_integer ? json(static_cast<std::int64_t>(value))
                                                      : json(value));
        }
    document.erase("design");
    return document;
}

DesignTask with_layers(const DesignTask& task, const std::vector<OtherLayer>& layers,
                       DesignProblem problem) {
    DesignTask other = task;
    other.problem = std::move(problem);
    json& written = other.source.document["layers"];
    const json before = std::exchange(written, json::array());
    for (const OtherLayer& layer : layers) {
        json one;
        if (layer.origin) {
            one = before[*layer.origin];
        } else {
            const auto at = std::ranges::find(task.materials, layer.material);
            one["material"] =
                task.material_documents[static_cast<std::size_t>(at - task.materials.begin())];
        }
        one["thickness_nm"] = layer.thickness_nm;
        written.push_back(std::move(one));
    }
    other.paths.clear();
    for (const FreeValue& value : other.problem.free) other.paths.push_back({value.name});
    return other;
}

std::vector<std::string> design_problems(const json& document, const std::string& file,
                                         const std::string& folder) {
    std::vector<std::string> lines;
    for (const Problem& problem : broken_design_rules(document))
        lines.emplace_back(InputError(file, problem.pointer, problem.message).what());
    if (!lines.empty()) return lines;
    try {
        read_checked(document, file, folder);
    } catch (const InputError& error) {
        lines.emplace_back(error.what());
    }
    return lines;
}

const char* design_schema_text() {
    return
#include "design_schema.inc"
        ;
}

}  // namespace irido::schemas
