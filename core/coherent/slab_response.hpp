#pragma once

#include <span>

#include "core/coherent/layer.hpp"

namespace irido {

/// Absorptances above this are computed as 1 - R - T without loss of precision.
inline constexpr double kSubtractable = 0.01;

/// Beyond this growth, sums of fields lose the weaker wave, so the plain kernel switches to wave
/// amplitudes.
inline constexpr double kAmplified = 100;

/// x exp(exponent), where exp(exponent) alone may underflow.
double times_exp(double x, double exponent);

/// One wave in a medium: its tangential fields B : C, up to a common factor, and their flux
/// Re(conj(B) C).
struct Wave {
    Complex b, c;
    double flux;
};

/// The outgoing wave of a half-space: Im(kz) > 0, or Re(kz) > 0 where kz is real.
Wave outgoing_wave(const Medium& half_space, Polarization polarization);

/// kz / k0 of the forward wave in a layer: Re > 0 where it travels (Re q2 >= 0), so it grows in a
/// gain medium; Im > 0 where it is evanescent.
Complex onward_kz(const Medium& layer);
Wave onward_wave(const Medium& layer, Polarization polarization);

/// Response of a slab to the incident wave `in`, with `out` the wave transmitted. An incident wave
/// without flux is totally reflected. Throws DomainError at the lasing threshold of an amplifying
/// slab, where the powers are infinite.
Response slab_response(const Wave& in, const Slab& slab, const Wave& out);

/// The number that reflection and transmission are divided by. At a pole, which without gain is a
/// resonance that light hardly reaches, rounding may leave nothing of `sum`; as all powers are
/// divided by it and balanced(), any number does then.
///   sum, difference  of the incident and the reflected wave's parts of the fields at the top
Complex divisor_of(Complex sum, Complex difference);

/// What balanced() has to know of a slab and the wave below it.
struct FluxBalance {
    bool absorbs;  ///< or amplifies
    bool at_pole;  ///< divisor_of() is not the sum
    double out;    ///< of the transmitted wave
};

/// Powers that add up to 1: rounding errors of the common divisor, all there is to them near a pole
/// without gain, show up in the sum of the three. If nothing at all is left, light is reflected
/// before it gets there. Throws DomainError where gain makes them infinite.
///   power  A without `mixed`
///   mixed  mixed_power()
///   flux   see there
Power balanced(Power power, double mixed, const FluxBalance& flux);

/// Interference (cross) flux of the incident and reflected waves in an absorbing medium above the
/// slab, as a fraction of the incident power: part of A, but not of any layer's absorption.
double mixed_power(const Wave& in, Complex r);

/// coherent_response() between given waves instead of half-spaces.
///   in            incident wave
///   elements      layers and groups, from the incident side down
///   out           transmitted wave
///   media         one per material of the stack
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that the waves and `media` were computed for
Response coherent_response(const Wave& in, std::span<const Element> elements, const Wave& out,
                           std::span<const Medium> media, double k0, Polarization polarization);

/// Power absorbed in each layer, as a fraction of the incident power, from the fields at its lower
/// face.
///   in            incident wave
///   elements      layers and groups, from the incident side down
///   out           transmitted wave
///   media         one per material of the stack
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that the waves and `media` were computed for
///   absorbed      output, one per layer with groups expanded, top layer first
void coherent_layer_absorption(const Wave& in, std::span<const Element> elements, const Wave& out,
                               std::span<const Medium> media, double k0, Polarization polarization,
                               std::span<double> absorbed);

}  // namespace irido
