#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/render/camera.hpp"
#include "core/render/environment.hpp"
#include "core/render/lamp.hpp"
#include "core/render/noise.hpp"
#include "core/render/shape.hpp"

namespace irido {

/// A lamp and the number of its illuminant among those of the picture, 0 being the picture's own.
struct PictureLamp {
    Lamp lamp;
    std::size_t illuminant = 0;
};

/// All that a picture of a surface shows, but for the surface.
struct PictureScene {
    Camera camera;
    ShapeKind shape = ShapeKind::sphere;
    double tilt_deg = 0;     ///< of a plane
    double inner_index = 1;  ///< of a gem, over that of the medium around it
    Environment environment;
    std::vector<PictureLamp> lamps{};
    std::optional<Triple> floor{};        ///< its albedo, below the shape; none
    std::optional<double> alpha;          ///< roughness of the stack's facets; else it is smooth
    std::optional<ThicknessNoise> noise;  ///< else the thickness is `thickness_nm` everywhere
    double thickness_nm = 0;
    std::size_t samples = 0;  ///< per pixel; 0: its centre, for smooth shapes
    std::uint64_t seed = 1;
    /// Behind the shape: nothing, the environment or one colour.
    std::variant<std::monostate, Environment, Triple> background;
};

}  // namespace irido
