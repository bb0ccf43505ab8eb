#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/render/environment_sampler.hpp"
#include "core/render/path_colors.hpp"
#include "core/render/path_tracer.hpp"
#include "core/render/picture_scene.hpp"

namespace irido {

/// Linear sRGB, multiplied by alpha; rows from the top.
struct Picture {
    std::size_t width = 0, height = 0;
    std::vector<float> rgba;
};

inline constexpr std::size_t kMostPictureSamples = 65536;

/// Pictures of one scene. Safe from many threads.
class Painter {
public:
    /// Throws DomainError, which names the argument.
    explicit Painter(PictureScene scene);

    /// The angles and thicknesses that occur, and the number of places where the stack is met.
    struct Survey {
        ShownRange range;
        std::size_t points = 0;
    };
    Survey survey(unsigned threads) const;

    /// Pixels do not depend on the number of threads. `progress` gets a growing fraction.
    Picture paint(const ReflectedColors& colors, unsigned threads,
                  const std::function<void(double)>& progress) const;
    Picture paint(const PathColors& colors, unsigned threads,
                  const std::function<void(double)>& progress) const;
    /// Of the same scene.
    Picture paint(const PathTracer& tracer, unsigned threads,
                  const std::function<void(double)>& progress) const;

private:
    /// One look through a pixel.
    struct Sample {
        Ray ray;
        double u = 0, v = 0;  ///< for the facet of a rough surface
    };
    /// Steps of the path that begins with a ray; false if it meets nothing.
    bool trace(const Sample& sample, std::vector<PathStep>& path) const;
    /// The light that a rough surface reflects there.
    PathStep rough_step(const Hit& hit, const Sample& sample) const;
    Triple behind(const Ray& ray) const;
    void trace_through(Ray ray, Hit hit, std::vector<PathStep>& path) const;
    FilmPoint surface_point(const Hit& hit, const Vector3& direction) const;
    /// Calls visit(x, sample) for so many samples of each pixel of a row, 0 for its centre.
    void each_sample(std::size_t y, std::size_t samples,
                     const std::function<void(std::size_t x, const Sample& sample)>& visit) const;
    template <class PaintRow>
    Picture paint_rows(unsigned threads, const std::function<void(double)>& progress,
                       const PaintRow& paint_row) const;
    void finish_pixel(std::size_t x, std::size_t y, const Triple& sum, std::size_t hits,
                      const Triple& behind, Picture& picture) const;

    PictureScene scene_;
    std::unique_ptr<const Shape> shape_;
    std::optional<ThicknessField> field_;
    std::optional<EnvironmentSampler> lights_;  ///< of a rough surface
    double facet_part_ = 1;  ///< of the samples that are drawn by facets, the others by lights
};

}  // namespace irido
