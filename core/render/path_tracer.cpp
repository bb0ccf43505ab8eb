#include "core/render/path_tracer.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/render/as_array.hpp"

namespace irido {

namespace {

constexpr double kOffFace = 1e-7;  ///< from a face on which a ray begins
/// Samples of a table of a smooth stack that is worth making.
constexpr std::size_t kMostFaceSamples = 1U << 15U;
/// Meetings with a clear wall after which both ways are followed, not one by chance.
constexpr std::size_t kSplits = 3;
/// Chance of the mirror after the first reflection, where a surface scatters as well.
constexpr double kMirrorPart = 0.5;

void increase(Triple& sum, const Triple& a) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += a[c];
}

}  // namespace

/// Axes at a place of a surface: z along the normal, x horizontal, to the right of who looks at it.
struct PathTracer::Frame {
    explicit Frame(const Vector3& normal) : z(normal) {
        constexpr double kUpright = 1 - 1e-9;
        x = std::abs(z.y) < kUpright ? normalized({z.z, 0, -z.x}) : Vector3{1, 0, 0};
        y = {z.y * x.z - z.z * x.y, z.z * x.x - z.x * x.z, z.x * x.y - z.y * x.x};
    }
    Vector3 local(const Vector3& a) const { return {dot(a, x), dot(a, y), dot(a, z)}; }
    Vector3 world(const Vector3& a) const { return a.x * x + a.y * y + a.z * z; }
    Vector3 x, y, z;
};

ColorNodes smooth_nodes(const SurfaceStack& stack, const ShownRange& range,
                        const Sensitivity& sensitivity, const RgbTransform& to_srgb,
                        SimdLevel simd) {
    constexpr double kDrawnTolerance = 0.03;
    ColorNodes nodes = enough_nodes(
        sensitivity, to_srgb,
        [&](const ColorNodes& some) {
            const std::size_t count = some.wavelength_nm.size();
            const StackSpectra spectra(stack, some.wavelength_nm, simd);
            StackSpectra::Memory memory;
            std::vector<float> powers(4 * count);
            std::vector<Triple> colors;
            for (const double nm : {range.least_nm, range.largest_nm})
                for (const double cosine : {1.0, 0.7, 0.3}) {
                    spectra({cosine, nm}, powers, memory);
                    for (const bool twice : {false, true}) {
                        Triple rgb{};
                        for (std::size_t w = 0; w < count; ++w) {
                            const auto R = static_cast<double>(powers[w]);
                            const auto T = static_cast<double>(powers[2 * count + w]);
                            for (std::size_t c = 0; c < 3; ++c)
                                rgb[c] += some.weight[c][w] * (twice ? T * T * R : R);
                        }
                        colors.push_back(rgb);
                    }
                }
            return colors;
        },
        kDrawnTolerance);
    if (!nodes.are_enough)
        throw DomainError("the fringes of the stack are too fine for " +
                          std::to_string(nodes.wavelength_nm.size()) + " wavelengths");
    return nodes;
}

PathTracer::PathTracer(const PictureScene& scene, TracedSurface surface, const PictureNodes& nodes,
                       const ShownRange& range, const TablePlan& plan)
    : scene_(scene),
      nodes_(nodes),
      surface_(std::move(surface)),
      shape_(make_shape(scene.shape, scene.tilt_deg, scene.camera.elevation_deg)) {
    if (scene.noise) field_.emplace(*scene.noise);
    if (scene.floor) floor_ = shape_->lowest();
    report_.wavelengths = nodes.count();
    if (surface_.stack) add_faces(*surface_.stack, range, plan);
    const bool is_scattered = scene.floor || surface_.scatterer;
    if (!is_scattered) return;
    sampler_.emplace(scene.environment);
    if (sampler_->is_uniform()) sampler_.reset();
    const std::size_t others = scene.lamps.size() + (sampler_ ? 1 : 0);
    if (others == 0) return;
    surface_part_ = 0.5;
    other_part_ = (1 - surface_part_) / static_cast<double>(others);
}

