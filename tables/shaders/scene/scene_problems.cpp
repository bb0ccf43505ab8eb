#include "tables/shaders/scene/scene_problems.hpp"

#include <algorithm>

#include "core/color/held_stack.hpp"
#include "core/stack/index_table.hpp"
#include "schemas/documents/scene_document.hpp"
#include "tables/shaders/scene/scene_plan.hpp"

namespace irido::tables {

std::string mirror_fault(const Stack& stack) {
    const auto* group =
        stack.elements.size() == 1 ? std::get_if<Group>(&stack.elements[0].value) : nullptr;
    if (!group || group->elements.size() != 2 ||
        !std::ranges::all_of(group->elements, [](const Element& e) {
            return std::holds_alternative<Layer>(e.value);
        }))
        return "one repeated group of two layers and nothing else";
    const auto& first = std::get<Layer>(group->elements[0].value);
    const auto& second = std::get<Layer>(group->elements[1].value);
    if (first.material != stack.incident || first.material != stack.substrate)
        return "the first layer's material on both sides of the mirror";
    if (first_uniaxial(stack.materials)) return "isotropic media";
    if (IndexTable(stack, {kShaderIndices_nm}).index(second.material, 0).imag() != 0)
        return "layers that do not absorb";
    return "";
}

bool is_opaque(const Stack& stack, const Sensitivity& sensitivity) {
    constexpr double kOpaque_k = 1e-6;
    const Stack held = held_stack(stack, sensitivity);
    return index_at(held.materials[held.substrate], kShaderIndices_nm).imag() > kOpaque_k;
}

std::vector<std::string> problems_of_scene(const nlohmann::json& document, const std::string& file,
                                           const std::string& folder, const Execution& execution) {
    std::vector<std::string> lines;
    const schemas::Scene scene = schemas::readable_scene(document, file, folder, lines);
    ScenePlan plan = plan_scene(scene, execution);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        MaterialPlan& material = plan.materials[m];
        try {
            for (const MaterialPlan::Use& use : material.tables) {
                const SceneTable& table = plan.tables[use.table];
                if (table.kind) table.kind->plan(table.request);
            }
        } catch (const std::exception& error) {  // what the kind of table does not take
            material.faults.push_back(schemas::fault_of(scene.materials[m], error));
        }
        for (const schemas::SceneFault& fault : material.faults)
            lines.push_back(schemas::fault_text(scene, material.name, fault));
    }
    return lines;
}

}  // namespace irido::tables
