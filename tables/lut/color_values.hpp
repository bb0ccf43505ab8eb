#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/colorimetry/space.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

// What the kinds have in common whose values are colours, three channels each.

/// R, G, B, or X, Y, Z in the space xyz.
std::vector<std::string> color_channels(const LutRequest& request);

/// Values of a table from XYZ: linear RGB of the space, or XYZ as it is in the space xyz.
class ColorValues {
public:
    explicit ColorValues(const LutRequest& request);
    Triple operator()(const Triple& xyz) const;
    /// L*, a*, b* of a table's value, under the white of the space, or of the illuminant where
    /// nothing was adapted.
    Triple to_lab(const Triple& value) const;

private:
    bool is_xyz_;
    RgbTransform transform_;
    ColorMatrix xyz_from_value_;
    Triple white_;
};

/// CIEDE2000 of two samples.
LutMeasure color_measure(const LutRequest& request);

/// color_space, stack and what colours have of the request.
nlohmann::json color_facts(const LutRequest& request);

/// Values that no colour has: below 0 or above the white in XYZ, far outside in RGB.
std::vector<std::string> color_problems(const Lut& lut);

/// Unit of a value of a stack, by the end of its path.
std::string unit_of_path(const std::string& path);

/// Degrees in [0, 90] of a cosine in [0, 1], with its last digits near 90.
double angle_of_cosine(double cosine);

}  // namespace irido::tables
