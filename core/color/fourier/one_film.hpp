#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/coherent/coherent.hpp"
#include "core/color/color_request.hpp"
#include "core/complex.hpp"

namespace irido {

/// The only layer of a stack, possibly inside groups of one repetition; nullptr if there is none or
/// more than one.
const Layer* only_layer(const Stack& stack);

/// Why a method that takes light reflected by one coherent isotropic film of fixed thickness does
/// not take these, a sentence; "" if it does.
std::string reflected_film_fault(std::string_view method, const Stack& stack,
                                 const ColorRequest& request);

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
