#pragma once

#include <vector>

#include "tests/oracle/stack_oracle.hpp"

namespace irido::oracle {

/// Power absorbed in each layer of a coherent stack, with groups expanded, starting with the first
/// layer: the difference of the Poynting fluxes at its faces, in 100 digits. The fields are waves
/// exp(+-i kz z) in each layer, matched at every interface from the substrate up.
std::vector<double> layer_absorption(const Stack& stack, const Query& query);

/// Reflected and transmitted amplitudes of the tangential electric field, from the same fields.
struct Amplitudes {
    Complex r, t;
};
Amplitudes amplitudes(const Stack& stack, const Query& query);

}  // namespace irido::oracle
