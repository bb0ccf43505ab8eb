#pragma once

#include <span>

#include "core/coherent/layer.hpp"

namespace irido {

/// An absorption above this loses nothing as 1 - R - T.
inline constexpr double kSubtractable = 0.01;

/// Where light grows by more than this, sums of fields lose the wave that is weak in them, and the
/// plain kernel takes waves instead.
inline constexpr double kAmplified = 100;

/// x exp(exponent), where exp(exponent) alone may underflow.
double times_exp(double x, double exponent);

/// One wave of a medium: its tangential fields B : C, up to a common factor, and the flux
/// Re(conj(B) C) of that.
struct Wave {
    Complex b, c;
    double flux;
};

/// The wave that travels or decays away in a half-space: Im(kz) > 0, or Re(kz) > 0 where it is
/// real.
Wave outgoing_wave(const Medium& half_space, Polarization polarization);

/// kz / k0 of the wave that goes on in a layer: Re > 0 where it travels (Re q2 >= 0), so that it
/// grows in a medium that amplifies, Im > 0 where it does not.
Complex onward_kz(const Medium& layer);
Wave onward_wave(const Medium& layer, Polarization polarization);

/// What a slab does to the wave `in` that meets it, when `out` leaves it. A wave without flux is
/// wholly reflected. Throws DomainError at the laser threshold of a slab that amplifies, where no
/// power is finite.
Response slab_response(const Wave& in, const Slab& slab, const Wave& out);

/// Power that the interference of the incident and the reflected wave takes out of an absorbing
/// medium above the slab, as part of the incident power: it is in A, and in no layer of the slab.
double mixed_power(const Wave& in, Complex r);

/// coherent_response() between given waves instead of half-spaces.
Response coherent_response(const Wave& in, std::span<const Element> elements, const Wave& out,
                           std::span<const Medium> media, double k0, Polarization polarization);

/// Power absorbed in every layer of such a stack, as part of the incident one, by the fields at its
/// lower face. `absorbed` has one entry a layer with groups written out, the first one's first.
void coherent_layer_absorption(const Wave& in, std::span<const Element> elements, const Wave& out,
                               std::span<const Medium> media, double k0, Polarization polarization,
                               std::span<double> absorbed);

}  // namespace irido
