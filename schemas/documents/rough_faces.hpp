#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// Callbacks into the reader of a document, used by with_rough_faces().
struct FaceReader {
    /// The material at the top or bottom of a layer that is not homogeneous.
    std::function<std::size_t(const nlohmann::json& layer, const std::string& pointer, bool top)>
        end_of;
    /// The material of the interface layer between two others.
    std::function<std::size_t(std::size_t above, std::size_t below, bool centred,
                              const std::string& pointer)>
        between;
    std::function<void(const std::string& pointer, const std::string& message)> report;
};

/// The stack's elements with a layer of the two media's mixture, as thick as the roughness, at
/// every rough face. To keep the indices of the document, an element that gains layers, or loses
/// thickness to centred ones, becomes a group that occurs once; a rough face below the last element
/// becomes one more element. Groups whose first or last period has different faces from the others
/// are expanded accordingly.
/// document   the stack document
/// elements   its elements, in the same order
/// incident   index of the incident medium's material
/// substrate  index of the substrate's material
/// reader     makes the materials of the interface layers
std::vector<Element> with_rough_faces(const nlohmann::json& document,
                                      const std::vector<Element>& elements, std::size_t incident,
                                      std::size_t substrate, const FaceReader& reader);

/// Whether a document has a rough face.
bool has_rough_faces(const nlohmann::json& document);

}  // namespace irido::schemas
