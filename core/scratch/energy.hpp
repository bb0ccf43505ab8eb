#pragma once

#include <span>

namespace irido {

/// How scratches and the surface they are in share the light.
enum class ScratchEnergy {
    balanced,  ///< nothing gained or lost, see below
    blend,     ///< VWH18: the base times 1 - rho with their rho, twice the area (eqs. 17 and 18)
    none,      ///< each as if the other did not exist
};

/// One kind of groove: its share rho of the area, and its path v at the mirror direction.
struct GrooveShare {
    double share;
    double path_um;
};

/// Factors of the base's BRDF and of the scratches'.
struct ScratchBalance {
    double base = 1, scratches = 1;
};

/// Exact for masks that turn the phase alone: with d = 1 - exp(2 pi i v nu) the mirror keeps
///     w_B = |1 - sum rho d|^2 = 1 - |d|^2 rho (1 - rho) for grooves of one depth,
/// so scratches, whose lobes hold sum rho |d|^2, get (1 - w_B)/sum rho |d|^2 of it.
///   overlap  the grooves lie at random, one over the other: all of them together cover
///            1 - exp(-sum rho); else the sum, at most 1
///   wavenumber_per_um > 0. Source: Parseval's theorem.
ScratchBalance scratch_balance(std::span<const GrooveShare> grooves, double wavenumber_per_um,
                               bool overlap, ScratchEnergy rule = ScratchEnergy::balanced);

}  // namespace irido
