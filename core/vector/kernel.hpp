#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "core/math/simd_level.hpp"
#include "core/vector/program.hpp"

namespace irido {

/// One number per point of a run, or a single one for all.
struct Stream {
    const double* values = nullptr;  ///< a run that varies can be read kMostLanes past its end
    bool varies = false;
};

/// Stored rows of all FixedRuns of a program at some points: [vector of kMostLanes points][row],
/// with kMostLanes numbers per row.
struct FixedPoints {
    const double* numbers = nullptr;
    std::size_t count = 0;  ///< of points
};

/// Points that the vector kernel processes in one call.
struct PointRun {
    std::size_t count = 0;
    Stream k0;         ///< 2 pi / wavelength, 1/nm
    Stream incident;   ///< real index n0
    Stream cos_theta;  ///< in (0, 1]
    Stream sin_theta;
    std::vector<Stream> n, k;  ///< one per material
    /// Extraordinary indices, one per material, without values for isotropic ones; empty unless the
    /// run is of p alone and some medium is uniaxial.
    std::vector<Stream> extraordinary_n, extraordinary_k;
    /// Index into them of the medium above the layers; nothing for the incident medium. Its wave is
    /// the one that travels or decays downwards, and k >= 0.
    std::optional<std::size_t> above;
    /// All points, one part after the other, if the program has FixedRuns, and their rows.
    std::span<const FixedPoints> fixed;
    std::size_t fixed_rows = 0;
};

/// Destinations of one polarization's results, nullptr if not needed; the value of point i goes to
/// index i * stride.
struct RunOutput {
    double *R = nullptr, *T = nullptr, *A = nullptr;
    Complex *r = nullptr, *t = nullptr;
    double *denominator_re = nullptr, *denominator_im = nullptr, *log_scale = nullptr;
    std::size_t stride = 1;
};

/// Destination of the power absorbed in each layer in one polarization: that of a layer at point i
/// goes to index layer * layer_stride + i * stride.
struct LayerOutput {
    double* A;
    std::size_t layer_stride, stride;
};

/// Scratch buffers, reusable between runs.
struct RunMemory {
    std::vector<double> records, absorbed;
    std::vector<char> evanescent;
    std::vector<std::size_t> varying;
};

/// coherent_response() for many points at once. The result of a lane does not depend on the other
/// lanes. R, T and A agree with coherent_response() to the digits that the problem's conditioning
/// permits.
///   program  compiled layers
///   run      points
///   s, p     outputs, nullptr for a polarization that is not needed
///   redo     receives the points that need the plain kernel (result not finite, or exponents too
///            large)
///   memory   scratch
///   level    instruction set
void run_program(const Program& program, const PointRun& run, const RunOutput* s,
                 const RunOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
                 SimdLevel level);

/// coherent_layer_absorption() for many points at once, in terms of the incident power.
///   layers  compiled layers
///   run     points
///   s, p    outputs, nullptr for a polarization that is not needed
///   redo    receives the points that need the plain kernel
///   memory  scratch
///   level   instruction set
void run_layers(const LayerProgram& layers, const PointRun& run, const LayerOutput* s,
                const LayerOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
                SimdLevel level);

/// Stores the rows of a FixedRun at all points. Points that need the plain kernel get NaN.
///   fixed   elements to store
///   run     points
///   s, p    polarizations to store
///   rows    number of rows of all FixedRuns of the program
///   to      room for FixedPoints::numbers
///   memory  scratch
///   level   instruction set
void store_fixed(const FixedRun& fixed, const PointRun& run, bool s, bool p, std::size_t rows,
                 double* to, RunMemory& memory, SimdLevel level);

}  // namespace irido