void PathTracer::add_faces(const SurfaceStack& stack, const ShownRange& range,
                           const TablePlan& plan) {
    faces_.push_back({{stack, nodes_.wavelength_nm(), plan.simd}});
    if (!is_opaque(scene_.shape))
        faces_.push_back({{reversed_surface(stack), nodes_.wavelength_nm(), plan.simd}});
    const std::size_t count = nodes_.count(), half = 2 * count;
    const bool is_uniform = stack.varied.empty();
    for (Face& face : faces_) {
        face.table.emplace(
            GridTable::Plan{
                .range = {0, 1, is_uniform ? 0 : range.least_nm, is_uniform ? 0 : range.largest_nm},
                .channels = 2 * half,
                .tolerance = plan.tolerance,
                .most_samples = kMostFaceSamples,
                .threads = plan.threads},
            [&](double nm, std::span<const double> cosines, std::span<float> values) {
                StackSpectra::Memory memory;
                for (std::size_t i = 0; i < cosines.size(); ++i)
                    face.spectra({cosines[i], nm}, values.subspan(i * 2 * half, 2 * half), memory);
            },
            [&](std::span<const float> a, std::span<const float> b) {
                double most = 0;
                for (std::size_t part = 0; part < 4; ++part)
                    most =
                        std::max(most, srgb_difference(nodes_.rgb(a.subspan(part * count, count)),
                                                       nodes_.rgb(b.subspan(part * count, count))));
                return most;
            });
        if (face.table->is_good()) {
            add_table(*face.table, report_);
            report_.reason = "fewer spectra than places";
        } else {
            report_.evaluations += face.table->evaluations();
            report_.reason = "a table would be too large";
            face.table.reset();
        }
    }
}

std::optional<PathTracer::Place> PathTracer::first_place(const Ray& ray) const {
    std::optional<Place> found;
    if (const std::optional<Hit> hit = shape_->first_hit(ray))
        found = Place{*hit, false, dot(hit->normal, ray.direction) > 0};
    if (!scene_.floor || !(ray.direction.y < 0)) return found;
    const double at = (floor_ - ray.origin.y) / ray.direction.y;
    if (!(at > ray.from) || (found && found->hit.distance < at)) return found;
    return Place{{at, ray.origin + at * ray.direction, {0, 1, 0}}, true, false};
}

FilmPoint PathTracer::point_at(const Hit& hit, const Vector3& direction) const {
    const double nm =
        field_ ? (*field_)(hit.point.x, hit.point.y, hit.point.z) : scene_.thickness_nm;
    return {std::min(1.0, std::abs(dot(direction, hit.normal))), nm};
}

void PathTracer::reset(Scratch& scratch) const {
    scratch.through_.assign(2 * nodes_.count(), 1.0F);
    scratch.split_ = false;
    scratch.tint_ = {1, 1, 1};
}

std::optional<Triple> PathTracer::operator()(const Ray& ray, const Numbers& numbers,
                                             Scratch& scratch) const {
    const std::optional<Place> place = first_place(ray);
    if (!place) return std::nullopt;
    reset(scratch);
    return follow(ray, *place, 0, numbers, scratch);
}

/// Light of an illuminant through all that lies on the path so far.
Triple PathTracer::seen(const Triple& light, std::size_t illuminant, Scratch& scratch) const {
    if (light[0] == 0 && light[1] == 0 && light[2] == 0) return {};
    const std::size_t count = nodes_.count();
    const std::span<const float> through(scratch.through_);
    Triple color = nodes_.rgb(through.first(count), illuminant);
    if (scratch.split_) {
        increase(color, nodes_.rgb(through.subspan(count), illuminant));
        for (double& channel : color) channel /= 2;
    }
    for (std::size_t c = 0; c < 3; ++c) color[c] *= light[c] * scratch.tint_[c];
    return color;
}

/// Environment and lamps far away.
Triple PathTracer::surroundings(const Vector3& from, const Vector3& direction,
                                Scratch& scratch) const {
    Triple color = seen(scene_.environment(direction), 0, scratch);
    for (const PictureLamp& lamp : scene_.lamps) {
        const std::optional<double> at = lamp.lamp.distance(from, direction);
        if (!at || *at != kInfinity) continue;
        const double radiance = lamp.lamp.radiance();
        increase(color, seen({radiance, radiance, radiance}, lamp.illuminant, scratch));
    }
    return color;
}

