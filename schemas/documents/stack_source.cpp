#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>

#include "core/material/material.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/documents/stack_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/stack_expression.hpp"
#include "schemas/readers/text_file.hpp"
#include "schemas/readers/utf8.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

std::string folder_of(const std::string& path) {
    return std::filesystem::path(path).parent_path().string();
}

/// Adds NAME=MATERIAL to the document's materials.
void add_medium(StackSource& source, const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw InputError("--material", "",
                         "must be NAME=MATERIAL, as in H=2.35 (got " + short_text(text) + ")");
    if (!source.document.is_object()) return;  // said where it is read
    json& media = source.document["materials"];
    if (media.is_null()) media = json::object();
    if (!media.is_object()) return;
    try {
        media[text.substr(0, equals)] = value_from_text("material", text.substr(equals + 1));
    } catch (const InputError& error) {
        throw InputError("--material " + text, error.where, error.message);
    }
}

/// The number of --reference.
json reference_of(const std::string& text) {
    const std::optional<double> nm = parse_number(text);
    if (!nm || !(*nm >= kAllWavelengths.first_nm && *nm <= kAllWavelengths.last_nm))
        throw InputError("--reference", "",
                         "must be a wavelength in [1, 1e7] nm (got '" + text + "')");
    return *nm;
}

}  // namespace

StackSource load_stack(const StackRequest& request) {
    StackSource source;
    source.reverse = request.reverse;
    if (request.stack.find('|') != std::string::npos) {
        source.file = "\"" + request.stack + "\"";
        if (!is_well_formed(request.stack)) throw InputError(well_formed(source.file), "", kNoText);
        source.document = parse_stack_expression(request.stack);
    } else {
        std::error_code ignored;
        if (request.stack != "-" && request.stack.find('.') == std::string::npos &&
            !std::filesystem::exists(request.stack, ignored))
            throw InputError("", "",
                             "there is no file '" + request.stack +
                                 "', and an expression must contain '|' (see --help)");
        source.file = shown_path(request.stack);
        source.folder = folder_of(request.stack);
        source.document = parse_json(read_text(request.stack), source.file);
    }
    set_values(source, request);
    return source;
}

void set_values(StackSource& source, const StackRequest& request) {
    for (const std::string& text : request.media) add_medium(source, text);
    if (!request.reference_nm.empty() && source.document.is_object())
        source.document["reference_nm"] = reference_of(request.reference_nm);
    for (const std::string& text : request.set) {
        try {
            set_value(source.document, text);
        } catch (const InputError& error) {
            throw InputError(error.file.empty() ? "--set" : "--set " + error.file, error.where,
                             error.message);
        }
    }
}

namespace {

/// Calls visit(material) for a material and the parts of mixtures.
void visit_material(json& material, const std::function<void(json&)>& visit) {
    visit(material);
    if (!material.is_object()) return;
    for (const char* key : {"ordinary", "extraordinary"})
        if (material.contains(key)) visit_material(material[key], visit);
    if (!material.contains("mixture")) return;
    json& mixture = material["mixture"];
    if (!mixture.is_object()) return;
    for (const char* key : {"inclusion", "host"})
        if (mixture.contains(key)) visit_material(mixture[key], visit);
}

/// Calls visit(material) for every material of a list of layers and groups.
void for_each_material(json& layers, const std::function<void(json&)>& visit) {
    if (!layers.is_array()) return;
    for (json& element : layers) {
        if (!element.is_object()) continue;
        if (element.contains("material")) visit_material(element["material"], visit);
        if (element.contains("graded") && element["graded"].is_object())
            for (const char* key : {"from", "to"})
                if (element["graded"].contains(key)) visit_material(element["graded"][key], visit);
        if (element.contains("layers")) for_each_material(element["layers"], visit);
    }
}

}  // namespace

void move_files(json& document, const std::string& from, const std::string& to) {
    const json own = document.value("materials", json::object());
    const auto move = [&](json& name) {
        const std::string path = name.is_string() ? name.get<std::string>() : "";
        if (!is_material_file(path) || std::filesystem::path(path).is_absolute()) return;
        const auto place = std::filesystem::absolute(std::filesystem::path(from) / path);
        name = place.lexically_normal()
                   .lexically_relative(
                       std::filesystem::absolute(to.empty() ? "." : to).lexically_normal())
                   .string();
    };
    const auto visit = [&](json& material) {
        if (material.is_string() && !own.contains(material.get<std::string>())) move(material);
        if (material.is_object() && material.contains("file")) move(material["file"]);
    };
    for (const char* key : {"incident", "substrate"})
        if (document.contains(key)) visit_material(document[key], visit);
    if (document.contains("layers")) for_each_material(document["layers"], visit);
    if (own.is_object() && !own.empty())
        for (json& material : document["materials"]) visit_material(material, visit);
}

}  // namespace irido::schemas
