#include "schemas/documents/plain_stack.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace irido::schemas {

namespace {

using nlohmann::json;

bool is_in_range(const json& value, double lowest, double highest) {
    if (!value.is_number()) return false;
    const double number = value.get<double>();
    return number >= lowest && number <= highest;
}

bool is_plain_index(const json& material) {
    return std::ranges::all_of(material.items(), [](const auto& member) {
        return (member.key() == "n" && is_in_range(member.value(), 1e-6, 1e4)) ||
               (member.key() == "k" && is_in_range(member.value(), 0, 1e4));
    });
}

bool is_plain_material(const json& material) {
    if (material.is_string()) return !material.get_ref<const std::string&>().empty();
    if (material.is_object()) return material.contains("n") && is_plain_index(material);
    return is_in_range(material, 1e-6, 1e4);
}

bool are_plain(const json& elements);

bool is_plain_group(const json& group) {
    if (group.size() != 2 || !group.contains("repeat") || !group.contains("layers")) return false;
    const json& repeat = group["repeat"];
    return is_in_range(repeat, 1, 1e9) && std::fmod(repeat.get<double>(), 1) == 0 &&
           !group["layers"].empty() && are_plain(group["layers"]);
}

bool is_plain_layer(const json& layer) {
    return layer.contains("material") && layer.contains("thickness_nm") &&
           std::ranges::all_of(layer.items(), [](const auto& member) {
               const auto& key = member.key();
               if (key == "material") return is_plain_material(member.value());
               if (key == "coherent") return member.value().is_boolean();
               return (key == "thickness_nm" || key == "thickness_sigma_nm") &&
                      is_in_range(member.value(), 0, 1e9);
           });
}

bool are_plain(const json& elements) {
    return elements.is_array() && std::ranges::all_of(elements, [](const json& element) {
               if (!element.is_object()) return false;
               return element.contains("layers") ? is_plain_group(element)
                                                 : is_plain_layer(element);
           });
}

}  // namespace

bool is_plain_stack(const json& document) {
    if (!document.is_object()) return false;
    for (const char* key : {"incident", "layers", "substrate"})
        if (!document.contains(key)) return false;
    return std::ranges::all_of(document.items(), [](const auto& member) {
        const auto& key = member.key();
        if (key == "incident" || key == "substrate") return is_plain_material(member.value());
        if (key == "layers") return are_plain(member.value());
        return (key == "$schema" || key == "name" || key == "comment") &&
               member.value().is_string();
    });
}

}  // namespace irido::schemas
