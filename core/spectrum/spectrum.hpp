#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/math/simd_level.hpp"
#include "core/spectrum/stack_power.hpp"
#include "core/stack/index_table.hpp"
#include "core/vector/chain_program.hpp"

namespace irido {

/// What a request needs. What is false is not computed, except that quantities may come along with
/// another one that is needed.
struct Needs {
    bool s = true, p = true;  ///< if both, p is left open at normal incidence unless:
    bool p_at_normal = true;
    bool R = true, T = true, A = true;
    bool amplitudes = false;    ///< r and t; of coherent stacks without spread thicknesses only
    bool denominators = false;  ///< of Response
    bool layers = false;        ///< absorption of every layer
};

/// Quantities of one polarization at every point, [angle][wavelength]; empty where not asked for.
struct Spectrum {
    std::vector<double> R, T, A;
    std::vector<Complex> r, t;
    std::vector<double> denominator_re, denominator_im, log_scale;  ///< of Response
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
    bool mirror = false;                 ///< Yeh's closed form of periods in their host
    std::size_t normal_angles = 0;       ///< one polarization serves both
    bool absorbs = false;                ///< any layer
    double operations_per_point = 0;     ///< see vector/program.hpp
};
Work work_of(const StackPower& stack, const IndexTable& table,
             std::span<const IncidentAngle> incidence, const Needs& needs,
             const Execution& execution = {1});

/// Points that differ in their wavelength or in their angle only.
struct SpectrumJob {
    bool along_angles;
    std::size_t fixed;  ///< index of the angle, or of the wavelength
    std::size_t begin, end;
};

/// What the layers do that a family of stacks has in common, at points of one angle.
struct FixedLayers {
    std::size_t points = 0;
    std::vector<double> numbers;  ///< see FixedPoints
};

/// Scratch memory of calls that follow each other on one thread; its content means nothing.
struct SpectrumMemory {
    std::vector<SpectrumJob> jobs;
    PointRun run;
    std::vector<double> cosines, sines;
    std::vector<std::size_t> redo;
    RunMemory kernel;
    std::vector<FixedLayers> fixed;
    std::vector<const FixedLayers*> fixed_parts;
    std::vector<FixedPoints> fixed_points;
};

/// A stack made ready for many calls with tables of the same materials, whose absorption and
/// amplification is nowhere more than stated. Refers to the StackPower. Safe from many threads.
class SpectrumKernel {
public:
    ///   absorbs, amplifies  as of the IndexTables to come, one per material
    ///   varied              elements of the stack, ascending, if these are all that update() will
    ///                       find different: what the others do is computed apart, see
    ///                       shares_layers()
    /// Throws DomainError if amplitudes are needed of a stack that has none.
    SpectrumKernel(const StackPower& stack, const std::vector<bool>& absorbs,
                   const std::vector<bool>& amplifies, const Needs& needs, SimdLevel simd,
                   std::span<const std::size_t> varied = {});

    /// To be called when the StackPower has become that of another stack of the same materials;
    /// memory is used again. Throws as above.
    void update();

    /// Whether layers that do not vary enter as FixedLayers: where these save work, with a single
    /// coherent block for the vector kernel, and unless the absorption of absorbing layers is
    /// needed. Results differ from those without in roundings.
    bool shares_layers() const { return !fixed_.runs.empty(); }
    /// The FixedLayers of all calls with this table and angle, whatever the varied layers.
    void fix_layers(const IndexTable& table, IncidentAngle incidence, FixedLayers& out,
                    SpectrumMemory& memory) const;

    /// As spectra(), into memory that is used again; threads as in Execution.
    void operator()(const IndexTable& table, std::span<const IncidentAngle> incidence,
                    unsigned threads, Spectra& out) const;
    /// The same on this thread.
    void operator()(const IndexTable& table, std::span<const IncidentAngle> incidence, Spectra& out,
                    SpectrumMemory& memory) const;
    /// The same with the FixedLayers given, which the two above compute for themselves: one or more
    /// for each angle, whose points add up to those of the table.
    void operator()(const IndexTable& table, std::span<const IncidentAngle> incidence,
                    std::span<const FixedLayers* const> fixed, Spectra& out,
                    SpectrumMemory& memory) const;

    /// Whether the vector kernel takes the stack, but for the largest phases.
    bool is_vectorized() const { return is_vectorized_; }

    /// How the call above goes about it.
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
};

/// The batch form of the kernel: a stack at all wavelengths of the table and all angles.
///   incidence  at normal incidence both polarizations are one computation
/// Stacks of fixed thicknesses go through the vector kernel; spread ones, A_layers and what the
/// vector kernel leaves go through StackPower one by one. Throws DomainError if amplitudes are
/// needed of a stack that has none, and as StackPower does.
Spectra spectra(const StackPower& stack, const IndexTable& table,
                std::span<const IncidentAngle> incidence, const Needs& needs,
                const Execution& execution = {1});

/// The same for the cosines of the angles of incidence, [0, 1].
inline Spectra spectra(const StackPower& stack, const IndexTable& table,
                       std::span<const double> cos_theta, const Needs& needs,
                       const Execution& execution = {1}) {
    return spectra(stack, table, std::vector<IncidentAngle>(cos_theta.begin(), cos_theta.end()),
                   needs, execution);
}

/// The same into memory that is used again.
void spectra(const StackPower& stack, const IndexTable& table,
             std::span<const IncidentAngle> incidence, const Needs& needs,
             const Execution& execution, Spectra& out);

}  // namespace irido
