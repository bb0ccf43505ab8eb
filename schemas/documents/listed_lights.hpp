#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace irido::schemas {

/// Reads one light or a list of them. Throws InputError, also for a DomainError of `use`, with the
/// light's place in the list.
/// text_or_path  JSON text, which begins with { or [, or the path of a file
/// schema        text of the JSON schema that the document must satisfy
/// use           called with each light
void each_light(const std::string& text_or_path, const char* schema,
                const std::function<void(const nlohmann::json&)>& use);

}  // namespace irido::schemas
