#include "schemas/documents/document_kind.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "schemas/documents/design_document.hpp"
#include "schemas/documents/surface_document.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

bool has_outer_media(const json& document) {
    return document.contains("incident") || document.contains("substrate");
}

constexpr std::string_view kStack = "a stack; irido spectrum, color and scenes read it";

bool has_array(const json& document, const char* key) {
    return document.contains(key) && document[key].is_array();
}

struct Kind {
    std::string_view name, words;
    bool (*is)(const json& document);
};

/// In the order in which they are tried.
constexpr std::array kKinds{
    Kind{"design", "a design task; irido design and fit read it", is_design_task},
    Kind{"stack", kStack, has_outer_media},
    Kind{"surface", "a surface; irido brdf, lut, render and scenes read it", is_surface},
    Kind{"stack", kStack, [](const json& document) { return document.contains("layers"); }},
    Kind{"scene", "a scene; irido plan, bake and render read it",
         [](const json& document) { return has_array(document, "materials"); }},
    Kind{"plan", "a plan; irido bake reads it with --plan",
         [](const json& document) { return has_array(document, "tables"); }},
    Kind{"manifest", "the manifest of a bake; irido validate checks it",
         [](const json& document) { return document.contains("tables"); }}};

}  // namespace

std::string other_kind(const json& document, std::string_view wanted) {
    if (!document.is_object()) return "";
    const auto kind =
        std::ranges::find_if(kKinds, [&](const Kind& one) { return one.is(document); });
    if (kind == kKinds.end() || kind->name == wanted) return "";
    return "is " + std::string(kind->words);
}

}  // namespace irido::schemas
