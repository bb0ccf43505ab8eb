#pragma once

#include "core/design/design_problem.hpp"

namespace irido {

/// The parameter in its material. Throws DomainError if the material's model has no such parameter.
double& value_of(Material& material, const MaterialNumber& number);

/// Derivative of a material's complex index with respect to one of its parameters, at one vacuum
/// wavelength. Zero for coefficients of formulas other than 2 (Sellmeier) and 5 (Cauchy).
Complex index_slope(const Material& material, const MaterialNumber& number, double wavelength_nm);

}  // namespace irido
