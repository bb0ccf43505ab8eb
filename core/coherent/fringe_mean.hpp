#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/coherent/coherent.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// R and T of a stack as functions of the phase factors w of one or two of its elements, layers or
/// groups, that turn far faster with the wavelength than all the rest. Each element is taken apart
/// into its two Bloch waves (for a layer, its two plane waves); with w1 of the upper element and w2
/// of the lower one,
///     r = (s0 + s1 w1 + (s2 + s3 w1) w2) / (p0 + p1 w1 + (p2 + p3 w1) w2),
///     T = through / |p0 + p1 w1 + (p2 + p3 w1) w2|^2,   |w1| = |w2| = 1;
/// of one element, s2 = s3 = p2 = p3 = 0.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), sections 4.5 and 6.2.
struct FringeForm {
    std::array<Complex, 4> reflected{}, incident{};  ///< s and p
    /// Sizes of s1 p0 - s0 p1, and of (s2 + s3 w1) (p0 + p1 w1) - (s0 + s1 w1) (p2 + p3 w1), which
    /// is the same for all w1.
    double swing_1 = 0, swing_2 = 0;
    double through = 0;
    std::array<double, 2> turn{};     ///< phases of w1 and w2, for a group up to multiples of
    std::array<double, 2> wrapped{};  ///< this, which is 0 for a layer
    /// How much of each element's own phase its means keep, see fringe_mean().
    std::array<double, 2> own{};
    /// exp(log_scale) denominator has no poles, and its zeros lie next to narrow features of the
    /// means: band-gap edges, narrow bands, resonances of the other layers.
    Complex denominator{1};
    double log_scale = 0;
};

/// Form of coherent layers without gain; the incident light must carry power into the stack.
///   stack         coherent stack
///   fast          indices in stack.elements of one element, or of two, ascending
///   media         one per material, followed by the incident medium
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that `media` were computed for
FringeForm fringe_form(const Stack& stack, std::span<const std::size_t> fast,
                       std::span<const Medium> media, double k0, Polarization polarization);

/// R and T averaged over the phases of the fast elements, as if neighbouring wavelengths differed
/// in these alone.
struct FringeMean {
    double R = 0, T = 0;
    /// Bounds on how far the stack's R and T swing about these, [0, 1], if one element is averaged.
    double swing_R = 0, swing_T = 0;
    FringeForm form;  ///< of all fast elements
};

/// Means in closed form. With the phase of the last element averaged, R is a rational function of
/// w1 whose denominator |p0 + p1 w1|^2 - |p2 + p3 w1|^2 is kappa |1 + v w1|^2, |v| < 1 (theorem of
/// Fejer and Riesz). The mean over a group's phase does not exist inside a band gap or within a few
/// cycles of phase from its edge: there R and T blend smoothly into those at its own phase.
/// Arguments as those of fringe_form().
FringeMean fringe_mean(const Stack& stack, std::span<const std::size_t> fast,
                       std::span<const Medium> media, double k0, Polarization polarization);

/// The waves exp(i (m1 turn[0] + m2 turn[1])) that the means leave out:
///     R = mean + Re sum of R[h] wave_h,   T likewise.
struct FringeHarmonics {
    static constexpr int kMost = 6;  ///< largest |m1| and m2
    static constexpr std::size_t kOfOne = kMost, kOfTwo = kMost + kMost * (2 * kMost + 1);
    /// (1, 0) to (kMost, 0), then with m2 = 1 to kMost all m1 from -kMost on.
    struct Wave {
        int m1, m2;
    };
    static Wave wave(std::size_t h);

    std::array<Complex, kOfTwo> R{}, T{};
};

/// Harmonics of one element (the first kOfOne) or of two.
FringeHarmonics fringe_harmonics(const FringeForm& form, std::size_t elements);

}  // namespace irido
