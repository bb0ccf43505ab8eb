#pragma once

#include <memory>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// Colours of stacks with thickness_sigma_nm by quadrature of the means of their R and T at each
/// wavelength, see run_spread(). Throws DomainError for angles at which these are not known.
///   stack    one of those to come, as of color_algorithm()
///   request  of them
/// nullptr if the tolerance is below 1e-10, a material amplifies, or the means are known for no
/// such stack: a spread layer is incoherent or in a repeated group of several layers, one that
/// absorbs is wide or the only one, or there are more than three. DomainError also where one is cut
/// at zero.
std::unique_ptr<ColorAlgorithm> spread_means(const ColorTables& tables, const Stack& stack,
                                             const ColorRequest& request);

}  // namespace irido
