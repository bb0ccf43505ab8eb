#pragma once

#include <array>
#include <cmath>

#include "core/engines/engine_film.hpp"
#include "core/math/square.hpp"

/// Building blocks that several engines share, with the constants of their sources.
namespace irido {

/// XYZ to linear Rec.709 as used in shaders, rounded to seven digits; white D65.
inline constexpr ColorMatrix kShaderRgb{{{3.2404542, -1.5371385, -0.4985314},
                                         {-0.9692660, 1.8760108, 0.0415560},
                                         {0.0556434, -0.2040259, 1.0572252}}};

constexpr double fifth_power(double x) {
    return x * x * x * x * x;
}
constexpr double sixth_power(double x) {
    return x * x * x * x * x * x;
}

/// GLSL's mix().
constexpr double mixed(double a, double b, double part) {
    return a * (1 - part) + b * part;
}

/// GLSL's smoothstep().
double smooth_step(double first, double last, double x);

Triple product(const ColorMatrix& rows, const Triple& column);

/// Real index of a base with reflectance f0 in air; infinite for 1.
inline double index_of_f0(double f0) {
    const double root = std::sqrt(f0);
    return (1 + root) / (1 - root);
}

/// Whether a base is optically thinner than the film, so that reflection at it adds a phase of pi.
/// Engines compare an index recovered from F0, where rounding decides if both are equal; here a
/// base within 1e-12 of the film counts as equal, as is physically correct.
inline bool is_below(double base_n, double film_n) {
    return base_n < film_n * (1 - 1e-12);
}

/// Airy series of one polarization and one channel, from the reflectances of both interfaces: I =
/// constant + sum_m amplitude step^m 2 S(m D, m phase).
struct AirySeries {
    /// R12 of the upper and R23 of the lower interface, each in [0, 1]. A negative R23, which
    /// F82-Schlick produces for dark tints, suppresses the fringes.
    AirySeries(double R12, double R23);
    /// With R123 in place of the product R12 R23.
    AirySeries(double R12, double R23, double R123);

    double constant, amplitude, step;
};

/// Result of the shaders of glTF and its relatives: linear Rec.709 from the series to order 2 with
/// the Gaussian observer. The phases of r, g, b are used for X, Y, Z.
Triple shader_series(const std::array<AirySeries, 3>& series, double opd_nm, const Triple& phase);

/// The series of glTF's shader and its relatives with Schlick reflectances, unclipped; {1, 1, 1}
/// under total reflection.
///   film     thickness, incidence and base
///   film_n   index of the film, replacing the one in `film`
///   base_n   real indices of the base for r, g, b; may be infinite
///   fresnel  Schlick's reflectance as a function of F0 and the cosine
Triple schlick_film(const EngineFilm& film, double film_n, const Triple& base_n,
                    double (*fresnel)(double f0, double cos_theta));

/// F82-Schlick: schlick(f0, cos_theta) with a dip that scales it by `tint` at cosine 1/7.
double f82_schlick(double f0, double tint, double cos_theta);

}  // namespace irido
