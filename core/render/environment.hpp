#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/colorimetry/space.hpp"
#include "core/render/vector3.hpp"

namespace irido {

/// Radiance that comes from a direction (of unit length, away from the object), linear sRGB whose
/// {1, 1, 1} is the illuminant's white at the radiance of a white diffuser. At least 0.
using Environment = std::function<Triple(const Vector3& direction)>;

/// A picture of all directions: rows from the zenith (y = 1) to the nadir, twice as many columns,
/// the middle one straight ahead of the camera (z = -1), x growing with the columns.
struct EnvironmentImage {
    std::size_t width = 0, height = 0;
    std::vector<float> rgb;  ///< [row][column][channel], finite, at least 0
};

/// Names of the environments that are formulas: studio, sky, white, none.
std::span<const std::string_view> environment_names();

/// One of them. studio: soft boxes in a grey room; sky: a clear sky with its sun over dry ground;
/// white: radiance 1 everywhere; none: no light. Throws DomainError that lists the names.
Environment named_environment(std::string_view name);

/// An image, interpolated linearly between the centres of its pixels, across its left and right end
/// as well. Throws DomainError unless the width is twice the height and the values are as they
/// should be.
Environment image_environment(std::shared_ptr<const EnvironmentImage> image);

}  // namespace irido
