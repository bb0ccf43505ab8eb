#pragma once

#include <cstdint>

#include "core/complex.hpp"
#include "core/periodic/bragg.hpp"

namespace irido {

/// A finite number of two-layer periods between two half-spaces, all transparent, at one angle and
/// polarization. Admittances Y are sqrt(q2) for s and eps / sqrt(q2) for p, all > 0.
struct BlochMirror {
    BraggPeriod period;                ///< Y_second = admittance_ratio Y_first, or its inverse
    double Y_in = 1, Y_out = 1;        ///< of the half-spaces
    double Y_first = 1, Y_second = 1;  ///< of the layers
    std::uint64_t repeat = 1;          ///< N, [1, 1e9]
};

/// Builds the mirror; throws DomainError if a layer or the half-space below reflects totally, and
/// as bragg_period() does.
///   first, second  the layers of a period, from the incident side
///   repeat         number of periods, [1, 1e9]
///   n0, n_out      indices of the half-spaces above and below, > 0
///   incidence      direction of the light in n0, not 90 degrees
///   polarization   s or p
BlochMirror bloch_mirror(const RealLayer& first, const RealLayer& second, std::uint64_t repeat,
                         double n0, double n_out, IncidentAngle incidence,
                         Polarization polarization);

/// Invariants of one period at one omega. With M its matrix of tangential fields, det M = 1,
///     cos KL = tr(M)/2,   u = (Y_in - Y_out) (M11 - M22)/2,   v = |Y_in Y_out M12 + M21|.
/// sin^2(KL/2) = F(q) F(1/q) and cos^2(KL/2) = G(q) G(1/q) are computed from
///     F(q) = ((1+q) sin h + (1-q) sin g)/2,   G(q) = ((1+q) cos h + (1-q) cos g)/2,
/// h, g = (a +- b)/2, which do not cancel near a gap edge.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 6.2.
struct BlochPoint {
    double sin2 = 0, cos2 = 0;  ///< for KL/2; one of them is negative in a gap
    double u = 0, v = 0;
};
BlochPoint bloch_point(const BlochMirror& mirror, double omega_per_nm);

/// d KL / d omega inside a band, nm.
double bloch_phase_slope(const BraggPeriod& period, double omega_per_nm);

/// T of all periods together, exact in bands and gaps: with P = Y_in + Y_out
///     T = 4 Y_in Y_out / ((P cos NKL + u U)^2 + v^2 U^2),   U = sin NKL / sin KL.
double bloch_transmittance(const BlochMirror& mirror, double omega_per_nm);

/// T inside a band as a series in its fast phase 2 NKL,
///     T = average (1 + 2 Re sum_{m >= 1} bounce^m).
/// |bounce| <= 1 does not depend on N; its phase advances with it. In terms of
///     1/T = A + B cos(2 NKL - phi0),
/// average = 1/sqrt(A^2 - B^2) and |bounce| = B/(A + sqrt(A^2 - B^2)).
struct BlochSeries {
    double average = 0;
    Complex bounce;
};
BlochSeries bloch_series(const BlochMirror& mirror, double omega_per_nm);

}  // namespace irido
