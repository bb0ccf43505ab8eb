#pragma once

#include <span>
#include <vector>

#include "core/complex.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// An incident medium with |k| below this counts as transparent: its waves are those of the real
/// index, and its own absorption is not reported.
inline constexpr double kTransparentBelow_k = 1e-3;

/// Complex index of each material of a stack at each wavelength, computed once for all angles.
class IndexTable {
public:
    /// Throws DomainError as index_at() does, and if the incident medium's |k| reaches
    /// kTransparentBelow_k at one of the wavelengths (a smaller k is ignored).
    IndexTable(const Stack& stack, std::vector<double> wavelength_nm);

    /// Turns this into the table of a stack of constant indices at other wavelengths (not checked),
    /// copied from a table of that stack; reuses memory.
    void assign(const IndexTable& constant,
                std::span<const std::vector<double>* const> wavelengths);
    /// Concatenates tables of the same stack; reuses memory.
    void assign(std::span<const IndexTable* const> parts);

    /// Replaces one material's indices, one per wavelength (not checked). They may absorb or
    /// amplify only where the old ones did.
    void replace(std::size_t material, std::span<const Complex> index);

    const std::vector<double>& wavelength_nm() const { return wavelength_nm_; }
    std::size_t materials() const { return materials_; }
    /// Complex index of one material.
    ///   material    its index, or a row of extraordinary()
    ///   wavelength  index into wavelength_nm()
    Complex index(std::size_t material, std::size_t wavelength) const {
        return {n(material, wavelength), k(material, wavelength)};
    }
    /// Real and imaginary part of index().
    double n(std::size_t material, std::size_t wavelength) const {
        return n_[rows_[material].at(wavelength)];
    }
    double k(std::size_t material, std::size_t wavelength) const {
        return k_[rows_[material].at(wavelength)];
    }
    /// The values of one material from a wavelength on, readable kMostLanes past the last of them;
    /// a single value if row_varies() is false.
    ///   material    its index, or a row of extraordinary()
    ///   wavelength  index into wavelength_nm()
    const double* n_from(std::size_t material, std::size_t wavelength) const {
        return n_.data() + rows_[material].at(wavelength);
    }
    const double* k_from(std::size_t material, std::size_t wavelength) const {
        return k_.data() + rows_[material].at(wavelength);
    }
    /// Whether a row's values differ from wavelength to wavelength.
    bool row_varies(std::size_t row) const { return rows_[row].varies; }
    std::size_t incident() const { return incident_; }
    /// Whether any material is uniaxial: index() is then that of s waves.
    bool is_uniaxial() const { return rows_.size() > materials_; }
    /// The row that holds a material's extraordinary index: its own, or one after all materials.
    std::size_t extraordinary(std::size_t material) const { return extraordinary_[material]; }
    /// 2 pi / wavelength, 1/nm.
    const std::vector<double>& k0() const { return k0_; }
    /// Upper bound on k0 |n + ik| over all materials, 1/nm.
    double largest_wavenumber() const { return largest_wavenumber_; }
    /// Whether the material's indices are the same at all wavelengths.
    bool is_constant(std::size_t material) const {
        return !rows_[material].varies && !rows_[extraordinary_[material]].varies;
    }
    /// Per material: whether any of its indices has an imaginary part.
    const std::vector<bool>& absorbs() const { return absorbs_; }
    /// Per material: whether any of these is negative.
    const std::vector<bool>& amplifies() const { return amplifies_; }

private:
    /// One value for all wavelengths, or one for each.
    struct Row {
        std::size_t first;
        bool varies;
        std::size_t at(std::size_t wavelength) const { return varies ? first + wavelength : first; }
    };

    void clear_rows();
    Row new_row(std::size_t places);
    void set(std::size_t row, std::size_t wavelength, Complex index);
    void note_sign(std::size_t material, Complex index);
    void resize_like(const IndexTable& model, std::size_t count);

    std::vector<double> wavelength_nm_;
    std::size_t materials_, incident_;
    std::vector<std::size_t> extraordinary_;  ///< row of each material
    double largest_wavenumber_ = 0;
    std::vector<Row> rows_;  ///< of the materials, then of the extraordinary indices
    // all three are readable kMostLanes past their end
    std::vector<double> n_, k_, k0_;
    std::vector<bool> absorbs_, amplifies_;
};

}  // namespace irido