Triple PathTracer::go_on(const Vector3& from, const Vector3& direction, std::size_t step,
                         const Numbers& numbers, Scratch& scratch) const {
    const std::span<const float> through(scratch.through_);
    const std::size_t count = nodes_.count();
    if (!(as_array(through.first(scratch.split_ ? 2 * count : count)).maxCoeff() > 0)) return {};
    const Ray ray{from, direction, kOffFace};
    const std::optional<Place> place = first_place(ray);
    // the nearest lamp before that
    double nearest = place ? place->hit.distance : kInfinity;
    const PictureLamp* met = nullptr;
    for (const PictureLamp& lamp : scene_.lamps) {
        const std::optional<double> at = lamp.lamp.distance(from, direction);
        if (!at || !(*at < nearest)) continue;
        nearest = *at;
        met = &lamp;
    }
    if (met) {
        const double radiance = met->lamp.radiance();
        return seen({radiance, radiance, radiance}, met->illuminant, scratch);
    }
    if (!place || step + 1 == kBounces) return surroundings(from, direction, scratch);
    return follow(ray, *place, step + 1, numbers, scratch);
}

/// What smooth faces do to s and p.
void PathTracer::multiply_split(std::span<const float> s_and_p, Scratch& scratch) const {
    const std::size_t count = nodes_.count();
    const std::span<float> through(scratch.through_);
    if (!scratch.split_)
        std::copy_n(through.begin(), count, through.begin() + static_cast<std::ptrdiff_t>(count));
    scratch.split_ = true;
    as_array(through) *= as_array(s_and_p);
}

Triple PathTracer::follow(const Ray& ray, const Place& place, std::size_t step,
                          const Numbers& numbers, Scratch& scratch) const {
    if (place.is_floor) return scatter_on(ray, place, step, 0, numbers, scratch);
    if (!surface_.scatterer) return pass_smooth(ray, place, step, numbers, scratch);
    const Scatterer& scatterer = *surface_.scatterer;
    if (!scatterer.mirrors())
        return scatter_on(ray, place, step, numbers(2 * step + 1)[1], numbers, scratch);
    const auto mirror = [&](double times) {
        const std::size_t width = 2 * nodes_.count();
        scratch.spectrum_.resize(width);
        scatterer.mirror(point_at(place.hit, ray.direction), scratch.spectrum_, scratch.scatterer_);
        multiply_split(scratch.spectrum_, scratch);
        for (double& channel : scratch.tint_) channel *= times;
        return go_on(place.hit.point, mirrored(ray.direction, place.hit.normal), step, numbers,
                     scratch);
    };
    if (step == 0) {  // both, where it is seen best
        Triple color = mirror(1);
        if (!scatterer.scatters()) return color;
        reset(scratch);
        increase(color, scatter_on(ray, place, step, numbers(2 * step + 1)[1], numbers, scratch));
        return color;
    }
    if (!scatterer.scatters()) return mirror(1);
    const double pick = numbers(2 * step + 1)[1];
    if (pick < kMirrorPart) return mirror(1 / kMirrorPart);
    for (double& channel : scratch.tint_) channel /= 1 - kMirrorPart;
    return scatter_on(ray, place, step, (pick - kMirrorPart) / (1 - kMirrorPart), numbers, scratch);
}

