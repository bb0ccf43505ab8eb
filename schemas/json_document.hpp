#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace irido {

/// JSON as irido reads it: UTF-8 (a byte order mark is skipped), no comments, no key twice in an
/// object, at most 64 levels deep, every number a finite double.
/// Throws InputError(file, "LINE:COLUMN", words), both counted from 1 in characters.
nlohmann::json parse_json(std::string_view text, const std::string& file);

/// Sets the value at a dotted path ("layers.0.thickness_nm"). All but the last step must exist, and
/// so must an index; a last key that is missing is added. Throws InputError("PATH", "", words).
void set_value(nlohmann::json& document, std::string_view path, nlohmann::json value);

/// The same for what follows --set, "PATH=VALUE". VALUE is JSON, or else text; where a material is
/// expected, 1.9+1.5i is {"n": 1.9, "k": 1.5}.
void set_value(nlohmann::json& document, std::string_view path_equals_value);

}  // namespace irido
