#pragma once

#include <span>
#include <vector>

#include "core/complex.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// |k| below which an incident medium passes as transparent: its waves are those of a real index,
/// and what it absorbs on its own path is not part of any answer.
inline constexpr double kTransparentBelow_k = 1e-3;

/// Complex index of every material of a stack at every wavelength, computed once for all angles.
class IndexTable {
public:
    /// Throws DomainError as index_at does, and if the incident medium's |k| is not below
    /// kTransparentBelow_k at one of the wavelengths (a smaller k is left out there).
    IndexTable(const Stack& stack, std::vector<double> wavelength_nm);

    /// Becomes the table of a stack of constant indices, given by another table of it, at other
    /// wavelengths, which are not checked; memory is used again.
    void assign(const IndexTable& constant,
                std::span<const std::vector<double>* const> wavelengths);
    /// Becomes the parts, tables of the same stack, one after the other; memory is used again.
    void assign(std::span<const IndexTable* const> parts);

    /// Other indices of one material, as many as there are wavelengths, which are not checked; they
    /// absorb and amplify where the old ones do at most.
    void replace(std::size_t material, std::span<const Complex> index);

    const std::vector<double>& wavelength_nm() const { return wavelength_nm_; }
    std::size_t materials() const { return materials_; }
    /// Real and imaginary part of one material's index at all wavelengths.
    std::span<const double> n(std::size_t material) const { return row(n_, material); }
    std::span<const double> k(std::size_t material) const { return row(k_, material); }
    Complex index(std::size_t material, std::size_t wavelength) const {
        return {n(material)[wavelength], k(material)[wavelength]};
    }
    std::size_t incident() const { return incident_; }
    /// Whether any material is uniaxial: index() is then that of s waves.
    bool is_uniaxial() const { return rows_ > materials_; }
    /// The row of n(row) and k(row) with a material's extraordinary index: its own, or one behind
    /// all materials.
    std::size_t extraordinary(std::size_t material) const { return extraordinary_[material]; }
    /// 2 pi / wavelength, 1/nm.
    const std::vector<double>& k0() const { return k0_; }
    /// Largest k0 |n + ik| of any material, 1/nm, or somewhat more.
    double largest_wavenumber() const { return largest_wavenumber_; }
    /// Whether the material has the same indices at all wavelengths.
    bool is_constant(std::size_t material) const { return constant_[material]; }
    /// Per material: whether an index of it has an imaginary part at any wavelength.
    const std::vector<bool>& absorbs() const { return absorbs_; }
    /// Per material: whether that is negative anywhere.
    const std::vector<bool>& amplifies() const { return amplifies_; }

private:
    void resize_like(const IndexTable& model, std::size_t count);
    std::span<const double> row(const std::vector<double>& values, std::size_t material) const {
        return {values.data() + material * wavelength_nm_.size(), wavelength_nm_.size()};
    }

    std::vector<double> wavelength_nm_;
    std::size_t materials_, incident_;
    std::vector<std::size_t> extraordinary_;  ///< row per material
    std::size_t rows_;                        ///< materials, and extraordinary indices
    double largest_wavenumber_ = 0;
    // n_ and k_ are [row][wavelength]; all three can be read kMostLanes past their end
    std::vector<double> n_, k_, k0_;
    std::vector<bool> constant_, absorbs_, amplifies_;
};

}  // namespace irido
