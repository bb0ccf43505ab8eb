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
    std::string source;    ///< what it is, who published it where and when, temperature if known
    int year = 0;          ///< of the publication; 0 where there is none
    bool is_film = false;  ///< measured on a film, whose index is not that of the bulk
    std::vector<std::string> aliases;
};

/// Names of all built-in materials, aliases left out, related ones together. Static data.
std::span<const std::string_view> library_names();

/// The same with the aliases of each behind it, for suggestions.
std::vector<std::string> library_names_and_aliases();

/// The built-in material of this name or alias, exact and case-sensitive; nothing if there is none.
std::optional<LibraryMaterial> find_material(std::string_view name);

}  // namespace irido
