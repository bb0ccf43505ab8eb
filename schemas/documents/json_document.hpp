#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// Parses strict JSON: UTF-8 (a byte order mark is skipped), no comments, no duplicate keys, at
/// most 64 levels deep, every number a finite double. Throws InputError(file, "LINE:COLUMN",
/// words), both counted from 1 in characters.
nlohmann::json parse_json(std::string_view text, const std::string& file);

/// Sets the value at a dotted path ("layers.0.thickness_nm"). All steps but the last must exist,
/// and so must array indices; a missing last key is added. Throws InputError("PATH", "", words).
void set_value(nlohmann::json& document, std::string_view path, nlohmann::json value);

/// Sets the value given as "PATH=VALUE", the argument of --set. Throws InputError.
void set_value(nlohmann::json& document, std::string_view path_equals_value);

/// Whether the document has a value at a dotted path.
bool has_value(const nlohmann::json& document, std::string_view path);

/// Whether a dotted path names the same value as `whole`, or a part of it.
bool is_part_of(std::string_view path, std::string_view whole);

/// Two of the paths, by number.
struct PathOverlap {
    std::size_t inner = 0, outer = 0;
    bool is_same = false;  ///< both name the same value; otherwise the inner one names a part
};

/// Two paths of which one names the same value as the other, or a part of it, if there are any.
std::optional<PathOverlap> overlap_of(const std::vector<std::string>& paths);

/// The value that `text` means at a dotted path: JSON if it parses, otherwise a string; where a
/// material is expected, 1.9+1.5i is {"n": 1.9, "k": 1.5}. Throws InputError("PATH=TEXT", place,
/// words) for text that begins like JSON ({, [ or ") but is not valid.
nlohmann::json value_from_text(std::string_view path, std::string_view text);

/// Turns whole numbers into integers, so that 100.0 prints as 100.
void shorten_numbers(nlohmann::json& value);

/// The items of `Ag,1.9+1.5i,{"n":1.5,"k":0.1}`: split at commas outside brackets, braces and
/// double quotes, trimmed; empty items are kept.
std::vector<std::string_view> split_values(std::string_view text);

}  // namespace irido::schemas
