#pragma once

#include <vector>

#include "core/coherent/fringe_mean.hpp"
#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// Error of a colour due to replacing fringes by their mean, estimated at the points at which the
/// means were integrated, which resolve them closely.
class LeftOutFringes {
public:
    void clear() { points_.clear(); }
    void add(double wavelength_nm, const FringeMean& mean);

    /// Where the phase advances by many turns between points, the error is the Fourier integral of
    /// the weighted colour-matching functions at that path difference; elsewhere, where the means
    /// vary about as fast as the phase, everything that the fringes may add. Infinite if a mean was
    /// not finite.
    ///   side        reflected or transmitted
    ///   tables      observer and illuminant
    ///   only_edges  the means vary fast near gap edges only, which they account for
    double error(Side side, const ColorTables& tables, bool only_edges);

private:
    struct Point {
        double wavelength_nm, phase, swing_R, swing_T;
        double turned;  ///< phase accumulated from the shortest wavelength to here
    };
    std::vector<Point> points_;
};

}  // namespace irido
