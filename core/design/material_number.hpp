#pragma once

#include "core/design/design_problem.hpp"

namespace irido {

/// The number in its material. Throws DomainError if the material's model has no such number.
double& value_of(Material& material, const MaterialNumber& number);

/// Derivative of the material's complex index by one of its numbers, at one vacuum wavelength; zero
/// where a formula of n is not one of 2 (Sellmeier) and 5 (Cauchy).
Complex index_slope(const Material& material, const MaterialNumber& number, double wavelength_nm);

}  // namespace irido
