#pragma once

#include <span>
#include <string_view>

#include "core/coherent/coherent.hpp"
#include "core/color/color_request.hpp"
#include "core/complex.hpp"

namespace irido {

/// The only layer of a stack, in groups of one repetition or not; nullptr if there is none or more.
const Layer* only_layer(const Stack& stack);

/// Throws DomainError that names the method unless the stack is one coherent film of one thickness
/// and reflected light is all that is asked for.
void require_film(std::string_view method, const Stack& stack, const ColorRequest& request);

/// The film of such a stack.
const Layer& film_of(const Stack& stack);

/// Indices of the three media at one wavelength.
struct FilmIndex {
    double incident;
    Complex film, substrate;
};
FilmIndex film_index(const Stack& stack, double wavelength_nm);

/// One or both.
std::span<const Polarization> polarizations(Light light);

}  // namespace irido
