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
#include "tables/shaders/scene/scratched_material.hpp"

namespace irido::tables {

/// Incremented whenever irido computes different numbers for the same request, so that older tables
/// are remade.
inline constexpr int kNumbersVersion = 2;

/// A table that a scene needs; its size is not known yet. Or a grid of scratches, which no kind of
/// table makes.
struct SceneTable {
    std::string id;    ///< hash of everything its values depend on, 16 hexadecimal digits
    std::string file;  ///< KIND-ID.FORMAT
    const LutKind* kind = nullptr;
    std::shared_ptr<const SceneGrid> grid;  ///< in the place of kind, request and making
    std::string_view kind_name() const { return grid ? kGridKind : kind->name; }
    LutRequest request;
    LutMaking making;
    /// The largest angle of an axis of cosines, degrees; 0 if the table has none.
    double largest_angle_deg = 0;
    bool may_end_early = false;  ///< the scene gives no angles: the range may be shortened
    std::optional<double> served_angle_deg{};  ///< where the range ends, if that is known
    nlohmann::json inputs;                     ///< the hashed inputs of the id
    std::vector<std::string> materials;        ///< materials that use it
};

/// Something omitted for a material, and the reason.
struct Omission {
    enum class Kind {
        skipped,  ///< work that would not change the result
        loss,     ///< the result differs from the scene's description
        given,    ///< requested by the scene
    };
    std::string material;
    std::string what;    ///< transmission, mip levels, layers.0.thickness_nm, ...
    std::string reason;  ///< in words
    Kind kind = Kind::skipped;
    std::optional<double> delta_e{};  ///< for a loss, if known: the largest value found
};

/// The loss of the shading scratches over a base.
inline constexpr const char* kProductOfColors = "product of colours";

/// The loss of the shading fourier past a film's critical angle.
inline constexpr const char* kPastCriticalAngle = "light past the film's critical angle";

/// Everything that an engine needs for one material.
struct MaterialPlan {
    struct Use {
        std::string role;  ///< reflection, transmission, sensitivity, falpha, ...
        std::size_t table = 0;
        std::string why{};  ///< this form of several, in words; "" if there is no choice
    };
    std::string name;
    schemas::Shading shading = schemas::Shading::color;
    schemas::ValueRange angles_deg;  ///< from the scene, or [0, 90]
    std::vector<schemas::VariedRange> vary;
    std::vector<Use> tables;
    nlohmann::json constants = nlohmann::json::object();
    std::vector<std::string> snippets;        ///< names for irido lut shader
    std::vector<schemas::SceneFault> faults;  ///< why it cannot be made; empty if it can
};

struct ScenePlan {
    std::vector<SceneTable> tables;
    std::vector<MaterialPlan> materials;
    std::vector<Omission> omissions;
    Triple white_xyz{};          ///< for the scene's light
    ColorMatrix rgb_from_xyz{};  ///< to the scene's space, with its adaptation; rows
};

/// Plans a scene: tables with axes and tolerances, constants, and omissions. Identical tables are
/// shared. Depends only on the scene. A material that cannot be made has faults and no tables.
ScenePlan plan_scene(const schemas::Scene& scene, const Execution& execution);

/// The table's request with its angles limited to `largest_angle_deg`.
LutRequest request_up_to(const SceneTable& table, double largest_angle_deg);

/// The request for a table of kind `color` for a material's reflected light, whatever its shading.
LutRequest color_request_of(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                            const Execution& execution);

/// The wavelength at which shaders take indices.
inline constexpr double kShaderIndices_nm = 550;

/// The film of a stack, with its indices at that wavelength.
Film shader_film(const Stack& stack);

/// The file format that the scene requests.
const LutFormat& format_of(const schemas::Scene& scene);

}  // namespace irido::tables
