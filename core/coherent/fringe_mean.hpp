#pragma once

#include <cstddef>
#include <span>

#include "core/coherent/coherent.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// R and T of a stack averaged over the phase factor w of one element, a layer or a group, as if
/// neighbouring wavelengths differed in that phase alone. In the basis of the element's two Bloch
/// waves (for a layer, its two plane waves),
///     r = r0 + X w/(1 + q w),   t = t0/(1 + q w),   |w| = 1,   0 <= q < 1
/// so the means are |r0|^2 + X^2/(1 - q^2) and |t0|^2/(1 - q^2), and the harmonics left out decay
/// as q^m. The mean does not exist inside a group's band gap or within a few cycles of phase from
/// its edge: there R and T blend smoothly into those of the stack.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), sections 4.5 and 6.2.
struct FringeMean {
    double R = 0, T = 0;
    double swing_R = 0, swing_T = 0;  ///< bounds on how far the stack's R and T swing about these,
                                      ///< [0, 1]
    double phase = 0;                 ///< 2 N K, advancing as fast as w; whole turns of K are
                                      ///< dropped
    /// exp(log_scale) denominator has no poles, and its zeros lie next to narrow features of the
    /// means: band-gap edges, narrow bands, resonances of the other layers.
    Complex denominator{1};
    double log_scale = 0;
};

/// Fringe mean of coherent layers without gain; the incident light must carry power into the stack.
///   stack         coherent stack
///   fast          index of the averaged element in stack.elements
///   media         one per material, followed by the incident medium
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that `media` were computed for
FringeMean fringe_mean(const Stack& stack, std::size_t fast, std::span<const Medium> media,
                       double k0, Polarization polarization);

}  // namespace irido
