#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/colorimetry/space.hpp"
#include "core/film/film.hpp"
#include "schemas/documents/scene_document.hpp"
#include "tables/lut/lut_format.hpp"
#include "tables/lut/lut_kind.hpp"
#include "tables/lut/lut_maker.hpp"

namespace irido::tables {

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
    /// The largest angle of an axis of cosines, degrees; 0 if the table has none.
    double largest_angle_deg = 0;
    bool may_end_early = false;  ///< the scene gives no angles: those that a table can serve
    nlohmann::json inputs;       ///< what the id is made of
    std::vector<std::string> materials;  ///< that use it
};

/// Something that a material does without, and why.
struct Omission {
    enum class Kind {
        skipped,  ///< work that changes nothing
        loss,     ///< what is seen differs from what the scene describes
        given,    ///< the scene says so itself
    };
    std::string material;
    std::string what;    ///< transmission, mip levels, layers.0.thickness_nm, ...
    std::string reason;  ///< in words
    Kind kind = Kind::skipped;
    std::optional<double> delta_e{};  ///< of a loss, where it is known: the largest that was found
};

/// The loss of a series that shades a film past its critical angle.
inline constexpr const char* kPastCriticalAngle = "light past the film's critical angle";

/// What an engine needs for one material.
struct MaterialPlan {
    struct Use {
        std::string role;  ///< reflection, transmission, sensitivity, falpha, ...
        std::size_t table = 0;
    };
    std::string name;
    schemas::Shading shading = schemas::Shading::color;
    schemas::ValueRange angles_deg;  ///< of the scene, or the largest range
    std::vector<schemas::VariedRange> vary;
    std::vector<Use> tables;
    nlohmann::json constants = nlohmann::json::object();
    std::vector<std::string> snippets;        ///< of irido lut shader
    std::vector<schemas::SceneFault> faults;  ///< why it cannot be; none if it can
};

struct ScenePlan {
    std::vector<SceneTable> tables;
    std::vector<MaterialPlan> materials;
    std::vector<Omission> omissions;
    Triple white_xyz{};          ///< of the scene's light
    ColorMatrix rgb_from_xyz{};  ///< to the scene's space, with its adaptation; rows
};

/// What a scene needs: tables with their axes and tolerances, numbers in place of tables, and all
/// that is left out. Equal tables are one. Depends on the scene alone. A material that cannot be
/// has faults and no tables.
ScenePlan plan_scene(const schemas::Scene& scene, const Execution& execution);

/// Everything that is known to be wrong with a scene before its tables are computed, one line each:
/// "FILE: POINTER: material NAME: reason".
std::vector<std::string> problems_of_scene(const nlohmann::json& document, const std::string& file,
                                           const std::string& folder, const Execution& execution);

/// The table's request with the angles ending at this one, degrees.
LutRequest request_up_to(const SceneTable& table, double largest_angle_deg);

/// What the kind `color` is asked for a material's reflected light, however it is shaded.
LutRequest color_request_of(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                            const Execution& execution);

/// Where shaders take the indices of a stack.
inline constexpr double kShaderIndices_nm = 550;

/// One film with the indices that shaders take.
Film shader_film(const Stack& stack);

/// The layout that the scene's format and type ask for.
const LutFormat& format_of(const schemas::Scene& scene);

}  // namespace irido::tables
