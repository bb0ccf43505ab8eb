#pragma once

#include <array>
#include <vector>

#include "core/coherent/coherent.hpp"

namespace irido {

/// Precision of an evaluation; `extended` is long double.
enum class Precision { double_, extended, digits50, digits100 };

/// Power of a stack by an independent, slow method that shares no formula with coherent_response:
/// transfer matrices D P D^-1 of forward and backward waves, groups by repeated squaring. It takes
/// the same doubles and rounds only the result; A = 1 - R - T. R and A have about 50 (100) digits
/// absolute, T as many relative. Layers are treated as coherent with exact thicknesses. double_ is
/// fast, and accurate to about 1e-13 without evanescent waves or resonances.
///   stack          layers and half-spaces
///   wavelength_nm  in vacuum, [1, 1e7]
///   angle_deg      [0, 90); at 90 no power arrives
///   polarization   s or p
///   precision      of the arithmetic
/// Throws DomainError as index_at does, and naming the angle.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 5.1.
Power reference_power(const Stack& stack, double wavelength_nm, double angle_deg,
                      Polarization polarization, Precision precision = Precision::digits100);

/// Condition of R, T, ln T and A: their first-order change under componentwise relative changes of
/// the inputs,
///     sum over all inputs x of |x df/dx|
/// where x runs over n and k of every layer and half-space, the thickness of every layer, and the
/// wavelength, n0 and cos(theta) separately for each layer and half-space (so that their effects on
/// different layers do not cancel). A layer in a group counts once for all repetitions. A method
/// whose rounding errors amount to a relative 2^-53 of each input has an error of Condition 2^-53.
struct Condition {
    double R = 0, T = 0, log_T = 0, A = 0;
};

/// A power to 50 digits, and its condition.
struct ConditionedPower {
    Power power;
    Condition condition;
};

/// Power and condition for both polarizations, {s, p}; see reference_power(). First derivatives
/// underestimate errors at a narrow peak (they vanish at its top) and overestimate them at the
/// substrate's critical angle (where they are infinite). Each condition is therefore the largest
/// over three points: the given one, unless it is within rounding of that angle, and two with all
/// inputs moved by a relative 2^-51 so that all q2 and all phases increase, or decrease.
std::array<ConditionedPower, 2> conditioned_power(const Stack& stack, double wavelength_nm,
                                                  double angle_deg);

/// Derivatives of R and of ln T.
struct PowerSlope {
    double R = 0, log_T = 0;
};
/// Derivatives with respect to thickness in nm (0 for the substrate), n and k of a layer; a layer
/// in a group counts once for all repetitions. Derivatives by an n, k or thickness of 0 are
/// returned as 0.
struct LayerPowerSlopes {
    PowerSlope thickness, n, k;
};

/// Derivatives for every layer of a stack, each group listed once, and finally for its substrate:
/// to 50 digits, by the adjoint of the transfer matrices.
///   stack          layers and half-spaces
///   wavelength_nm  in vacuum, [1, 1e7]
///   angle_deg      [0, 90)
///   polarization   s or p
std::vector<LayerPowerSlopes> reference_slopes(const Stack& stack, double wavelength_nm,
                                               double angle_deg, Polarization polarization);

/// Backward-error test: whether the stack attains `value` exactly when all inputs move together by
/// at most `roundings` 2^-53 of themselves, so that all q2 and all phases increase, or decrease.
/// Such a value is as good as the inputs permit. Unlike first derivatives, the test works for the
/// fringes of 1e9 periods near a gap edge, narrow peaks and critical angles. It evaluates 401
/// points, and more near the closest, in 50 digits: "yes" is always right, "no" may be wrong if
/// more than 100 fringes are swept.
///   stack          layers and half-spaces
///   wavelength_nm  in vacuum, [1, 1e7]
///   angle_deg      [0, 90)
///   polarization   s or p
///   quantity       member of Power: R, T or A
///   value          to be attained
///   roundings      largest relative change of the inputs, in units of 2^-53
bool is_answer_nearby(const Stack& stack, double wavelength_nm, double angle_deg,
                      Polarization polarization, double Power::*quantity, double value,
                      double roundings);

}  // namespace irido
