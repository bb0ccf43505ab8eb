#pragma once

#include <array>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "core/scratch/scratched_surface.hpp"
#include "schemas/documents/stack_document.hpp"

namespace irido::schemas {

/// How an engine shades a material.
enum class Shading {
    color,         ///< RGB from a table
    fourier,       ///< Fourier series in the shader, with a table of kind sensitivity
    bragg,         ///< Yeh's reflectance in the shader
    rough_layers,  ///< tables falpha and transmissivity
    albedo,        ///< table of the directional albedo
    facets,        ///< GGX facets in the shader, with their colours from a table
    scratches,     ///< scratch by scratch in the shader, with tables of the kind scratch
};

std::string_view name_of(Shading shading);

/// A closed range, first <= last.
struct ValueRange {
    double first = 0, last = 0;
    bool is_one() const { return first == last; }
};

struct VariedRange {
    std::string path;
    ValueRange range;
};

/// An error in a scene.
struct SceneFault {
    std::string pointer;  ///< where in the scene: /materials/3/roughness
    std::string reason;   ///< in words
    bool operator==(const SceneFault&) const = default;
};

/// Lights of a scene that cover so many degrees; 0 is a point.
struct SceneLight {
    std::string name;
    ValueRange diameter_deg;
};

/// A surface with scratches, and what an engine shows of it.
struct SceneScratches {
    ScratchedSurface surface;
    std::array<double, 2> extent_um{4000, 4000};  ///< [1, 1e6] each
    double footprint_um = 200;  ///< largest half extent of a footprint, [0, 1e4]; 0: points
};

/// A material of a scene. Angles in degrees, alpha in [1e-4, 1].
struct SceneMaterial {
    std::string name;
    std::string pointer;             ///< in the scene: /materials/3
    std::vector<SceneFault> faults;  ///< why it cannot be made; then its stack may be missing
    std::optional<SceneScratches> scratches;  ///< then the stack is that of their base, if any
    StackSource source;
    StackDocument document;
    std::vector<VariedRange> vary;  ///< at most two
    ValueRange angles_deg{0, 90};
    bool has_angles = false;  ///< whether the scene specifies them
    bool is_rough = false;
    ValueRange alpha;
    bool transmission = false;
    double thickness_spread_nm = 0;
    Shading shading = Shading::color;
};

/// A scene document as plain values. Names of spaces, illuminants, formats and types have been
/// checked.
struct Scene {
    std::string file;  ///< its name in messages
    std::string name;
    std::string space = "srgb", illuminant = "D65", adaptation = "bradford";
    int observer_deg = 2;
    double delta_e = 0.5, relative = 1e-3;  ///< tolerances of colours and of filters
    std::string format = "ktx2", type = "f16";
    std::vector<SceneLight> lights;  ///< none: any may occur
    std::vector<SceneMaterial> materials;
    std::vector<std::string> notes;  ///< notes from reading the stacks
};

/// Reads a scene file ("-" for standard input). Throws InputError if it violates the schema or two
/// materials have the same name. Other errors of a material are listed in its faults.
Scene read_scene(const std::string& path);

/// Reads a scene from a JSON document. Throws InputError.
/// document  the scene
/// file      its name in messages
/// folder    base of its relative paths
Scene read_scene(const nlohmann::json& document, const std::string& file,
                 const std::string& folder);

/// Reads what can be read of a scene, for reports of all its problems: if the scene breaks rules of
/// its own, the settings are the defaults, and materials that break them are left out.
/// document  the scene
/// file      its name in messages
/// folder    base of its relative paths
/// problems  receives those for which read_scene() throws, one line each, and those in the stacks
///           and surfaces of materials that are left out
Scene readable_scene(const nlohmann::json& document, const std::string& file,
                     const std::string& folder, std::vector<std::string>& problems);

/// Converts an error from reading or computing a material; for errors inside an inline stack the
/// pointer is relative to the scene.
SceneFault fault_of(const SceneMaterial& material, const std::exception& error);

/// "FILE: POINTER: material NAME: reason".
std::string fault_text(const Scene& scene, const std::string& material, const SceneFault& fault);

/// The text of scene.schema.json.
const char* scene_schema_text();

}  // namespace irido::schemas
