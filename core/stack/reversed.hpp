#pragma once

#include "core/stack/stack.hpp"

namespace irido {

/// The elements seen from the other side, groups included. Its own inverse.
std::vector<Element> reversed(const std::vector<Element>& elements);

/// The stack illuminated through its substrate, which becomes the incident medium.
Stack reversed(Stack stack);

}  // namespace irido
