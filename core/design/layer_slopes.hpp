#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/simd_level.hpp"

namespace irido {

/// A medium at the wavelengths of one run, for one angle and polarization: rows of
/// whole_vectors(count) numbers. q = kz/k0 with Im q >= 0, y = C/B of the wave that goes on (q for
/// s, eps/q for p), `inverse` is 1/y.
struct MediumRows {
    const double *q_re = nullptr, *q_im = nullptr;
    const double *y_re = nullptr, *y_im = nullptr;
    const double *inverse_re = nullptr, *inverse_im = nullptr;
    const double *n_re = nullptr, *n_im = nullptr;  ///< index
    bool is_real = false;                           ///< q real at all wavelengths
};

/// No slope is wanted.
inline constexpr std::size_t kNoSlot = static_cast<std::size_t>(-1);

/// A layer, once for all its repetitions.
struct RunLayer {
    MediumRows medium;
    double thickness_nm = 0;
    std::size_t thickness_slot = kNoSlot;
    std::size_t index_slot = kNoSlot;  ///< of its material, which others may share
};

/// Coherent layers between two half-spaces at one angle and polarization.
struct SlopeRun {
    std::size_t stride = 0;      ///< of rows: whole_vectors() of the wavelengths
    const double* k0 = nullptr;  ///< 2 pi / wavelength, 1/nm
    bool is_p = false;
    std::span<const RunLayer> layers;
    std::span<const std::uint32_t> sequence;  ///< places in `layers`, from the incident side
    const double* incident_y = nullptr;       ///< real, above 0
    MediumRows substrate;
    std::size_t substrate_slot = kNoSlot;
    std::size_t slots = 0;
    bool with_slopes = true;
    bool with_transmission = true;
    /// Slopes of r and of ln t, not of R and T.
    bool of_amplitudes = false;
};

/// Answers, rows of `stride` numbers; memory is used again.
struct SlopeAnswer {
    std::vector<double> r_re, r_im, t_re, t_im, R, T;
    /// [slot][re, im][stride]. Of amplitudes: dr/dx. Of powers, by a thickness in nm: dR/dx/2 in
    /// the real part; by an index: H, with dR = 2 Re(H dn).
    std::vector<double> reflected;
    std::vector<double> transmitted;  ///< the same of ln t, or of T

    const double* row(const std::vector<double>& all, std::size_t slot, bool imaginary,
                      std::size_t stride) const {
        return all.data() + (2 * slot + (imaginary ? 1 : 0)) * stride;
    }
};

/// Scratch memory of a run.
struct SlopeMemory {
    std::vector<double> turns, fields, products;
};

/// r, t (amplitudes of the tangential electric field), R, T and their derivatives by the thickness
/// of any layer and by the complex index of any medium but the incident one, all at a cost of less
/// than three evaluations. With fields (B, C) above layer j, D = y0 B + C at the top and the row
/// z = (y0 (1 - r), -(1 + r))/D, carried down through the matrices of the layers,
///     dr/dd_j = -i k0 q (z_B C / y + z_C B y),
/// since the generator of a layer commutes with its matrix; ln t has -(y0, 1)/D as its row. By an
/// index, dM_j stands between the row above and the fields below. The same bits at every level.
/// Errors are about 1e-14 of the largest value; layers whose q2 is below 1e-24 have that.
void layer_slopes(const SlopeRun& run, SlopeAnswer& answer, SlopeMemory& memory, SimdLevel simd);

}  // namespace irido
