#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/simd_level.hpp"

namespace irido {

/// A medium at all wavelengths of a run, for one angle and polarization, as rows of
/// whole_vectors(count) numbers: q = kz/k0 with Im q >= 0, y = C/B of the forward wave (q for s,
/// eps/q for p), and `inverse` = 1/y.
struct MediumRows {
    const double *q_re = nullptr, *q_im = nullptr;
    const double *y_re = nullptr, *y_im = nullptr;
    const double *inverse_re = nullptr, *inverse_im = nullptr;
    const double *n_re = nullptr, *n_im = nullptr;  ///< index
    bool is_real = false;                           ///< q real at all wavelengths
};

/// Marks a derivative that is not requested.
inline constexpr std::size_t kNoSlot = static_cast<std::size_t>(-1);

/// A layer, listed once for all its repetitions.
struct RunLayer {
    MediumRows medium;
    double thickness_nm = 0;
    std::size_t thickness_slot = kNoSlot;
    std::size_t index_slot = kNoSlot;  ///< of its material, possibly shared with other layers
};

/// Coherent layers between two half-spaces at one angle and polarization.
struct SlopeRun {
    std::size_t stride = 0;      ///< of rows: whole_vectors() of the number of wavelengths
    const double* k0 = nullptr;  ///< 2 pi / wavelength, 1/nm
    bool is_p = false;
    std::span<const RunLayer> layers;
    std::span<const std::uint32_t> sequence;  ///< indices into `layers`, from the incident side
    const double* incident_y = nullptr;       ///< real, > 0
    MediumRows substrate;
    std::size_t substrate_slot = kNoSlot;
    std::size_t slots = 0;
    bool with_slopes = true;
    bool with_transmission = true;
    /// Derivatives of r and ln t instead of R and T.
    bool of_amplitudes = false;
};

/// Results, in rows of `stride` numbers; memory is reused.
struct SlopeAnswer {
    std::vector<double> r_re, r_im, t_re, t_im, R, T;
    /// [slot][re, im][stride]. For amplitudes: dr/dx. For powers: with respect to a thickness in
    /// nm, dR/dx/2 in the real part; with respect to an index, H with dR = 2 Re(H dn).
    std::vector<double> reflected;
    std::vector<double> transmitted;  ///< likewise for ln t, or T

    /// One row of `reflected` or `transmitted`.
    ///   all        which of them
    ///   slot       derivative
    ///   imaginary  the imaginary instead of the real part
    ///   stride     that of the run
    const double* row(const std::vector<double>& all, std::size_t slot, bool imaginary,
                      std::size_t stride) const {
        return all.data() + (2 * slot + (imaginary ? 1 : 0)) * stride;
    }
};

/// Scratch memory of a run.
struct SlopeMemory {
    std::vector<double> turns, fields, products;
};

/// r, t (of the tangential electric field), R, T and their derivatives with respect to the
/// thickness of any layer and the complex index of any medium except the incident one, at the cost
/// of less than three evaluations. With fields (B, C) above layer j, D = y0 B + C at the top, and
/// the row vector z = (y0 (1 - r), -(1 + r))/D propagated down through the layer matrices,
///     dr/dd_j = -i k0 q (z_B C / y + z_C B y),
/// since the generator of a layer commutes with its matrix; for ln t the row starts as -(y0, 1)/D.
/// For an index, dM_j is sandwiched between the row above and the fields below. Bit-identical at
/// every SIMD level. Errors are about 1e-14 of the largest value; |q2| is raised to at least 1e-24.
///   run     layers, media and the derivatives requested
///   answer  results
///   memory  scratch, reusable for any run
///   simd    instruction set
void layer_slopes(const SlopeRun& run, SlopeAnswer& answer, SlopeMemory& memory, SimdLevel simd);

}  // namespace irido
