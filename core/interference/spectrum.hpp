#pragma once

#include <span>
#include <vector>

#include "core/interference/index_table.hpp"
#include "core/interference/stack_power.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

/// What a request needs. What is false is not computed, except that quantities may come along with
/// another one that is needed.
struct Needs {
    bool s = true, p = true;
    bool R = true, T = true, A = true;
    bool amplitudes = false;    ///< r and t; of coherent stacks without spread thicknesses only
    bool denominators = false;  ///< of Response
    bool layers = false;        ///< absorption of every layer
};

/// Quantities of one polarization at every point, [angle][wavelength]; empty where not asked for.
struct Spectrum {
    std::vector<double> R, T, A;
    std::vector<Complex> r, t;
    std::vector<Complex> denominator;  ///< times exp(log_scale)
    std::vector<double> log_scale;
    std::vector<double> A_layers;  ///< [layer][angle][wavelength], layers with groups written out

    /// Where R, T and A were asked for.
    Power power(std::size_t point) const { return {R[point], T[point], A[point]}; }
};

struct Spectra {
    Spectrum s, p;
};

/// How a request is computed, and what its physics makes needless.
struct Work {
    std::size_t points = 0;
    SimdLevel kernel = SimdLevel::plain;  ///< plain where the vector kernel does not take the stack
    // of the vector kernel
    std::size_t passes = 0;              ///< 1; more if incoherent layers part coherent blocks
    std::size_t layers = 0;              ///< that are computed, those of a period once
    std::size_t transparent_layers = 0;  ///< of these: in real arithmetic
    std::size_t distinct_layers = 0;     ///< matrices computed, where that is less
    std::size_t powers = 0;              ///< groups raised to their power in closed form
    std::size_t media = 0;               ///< of layers and substrate
    std::size_t constant_media = 0;      ///< of these: angle terms once an angle
    bool one_film = false;               ///< the Airy sum
    std::size_t normal_angles = 0;       ///< one polarization serves both
    bool absorbs = false;                ///< any layer
    double operations_per_point = 0;     ///< see vector/program.hpp
};
Work work_of(const StackPower& stack, const IndexTable& table, std::span<const double> cos_theta,
             const Needs& needs, const Execution& execution = {1});

/// The batch form of the kernel: a stack at all wavelengths of the table and all angles.
///   cos_theta  of the angles of incidence, [0, 1]; at 1 both polarizations are one computation
/// Stacks of fixed thicknesses go through the vector kernel; spread ones, A_layers and what the
/// vector kernel leaves go through StackPower one by one. Throws DomainError if amplitudes are
/// needed of a stack that has none, and as StackPower does.
Spectra spectra(const StackPower& stack, const IndexTable& table, std::span<const double> cos_theta,
                const Needs& needs, const Execution& execution = {1});

/// The same into memory that is used again.
void spectra(const StackPower& stack, const IndexTable& table, std::span<const double> cos_theta,
             const Needs& needs, const Execution& execution, Spectra& out);

}  // namespace irido
