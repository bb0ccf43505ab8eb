#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/math/simd_level.hpp"
#include "core/spectrum/stack_power.hpp"
#include "core/stack/index_table.hpp"
#include "core/vector/chain_program.hpp"
#include "core/vector/spread_program.hpp"

namespace irido {

/// Outputs requested. The others are not computed, unless they come along with a requested one.
struct Needs {
    bool s = true, p = true;  ///< if both, p is skipped at normal incidence unless:
    bool p_at_normal = true;
    bool R = true, T = true, A = true;
    bool amplitudes = false;    ///< r and t; needs a coherent stack of fixed thicknesses
    bool denominators = false;  ///< of Response
    bool layers = false;        ///< absorption of every layer
    /// Largest error of R and T where thicknesses are spread, by at most 1/spread_reach of them. If
    /// above 0, means are those of run_spread(), without A, with a DomainError where these are not
    /// known; if 0, they are those of StackPower.
    double spread_error = 0, spread_reach = 0;
};

/// Results of one polarization, [angle][wavelength]; empty if not requested.
struct Spectrum {
    std::vector<double> R, T, A;
    std::vector<Complex> r, t;
    std::vector<double> denominator_re, denominator_im, log_scale;  ///< of Response
    std::vector<double> A_layers;  ///< [layer][angle][wavelength], layers with groups written out

    /// Requires that R, T and A were requested.
    Power power(std::size_t point) const { return {R[point], T[point], A[point]}; }
};

struct Spectra {
    Spectrum s, p;
};

/// Cost report: how a request is computed, and which shortcuts its physics allows.
struct Work {
    std::size_t points = 0;
    SimdLevel kernel = SimdLevel::plain;  ///< plain if the vector kernel does not support the stack
    // of the vector kernel
    std::size_t passes = 0;              ///< 1; more if incoherent layers separate coherent blocks
    std::size_t layers = 0;              ///< computed, those of a period once
    std::size_t transparent_layers = 0;  ///< of these, in real arithmetic
    std::size_t distinct_layers = 0;     ///< matrices computed, if fewer
    std::size_t powers = 0;              ///< groups raised to their power in closed form
    std::size_t media = 0;               ///< of layers and substrate
    std::size_t constant_media = 0;      ///< of these, with angle terms computed once per angle
    bool one_film = false;               ///< the Airy sum
    bool mirror = false;                 ///< closed form of an embedded mirror
    std::size_t normal_angles = 0;       ///< where one polarization serves both
    bool absorbs = false;                ///< any layer
    double operations_per_point = 0;     ///< see vector/program.hpp
};
/// Cost of spectra() without computing them.
///   stack      power of the stack
///   table      its indices
///   incidence  directions of the light
///   needs      outputs requested
///   execution  threads and instruction set
Work work_of(const StackPower& stack, const IndexTable& table,
             std::span<const IncidentAngle> incidence, const Needs& needs,
             const Execution& execution = {1});

/// Points that differ in their wavelength or in their angle only.
struct SpectrumJob {
    bool along_angles;
    std::size_t fixed;  ///< index of the angle, or of the wavelength
    std::size_t begin, end;
};

/// Contribution of the layers that a family of stacks shares, at points of one angle.
struct FixedLayers {
    std::size_t points = 0;
    std::vector<double> numbers;  ///< see FixedPoints
};

/// Scratch buffers of one thread, reusable between calls.
struct SpectrumMemory {
    std::vector<SpectrumJob> jobs;
    PointRun run;
    std::vector<double> cosines, sines;
    std::vector<std::size_t> redo, redo_layers;
    RunMemory kernel;
    std::vector<FixedLayers> fixed;
    std::vector<const FixedLayers*> fixed_parts;
    std::vector<FixedPoints> fixed_points;
};

/// A stack prepared for many calls with tables of the same materials, which absorb and amplify only
/// where declared. Refers to the StackPower. Thread-safe.
class SpectrumKernel {
public:
    /// Throws DomainError if amplitudes are requested from a stack that has none, and as
    /// StackPower::require_layer_list() does if the absorption of each layer is requested.
    ///   stack               must outlive this object
    ///   absorbs, amplifies  per material, as in the IndexTables to come
    ///   needs               outputs requested
    ///   simd                instruction set
    ///   varied              elements of the stack, ascending, if update() will change no others;
    ///                       the rest is then computed separately, see shares_layers()
    SpectrumKernel(const StackPower& stack, const std::vector<bool>& absorbs,
                   const std::vector<bool>& amplifies, const Needs& needs, SimdLevel simd,
                   std::span<const std::size_t> varied = {});

