#pragma once

#include <span>
#include <vector>

#include "core/coherent/fringe_mean.hpp"
#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// Error of a colour due to replacing fringes by their mean, estimated at the points at which the
/// means were integrated, which resolve them closely.
class LeftOutFringes {
public:
    /// A row of a table, at which the slope of an index jumps.
    struct Kink {
        double wavelength_nm;
        double path_jump_nm;  ///< of the path, d phase / d (2 pi / lambda)
    };

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

    /// What fringes leave at kinks of their phase, to be asked after error(): between two kinks
    /// they cancel but for S lambda^2 / (2 pi path) at both ends, of which the jump of the path
    /// remains. Their phases there have nothing to do with each other: three times the root of the
    /// squares.
    double at_kinks(Side side, const ColorTables& tables, std::span<const Kink> kinks) const;

private:
    struct Point {
        double wavelength_nm, phase, swing_R, swing_T;
        double turned;  ///< phase accumulated from the shortest wavelength to here
    };
    static double path_nm(const Point& from, const Point& to);

    std::vector<Point> points_;
};

/// Adds the rows of the tables of an element's materials.
///   element  of a stack
///   held     its materials
///   support  wavelengths
///   kinks    to add to
void kinks_of(const Element& element, const Stack& held, WavelengthRange support,
              std::vector<LeftOutFringes::Kink>& kinks);

}  // namespace irido
