#pragma once

#include <cstdint>
#include <string_view>

#include "core/complex.hpp"
#include "core/math/random.hpp"
#include "core/stack/builder.hpp"

namespace irido::oracle {

using irido::Random;
using irido::StackBuilder;

enum class Kind {
    film,             ///< one dielectric film on a dielectric
    film_on_metal,    ///< one or two dielectric films on a metal of constant index
    multilayer,       ///< 2 to 9 films, some of them absorbing
    tabulated_metal,  ///< films on a metal of the library
    kinked_table,     ///< a film with a coarse table of n and k
    bragg,            ///< two-layer periods, 2 to 30 of them
    thick_film,       ///< 2 to 20 um
    metal_cavity,     ///< a dielectric between two thin metals
    mirror,           ///< two-layer periods in the first one's medium, 1 to 300 of them
};
inline constexpr std::size_t kKinds = 8;     ///< without mirrors, whose oracle is slow
inline constexpr std::size_t kAllKinds = 9;  ///< with mirrors
std::string_view name_of(Kind kind);

Stack random_stack(Kind kind, Random& random);

/// Makes the layer incoherent, or gives it a thickness distribution.
Element incoherent(Element layer);
Element spread(Element layer, double sigma_nm);

/// 0 to 89 degrees, every fifth above 75.
double random_angle(Random& random);

/// Complete description on one line, for messages.
std::string text_of(const Stack& stack);

}  // namespace irido::oracle
