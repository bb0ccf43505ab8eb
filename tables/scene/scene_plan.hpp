#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/color/space.hpp"
#include "core/interference/film.hpp"
#include "schemas/scene_document.hpp"
#include "tables/lut_format.hpp"
#include "tables/lut_kind.hpp"
#include "tables/lut_maker.hpp"

namespace irido {

/// Changes whenever irido computes other numbers for the same request: tables made before are then
/// made again.
inline constexpr int kNumbersVersion = 2;

/// A table that a scene needs, before its size is known.
struct SceneTable {
    std::string id;    ///< 16 hexadecimal digits of a hash of all that its values depend on
    std::string file;  ///< KIND-ID.FORMAT
    const LutKind* kind = nullptr;
    LutRequest request;
    LutMaking making;
    nlohmann::json inputs;               ///< what the id is made of
    std::vector<std::string> materials;  ///< that use it
};

/// Something that a material does without, and why.
struct Omission {
    std::string material;
    std::string what;    ///< transmission, mip levels, layers.0.thickness_nm, ...
    std::string reason;  ///< in words
};

/// What an engine needs for one material.
struct MaterialPlan {
    struct Use {
        std::string role;  ///< reflection, transmission, sensitivity, falpha, ...
        std::size_t table = 0;
    };
    std::string name;
    Shading shading = Shading::color;
    ValueRange angles_deg;
    std::vector<VariedRange> vary;
    std::vector<Use> tables;
    nlohmann::json constants = nlohmann::json::object();
    std::vector<std::string> snippets;  ///< of irido lut shader
    std::string fault;                  ///< why it cannot be, "" if it can
};

struct ScenePlan {
    std::vector<SceneTable> tables;
    std::vector<MaterialPlan> materials;
    std::vector<Omission> omissions;
    Triple white_xyz{};          ///< of the scene's light
    ColorMatrix rgb_from_xyz{};  ///< to the scene's space, with its adaptation; rows
};

/// What a scene needs: tables with their axes and tolerances, numbers in place of tables, and all
/// that is left out. Equal tables are one. Depends on the scene alone.
ScenePlan plan_scene(const Scene& scene, const Execution& execution);

/// What the kind `color` is asked for a material's reflected light, however it is shaded.
LutRequest color_request_of(const Scene& scene, const SceneMaterial& material,
                            const Execution& execution);

/// One film with the indices that shaders take, those of 550 nm.
Film shader_film(const Stack& stack);

/// The layout that the scene's format and type ask for.
const LutFormat& format_of(const Scene& scene);

}  // namespace irido
