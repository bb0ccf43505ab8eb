#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/rough/layered/layered_surface.hpp"
#include "core/scratch/scratched_surface.hpp"
#include "schemas/documents/stack_document.hpp"

namespace irido::schemas {

/// The options that select a surface, as given on the command line.
struct SurfaceRequest {
    StackRequest source;          ///< its `stack` is a surface or stack file, "-" or an expression
    std::optional<double> alpha;  ///< roughness to give to a plain stack
    bool takes_stacks = true;     ///< false: plain stacks are refused whatever their alpha
};

/// A surface of any kind that a document can describe.
using Surface = std::variant<LayeredSurface, ScratchedSurface>;

/// A surface document as plain values.
struct SurfaceDocument {
    Surface surface;
    std::string file;                ///< its name in messages
    std::string name;                ///< "" if the document has none
    std::vector<std::string> notes;  ///< notes from reading the stacks
};

/// Checks a document against surface.schema.json and further rules, and builds its surface. Throws
/// InputError for the first problem.
/// document  the surface
/// file      its name in messages
/// folder    base of its relative paths
SurfaceDocument read_surface(const nlohmann::json& document, const std::string& file,
                             const std::string& folder);

/// Loads and reads the surface of a request; a stack with an alpha becomes a surface of one layer
/// over a black base. Throws InputError.
SurfaceDocument read_surface(const SurfaceRequest& request);

/// All problems of a surface document, one line each: "FILE: POINTER: message".
std::vector<std::string> surface_problems(const nlohmann::json& document, const std::string& file,
                                          const std::string& folder);

/// The text of surface.schema.json.
const char* surface_schema_text();

}  // namespace irido::schemas
