#include "core/render/picture.hpp"

#include <algorithm>
#include <atomic>
#include <limits>

#include "core/error.hpp"
#include "core/math/parallel.hpp"
#include "core/math/random.hpp"

namespace irido {

namespace {

constexpr double kOff = 1e-9;                      ///< from a face on which a ray begins
constexpr std::size_t kDepth = 6, kGemDepth = 12;  ///< steps of a path
constexpr double kMostPixels = 8192;               ///< of a side

std::unique_ptr<const Shape> shape_of(const PictureScene& scene) {
    switch (scene.shape) {
        case ShapeKind::plane:
            return plane_shape(scene.tilt_deg);
        case ShapeKind::ring:
            return ring_shape();
        case ShapeKind::gem:
            return gem_shape();
        case ShapeKind::sphere:
        case ShapeKind::bubble:
            break;
    }
    return sphere_shape();
}

std::uint32_t reversed_bits(std::uint32_t bits) {
    std::uint32_t result = 0;
    for (int i = 0; i < 32; ++i, bits >>= 1U) result = (result << 1U) | (bits & 1U);
    return result;
}

/// The second dimension of Sobol's sequence.
std::uint32_t second_sobol(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t v = 1U << 31U; index != 0; index >>= 1U, v ^= v >> 1U)
        if (index & 1U) result ^= v;
    return result;
}

/// Where the samples of a pixel lie: a (0, 2)-sequence, shifted by random bits.
/// Source: T. Kollig, A. Keller, Efficient multidimensional sampling, Computer Graphics Forum
/// 21, 557 (2002).
class PixelSamples {
public:
    PixelSamples(std::uint64_t seed, std::size_t pixel) {
        Random random(Random(seed).bits() ^ (0x9e3779b97f4a7c15U * (pixel + 1)));
        const std::uint64_t bits = random.bits();
        shift_x_ = static_cast<std::uint32_t>(bits);
        shift_y_ = static_cast<std::uint32_t>(bits >> 32U);
    }
    double x(std::size_t sample) const {
        return part(reversed_bits(static_cast<std::uint32_t>(sample)) ^ shift_x_);
    }
    double y(std::size_t sample) const {
        return part(second_sobol(static_cast<std::uint32_t>(sample)) ^ shift_y_);
    }

private:
    static double part(std::uint32_t bits) { return (static_cast<double>(bits) + 0.5) * 0x1p-32; }
    std::uint32_t shift_x_, shift_y_;
};

Triple product(const Triple& a, const Triple& b) {
    return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}

void add(Triple& sum, const Triple& a) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += a[c];
}

/// Of the pixels of a row.
struct RowSums {
    explicit RowSums(std::size_t width) : color(width), behind(width), hits(width) {}
    std::vector<Triple> color, behind;
    std::vector<std::size_t> hits;
};

}  // namespace

bool is_simple(ShapeKind shape) {
    return shape == ShapeKind::sphere || shape == ShapeKind::plane;
}

bool is_opaque(ShapeKind shape) {
    return shape != ShapeKind::bubble && shape != ShapeKind::gem;
}

Painter::Painter(PictureScene scene) : scene_(std::move(scene)), shape_(shape_of(scene_)) {
    require_in_range("width", static_cast<double>(scene_.camera.width), 1, kMostPixels);
    require_in_range("height", static_cast<double>(scene_.camera.height), 1, kMostPixels);
    require_in_range("samples", static_cast<double>(scene_.samples), 0,
                     static_cast<double>(kMostPictureSamples));
    if (scene_.noise) field_.emplace(*scene_.noise);
}

FilmPoint Painter::surface_point(const Hit& hit, const Vector3& direction) const {
    const double cosine = std::min(1.0, std::abs(dot(direction, hit.normal)));
    const double nm =
        field_ ? (*field_)(hit.point.x, hit.point.y, hit.point.z) : scene_.thickness_nm;
    return {cosine, nm};
}

/// Through walls that bend nothing, or into a body of another index.
void Painter::trace_through(Ray ray, Hit hit, std::vector<PathStep>& path) const {
    const bool is_bubble = scene_.shape == ShapeKind::bubble;
    const double index = is_bubble ? 1 : scene_.inner_index;
    const std::size_t depth = is_bubble ? kDepth : kGemDepth;
    path.push_back({surface_point(hit, ray.direction), false, true,
                    scene_.environment(mirrored(ray.direction, hit.normal))});
    std::optional<Vector3> direction = refracted(ray.direction, hit.normal, 1 / index);
    while (direction && path.size() < depth) {
        ray = {hit.point, *direction, kOff};
        const std::optional<Hit> next = shape_->first_hit(ray);
        if (!next) return;
        hit = *next;
        direction = mirrored(ray.direction, hit.normal);
        const std::optional<Vector3> out = refracted(ray.direction, hit.normal, index);
        // where nothing leaves, what is left at last leaves the way that it goes on
        path.push_back({surface_point(hit, ray.direction), true, true,
                        scene_.environment(out ? *out : *direction)});
    }
}

bool Painter::trace(const Ray& first, std::vector<PathStep>& path) const {
    path.clear();
    Ray ray = first;
    std::optional<Hit> hit = shape_->first_hit(ray);
    if (!hit) return false;
    if (!is_opaque(scene_.shape)) {
        trace_through(ray, *hit, path);
        return true;
    }
    while (true) {
        path.push_back({surface_point(*hit, ray.direction), false, false, {}});
        const Vector3 next = mirrored(ray.direction, hit->normal);
        if (!is_simple(scene_.shape)) {
            ray = {hit->point, next, kOff};
            hit = shape_->first_hit(ray);
        }
        if (is_simple(scene_.shape) || !hit || path.size() == kDepth) {
            path.back().leaves = true;
            path.back().light = scene_.environment(next);
            return true;
        }
    }
}

