#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/render/environment_sampler.hpp"
#include "core/render/noise.hpp"
#include "core/render/picture_scene.hpp"
#include "core/render/reflected_colors.hpp"
#include "core/render/scatterer.hpp"
#include "core/render/shape.hpp"
#include "core/render/spectral_table.hpp"

namespace irido {

/// The surface of a traced picture: scattering, or else a smooth stack.
struct TracedSurface {
    std::unique_ptr<const Scatterer> scatterer;
    std::optional<SurfaceStack> stack;
};

/// Light along paths of sight, spectra multiplied wavelength by wavelength: surfaces that scatter,
/// lamps, a floor. The next direction of a path is drawn from a mixture of what the surface
/// scatters, of the surroundings' bright parts and of each lamp, and weighted by the density of the
/// whole mixture. Smooth faces mirror, or light passes them, s and p apart. Up to kBounces
/// reflections; what is left then comes from the last direction.
/// Source: E. Veach, L. Guibas, Optimally combining sampling techniques, SIGGRAPH 1995 (balance
/// heuristic of one sample).
class PathTracer {
public:
    static constexpr std::size_t kBounces = 5;
    /// Pairs of random numbers that a path takes.
    static constexpr std::size_t kPairs = 2 * (kBounces + 1);
    using Numbers = std::function<std::array<double, 2>(std::size_t pair)>;

    /// Throws DomainError as StackSpectra does. `scene` and `nodes` must outlive it.
    PathTracer(const PictureScene& scene, TracedSurface surface, const PictureNodes& nodes,
               const ShownRange& range, const TablePlan& plan);

    /// Memory of calls on one thread.
    class Scratch {
        friend class PathTracer;
        Scatterer::Memory scatterer_;
        std::array<StackSpectra::Memory, 2> faces_;
        std::vector<float> through_;   ///< [s, p][wavelength]; s alone unless split
        std::vector<float> spectrum_;  ///< of the surface
        bool split_ = false;
        Triple tint_{};  ///< what multiplies the channels
    };

    /// Linear sRGB that comes along a ray of sight; nothing if it meets neither shape nor floor.
    std::optional<Triple> operator()(const Ray& ray, const Numbers& numbers,
                                     Scratch& scratch) const;

    /// How the spectra of the surface are computed.
    const ColorReport& report() const {
        return surface_.scatterer ? surface_.scatterer->report() : report_;
    }

private:
    struct Place {
        Hit hit;
        bool is_floor = false, is_inside = false;
    };
    /// A smooth stack from one side.
    struct Face {
        StackSpectra spectra;
        std::optional<GridTable> table{};
    };
    struct Frame;

    void add_faces(const SurfaceStack& stack, const ShownRange& range, const TablePlan& plan);
    std::optional<Place> first_place(const Ray& ray) const;
    FilmPoint point_at(const Hit& hit, const Vector3& direction) const;
    Triple follow(const Ray& ray, const Place& place, std::size_t step, const Numbers& numbers,
                  Scratch& scratch) const;
    Triple pass_smooth(const Ray& ray, const Place& place, std::size_t step, const Numbers& numbers,
                       Scratch& scratch) const;
    Triple scatter_on(const Ray& ray, const Place& place, std::size_t step, double pick,
                      const Numbers& numbers, Scratch& scratch) const;
    Triple go_on(const Vector3& from, const Vector3& direction, std::size_t step,
                 const Numbers& numbers, Scratch& scratch) const;
    Triple surroundings(const Vector3& from, const Vector3& direction, Scratch& scratch) const;
    Triple seen(const Triple& light, std::size_t illuminant, Scratch& scratch) const;
    void reset(Scratch& scratch) const;
    void multiply_split(std::span<const float> s_and_p, Scratch& scratch) const;

    const PictureScene& scene_;
    const PictureNodes& nodes_;
    TracedSurface surface_;
    std::unique_ptr<const Shape> shape_;
    std::optional<ThicknessField> field_;
    std::optional<EnvironmentSampler> sampler_;  ///< none where the surroundings are even
    std::vector<Face> faces_;                    ///< from outside, from inside
    double floor_ = 0;                           ///< height of the floor, if there is one
    double surface_part_ = 1, other_part_ = 0;   ///< chances of draws by surface, by each light
    ColorReport report_;
};

/// Wavelengths that serve reflectances and transmittances of a smooth stack and their products.
ColorNodes smooth_nodes(const SurfaceStack& stack, const ShownRange& range,
                        const Sensitivity& sensitivity, const RgbTransform& to_srgb,
                        SimdLevel simd);

}  // namespace irido
