#pragma once

#include <cstdint>
#include <span>

#include "core/coherent/coherent.hpp"
#include "core/stack/stack.hpp"

/// Independent checks of core's results, built on core's reference: different formulas, more
/// digits, no code shared with the kernel. They are slow and do not validate their input.
namespace irido::oracle {

/// A test point of a stack.
struct Query {
    double wavelength_nm = 550;
    double angle_deg = 0;
    Polarization polarization = Polarization::s;
};

/// reference_power in 100 digits. A non-zero `seed` shifts every input (indices, wavelength,
/// cosine, thicknesses) by a random relative 2^-53 or less; the scatter of the results shows how
/// well-conditioned the problem is.
Power coherent(const Stack& stack, const Query& query, std::uint64_t seed = 0);

/// The same with media in the kernel's form, eps and q2 exact.
///   above         incident medium
///   elements      of the stack, whose materials are indices into `media`
///   below         substrate
///   media         media of the layers
///   k0            2 pi / wavelength, 1/nm
///   polarization  s or p
Power coherent(const Medium& above, std::span<const Element> elements, const Medium& below,
               std::span<const Medium> media, double k0, Polarization polarization);

/// The same formulas in double; accurate to about 1e-13 on well-behaved stacks, and fast.
Power coherent_fast(const Stack& stack, const Query& query);

/// Largest change of R, and largest relative changes of T and A, under `draws` random shifts of the
/// inputs.
struct Scatter {
    double R = 0, T = 0, A = 0;
};
Scatter scatter(const Stack& stack, const Query& query, int draws = 4);

/// An incoherent layer (outside groups) as the mean of the coherent power over a full period of its
/// phase, by the trapezoid rule with `points` points, in long double. It converges as (|r|
/// |r'|)^points, where r and r' are the reflections on both sides of the layer. (The mean over
/// several phases is not the same as adding powers: paths that differ only in the order of their
/// round trips still interfere.)
Power incoherent(const Stack& stack, const Query& query, int points);

/// Mean over the Gaussian thickness distributions cut at zero, over 8 standard deviations, in long
/// double: Gauss-Legendre of order 20 on `panels` panels per such layer. Incoherent layers as
/// above.
///   stack   the stack
///   query   wavelength, angle and polarization
///   panels  per layer with a thickness distribution
///   points  per incoherent layer
Power spread(const Stack& stack, const Query& query, int panels, int points = 1);

}  // namespace irido::oracle
