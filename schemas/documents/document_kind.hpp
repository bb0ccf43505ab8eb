#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace irido::schemas {

enum class DocumentKind { stack, surface, design, scene, plan, manifest };

/// What a JSON document is meant to be, judged by its keys. Several may be present by mistake:
/// those of a design task decide first, then those that only surfaces have, then those of a stack.
/// A document that is not clearly of any kind counts as a stack.
DocumentKind kind_of(const nlohmann::json& document);

/// For the message that a document cannot be read: "is a scene; irido plan, bake and render read
/// it" if it is of another kind than `wanted`, "" if it is not clearly so.
std::string other_kind(const nlohmann::json& document, DocumentKind wanted);

}  // namespace irido::schemas
