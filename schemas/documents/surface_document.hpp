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

/// The options that select a surface, as typed.
struct SurfaceRequest {
    StackRequest source;          ///< its `stack` is a surface or stack file, "-" or an expression
    std::optional<double> alpha;  ///< the roughness of a stack
};

/// Every kind of surface that a document describes.
using Surface = std::variant<LayeredSurface, ScratchedSurface>;

/// A surface document as plain values.
struct SurfaceDocument {
    Surface surface;
    std::string file;                ///< its name in messages
    std::string name;                ///< "" if the document has none
    std::vector<std::string> notes;  ///< notes of the readers of stacks
};

/// Whether a JSON document has keys that only surfaces have.
bool is_surface(const nlohmann::json& document);

/// Checks a document against surface.schema.json and rules beyond it, and builds its surface.
/// Throws InputError for the first problem.
/// document  the surface
/// file      its name in messages
/// folder    where its relative paths start
SurfaceDocument read_surface(const nlohmann::json& document, const std::string& file,
                             const std::string& folder);

/// Loads and reads the surface of a request; a stack with an alpha is the surface of that one
/// layer over a black base. Throws InputError.
SurfaceDocument read_surface(const SurfaceRequest& request);

/// All problems of a surface document, one line each: "FILE: POINTER: message".
std::vector<std::string> surface_problems(const nlohmann::json& document, const std::string& file,
                                          const std::string& folder);

/// The text of surface.schema.json.
const char* surface_schema_text();

}  // namespace irido::schemas
