#pragma once

#include <array>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/rough/layered/layered_scattering.hpp"

namespace irido {

/// Colours of one rough layer over a base for very many pairs of directions, a renderer's work: the
/// colour of R over theta_d and the colour of what the base gives over both angles, G1(i) G1(o)
/// left out, from tables with cubic interpolation, at some 1e-5 of X, Y, Z. A layer and a base have
/// a closed form for all paths. Made in milliseconds.
class PreparedColor {
public:
    /// Throws DomainError unless the surface is one layer without a coating, and as
    /// LayeredScattering and held_stack() do; `tables` is needed here only.
    PreparedColor(const ColorTables& tables, LayeredSurface surface, Paths paths,
                  Crossings crossings, const Execution& execution);

    /// A unit vector that points away from the surface, z along the normal, z >= 0.
    using Direction = std::array<double, 3>;

    /// X, Y, Z of the BRDF, per steradian.
    Triple operator()(const Direction& i, const Direction& o) const;

private:
    /// Samples over u = sqrt(1 - cos theta) from 0 to 1, one more at each end, by which cubic
    /// interpolation goes on.
    struct Place {
        std::size_t first;
        std::array<double, 4> weight;
    };
    static double angle_at(std::size_t sample, std::size_t samples);  ///< degrees, clamped
    static Place place_of(double u, std::size_t samples);
    void prepare_base(const ColorTables& tables, const LayeredScattering& scattering, Paths paths,
                      Crossings crossings, const Execution& execution);

    using Cell = std::array<double, 4>;  ///< X, Y, Z and room
    double alpha2_ = 0;
    std::vector<Cell> facets_;  ///< R over theta_d
    std::size_t base_samples_ = 0;
    std::vector<Cell> base_;  ///< [i][o]; none without a base
};

}  // namespace irido
