#pragma once

#include <memory>

#include "core/color/color_method.hpp"

namespace irido {

/// Weighted sums of the spectra of any stack at given wavelengths. A perfect mirror has the
/// illuminant's white. Throws DomainError as held_stack(), StackPower and IndexTable do.
///   sensitivity  observer and illuminant
///   rule         wavelengths and weights
///   stack        materials and structure; clamped outside the materials' range
///   method       name of the method
///   request      options
std::unique_ptr<ColorAlgorithm> sampled_color(const Sensitivity& sensitivity,
                                              std::shared_ptr<const SampleRule> rule,
                                              const Stack& stack, std::string_view method,
                                              const ColorRequest& request);

}  // namespace irido
