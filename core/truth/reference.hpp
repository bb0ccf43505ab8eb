#pragma once

#include <array>
#include <vector>

#include "core/coherent/coherent.hpp"

namespace irido {

/// Numbers that an evaluation computes with; `extended` is long double.
enum class Precision { double_, extended, digits50, digits100 };

/// Power of a stack by a second, slow method that shares no formula with coherent_response:
/// transfer matrices D P D^-1 of forward and backward waves, groups by repeated squaring. It takes
/// the same doubles (indices, thicknesses, wavelength, angle in degrees) and rounds nothing but
/// its result; A = 1 - R - T, so it has about 50 (100) digits absolute, T as many relative. Layers
/// are taken as coherent and their thicknesses as sharp.
/// double_ is good to about 1e-13 where no wave dies away and nothing resonates, and fast.
///   wavelength_nm  vacuum, [1, 1e7];   angle_deg  [0, 90): at 90 no power arrives
/// Throws DomainError as index_at does, and naming the angle.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 5.1.
Power reference_power(const Stack& stack, double wavelength_nm, double angle_deg,
                      Polarization polarization, Precision precision = Precision::digits100);

/// By how much R, T, ln T and A move when the inputs move, componentwise and to first order:
///     sum over all inputs x of |x df/dx|
/// x runs over n and k of every layer and half-space, the thickness of every layer, and the
/// wavelength, n0 and cos(theta) as each layer and half-space takes them for itself (so that what
/// they do to different layers does not cancel); a layer of a group is one in all repetitions. A
/// method whose roundings amount to a relative 2^-53 in each input is off by Condition 2^-53.
struct Condition {
    double R = 0, T = 0, log_T = 0, A = 0;
};

/// A power to 50 digits, and its condition.
struct ConditionedPower {
    Power power;
    Condition condition;
};

/// Both polarizations, {s, p}. First derivatives miss what a narrow peak does to an error (none at
/// its top) and overstate what the substrate's critical angle does (infinite at it), so each
/// condition is the largest one at three points: the given one, unless it is within rounding of
/// that angle, and two where all inputs are a relative 2^-51 away so that all q2 and all phases
/// have grown, or shrunk. Arguments as above.
std::array<ConditionedPower, 2> conditioned_power(const Stack& stack, double wavelength_nm,
                                                  double angle_deg);

/// Derivatives of R and of ln T.
struct PowerSlope {
    double R = 0, log_T = 0;
};
/// By the thickness in nm (0 of the substrate), n and k of a layer; that of a group is one in all
/// repetitions. Those by an n, k or thickness that is 0 are left at 0.
struct LayerPowerSlopes {
    PowerSlope thickness, n, k;
};

/// Of every layer of a stack, groups written once, and last of its substrate, to 50 digits by the
/// adjoint of the transfer matrices. Arguments as above.
std::vector<LayerPowerSlopes> reference_slopes(const Stack& stack, double wavelength_nm,
                                               double angle_deg, Polarization polarization);

/// Whether the stack has that R, T or A at inputs that are at most so many 2^-53 of themselves
/// away, all moved together so that all q2 and all phases grow, or shrink: then the value is the
/// exact answer to a question that roundings do not tell from the given one. It holds where first
/// derivatives do not: at the fringes of 1e9 periods beside an edge, at narrow peaks, at critical
/// angles. Looked for at 401 points and where those come nearest to it, in 50 digits, so that
/// "no" may be wrong where more than 100 fringes pass, and "yes" never is.
bool is_answer_nearby(const Stack& stack, double wavelength_nm, double angle_deg,
                      Polarization polarization, double Power::*quantity, double value,
                      double roundings);

}  // namespace irido
