#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace irido::schemas {

/// For the message that a document cannot be read: "is a scene; irido plan, bake and render read
/// it" if it is of another kind than `wanted` ("stack" or "scene"), "" if it is not clearly so.
std::string other_kind(const nlohmann::json& document, std::string_view wanted);

}  // namespace irido::schemas
