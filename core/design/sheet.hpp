#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/coherent/coherent.hpp"
#include "core/design/design_problem.hpp"
#include "core/design/layer_slopes.hpp"
#include "core/design/written_out.hpp"

namespace irido {

/// Indices of a stack's materials over wavelength, and their derivatives with respect to material
/// parameters. Rows are whole_vectors() long, padded with the last value.
struct IndexGrid {
    std::vector<double> wavelength_nm;
    std::size_t stride = 0;
    std::vector<double> k0;
    std::vector<std::vector<double>> n_re, n_im;          ///< [material]
    std::vector<std::vector<double>> slope_re, slope_im;  ///< [number], of the parameters given

    /// Throws DomainError as IndexTable does.
    IndexGrid(const Stack& stack, std::vector<double> wavelengths_nm,
              std::span<const MaterialNumber> numbers);

    /// Recomputes one material of the stack and the derivatives with respect to its parameters.
    void update(const Stack& stack, std::size_t material, std::span<const MaterialNumber> numbers);
};

/// The derivatives requested.
struct SlopeSlots {
    std::vector<std::size_t> of_layer;     ///< by thickness, [expanded layer], or kNoSlot
    std::vector<std::size_t> of_material;  ///< by index, [material], or kNoSlot
    std::size_t count = 0;
};

/// Whether a quantity derives from amplitudes: psi, delta or a phase.
bool needs_amplitudes(DesignQuantity quantity);

/// A stack at one angle and the wavelengths of a grid, in both polarizations. Across incoherent
/// layers powers add, not amplitudes; see StackPower.
class Sheet {
public:
    struct Needs {
        bool s = false, p = false, amplitudes = false, transmission = false;
    };

    Sheet(const IndexGrid& grid, double angle_deg) : grid_(&grid), angle_deg_(angle_deg) {}

    const IndexGrid& grid() const { return *grid_; }
    double angle_deg() const { return angle_deg_; }
    std::size_t count() const { return grid_->wavelength_nm.size(); }

    Needs needs;
    /// Whether T and its derivatives follow from T = 1 - R.
    bool is_lossless = false;

    /// Sets the media of all of the stack's materials, or of one.
    void set_media(const Stack& stack);
    void set_medium(const Stack& stack, std::size_t material);
    /// Prepares for layers of these materials; call after set_media().
    void set_layers(const Stack& stack, const WrittenOut& written, const SlopeSlots& slots);

    /// Computes answer() for the polarizations needed.
    ///   written      layers and their current thicknesses
    ///   slots        derivatives requested
    ///   with_slopes  whether to compute derivatives
    ///   simd         instruction set
    void compute(const WrittenOut& written, const SlopeSlots& slots, bool with_slopes,
                 SimdLevel simd);

    /// Whether light travels without loss in every incoherent layer, as compute() requires.
    bool has_clear_gaps(const WrittenOut& written) const;

    /// Result for s or p; at normal incidence both are that of s.
    const SlopeAnswer& answer(Polarization polarization) const {
        return answers_[is_p(polarization) ? 1 : 0];
    }

    /// Adds the outputs that a target's entries require.
    static void add_needs(const DesignTarget& target, Needs& needs);

private:
    struct Rows {
        std::array<std::vector<double>, 2> q, n;                       ///< real, imaginary
        std::array<std::array<std::vector<double>, 2>, 2> y, inverse;  ///< of s and p
        bool is_real = true;
    };
    bool is_p(Polarization polarization) const {
        return polarization == Polarization::p && angle_deg_ > 0;
    }
    MediumRows rows_of(std::size_t material, bool p) const;
    SlopeRun run_of(const SlopeSlots& slots, bool with_slopes, bool p) const;
    void compute_chain(const WrittenOut& written, const SlopeSlots& slots, bool with_slopes, bool p,
                       SimdLevel simd);
    void add_block(const SlopeAnswer& block, const SlopeAnswer& from_below, SlopeAnswer& all) const;

    const IndexGrid* grid_;
    double angle_deg_;
    std::vector<Rows> media_;  ///< [material]
    std::array<std::vector<double>, 2> incident_y_;
    std::array<std::vector<RunLayer>, 2> layers_;
    std::size_t incident_ = 0, substrate_ = 0;
    std::array<SlopeAnswer, 2> answers_;
    std::array<SlopeAnswer, 2> block_;  ///< one block, for light from above and from below
    SlopeMemory memory_;
};

}  // namespace irido
