#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

/// Colorimetric metadata of a table of X, Y, Z: color_space, and in the request illuminant,
/// observer and white_xyz, the XYZ of a perfect mirror.
nlohmann::json light_facts(const LutRequest& request);

/// The largest absolute difference over the channels of a sample.
LutMeasure absolute_measure(std::size_t channels);

}  // namespace irido::tables
