#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/colorimetry/space.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

// Shared by the kinds whose values are colours, with three channels each.

/// Channel names: R, G, B, or X, Y, Z in the space xyz.
std::vector<std::string> color_channels(const LutRequest& request);

/// Converts XYZ to a table's values: linear RGB of the space, or unchanged in the space xyz.
class ColorValues {
public:
    explicit ColorValues(const LutRequest& request);
    Triple operator()(const Triple& xyz) const;
    /// L*, a*, b* of a table's value, under the white of the space or, without adaptation, of the
    /// illuminant.
    Triple to_lab(const Triple& value) const;

private:
    bool is_xyz_;
    RgbTransform transform_;
    ColorMatrix xyz_from_value_;
    Triple white_;
};

/// CIEDE2000 of two samples.
LutMeasure color_measure(const LutRequest& request);

/// The request with colours whose error is at most `error` in the measure, if that is more than it
/// asks for.
LutRequest rougher(LutRequest request, double error);

/// Metadata of colours: color_space, stack and the colour part of the request.
nlohmann::json color_facts(const LutRequest& request);

/// Problems with values that no colour has: XYZ below 0 or above the white, RGB far out of range.
std::vector<std::string> color_problems(const Lut& lut);

/// Unit of a stack value, derived from the end of its path.
std::string unit_of_path(const std::string& path);

}  // namespace irido::tables
