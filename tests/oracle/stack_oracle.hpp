#pragma once

#include <cstdint>
#include <span>

#include "core/coherent/coherent.hpp"
#include "core/stack/stack.hpp"

/// Second opinions on what core computes, built on core's reference: other formulas, more digits,
/// no code shared with the kernel. They are slow and trust their input.
namespace irido::oracle {

/// One question about a stack.
struct Query {
    double wavelength_nm = 550;
    double angle_deg = 0;
    Polarization polarization = Polarization::s;
};

/// reference_power in 100 digits. `seed` other than 0 shifts every input (indices, wavelength,
/// cosine, thicknesses) by a random relative 2^-53 or less: how far the answers scatter tells how
/// well the question is posed.
Power coherent(const Stack& stack, const Query& query, std::uint64_t seed = 0);

/// The same for media given as the kernel takes them, eps and q2 exact.
Power coherent(const Medium& above, std::span<const Element> elements, const Medium& below,
               std::span<const Medium> media, double k0, Polarization polarization);

/// The same formulas in double; good to about 1e-13 on tame stacks, and fast.
Power coherent_fast(const Stack& stack, const Query& query);

/// Largest change of R, and largest relative changes of T and A, under `draws` random shifts of the
/// inputs.
struct Scatter {
    double R = 0, T = 0, A = 0;
};
Scatter scatter(const Stack& stack, const Query& query, int draws = 4);

/// One incoherent layer (outside groups) as the mean of the coherent power over a full turn of its
/// phase, by the trapezoid rule with `points` points, in long double. It converges like
/// (|r| |r'|)^points, r and r' the reflections on both sides of the layer. (The mean over
/// several phases is not the same as adding powers: paths that differ in the order of their bounces
/// only still interfere.)
Power incoherent(const Stack& stack, const Query& query, int points);

/// Mean over the Gaussian spread of the thicknesses cut at zero, over 8 standard deviations, in
/// long double: Gauss-Legendre of order 20 on `panels` panels per spread layer. Incoherent layers
/// as above.
Power spread(const Stack& stack, const Query& query, int panels, int points = 1);

}  // namespace irido::oracle
