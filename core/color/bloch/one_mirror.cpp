#include "core/color/bloch/one_mirror.hpp"

#include "core/color/held_stack.hpp"
#include "core/error.hpp"

namespace irido {

namespace {

struct Pair {
    const Layer* first = nullptr;
    const Layer* second = nullptr;
    std::uint64_t repeat = 1;
};

/// The only two layers of a stack and how often they stand; {} if it is anything else.
Pair pair_of(const std::vector<Element>& elements) {
    if (elements.size() == 2) {
        const Layer* first = std::get_if<Layer>(&elements[0].value);
        const Layer* second = std::get_if<Layer>(&elements[1].value);
        return first && second ? Pair{first, second, 1} : Pair{};
    }
    const Group* group = elements.size() == 1 ? std::get_if<Group>(&elements[0].value) : nullptr;
    if (!group) return {};
    Pair inside = pair_of(group->elements);
    if (!inside.first || (group->repeat > 1 && inside.repeat > 1)) return {};
    inside.repeat *= group->repeat;
    return inside;
}

}  // namespace

std::string mirror_fault(const Stack& stack) {
    const Pair pair = pair_of(stack.elements);
    if (!pair.first) return "other layers";
    if (first_uniaxial(stack.materials)) return "a uniaxial medium";
    for (const Layer* layer : {pair.first, pair.second}) {
        if (!layer->coherent) return "an incoherent layer";
        if (layer->thickness_sigma_nm != 0) return "a spread thickness";
    }
    for (const std::size_t material :
         {stack.incident, pair.first->material, pair.second->material, stack.substrate}) {
        if (!is_constant(stack.materials[material])) return "an index that varies";
        if (!is_real(stack.materials[material])) return "k other than 0";
    }
    if (pair.first->thickness_nm + pair.second->thickness_nm == 0) return "no thickness";
    return "";
}

std::string mirror_fault(std::string_view method, const Stack& stack) {
    const std::string fault = mirror_fault(stack);
    return fault.empty() ? ""
                         : "method " + std::string(method) +
                               " needs one group of two coherent layers between media, all of "
                               "constant real index (got " +
                               fault + ")";
}

OneMirror one_mirror(std::string_view method, const Stack& stack) {
    if (const std::string fault = mirror_fault(method, stack); !fault.empty())
        throw DomainError(fault);
    const Pair pair = pair_of(stack.elements);
    const auto n = [&](std::size_t material) {
        return index_at(stack.materials[material], 550).real();
    };
    return {{n(pair.first->material), pair.first->thickness_nm},
            {n(pair.second->material), pair.second->thickness_nm},
            pair.repeat,
            n(stack.incident),
            n(stack.substrate)};
}

}  // namespace irido
