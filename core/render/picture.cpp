#include "core/render/picture.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "core/error.hpp"
#include "core/math/parallel.hpp"
#include "core/math/random.hpp"
#include "core/render/facet.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

namespace {

constexpr double kOff = 1e-9;                      ///< from a face on which a ray begins
constexpr std::size_t kDepth = 6, kGemDepth = 12;  ///< steps of a path
constexpr double kNearlySmooth = 0.03;  ///< alpha below which facets alone find all lights
constexpr double kMostPixels = 8192;    ///< of a side

std::uint32_t reversed_bits(std::uint32_t bits) {
    bits = ((bits >> 1U) & 0x55555555U) | ((bits & 0x55555555U) << 1U);
    bits = ((bits >> 2U) & 0x33333333U) | ((bits & 0x33333333U) << 2U);
    bits = ((bits >> 4U) & 0x0f0f0f0fU) | ((bits & 0x0f0f0f0fU) << 4U);
    bits = ((bits >> 8U) & 0x00ff00ffU) | ((bits & 0x00ff00ffU) << 8U);
    return (bits >> 16U) | (bits << 16U);
}

/// The second dimension of Sobol's sequence: Pascal's triangle modulo 2 times the reversed index.
std::uint32_t second_sobol(std::uint32_t index) {
    std::uint32_t bits = reversed_bits(index);
    bits ^= bits << 16U;
    bits ^= (bits & 0x00ff00ffU) << 8U;
    bits ^= (bits & 0x0f0f0f0fU) << 4U;
    bits ^= (bits & 0x33333333U) << 2U;
    bits ^= (bits & 0x55555555U) << 1U;
    return bits;
}

/// A permutation of 32-bit numbers whose lower bits depend on the higher ones only if read from the
/// other end: Owen's scrambling of a sequence in base 2.
std::uint32_t scrambled(std::uint32_t bits, std::uint32_t seed) {
    bits = reversed_bits(bits);
    bits ^= bits * 0x3d20adeaU;
    bits += seed;
    bits *= (seed >> 16U) | 1U;
    bits ^= bits * 0x05526c56U;
    bits ^= bits * 0x53a22864U;
    return reversed_bits(bits);
}

/// Pairs of numbers for the samples of a pixel: scrambled (0, 2)-sequences, in an order of their
/// own for each `pair`. Source: B. Burley, Practical hash-based Owen scrambling, JCGT 9(4), 1
/// (2020).
class PixelSamples {
public:
    PixelSamples(std::uint64_t seed, std::size_t pixel, std::size_t pair) {
        Random random(Random(seed).bits() ^ (0x9e3779b97f4a7c15U * (2 * pixel + pair % 2 + 1)) ^
                      (0xd1b54a32d192ed03U * (pair / 2)));
        const std::uint64_t bits = random.bits();
        first_ = static_cast<std::uint32_t>(bits);
        second_ = static_cast<std::uint32_t>(bits >> 32U);
        order_ = static_cast<std::uint32_t>(random.bits());
    }
    std::array<double, 2> operator()(std::size_t sample) const {
        const std::uint32_t index = scrambled(static_cast<std::uint32_t>(sample), order_);
        return {part(scrambled(reversed_bits(index), first_)),
                part(scrambled(second_sobol(index), second_))};
    }

private:
    static double part(std::uint32_t bits) { return (static_cast<double>(bits) + 0.5) * 0x1p-32; }
    std::uint32_t first_, second_, order_;
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

Painter::Painter(PictureScene scene)
    : scene_(std::move(scene)),
      shape_(make_shape(scene_.shape, scene_.tilt_deg, scene_.camera.elevation_deg)) {
    require_in_range("width", static_cast<double>(scene_.camera.width), 1, kMostPixels);
    require_in_range("height", static_cast<double>(scene_.camera.height), 1, kMostPixels);
    require_in_range("samples", static_cast<double>(scene_.samples), 0,
                     static_cast<double>(kMostPictureSamples));
    if (scene_.noise) field_.emplace(*scene_.noise);
    if (!scene_.alpha) return;
    require_in_range("alpha", *scene_.alpha, kSmoothest, kRoughest);
    if (!is_simple(scene_.shape)) throw DomainError("only spheres and planes can be rough");
    if (scene_.samples == 0) throw DomainError("samples of a rough surface must be at least 1");
    lights_.emplace(scene_.environment);
    if (*scene_.alpha > kNearlySmooth && !lights_->is_uniform()) facet_part_ = 0.5;
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

/// By facets or by lights, weighted by the balance heuristic.
/// Source: E. Veach, L. Guibas, Optimally combining sampling techniques, SIGGRAPH 1995.
PathStep Painter::rough_step(const Hit& hit, const Sample& sample) const {
    const Vector3 to = -sample.ray.direction;
    const double alpha = *scene_.alpha;
    const Vector3 from =
        sample.u < facet_part_
            ? facet_direction(hit.normal, to, alpha, sample.u / facet_part_, sample.v)
            : lights_->direction((sample.u - facet_part_) / (1 - facet_part_), sample.v);
    const FacetLight facet = facet_light(hit.normal, to, from, alpha);
    FilmPoint at = surface_point(hit, sample.ray.direction);
    at.cosine = facet.cosine;
    if (facet.density == 0 || facet.visible_part == 0) return {at, false, true, {}};
    double weight = facet.visible_part;
    if (facet_part_ < 1)
        weight /= facet_part_ + (1 - facet_part_) * lights_->density(from) / facet.density;
    Triple light = scene_.environment(from);
    for (double& channel : light) channel *= weight;
    return {at, false, true, light};
}

bool Painter::trace(const Sample& sample, std::vector<PathStep>& path) const {
    path.clear();
    Ray ray = sample.ray;
    std::optional<Hit> hit = shape_->first_hit(ray);
    if (!hit) return false;
    if (scene_.alpha) {
        path.push_back(rough_step(*hit, sample));
        return true;
    }
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

void Painter::each_sample(std::size_t y, std::size_t samples,
                          const std::function<void(std::size_t, const Sample&)>& visit) const {
    const Camera& camera = scene_.camera;
    for (std::size_t x = 0; x < camera.width; ++x) {
        const auto left = static_cast<double>(x), top = static_cast<double>(y);
        if (samples == 0) {
            visit(x, {camera.ray(left + 0.5, top + 0.5), 0.5, 0.5});
            continue;
        }
        const std::size_t pixel = y * camera.width + x;
        const PixelSamples places(scene_.seed, pixel, 0), facets(scene_.seed, pixel, 1);
        for (std::size_t i = 0; i < samples; ++i) {
            const auto [dx, dy] = places(i);
            const auto [u, v] = scene_.alpha ? facets(i) : std::array{0.5, 0.5};
            visit(x, {camera.ray(left + dx, top + dy), u, v});
        }
    }
}

Painter::Survey Painter::survey(unsigned threads) const {
    std::vector<Survey> rows(scene_.camera.height);
    constexpr double kMost = std::numeric_limits<double>::max();
    parallel_for(rows.size(), threads, [&](std::size_t y) {
        Survey found{{kMost, -kMost, kMost, -kMost}, 0};
        std::vector<PathStep> path;
        each_sample(y, scene_.alpha ? 0 : scene_.samples, [&](std::size_t, const Sample& sample) {
            if (!trace(sample, path)) return;
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
    if (scene_.alpha) {  // facets have all angles, and samples lie between the centres of pixels
        all.range.least_cosine = 0;
        all.range.largest_cosine = 1;
        if (scene_.noise) {
            all.range.least_nm = scene_.noise->least_nm;
            all.range.largest_nm = scene_.noise->most_nm;
        }
        all.points *= scene_.samples;
    }
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
        each_sample(y, scene_.samples, [&](std::size_t x, const Sample& sample) {
            if (!trace(sample, path)) return add(sums.behind[x], behind(sample.ray));
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
        each_sample(y, scene_.samples, [&](std::size_t x, const Sample& sample) {
            if (!trace(sample, path)) return add(sums.behind[x], behind(sample.ray));
            add(sums.color[x], colors(path, scratch));
            ++sums.hits[x];
        });
    });
}

Picture Painter::paint(const PathTracer& tracer, unsigned threads,
                       const std::function<void(double)>& progress) const {
    const std::size_t samples = std::max<std::size_t>(1, scene_.samples);
    return paint_rows(threads, progress, [&](std::size_t y, RowSums& sums) {
        PathTracer::Scratch scratch;
        std::vector<PixelSamples> pairs;
        std::size_t i = 0;
        const PathTracer::Numbers numbers = [&](std::size_t pair) { return pairs[pair](i); };
        for (std::size_t x = 0; x < scene_.camera.width; ++x) {
            const std::size_t pixel = y * scene_.camera.width + x;
            pairs.clear();
            for (std::size_t pair = 0; pair <= PathTracer::kPairs; ++pair)
                pairs.emplace_back(scene_.seed, pixel, pair);
            for (i = 0; i < samples; ++i) {
                const auto [dx, dy] = scene_.samples == 0 ? std::array{0.5, 0.5} : pairs[0](i);
                const Ray ray =
                    scene_.camera.ray(static_cast<double>(x) + dx, static_cast<double>(y) + dy);
                const std::optional<Triple> found = tracer(ray, numbers, scratch);
                if (!found) {
                    add(sums.behind[x], behind(ray));
                    continue;
                }
                add(sums.color[x], *found);
                ++sums.hits[x];
            }
        }
    });
}

Triple Painter::behind(const Ray& ray) const {
    if (const auto* environment = std::get_if<Environment>(&scene_.background))
        return (*environment)(ray.direction);
    if (const auto* color = std::get_if<Triple>(&scene_.background)) return *color;
    return {};
}

}  // namespace irido
