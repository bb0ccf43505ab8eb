#include "schemas/documents/document_kind.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

namespace irido::schemas {

namespace {

using nlohmann::json;

bool has_any(const json& document, std::initializer_list<const char*> keys) {
    return std::ranges::any_of(keys, [&](const char* key) { return document.contains(key); });
}

bool has_array(const json& document, const char* key) {
    return document.contains(key) && document[key].is_array();
}

bool is_design(const json& document) {
    return has_any(document, {"targets", "free"});
}

/// Whether a document has keys, or layers with keys, that only surfaces have.
bool is_surface(const json& document) {
    if (has_any(document, {"outside", "inside", "base", "scratches", "fields"})) return true;
    if (has_any(document, {"incident", "substrate"}) || !has_array(document, "layers"))
        return false;
    return std::ranges::any_of(document["layers"], [](const json& layer) {
        return layer.is_object() && has_any(layer, {"stack", "alpha"});
    });
}

bool is_stack(const json& document) {
    return has_any(document, {"layers", "incident", "substrate"});
}

/// The "materials" of a stack are an object, of the media that its layers name.
bool is_scene(const json& document) {
    if (!document.contains("materials")) return false;
    const json& materials = document["materials"];
    return !materials.is_object() || std::ranges::any_of(materials, [](const json& material) {
        return material.is_object() && has_any(material, {"stack", "surface"});
    });
}

bool is_plan(const json& document) {
    return has_array(document, "tables");
}

bool is_manifest(const json& document) {
    return document.contains("tables");
}

struct Kind {
    DocumentKind kind;
    bool (*is)(const json& document);
    std::string_view words;
};

/// In the order in which they are tried.
constexpr std::array kKinds{
    Kind{DocumentKind::design, is_design, "a design task; irido design and fit read it"},
    Kind{DocumentKind::surface, is_surface,
         "a surface; irido brdf, lut, render and scenes read it"},
    Kind{DocumentKind::stack, is_stack, "a stack; irido spectrum, color and scenes read it"},
    Kind{DocumentKind::scene, is_scene, "a scene; irido plan, bake and render read it"},
    Kind{DocumentKind::plan, is_plan, "a plan; irido bake reads it with --plan"},
    Kind{DocumentKind::manifest, is_manifest, "the manifest of a bake; irido validate checks it"}};

/// nullptr if the document is not clearly of any kind.
const Kind* clear_kind(const json& document) {
    if (!document.is_object()) return nullptr;
    const auto found =
        std::ranges::find_if(kKinds, [&](const Kind& one) { return one.is(document); });
    return found == kKinds.end() ? nullptr : &*found;
}

}  // namespace

DocumentKind kind_of(const json& document) {
    const Kind* const kind = clear_kind(document);
    return kind ? kind->kind : DocumentKind::stack;
}

std::string other_kind(const json& document, DocumentKind wanted) {
    const Kind* const kind = clear_kind(document);
    return !kind || kind->kind == wanted ? "" : "is " + std::string(kind->words);
}

}  // namespace irido::schemas
