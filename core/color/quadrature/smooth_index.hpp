#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/coherent/coherent.hpp"
#include "core/color/quadrature/quadrature_rule.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/stack/index_table.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Tabulated indices over one panel of the spectrum, replaced by polynomials in 1/lambda that hold
/// the tables' values at both ends and come as close to them in between, weighted with the
/// sensitivity, as they can. The kinks of the tables are gone, so quadrature converges fast; what
/// the colour loses is known by first and second order of what the indices lose, delta:
///     |dX| <= |sum_k g_k mu_k| + G^2 integral w |delta|^2,
///     mu_k = integral of w delta T_k over the panel,
/// with the Chebyshev coefficients g_k of dR/dn, which G bounds. Two bounds of the sum are known,
/// and the smaller one counts: G sqrt(2 sum_k mu_k^2), k = 0 .. K, if dR/dn is like a polynomial of
/// degree K, as the squares add to at most 2 G^2 (Cauchy and Schwarz); and G (|mu_0| + 2 sum_k s^k
/// |mu_k|) if it has no poles in the ellipse on which T_k is at most s^-k, as R has none there. The
/// fit makes the first mu_k of X, Y and Z small, which leaves little of what is smooth.
class IndexFit {
public:
    /// Error due to one material per unit of G and of G^2, for X, Y, Z.
    struct Error {
        std::size_t material;
        Triple first, second;
    };

    /// Fits the indices on one panel.
    ///   stack        whose materials are fitted
    ///   sensitivity  weights of the fit
    ///   panel        spectral range
    ///   materials    those with table rows in the panel
    ///   rows         these rows
    IndexFit(const Stack& stack, const Sensitivity& sensitivity, WavelengthRange panel,
             std::span<const std::size_t> materials, std::span<const double> rows);

    /// Writes the polynomials into a table of the stack at wavelengths of the panel.
    void replace(IndexTable& table) const;

    /// Errors of the materials, of K = kDegrees[level], level < kLevels, and coefficients that fall
    /// at kFallRates[rate]. Infinite if a polynomial is no index.
    std::span<const Error> errors(std::size_t level, std::size_t rate) const {
        return errors_[level][rate];
    }
    static constexpr std::size_t kLevels = 4;
    std::size_t degree() const { return degree_; }  ///< of the polynomials

private:
    /// n and k at both ends, and coefficients of what is added, (1 - x^2) sum_k c_k T_k(x).
    struct Curve {
        std::size_t material;
        bool absorbs_only;  ///< k must not be negative
        std::array<std::array<double, 2>, 2> ends;
        std::array<std::vector<double>, 2> bubble;
    };
    double x(double wavelength_nm) const;

    double middle_, half_;  ///< of 1/lambda
    std::size_t degree_;
    std::vector<Curve> curves_;
    std::array<std::array<std::vector<Error>, kFallRates.size()>, kLevels> errors_;
};

/// The tables of a stack, to be replaced over any panel.
class SmoothIndices {
public:
    /// Refers to both. Materials hold their end values.
    SmoothIndices(const Stack& stack, const Sensitivity& sensitivity);

    std::size_t rows() const { return rows_.size(); }  ///< of all tables
    bool is_tabulated(std::size_t material) const { return !material_rows_[material].empty(); }
    /// Whether a row of a table is inside the panel.
    bool has_rows(WavelengthRange panel) const { return !rows_in(panel).empty(); }
    /// The row closest to the middle of a panel that has one.
    double middle_row(WavelengthRange panel) const;
    /// Of a panel that has rows.
    std::unique_ptr<const IndexFit> fit(WavelengthRange panel) const;
    /// Per material the largest |n| / |kz/k0|^2 at the wavelengths of a table, 0 without rows, in
    /// `effects`, which is returned: see IntegrationLimits.
    std::span<const double> effects(const IndexTable& table, IncidentAngle incidence,
                                    std::vector<double>& effects) const;
    /// 1/|n| of every material in the middle of a panel.
    std::vector<double> inverse_indices(WavelengthRange panel) const;

private:
    std::span<const double> rows_in(WavelengthRange panel) const;

    const Stack& stack_;
    const Sensitivity& sensitivity_;
    std::vector<double> rows_;                        ///< of all tables
    std::vector<std::vector<double>> material_rows_;  ///< of each material
};

}  // namespace irido
