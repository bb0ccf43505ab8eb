#pragma once

#include <array>
#include <memory>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

/// The methods of approximate_color() for one film. `held` is a stack that satisfies
/// require_film(), with its materials clamped.
namespace irido {

/// `gaussian`.
///   sensitivity  observer and illuminant
///   held         the film
///   orders       last order of the series, 0: 3
///   request      options
std::unique_ptr<ColorAlgorithm> gaussian_color(const Sensitivity& sensitivity, const Stack& held,
                                               std::size_t orders, const ColorRequest& request);

/// `gltf`.
///   sensitivity  observer and illuminant
///   held         the film
///   base_color   linear sRGB, each in [0, 1]
///   request      options
std::unique_ptr<ColorAlgorithm> gltf_color(const Sensitivity& sensitivity, const Stack& held,
                                           const Triple& base_color, const ColorRequest& request);

std::unique_ptr<ColorAlgorithm> two_beam_color(const ColorTables& tables, Stack held,
                                               const ColorRequest& request);

/// Wavelengths used for red, green and blue.
inline constexpr std::array kRgb_nm{650.0, 510.0, 475.0};

/// Rows of weights that turn linear sRGB into XYZ under a light of this white: its r = g = b = 1.
ColorMatrix xyz_from_srgb(const Triple& white);

}  // namespace irido
