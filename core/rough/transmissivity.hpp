#pragma once

#include <span>
#include <vector>

#include "core/rough/facet_series.hpp"

namespace irido {

/// Integrated transmissivity of a rough layer whose facets are the stack,
///     ft_cos(theta_i) = integral_0^90deg T(theta_d) F_alpha(theta_i, theta_d) dtheta_d,
/// the fraction of the light that passes straight through, with T the stack's transmittance for
/// light meeting a facet at theta_d. For unpolarized light T is the mean of both polarizations, as
/// polarization is not tracked between layers. FPB24 assume the same medium on both sides of the
/// stack, so light is not refracted; with a different substrate, this is the fraction that enters
/// it, in directions that the filter does not describe. For T = 1 it is G1(theta_i).
/// Source: FPB24 eqs. 25 to 30.
///
/// T of each wavelength is computed once, at angles chosen for it alone (AngleSeries), and serves
/// all roughnesses and theta_i. Thread-safe; values depend on their own arguments only.
class RoughTransmissivity {
public:
    /// Throws DomainError as StackPower does.
    RoughTransmissivity(Stack stack, Light light, SimdLevel simd = best_simd_level());

    struct Value {
        double value = 0;
        /// Estimated error relative to G1(theta_i), the largest value possible for this alpha and
        /// theta_i; below 1e-9 unless T has too many fringes to resolve.
        double error = 0;
    };

    /// Computes T for wavelengths needed later. Throws DomainError as IndexTable does.
    void prepare(std::span<const double> wavelength_nm, unsigned threads) const;

    /// Values [theta_i][wavelength]. alpha in [1e-4, 1], theta_i_deg in [0, 90], else DomainError;
    /// throws as prepare() does.
    std::vector<Value> operator()(double alpha, std::span<const double> theta_i_deg,
                                  std::span<const double> wavelength_nm) const;

private:
    FacetSeries facets_;
    SimdLevel simd_;
};

}  // namespace irido
