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
    std::size_t panels = 1, degree = 16;  ///< in which they lie, Chebyshev points of each
};

/// The nodes of a picture with several lights, each with an illuminant of its own: linear sRGB of
/// spectra at the same wavelengths under each of them.
class PictureNodes {
public:
    /// others  sensitivities of further illuminants; that of `nodes` has the number 0. Throws
    ///         DomainError where one of them is not given over the range of the first.
    PictureNodes(ColorNodes nodes, WavelengthRange range,
                 std::span<const Sensitivity* const> others, const RgbTransform& to_srgb);

    std::size_t count() const { return wavelength_nm_.size(); }
    const std::vector<double>& wavelength_nm() const { return wavelength_nm_; }
    /// Of a perfect mirror's spectrum it is the illuminant's white, {1, 1, 1} of the first.
    Triple rgb(std::span<const float> spectrum, std::size_t illuminant = 0) const;

private:
    std::vector<double> wavelength_nm_;
    std::vector<std::array<std::vector<float>, 3>> weights_;  ///< of each illuminant
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
