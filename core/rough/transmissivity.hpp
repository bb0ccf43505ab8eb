#pragma once

#include <span>
#include <vector>

#include "core/rough/facet_series.hpp"

namespace irido {

/// Integrated transmissivity of a rough layer made of facets that each are the stack,
///     ft_cos(theta_i) = integral_0^90deg T(theta_d) F_alpha(theta_i, theta_d) dtheta_d,
/// the share of the light that goes straight on: the stack's power T of the light that meets a
/// facet at theta_d, of both polarizations' mean where the light is unpolarized, since polarization
/// is not followed between layers. FPB24 have the same medium on both sides of the stack, so that
/// light is not refracted; with another substrate this is the share that gets into it, in
/// directions that the filter says nothing about. T = 1 gives G1(theta_i); what is missing has been
/// shadowed. Source: FPB24 eqs. 25 to 30.
///
/// T of each wavelength is computed once, at angles that adapt to it alone (AngleSeries), and
/// serves every roughness and theta_i. Safe from many threads; a value depends on its own arguments
/// only.
class RoughTransmissivity {
public:
    /// Throws DomainError as StackPower does.
    RoughTransmissivity(Stack stack, Light light, SimdLevel simd = best_simd_level());

    struct Value {
        double value = 0;
        /// Estimate of its error, relative to the largest that a value of this alpha and theta_i
        /// can have, G1(theta_i): below 1e-9 unless T has more fringes than can be followed.
        double error = 0;
    };

    /// Computes T of wavelengths that will be asked for. Throws DomainError as IndexTable does.
    void prepare(std::span<const double> wavelength_nm, unsigned threads) const;

    /// Values [theta_i][wavelength]. alpha [1e-4, 1];  theta_i_deg [0, 90], else DomainError;
    /// throws as prepare() does.
    std::vector<Value> operator()(double alpha, std::span<const double> theta_i_deg,
                                  std::span<const double> wavelength_nm) const;

private:
    FacetSeries facets_;
    SimdLevel simd_;
};

}  // namespace irido
