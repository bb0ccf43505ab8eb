#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

/// Facts of a table of X, Y, Z: the space, and in the request illuminant, observer and the white,
/// XYZ of a perfect mirror.
nlohmann::json light_facts(const LutRequest& request);

/// The largest difference of a sample's channels, as it is.
LutMeasure absolute_measure(std::size_t channels);

}  // namespace irido::tables
