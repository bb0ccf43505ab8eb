#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/material/material.hpp"

namespace irido {

/// One built-in material.
struct LibraryMaterial {
    Material material;     ///< named by its built-in name
    std::string source;    ///< description, publication, and temperature if known
    int year = 0;          ///< of the publication; 0 if there is none
    bool is_film = false;  ///< measured on a film, whose index differs from the bulk
    std::vector<std::string> aliases;
};

/// Names of all built-in materials without aliases, related ones together. Static data.
std::span<const std::string_view> library_names();

/// Names of all built-in materials, each followed by its aliases, for suggestions.
std::vector<std::string> library_names_and_aliases();

/// The built-in material of this name or alias, exact and case-sensitive; nothing if unknown.
std::optional<LibraryMaterial> find_material(std::string_view name);

}  // namespace irido
