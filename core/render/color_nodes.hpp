#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/colorimetry/space.hpp"

namespace irido {

/// Wavelengths that serve a family of spectra, and their weights for linear sRGB: a spectrum's
/// colour is the weighted sum of its values, exactly for polynomials in 1/wavelength.
struct ColorNodes {
    std::vector<double> wavelength_nm;
    std::array<std::vector<double>, 3> weight;  ///< of the channels
    bool are_enough = false;
};

/// As many as it takes for the colours of spectra computed at them: those by twice as many differ
/// by less than the tolerance, CIEDE2000.
/// colors  linear sRGB of the spectra that need most
/// If `most` wavelengths are not enough, these are returned.
ColorNodes enough_nodes(const Sensitivity& sensitivity, const RgbTransform& to_srgb,
                        const std::function<std::vector<Triple>(const ColorNodes&)>& colors,
                        double tolerance, std::size_t most = 1100);

/// CIEDE2000 of two colours in linear sRGB.
double srgb_difference(std::span<const double> a, std::span<const double> b);

}  // namespace irido
