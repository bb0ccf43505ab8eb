#pragma once

#include <string>

#include "core/math/random.hpp"
#include "core/rough/layered/layered_surface.hpp"

namespace irido::test {

/// The surface of a document.
LayeredSurface surface_of(const std::string& json);

/// One to `most_layers` rough layers of few periods, some absorbing, over a base; every other
/// surface has a coating.
LayeredSurface random_surface(Random& random, std::size_t most_layers);

}  // namespace irido::test