void Painter::each_sample(std::size_t y,
                          const std::function<void(std::size_t, const Ray&)>& visit) const {
    const Camera& camera = scene_.camera;
    for (std::size_t x = 0; x < camera.width; ++x) {
        const auto left = static_cast<double>(x), top = static_cast<double>(y);
        if (scene_.samples == 0) {
            visit(x, camera.ray(left + 0.5, top + 0.5));
            continue;
        }
        const PixelSamples places(scene_.seed, y * camera.width + x);
        for (std::size_t i = 0; i < scene_.samples; ++i)
            visit(x, camera.ray(left + places.x(i), top + places.y(i)));
    }
}

Painter::Survey Painter::survey(unsigned threads) const {
    std::vector<Survey> rows(scene_.camera.height);
    constexpr double kMost = std::numeric_limits<double>::max();
    parallel_for(rows.size(), threads, [&](std::size_t y) {
        Survey found{{kMost, -kMost, kMost, -kMost}, 0};
        std::vector<PathStep> path;
        each_sample(y, [&](std::size_t, const Ray& ray) {
            if (!trace(ray, path)) return;
            found.points += path.size();
            for (const PathStep& step : path) {
                ShownRange& range = found.range;
                range.least_cosine = std::min(range.least_cosine, step.at.cosine);
                range.largest_cosine = std::max(range.largest_cosine, step.at.cosine);
                range.least_nm = std::min(range.least_nm, step.at.thickness_nm);
                range.largest_nm = std::max(range.largest_nm, step.at.thickness_nm);
            }
        });
        rows[y] = found;
    });
    Survey all{{kMost, -kMost, kMost, -kMost}, 0};
    for (const Survey& row : rows) {
        all.points += row.points;
        all.range.least_cosine = std::min(all.range.least_cosine, row.range.least_cosine);
        all.range.largest_cosine = std::max(all.range.largest_cosine, row.range.largest_cosine);
        all.range.least_nm = std::min(all.range.least_nm, row.range.least_nm);
        all.range.largest_nm = std::max(all.range.largest_nm, row.range.largest_nm);
    }
    if (all.points == 0) all.range = {0, 1, scene_.thickness_nm, scene_.thickness_nm};
    return all;
}

void Painter::finish_pixel(std::size_t x, std::size_t y, const Triple& sum, std::size_t hits,
                           const Triple& behind, Picture& picture) const {
    const auto samples = static_cast<double>(std::max<std::size_t>(1, scene_.samples));
    float* const pixel = &picture.rgba[(y * picture.width + x) * 4];
    for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<float>((sum[c] + behind[c]) / samples);
    const bool is_transparent = std::holds_alternative<std::monostate>(scene_.background);
    pixel[3] = is_transparent ? static_cast<float>(static_cast<double>(hits) / samples) : 1.0F;
}

template <class PaintRow>
Picture Painter::paint_rows(unsigned threads, const std::function<void(double)>& progress,
                            const PaintRow& paint_row) const {
    const Camera& camera = scene_.camera;
    Picture picture{camera.width, camera.height, {}};
    picture.rgba.resize(camera.width * camera.height * 4);
    std::atomic<std::size_t> done = 0;
    parallel_for(camera.height, threads, [&](std::size_t y) {
        RowSums sums(camera.width);
        paint_row(y, sums);
        for (std::size_t x = 0; x < camera.width; ++x)
            finish_pixel(x, y, sums.color[x], sums.hits[x], sums.behind[x], picture);
        progress(static_cast<double>(++done) / static_cast<double>(camera.height));
    });
    return picture;
}

Picture Painter::paint(const ReflectedColors& colors, unsigned threads,
                       const std::function<void(double)>& progress) const {
    return paint_rows(threads, progress, [&](std::size_t y, RowSums& sums) {
        std::vector<PathStep> path;
        std::vector<FilmPoint> points;
        std::vector<std::pair<std::size_t, Triple>> lit;  // column and light of each point
        each_sample(y, [&](std::size_t x, const Ray& ray) {
            if (!trace(ray, path)) return add(sums.behind[x], behind(ray));
            points.push_back(path.front().at);
            lit.emplace_back(x, path.front().light);
        });
        std::vector<Triple> found(points.size());
        colors(points, found);
        for (std::size_t i = 0; i < found.size(); ++i) {
            add(sums.color[lit[i].first], product(found[i], lit[i].second));
            ++sums.hits[lit[i].first];
        }
    });
}

Picture Painter::paint(const PathColors& colors, unsigned threads,
                       const std::function<void(double)>& progress) const {
    return paint_rows(threads, progress, [&](std::size_t y, RowSums& sums) {
        std::vector<PathStep> path;
        PathColors::Scratch scratch;
        each_sample(y, [&](std::size_t x, const Ray& ray) {
            if (!trace(ray, path)) return add(sums.behind[x], behind(ray));
            add(sums.color[x], colors(path, scratch));
            ++sums.hits[x];
        });
    });
}

Triple Painter::behind(const Ray& ray) const {
    if (const auto* environment = std::get_if<Environment>(&scene_.background))
        return (*environment)(ray.direction);
    if (const auto* color = std::get_if<Triple>(&scene_.background)) return *color;
    return {};
}

}  // namespace irido
