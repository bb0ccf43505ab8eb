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
    /// Real and imaginary part of one material's index, per wavelength.
    std::span<const double> n(std::size_t material) const { return row(n_, material); }
    std::span<const double> k(std::size_t material) const { return row(k_, material); }
    Complex index(std::size_t material, std::size_t wavelength) const {
        return {n(material)[wavelength], k(material)[wavelength]};
    }
    std::size_t incident() const { return incident_; }
    /// Whether any material is uniaxial: index() is then that of s waves.
    bool is_uniaxial() const { return rows_ > materials_; }
    /// The row of n(row) and k(row) that holds a material's extraordinary index: its own, or one
    /// after all materials.
    std::size_t extraordinary(std::size_t material) const { return extraordinary_[material]; }
    /// 2 pi / wavelength, 1/nm.
    const std::vector<double>& k0() const { return k0_; }
    /// Upper bound on k0 |n + ik| over all materials, 1/nm.
    double largest_wavenumber() const { return largest_wavenumber_; }
    /// Whether the material's indices are the same at all wavelengths.
    bool is_constant(std::size_t material) const { return constant_[material]; }
    /// Per material: whether any of its indices has an imaginary part.
    const std::vector<bool>& absorbs() const { return absorbs_; }
    /// Per material: whether any of these is negative.
    const std::vector<bool>& amplifies() const { return amplifies_; }

private:
    void resize_like(const IndexTable& model, std::size_t count);
    std::span<const double> row(const std::vector<double>& values, std::size_t material) const {
        return {values.data() + material * wavelength_nm_.size(), wavelength_nm_.size()};
    }

    std::vector<double> wavelength_nm_;
    std::size_t materials_, incident_;
    std::vector<std::size_t> extraordinary_;  ///< row of each material
    std::size_t rows_;                        ///< number of materials plus distinct extraordinary
                                              ///< indices
    double largest_wavenumber_ = 0;
    // n_ and k_ are [row][wavelength]; all three are readable kMostLanes past their end
    std::vector<double> n_, k_, k0_;
    std::vector<bool> constant_, absorbs_, amplifies_;
};

}  // namespace irido
