#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// What rough faces need of the reader of a document.
struct FaceReader {
    /// The material at the top or bottom of a layer that is not one medium.
    std::function<std::size_t(const nlohmann::json& layer, const std::string& pointer, bool top)>
        end_of;
    /// The material between two others.
    std::function<std::size_t(std::size_t above, std::size_t below, bool centred,
                              const std::string& pointer)>
        between;
    std::function<void(const std::string& pointer, const std::string& message)> report;
};

/// The stack's elements with a layer of the two media's mixture at every rough face, as thick as
/// the roughness. An element that gains layers, or loses thickness to centred ones, becomes a group
/// that occurs once, so that elements stay where the document has them; a rough face below the last
/// element is one more. Groups whose faces differ between the first or last period and the others
/// are written out that far.
/// elements  of the document, in the same order
std::vector<Element> with_rough_faces(const nlohmann::json& document,
                                      const std::vector<Element>& elements, std::size_t incident,
                                      std::size_t substrate, const FaceReader& reader);

/// Whether a document has a rough face.
bool has_rough_faces(const nlohmann::json& document);

}  // namespace irido::schemas
