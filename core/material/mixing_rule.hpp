#pragma once

#include <cmath>

#include "core/complex.hpp"
#include "core/math/series.hpp"

namespace irido {

/// How the permittivity of a fine mixture follows from those of its constituents.
enum class MixingRule {
    bruggeman,        ///< symmetric: grains of two media
    maxwell_garnett,  ///< spheres of the inclusion in the host
    lorentz_lorenz,   ///< (eps - 1)/(eps + 2) is additive: molecules in vacuum
    linear,           ///< eps is additive: walls along the field
    series            ///< 1/eps is additive: walls across the field
};

inline Complex root_near(const Complex& square) {
    return std::sqrt(square);
}
inline Series<Complex> root_near(const Series<Complex>& square) {
    return root_of(square, std::sqrt(square[0]));
}
inline Complex first_of(const Complex& value) {
    return value;
}
inline Complex first_of(const Series<Complex>& value) {
    return value[0];
}

/// Permittivity of a mixture, as a number or a series.
///   rule      effective-medium formula
///   n1, n2    indices of inclusion and host, n >= 0, not 0
///   fraction  volume of the inclusion, f in [0, 1]
/// Bruggeman's equation, f (e1 - e)/(e1 + 2 e) + (1 - f) (e2 - e)/(e2 + 2 e) = 0, has two roots;
/// this is the one that connects host and inclusion continuously: with p = n1/n2,
///     z = ((3 f - 1) p + (2 - 3 f)/p)/4,   w = z + sqrt(z^2 + 1/2),   e = n1 n2 w,   Re w > 0.
/// Sources: D. A. G. Bruggeman, Ann. Phys. 416, 636 (1935); J. C. Maxwell Garnett, Phil. Trans. A
/// 203, 385 (1904); D. E. Aspnes, Thin Solid Films 89, 249 (1982).
template <class Number>
Number mixed_permittivity(MixingRule rule, const Number& n1, const Number& n2, double fraction) {
    const double f = fraction;
    const Number e1 = n1 * n1, e2 = n2 * n2;
    switch (rule) {
        case MixingRule::bruggeman: {
            const Number p = n1 / n2, inverse = n2 / n1;
            const Number z = ((3 * f - 1) * p + (2 - 3 * f) * inverse) * 0.25;
            const Number s = root_near(z * z + Number(0.5));
            const bool cancels =
                std::norm(first_of(z) + first_of(s)) < std::norm(first_of(z) - first_of(s));
            return n1 * n2 * (cancels ? Number(-0.5) / (z - s) : z + s);
        }
        case MixingRule::maxwell_garnett:
            return e2 * ((1 + 2 * f) * e1 + (2 - 2 * f) * e2) / ((1 - f) * e1 + (2 + f) * e2);
        case MixingRule::lorentz_lorenz: {
            const Number x = f * ((e1 - Number(1.0)) / (e1 + Number(2.0))) +
                             (1 - f) * ((e2 - Number(1.0)) / (e2 + Number(2.0)));
            return (Number(1.0) + 2.0 * x) / (Number(1.0) - x);
        }
        case MixingRule::linear:
            return f * e1 + (1 - f) * e2;
        case MixingRule::series:
            break;
    }
    return e1 * e2 / (f * e2 + (1 - f) * e1);
}

}  // namespace irido
