#include "core/render/surface_stack.hpp"

#include <utility>

#include "core/error.hpp"
#include "core/stack/reversed.hpp"

namespace irido {

namespace {

template <class Elements>
auto* layer_in(Elements& elements, const LayerPlace& place) {
    auto* value = &elements[place.front()].value;
    for (std::size_t i = 1; i < place.size(); ++i)
        value = &std::get<Group>(*value).elements[place[i]].value;
    return &std::get<Layer>(*value);
}

/// Walks to the layer of that number, which it counts down.
bool find_layer(const std::vector<Element>& elements, std::size_t& number, LayerPlace& place) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
        place.push_back(i);
        const auto* group = std::get_if<Group>(&elements[i].value);
        if (group ? find_layer(group->elements, number, place) : --number == 0) return true;
        place.pop_back();
    }
    return false;
}

}  // namespace

void SurfaceStack::set(double thickness_nm) {
    if (!varied.empty()) layer_in(stack.elements, varied)->thickness_nm = thickness_nm;
}

Stack SurfaceStack::at(double thickness_nm) const {
    SurfaceStack other = *this;
    other.set(thickness_nm);
    return std::move(other.stack);
}

SurfaceStack reversed_surface(const SurfaceStack& surface) {
    SurfaceStack other{reversed(surface.stack), surface.varied};
    const std::vector<Element>* elements = &surface.stack.elements;
    for (std::size_t& index : other.varied) {
        const Element& element = (*elements)[index];
        index = elements->size() - 1 - index;
        if (const auto* group = std::get_if<Group>(&element.value)) elements = &group->elements;
    }
    return other;
}

LayerPlace layer_number(const Stack& stack, std::size_t number) {
    LayerPlace place;
    std::size_t left = number;
    if (number == 0 || !find_layer(stack.elements, left, place))
        throw DomainError("the stack has no layer " + std::to_string(number));
    return place;
}

double thickness_at(const Stack& stack, const LayerPlace& place) {
    return layer_in(stack.elements, place)->thickness_nm;
}

}  // namespace irido
