#pragma once

#include <vector>

#include "core/interference/spectrum.hpp"
#include "core/interference/stack_power.hpp"

namespace irido {

/// Powers of the two polarizations.
struct Powers {
    Power s, p, u;
};

/// Both polarizations at one wavelength and angle, by the public way through core.
inline Powers ask(const Stack& stack, double wavelength_nm, double angle_deg) {
    const IndexTable table(stack, {wavelength_nm});
    std::vector<Polarized> out(1);
    power_spectrum(StackPower(stack), table, cos_of_incidence(angle_deg), {}, out);
    return {out.front().s.power, out.front().p.power, out.front().unpolarized()};
}

}  // namespace irido
