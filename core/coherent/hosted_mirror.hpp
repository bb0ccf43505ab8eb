#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/coherent/coherent.hpp"

namespace irido {

/// A two-layer mirror embedded in the material of one of its layers, the host.
struct HostedMirror {
    std::size_t host = 0, other = 0;  ///< indices into Stack::materials
    double host_nm = 0, other_nm = 0;
    std::uint64_t repeat = 1;
    /// False if anything else, such as more of the host, adjoins the periods: it leaves the powers
    /// alone but shifts the phase of the denominator.
    bool is_whole = true;

    /// Whether the closed form can supply the outputs requested: it has no r and t.
    bool serves(bool amplitudes, bool denominators) const {
        return !amplitudes && (is_whole || !denominators);
    }
};

/// Recognizes coherent elements that form such a mirror. They may start and end with the other
/// layer, giving it one layer more than the host, and the host may continue on both sides.
///   incident, substrate  indices of their materials
std::optional<HostedMirror> hosted_mirror(std::span<const Element> elements, std::size_t incident,
                                          std::size_t substrate);

/// Power of N periods embedded in the host. With q the ratio of the other layer's admittance to the
/// host's, a and b the phases k0 d kz of host and other layer, and K the Bloch phase,
///     R = C^2 U^2/(1 + C^2 U^2),   T = 1/(1 + C^2 U^2),   A = 0
///     C = (q - 1/q)/2 sin b,       U = sin(N K)/sin(K)
///     sin(K/2)^2 = F(q) F(1/q),   F(q) = sin a/2 cos b/2 + q cos a/2 sin b/2
///     cos(K/2)^2 = G(q) G(1/q),   G(q) = cos a/2 cos b/2 - q sin a/2 sin b/2
/// This form is free of cancellation at band edges, at closed gaps (U -> N) and at Brewster's
/// angle. In a gap T contains the factor exp(-2 N Im K) explicitly, so it stays accurate down to
/// 1e-300. For an evanescent layer b and q are imaginary, while C, F F' and G G' stay real.
///   mirror        as hosted_mirror() returns it
///   host, other   media of the two layers
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that the media were computed for
/// Returns nothing at 90 degrees, if a layer absorbs, or if the other layer is evanescent with
/// |b| > 300. R and T are as accurate as the problem is conditioned: a few roundings of the inputs.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 6.3; FPB24 (CGF 43(2), 2024),
/// eqs. 5 to 9, factored.
std::optional<Power> mirror_power(const HostedMirror& mirror, const Medium& host,
                                  const Medium& other, double k0, Polarization polarization);

}  // namespace irido