    /// Call after assigning another stack of the same materials to the StackPower; memory is
    /// reused. Throws as the constructor does.
    void update();

    /// The same, for a stack of any other materials and needs, of which no elements are varied.
    void serve(const std::vector<bool>& absorbs, const std::vector<bool>& amplifies,
               const Needs& needs, SimdLevel simd);

    /// Whether layers that do not vary enter as FixedLayers: if that saves work, if the stack is a
    /// single coherent block that the vector kernel supports, and unless the absorption of
    /// absorbing layers is requested. Results then differ within rounding.
    bool shares_layers() const { return !fixed_.runs.empty(); }
    /// Computes the FixedLayers shared by all calls with this table and angle.
    ///   table      indices
    ///   incidence  direction of the light
    ///   out        result
    ///   memory     scratch
    void fix_layers(const IndexTable& table, IncidentAngle incidence, FixedLayers& out,
                    SpectrumMemory& memory) const;

    /// spectra() into reused memory; 0 threads: one per core.
    void operator()(const IndexTable& table, std::span<const IncidentAngle> incidence,
                    unsigned threads, Spectra& out) const;
    /// spectra() into reused memory, on this thread.
    void operator()(const IndexTable& table, std::span<const IncidentAngle> incidence, Spectra& out,
                    SpectrumMemory& memory) const;
    /// spectra() on this thread with given FixedLayers, which the calls above compute themselves.
    ///   table      indices
    ///   incidence  directions of the light
    ///   fixed      one or more per angle, whose points together are those of the table
    ///   out        results
    ///   memory     scratch
    void operator()(const IndexTable& table, std::span<const IncidentAngle> incidence,
                    std::span<const FixedLayers* const> fixed, Spectra& out,
                    SpectrumMemory& memory) const;

    /// Whether the vector kernel supports the stack, except for the largest phases.
    bool is_vectorized() const { return is_vectorized_; }

    /// StackPower::has_amplitudes().
    bool has_amplitudes() const { return stack_.has_amplitudes(); }

    /// StackPower::spread_layers().
    std::size_t spread_layers() const { return stack_.spread_layers(); }

    /// How such a call is computed.
    Work work(const IndexTable& table, std::span<const IncidentAngle> incidence) const;

private:
    bool by_vectors(const IndexTable& table) const;
    void prepare(const IndexTable& table, std::span<const IncidentAngle> incidence, Spectra& out,
                 std::vector<SpectrumJob>& jobs) const;
    void fix_all_layers(const IndexTable& table, std::span<const IncidentAngle> incidence,
                        SpectrumMemory& memory) const;
    void run(std::span<const SpectrumJob> jobs, const IndexTable& table,
             std::span<const IncidentAngle> incidence, std::span<const FixedLayers* const> fixed,
             Spectra& out, SpectrumMemory& memory) const;

    const StackPower& stack_;
    std::vector<bool> absorbs_, amplifies_;
    Needs needs_;
    SimdLevel simd_;
    FixedRuns fixed_;
    bool is_vectorized_ = false;
    ChainProgram program_;  ///< if it is
    bool has_means_ = false;
    SpreadProgram means_;  ///< if it has them
    ChainLayers layers_;   ///< likewise, if the absorption of each is requested
};

/// Spectra of a stack at all wavelengths of a table and all angles. Stacks of fixed thicknesses use
/// the vector kernel; thickness distributions and points that the vector kernel rejects go through
/// StackPower one by one. Throws DomainError if amplitudes are requested from a stack that has
/// none, and as StackPower does.
///   stack      power of the stack
///   table      its indices
///   incidence  directions; at normal incidence both polarizations are computed as one
///   needs      outputs requested
///   execution  threads and instruction set
Spectra spectra(const StackPower& stack, const IndexTable& table,
                std::span<const IncidentAngle> incidence, const Needs& needs,
                const Execution& execution = {1});

/// Spectra for cosines of the angles of incidence, [0, 1].
inline Spectra spectra(const StackPower& stack, const IndexTable& table,
                       std::span<const double> cos_theta, const Needs& needs,
                       const Execution& execution = {1}) {
    return spectra(stack, table, std::vector<IncidentAngle>(cos_theta.begin(), cos_theta.end()),
                   needs, execution);
}

/// Spectra into memory that is reused.
void spectra(const StackPower& stack, const IndexTable& table,
             std::span<const IncidentAngle> incidence, const Needs& needs,
             const Execution& execution, Spectra& out);

}  // namespace irido