/// Mirrored, and refracted where the shape is clear.
Triple PathTracer::pass_smooth(const Ray& ray, const Place& place, std::size_t step,
                               const Numbers& numbers, Scratch& scratch) const {
    const std::size_t count = nodes_.count(), half = 2 * count;
    const FilmPoint at = point_at(place.hit, ray.direction);
    const std::size_t side = place.is_inside && faces_.size() > 1 ? 1 : 0;
    std::vector<float> powers(2 * half);
    if (const Face& face = faces_[side]; face.table)
        face.table->lookup(at.cosine, at.thickness_nm, powers);
    else
        face.spectra(at, powers, scratch.faces_[side]);
    const std::span<const float> R = std::span(powers).first(half),
                                 T = std::span(powers).last(half);
    const Vector3 back = mirrored(ray.direction, place.hit.normal);
    if (is_opaque(scene_.shape)) {
        multiply_split(R, scratch);
        return go_on(place.hit.point, back, step, numbers, scratch);
    }
    const double index = scene_.shape == ShapeKind::bubble ? 1 : scene_.inner_index;
    const std::optional<Vector3> through =
        refracted(ray.direction, place.hit.normal, place.is_inside ? index : 1 / index);
    if (step < kSplits) {
        const std::vector<float> before = scratch.through_;
        const bool was_split = scratch.split_;
        const Triple tint = scratch.tint_;
        multiply_split(R, scratch);
        Triple color = go_on(place.hit.point, back, step, numbers, scratch);
        if (!through) return color;
        scratch.through_ = before;
        scratch.split_ = was_split;
        scratch.tint_ = tint;
        multiply_split(T, scratch);
        increase(color, go_on(place.hit.point, *through, step, numbers, scratch));
        return color;
    }
    const double reflected = static_cast<double>(as_array(R).mean());
    const double passed = through ? static_cast<double>(as_array(T).mean()) : 0;
    constexpr double kLeastChance = 0.05;
    const double chance =
        passed > 0 ? std::clamp(reflected / (reflected + passed), kLeastChance, 1 - kLeastChance)
                   : 1;
    const bool is_back = !(numbers(2 * step + 1)[0] >= chance);
    multiply_split(is_back ? R : T, scratch);
    for (double& channel : scratch.tint_) channel /= is_back ? chance : 1 - chance;
    return go_on(place.hit.point, is_back ? back : *through, step, numbers, scratch);
}

Triple PathTracer::scatter_on(const Ray& ray, const Place& place, std::size_t step, double pick,
                              const Numbers& numbers, Scratch& scratch) const {
    if (place.is_inside) return {};
    const Frame frame(place.hit.normal);
    const Vector3 to = frame.local(-ray.direction);
    const Vector3& point = place.hit.point;
    const auto [u, v] = numbers(2 * step + 2);
    const double strategy = numbers(2 * step + 1)[0];
    Vector3 from;  // in the frame
    if (strategy < surface_part_) {
        if (place.is_floor) {
            const double across = std::sqrt(u), phi = kTwoPi * v;
            from = {across * std::cos(phi), across * std::sin(phi), std::sqrt(1 - u)};
        } else {
            const auto drawn = surface_.scatterer->draw(to, pick, u, v);
            if (!drawn) return {};
            from = *drawn;
        }
    } else {
        const auto number = static_cast<std::size_t>((strategy - surface_part_) / other_part_);
        from =
            frame.local(number < scene_.lamps.size() ? scene_.lamps[number].lamp.draw(point, u, v)
                                                     : sampler_->direction(u, v));
    }
    if (!(from.z > 0)) return {};
    const Vector3 direction = frame.world(from);
    double density =
        surface_part_ * (place.is_floor ? from.z / kPi : surface_.scatterer->density(to, from));
    if (other_part_ > 0) {
        for (const PictureLamp& lamp : scene_.lamps)
            density += other_part_ * lamp.lamp.density(point, direction);
        if (sampler_) density += other_part_ * sampler_->density(direction);
    }
    if (!(density > 0)) return {};
    const std::size_t count = nodes_.count();
    const std::span<float> through = std::span(scratch.through_).first(count);
    if (scratch.split_)
        as_array(through) = 0.5F * (as_array(through) +
                                    as_array(std::span(scratch.through_).subspan(count, count)));
    scratch.split_ = false;
    if (place.is_floor) {
        for (std::size_t c = 0; c < 3; ++c)
            scratch.tint_[c] *= (*scene_.floor)[c] * from.z / kPi / density;
    } else {
        scratch.spectrum_.resize(std::max(scratch.spectrum_.size(), count));
        const std::span<float> spectrum = std::span(scratch.spectrum_).first(count);
        const double nm = point_at(place.hit, ray.direction).thickness_nm;
        surface_.scatterer->scatter(to, from, nm, spectrum, scratch.scatterer_);
        as_array(through) *= static_cast<float>(1 / density) * as_array(spectrum);
    }
    return go_on(point, direction, step, numbers, scratch);
}

}  // namespace irido
