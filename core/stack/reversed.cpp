#include "core/stack/reversed.hpp"

#include <utility>

namespace irido {

std::vector<Element> reversed(const std::vector<Element>& elements) {
    std::vector<Element> result(elements.rbegin(), elements.rend());
    for (Element& element : result)
        if (Group* group = std::get_if<Group>(&element.value))
            group->elements = reversed(group->elements);
    return result;
}

Stack reversed(Stack stack) {
    stack.elements = reversed(stack.elements);
    std::swap(stack.incident, stack.substrate);
    return stack;
}

}  // namespace irido
