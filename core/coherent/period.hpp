#pragma once

#include <cstdint>
#include <span>

#include "core/coherent/layer.hpp"

namespace irido {

/// Characteristic matrix of layers and groups.
///   elements      from the incident side to the substrate
///   media         one per material of the stack
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that `media` were computed for
Matrix matrix_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
                 Polarization polarization);

/// Matrix of layers and groups acting on wave amplitudes, see wave_matrix().
///   elements      from the incident side to the substrate
///   media         one per material of the stack
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that `media` were computed for
///   y0            admittance of the reference medium, not 0
Matrix wave_matrix_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
                      Polarization polarization, Complex y0);

/// Characteristic matrix of layers and groups, and the power they absorb.
///   elements      from the incident side to the substrate
///   media         one per material of the stack
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that `media` were computed for
Slab slab_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
             Polarization polarization);

/// slab_of() if any element absorbs, else matrix_of() alone.
///   elements      from the incident side to the substrate
///   media         one per material of the stack
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that `media` were computed for
Slab coherent_slab(std::span<const Element> elements, std::span<const Medium> media, double k0,
                   Polarization polarization);

/// Where all entries of M -+ I are smaller than this, they determine the Bloch phase more
/// accurately than the trace does.
inline constexpr double kNearlyIdentity = 0.5;

/// Bloch phase K of a period, cos(K) = tr(M)/2, as both squares of its half angle: computing either
/// from the other loses precision.
struct BlochPhase {
    Complex sin2;  ///< sin(K/2)^2 = (2 - tr M)/4
    Complex cos2;  ///< cos(K/2)^2 = (2 + tr M)/4
};

/// Bloch phase of a group's period.
///   group         whose elements make up one period
///   period        their matrix, see matrix_of()
///   media         one per material of the stack
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that `media` were computed for
BlochPhase bloch_phase(const Group& group, const Matrix& period, std::span<const Medium> media,
                       double k0, Polarization polarization);

/// matrix^repeat in closed form:
///     M^N = cos(N K) I + sin(N K)/sin(K) (M - cos(K) I)
/// with the growing exponential factored out; N in [1, 1e9], at a cost independent of N. Source: P.
/// Yeh, Optical Waves in Layered Media (1988), sections 4.5 and 6.2.
Matrix power(const Matrix& matrix, const BlochPhase& bloch, std::uint64_t repeat);

}  // namespace irido
