#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/coherent/coherent.hpp"

namespace irido {

/// Periods of two layers between half-spaces of the material of one of them, the host.
struct HostedMirror {
    std::size_t host = 0, other = 0;  ///< indices into Stack::materials
    double host_nm = 0, other_nm = 0;
    std::uint64_t repeat = 1;
    /// There is nothing beside the periods, such as more of the host, which powers do not see but
    /// the denominator's phase does.
    bool is_whole = true;

    /// Whether the closed form has all that is asked for: it has no r and t.
    bool serves(bool amplitudes, bool denominators) const {
        return !amplitudes && (is_whole || !denominators);
    }
};

/// The mirror that coherent elements are, if they are one. They may begin and end with the other
/// layer, once more than with the host's, and the host may go on on both sides.
///   incident, substrate  indices of their materials
std::optional<HostedMirror> hosted_mirror(std::span<const Element> elements, std::size_t incident,
                                          std::size_t substrate);

/// Power of N periods in the host. With q the other layer's admittance over the host's, a and b the
/// phases k0 d kz of host and other layer, and the Bloch phase K,
///     R = C^2 U^2/(1 + C^2 U^2),   T = 1/(1 + C^2 U^2),   A = 0
///     C = (q - 1/q)/2 sin b,       U = sin(N K)/sin(K)
///     sin(K/2)^2 = F(q) F(1/q),   F(q) = sin a/2 cos b/2 + q cos a/2 sin b/2
///     cos(K/2)^2 = G(q) G(1/q),   G(q) = cos a/2 cos b/2 - q sin a/2 sin b/2
/// in which nothing cancels that a band edge, a closed gap (U -> N) or Brewster's angle could feel;
/// in gaps exp(-2 N Im K) stands in T as a factor, which keeps its digits down to 1e-300. An
/// evanescent layer has imaginary b and q, and real C, F F' and G G'.
///   host, other  media of the layers;  k0 = 2 pi / wavelength, 1/nm
/// Nothing where a layer absorbs, at 90 degrees, and where the other layer is evanescent with
/// |b| > 300. R and T are as good as the question: a few roundings of the inputs.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 6.3; FPB24 (CGF 43(2), 2024),
/// eqs. 5 to 9, factored.
std::optional<Power> mirror_power(const HostedMirror& mirror, const Medium& host,
                                  const Medium& other, double k0, Polarization polarization);

}  // namespace irido
