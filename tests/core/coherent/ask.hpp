#pragma once

#include <span>

#include "core/spectrum/spectrum.hpp"
#include "core/spectrum/stack_power.hpp"

namespace irido {

/// Powers of the two polarizations.
struct Powers {
    Power s, p, u;
};

/// Powers of both polarizations at one wavelength and angle, through core's public interface.
inline Powers ask(const Stack& stack, double wavelength_nm, double angle_deg) {
    const IndexTable table(stack, {wavelength_nm});
    const double cosine = cos_of_incidence(angle_deg);
    const Spectra at = spectra(StackPower(stack), table, std::span(&cosine, 1), {});
    const Power s = at.s.power(0), p = at.p.power(0);
    return {s, p, {(s.R + p.R) / 2, (s.T + p.T) / 2, (s.A + p.A) / 2}};
}

}  // namespace irido
