#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/complex.hpp"
#include "core/math/series.hpp"

namespace irido {

/// Index profile of a graded layer over the relative depth t in [0, 1]: linear in n, in n^2 or in
/// 1/n, or n1 (n2/n1)^t.
enum class GradedProfile { n, eps, exp, inverse_n };

inline Complex power_of(const Complex& base, double exponent) {
    return std::pow(base, exponent);
}
inline Series<Complex> power_of(const Series<Complex>& base, double exponent) {
    return power_series(base, exponent, std::pow(base[0], exponent));
}

/// Permittivity of a graded layer at one depth, as a number or a series.
///   profile  shape of the index
///   n1, n2   indices at top and bottom
///   t        relative depth, [0, 1]
template <class Number>
Number graded_permittivity(GradedProfile profile, const Number& n1, const Number& n2, double t) {
    switch (profile) {
        case GradedProfile::n: {
            const Number n = (1 - t) * n1 + t * n2;
            return n * n;
        }
        case GradedProfile::eps:
            return (1 - t) * (n1 * n1) + t * (n2 * n2);
        case GradedProfile::exp:
            return n1 * n1 * power_of(n2 / n1, 2 * t);
        case GradedProfile::inverse_n:
            break;
    }
    const Number n = n1 * n2 / ((1 - t) * n2 + t * n1);
    return n * n;
}

/// Half of one of the equal steps of a graded layer. The exponentials of the fourth-order
/// commutator-free Magnus integrator are homogeneous uniaxial layers half a step thick, whose
/// in-plane eps and normal 1/eps are weighted means of the values at the step's two Gauss points,
/// with weights
///     a = 1/2 + 1/sqrt(3) for the nearer one, 1 - a = -0.077 for the other.
/// Each half step conserves energy and obeys reciprocity; the error falls as the fourth power of
/// the step.
/// Source: S. Blanes and P. C. Moan, Appl. Numer. Math. 56, 1519 (2006), section 3.
struct GradedHalfStep {
    double nearer, other;  ///< relative depths of the two Gauss points, [0, 1]

    /// Number `half` of the 2 steps half steps, counted from the top.
    GradedHalfStep(std::size_t half, std::size_t steps) {
        const std::size_t step = half / 2;
        const double middle = static_cast<double>(step) + 0.5, reach = std::sqrt(3.0) / 6;
        const double sign = half % 2 == 0 ? -1 : 1;
        nearer = (middle + sign * reach) / static_cast<double>(steps);
        other = (middle - sign * reach) / static_cast<double>(steps);
    }

    /// {in-plane eps, eps along the normal}
    template <class Number>
    std::array<Number, 2> permittivity(GradedProfile profile, const Number& n1,
                                       const Number& n2) const {
        const double a = 0.5 + 1 / std::sqrt(3.0);
        const Number near = graded_permittivity(profile, n1, n2, nearer);
        const Number far = graded_permittivity(profile, n1, n2, other);
        return {a * near + (1 - a) * far, near * far / (a * far + (1 - a) * near)};
    }
};

}  // namespace irido
