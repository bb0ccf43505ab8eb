#pragma once

#include <cstddef>
#include <span>

#include "core/coherent/coherent.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// R and T of a stack averaged over the phase w of one element, a layer or a group, as if
/// wavelengths close by differed in that phase alone. With the element's two Bloch waves (the
/// layer's own two) as a basis, and Z the size of what comes back up to its top,
///     r = r0 + X w/(1 + q w),   t = t0/(1 + q w),   |w| = 1,   0 <= q < 1
/// so that the means are |r0|^2 + X^2/(1 - q^2) and |t0|^2/(1 - q^2), and the harmonics that are
/// left out fall as q^m. Where the phase is within a few turns of that at the edge of a group's
/// gap, and in gaps, there is no mean: R and T pass over to those of the stack, softly. Source: P.
/// Yeh, Optical Waves in Layered Media (1988), sections 4.5 and 6.2.
struct FringeMean {
    double R = 0, T = 0;
    double swing_R = 0, swing_T = 0;  ///< bounds of what R and T leave of the stack's, [0, 1]
    double phase = 0;                 ///< 2 N K, its speed being that of w, without the turns of K
    /// exp(log_scale) denominator has no poles, and zeros next to what is narrow in the means:
    /// edges of gaps, narrow bands, lines of the other layers.
    Complex denominator{1};
    double log_scale = 0;
};

/// Of coherent layers that do not amplify; the light carries power into the stack.
///   fast   index of the element among the stack's
///   media  one per material and, as its last, the incident one; k0 = 2 pi / wavelength, 1/nm
FringeMean fringe_mean(const Stack& stack, std::size_t fast, std::span<const Medium> media,
                       double k0, Polarization polarization);

}  // namespace irido
