#include "core/color/fourier/one_film.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/stack/index_table.hpp"

namespace irido {

namespace {

const Layer* only_layer_of(const std::vector<Element>& elements) {
    if (elements.size() != 1) return nullptr;
    if (const Layer* layer = std::get_if<Layer>(&elements.front().value)) return layer;
    const Group& group = std::get<Group>(elements.front().value);
    return group.repeat == 1 ? only_layer_of(group.elements) : nullptr;
}

}  // namespace

const Layer* only_layer(const Stack& stack) {
    return only_layer_of(stack.elements);
}

std::string reflected_film_fault(std::string_view method, const Stack& stack,
                                 const ColorRequest& request) {
    const std::string must_have = "method " + std::string(method) + " must have ";
    const Layer* film = only_layer(stack);
    if (!film || !film->coherent || film->thickness_sigma_nm != 0)
        return must_have + "one coherent film of one thickness over a substrate";
    if (first_uniaxial(stack.materials)) return must_have + "isotropic media only";
    if (std::ranges::count(request.sides, Side::transmitted) > 0)
        return must_have + "reflected light only";
    return "";
}

const Layer& film_of(const Stack& stack) {
    return *only_layer(stack);
}

FilmIndex film_index(const Stack& stack, double wavelength_nm) {
    const IndexTable table(stack, {wavelength_nm});
    return {table.n(stack.incident, 0), table.index(film_of(stack).material, 0),
            table.index(stack.substrate, 0)};
}

std::span<const Polarization> polarizations(Light light) {
    static constexpr std::array both{Polarization::s, Polarization::p};
    return light == Light::s   ? std::span(both).first(1)
           : light == Light::p ? std::span(both).last(1)
                               : std::span(both);
}

}  // namespace irido
