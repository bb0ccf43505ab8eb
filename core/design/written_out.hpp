#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido {

/// A stack with its groups expanded: each distinct layer once, and the sequence in which light
/// meets them.
struct WrittenOut {
    static constexpr std::size_t kMostLayers = 100000;

    std::vector<Layer> layers;
    std::vector<std::uint32_t> sequence;  ///< indices into `layers`, from the incident side
    std::map<LayerPlace, std::size_t> place_of;

    /// Throws DomainError if the sequence is longer than kMostLayers.
    explicit WrittenOut(const Stack& stack);
};

/// Thickness of elements with groups expanded.
double total_thickness(const std::vector<Element>& elements);

/// The element at a place, or nullptr.
Element* element_at(Stack& stack, const LayerPlace& place);

}  // namespace irido
