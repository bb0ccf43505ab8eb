#pragma once

#include "core/stack/stack.hpp"

namespace irido {

/// The elements from the other side, those of groups as well. Twice is the same again.
std::vector<Element> reversed(const std::vector<Element>& elements);

/// The stack with light from its substrate, which becomes the incident medium.
Stack reversed(Stack stack);

}  // namespace irido
