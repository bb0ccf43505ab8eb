#pragma once

#include <limits>
#include <span>

#include "core/coherent/coherent.hpp"
#include "core/math/series.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Phase of an amplitude and its derivatives by the angular frequency w at a fixed angle: a pulse
/// leaves as the integral of a(w) r(w) exp(-i w t), so its peak comes gd later. NaN where the
/// amplitude is 0, and where a derivative is infinite.
struct Delay {
    double phase_deg = std::numeric_limits<double>::quiet_NaN();  ///< (-180, 180]
    double gd_fs = phase_deg, gdd_fs2 = phase_deg, tod_fs3 = phase_deg;
};

/// Of r, which refers to the first face, and of t, from the first face to the last.
struct Delays {
    Delay r, t;
};

/// Phase, group delay, group-delay dispersion and third order of a coherent stack, by power series
/// in x = (w - w0)/w0 carried through the recursion of coherent_response(), without finite
/// differences. Groups are raised to their power by squaring. The error of the m-th derivative is
/// about 1e-15 (tau/|a|)^m, with tau the longest delay and |a| the amplitude (1 for t). A reflected
/// amplitude below 2^-46 of the waves whose difference it is counts as 0. At 90 degrees t is 0, and
/// its phase and delays are limits.
///   stack          coherent layers of fixed thickness
///   index          index_series() of each material
///   wavelength_nm  in vacuum, [1, 1e7]
///   incidence      direction of the light in the incident medium
///   polarization   s or p
///   extraordinary  extraordinary_series() of each material; optional if none is uniaxial
Delays delays(const Stack& stack, std::span<const Series<Complex>> index, double wavelength_nm,
              IncidentAngle incidence, Polarization polarization,
              std::span<const Series<Complex>> extraordinary = {});

}  // namespace irido
