#pragma once

#include <vector>

#include "core/coherent/fringe_mean.hpp"
#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// What a colour loses where fringes are replaced by their mean: that is known at the points at
/// which the means were integrated, which follow them closely.
class LeftOutFringes {
public:
    void clear() { points_.clear(); }
    void add(double wavelength_nm, const FringeMean& mean);

    /// Where the phase turns many times from some points to the next, all that the sensitivity has
    /// of waves of such a path; elsewhere, where the means are about as quick as the phase, all
    /// that the fringes may add. Infinite if a mean was not finite.
    ///   only_edges  the means are quick next to the edges of gaps only, which they know of
    double error(Side side, const ColorTables& tables, bool only_edges);

private:
    struct Point {
        double wavelength_nm, phase, swing_R, swing_T;
        double turned;  ///< the way of the phase from the shortest wavelength to here
    };
    std::vector<Point> points_;
};

}  // namespace irido
