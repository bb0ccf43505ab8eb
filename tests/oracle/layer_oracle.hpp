#pragma once

#include <vector>

#include "tests/oracle/stack_oracle.hpp"

namespace irido::oracle {

/// Power absorbed in every layer of a coherent stack, groups written out, the first layer's first:
/// the difference of the Poynting fluxes at its faces, in 100 digits. The fields are waves exp(+-i
/// kz z) of each layer, matched at every interface from the substrate up.
std::vector<double> layer_absorption(const Stack& stack, const Query& query);

/// Amplitudes of the tangential electric field, reflected and transmitted, from the same fields.
struct Amplitudes {
    Complex r, t;
};
Amplitudes amplitudes(const Stack& stack, const Query& query);

}  // namespace irido::oracle
