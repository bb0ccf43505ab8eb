#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/coherent/coherent.hpp"
#include "core/stack/index_table.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// A complex wavenumber at which light meets a half-space, or an incoherent layer, at its critical
/// angle. Spectra have a square root there, like kz of that medium. They have none at the critical
/// angles of films, as both signs of kz are alike in these.
struct BranchPoint {
    WavelengthRange range;  ///< with indices of which the point was found
    Complex inverse_nm;     ///< 1/lambda
    double slope_nm;        ///< of the index, in that of the incident medium, by 1/lambda
    std::array<std::size_t, 2> materials;  ///< the medium's and the incident one
};

/// Chebyshev coefficients of a spectrum on a panel fall as exp(-rate k) or faster, as far as branch
/// points are concerned: 0 with one in the panel, infinite if none is near.
double fall_rate(std::span<const BranchPoint> points, WavelengthRange panel);

/// Largest 2 |n| / |kz/k0|^2 of one material on a panel, times the incident index, if branch points
/// are near; else 0.
double effect_of_branch(std::span<const BranchPoint> points, std::size_t material,
                        WavelengthRange panel);

/// Finds the branch points of a stack.
class BranchPoints {
public:
    /// Refers to `stack`.
    ///   stack  materials and structure, without held ranges
    ///   rows   indices at the ends of the support and at the kinks of all materials
    BranchPoints(const Stack& stack, const IndexTable& rows);

    /// The branch points close to the spectrum at an angle, in `points`.
    void find(IncidentAngle incidence, std::vector<BranchPoint>& points) const;

private:
    /// A medium that may have some.
    struct Outer {
        std::size_t material;
        bool is_extraordinary;  ///< its index for p waves
        /// Its index, in that of the incident medium, at each wavelength of each grid.
        std::vector<std::vector<Complex>> ratios;
    };
    Complex ratio_at(const Outer& medium, double nm) const;
    /// Of a piece on which the ratio less the sine goes from one value to another.
    void add_point(const Outer& medium, WavelengthRange piece, Complex from, Complex to,
                   IncidentAngle incidence, std::vector<BranchPoint>& points) const;

    const Stack& stack_;
    /// Ends of nearly straight pieces, ascending: from row to row, and wider ones, which tell of
    /// points further away.
    std::vector<std::vector<double>> grids_;
    std::vector<Outer> media_;
};

}  // namespace irido
