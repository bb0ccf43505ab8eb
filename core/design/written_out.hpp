#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido {

/// A stack written out: each layer of the stack once, and the order in which light meets them.
struct WrittenOut {
    static constexpr std::size_t kMostLayers = 100000;

    std::vector<Layer> layers;
    std::vector<std::uint32_t> sequence;  ///< places in `layers`, from the incident side
    std::map<LayerPlace, std::size_t> place_of;

    /// Throws DomainError if the sequence has more than kMostLayers.
    explicit WrittenOut(const Stack& stack);
};

/// Thickness of elements, groups written out.
double total_thickness(const std::vector<Element>& elements);

/// The element at a place, nullptr if there is none.
Element* element_at(Stack& stack, const LayerPlace& place);

}  // namespace irido
