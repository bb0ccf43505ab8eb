#pragma once

#include <cstdint>
#include <span>

#include "core/coherent/layer.hpp"

namespace irido {

/// Matrix of layers and groups, from the incident side to the substrate.
Matrix matrix_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
                 Polarization polarization);

/// The same for wave_matrix().
Matrix wave_matrix_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
                      Polarization polarization, Complex y0);

/// The same as matrix_of() with the power they absorb.
Slab slab_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
             Polarization polarization);

/// The latter if any of them absorbs, else the former.
Slab coherent_slab(std::span<const Element> elements, std::span<const Medium> media, double k0,
                   Polarization polarization);

/// Entries beside I or -I below which these tell more of the Bloch phase than the trace.
inline constexpr double kNearlyIdentity = 0.5;

/// Bloch phase K of a period, cos(K) = tr(M)/2, by the squares of its half angle: each loses its
/// digits where it is formed from the other.
struct BlochPhase {
    Complex sin2;  ///< sin(K/2)^2 = (2 - tr M)/4
    Complex cos2;  ///< cos(K/2)^2 = (2 + tr M)/4
};

/// Of a group's period, whose matrix is matrix_of() its elements.
BlochPhase bloch_phase(const Group& group, const Matrix& period, std::span<const Medium> media,
                       double k0, Polarization polarization);

/// matrix^repeat, exact in the number of periods:
///     M^N = cos(N K) I + sin(N K)/sin(K) (M - cos(K) I)
/// with the growing exponential factored out; N in [1, 1e9] costs the same as 1.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), sections 4.5 and 6.2.
Matrix power(const Matrix& matrix, const BlochPhase& bloch, std::uint64_t repeat);

}  // namespace irido
