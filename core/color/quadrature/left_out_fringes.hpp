#pragma once

#include <span>
#include <vector>

#include "core/coherent/fringe_mean.hpp"
#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// What a colour loses where fringes are replaced by their mean: that is known at the points at
/// which the means were integrated, which follow them closely.
class LeftOutFringes {
public:
    /// A row of a table, at which the slope of an index jumps.
    struct Kink {
        double wavelength_nm;
        double path_jump_nm;  ///< of the path, d phase / d (2 pi / lambda)
    };

    void clear() { points_.clear(); }
    void add(double wavelength_nm, const FringeMean& mean);

    /// Where the phase turns many times from some points to the next, all that the sensitivity has
    /// of waves of such a path; elsewhere, where the means are about as quick as the phase, all
    /// that the fringes may add. Infinite if a mean was not finite.
    ///   only_edges  the means are quick next to the edges of gaps only, which they know of
    double error(Side side, const ColorTables& tables, bool only_edges);

    /// What fringes leave at kinks of their phase, to be asked after error(): between two kinks
    /// they cancel but for S lambda^2 / (2 pi path) at both ends, of which the jump of the path
    /// remains. Their phases there have nothing to do with each other: three times the root of the
    /// squares.
    double at_kinks(Side side, const ColorTables& tables, std::span<const Kink> kinks) const;

private:
    struct Point {
        double wavelength_nm, phase, swing_R, swing_T;
        double turned;  ///< the way of the phase from the shortest wavelength to here
    };
    static double path_nm(const Point& from, const Point& to);

    std::vector<Point> points_;
};

}  // namespace irido
