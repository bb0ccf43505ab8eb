#include "core/scratch/light.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/scratch/vectors.hpp"

namespace irido {

namespace {

constexpr double kFarthestLight_mm = 1e12;

/// Nothing of a vector without length.
std::optional<UnitVector> unit_of(const Place& v) {
    const double length = length_of(v);
    if (!(length > 0)) return std::nullopt;
    return UnitVector{v[0] / length, v[1] / length, v[2] / length};
}
void require_place(std::string_view name, const Place& place) {
    for (const double value : place)
        require_in_range(name, value, -kFarthestLight_mm, kFarthestLight_mm);
}

}  // namespace

LightCone::LightCone(const AreaLight& light) : light_(light) {
    if (const auto* sphere = std::get_if<SphereLight>(&light))
        set_sphere(*sphere);
    else
        set_polygon(std::get<PolygonLight>(light));
}

void LightCone::set_sphere(const SphereLight& light) {
    require_place("center_mm", light.center_mm);
    require_in_range("radius_mm", light.radius_mm, std::numeric_limits<double>::min(),
                     kFarthestLight_mm);
    const Place& c = light.center_mm;
    const double distance = length_of(c), sine = light.radius_mm / distance;
    if (!(sine < 1))
        throw DomainError("radius_mm must be below the distance of center_mm, " +
                          to_text(distance) + " (got " + to_text(light.radius_mm) + ")");
    bound_ = {*unit_of(c), std::sqrt((1 - sine) * (1 + sine))};
    half_spaces_ = {bound_};
    half_angle_ = std::asin(sine);
}

void LightCone::set_polygon(const PolygonLight& light) {
    constexpr std::size_t kMostCorners = 256;
    constexpr double kRounding = 1e-9;
    const std::size_t count = light.vertices_mm.size();
    if (count < 3 || count > kMostCorners)
        throw DomainError("vertices_mm must be 3 to 256 points (got " + std::to_string(count) +
                          ")");
    Place sum{};
    for (const Place& vertex : light.vertices_mm) {
        require_place("vertices_mm", vertex);
        const auto corner = unit_of(vertex);
        if (!corner) throw DomainError("vertices_mm must not contain the shaded point itself");
        corners_.push_back(*corner);
        for (std::size_t i = 0; i < 3; ++i) sum[i] += (*corner)[i];
    }
    const auto axis = unit_of(sum);
    for (std::size_t i = 0; i < count && axis; ++i) {
        auto normal = unit_of(cross(corners_[i], corners_[(i + 1) % count]));
        if (!normal) continue;  // two vertices in one direction
        if (dot(*normal, *axis) < 0)
            for (double& value : *normal) value = -value;
        half_spaces_.push_back({*normal, 0});
    }
    const auto is_outside = [&](const UnitVector& corner) {
        return std::ranges::any_of(half_spaces_, [&](const HalfSpace& half) {
            return dot(half.normal, corner) < -kRounding;
        });
    };
    const auto is_flat = [&](const HalfSpace& half) {  // all corners on it: seen edge-on
        constexpr double kThinnest = 1e-13;
        return std::ranges::none_of(corners_, [&](const UnitVector& corner) {
            return dot(half.normal, corner) > kThinnest;
        });
    };
    if (!axis || half_spaces_.size() < 3 || std::ranges::any_of(corners_, is_outside) ||
        std::ranges::any_of(half_spaces_, is_flat))
        throw DomainError(
            "vertices_mm must be a convex polygon, in order, whose plane does not "
            "contain the shaded point");
    bound_ = {*axis, 1};
    for (const UnitVector& corner : corners_) {
        const double cosine = dot(*axis, corner);
        const Place off = cross(*axis, corner);
        bound_.least = std::min(bound_.least, cosine);
        half_angle_ = std::max(half_angle_, std::atan2(std::sqrt(dot(off, off)), cosine));
    }
    if (bound_.least < 0)
        bound_.least = -1;  // a cap above a hemisphere holds no hull of its corners
}

bool LightCone::contains(const UnitVector& direction) const {
    return direction[2] >= 0 && std::ranges::all_of(half_spaces_, [&](const HalfSpace& half) {
               return dot(half.normal, direction) >= half.least;
           });
}

LightSlices::LightSlices(const LightCone& cone, std::array<double, 2> tangent) {
    const auto [tx, ty] = tangent;
    for (const HalfSpace& half : cone.half_spaces()) {
        const auto& [x, y, z] = half.normal;
        const double across = y * tx - x * ty;
        cuts_.push_back(
            {x * tx + y * ty, std::atan2(across, z), std::hypot(across, z), half.least});
    }
    set_breaks(cone, tangent);
}

std::vector<Arc> LightSlices::at(double tau) const {
    std::vector<Arc> arcs{{-kPi / 2, kPi / 2}}, cut;
    const double r = std::sqrt((1 - tau) * (1 + tau));
    for (const Cut& half : cuts_) {
        const double m = r * half.across, k = half.least - half.along * tau;
        if (k <= -m) continue;
        if (k > m) return {};
        const double reach = std::atan2(std::sqrt((m - k) * (m + k)), k);
        cut.clear();
        for (const Arc& arc : arcs)
            for (const double turn : {-kTwoPi, 0.0, kTwoPi}) {
                const double from = std::max(arc.from, half.middle + turn - reach),
                             to = std::min(arc.to, half.middle + turn + reach);
                if (from < to) cut.push_back({from, to});
            }
        arcs.swap(cut);
        if (arcs.empty()) return {};
    }
    std::ranges::sort(arcs, {}, &Arc::from);
    return arcs;
}

/// The arcs' ends can only turn sharply where a boundary touches the slice, or two boundaries meet
/// on it. Places beyond the light do no harm but cost a panel.
void LightSlices::set_breaks(const LightCone& cone, std::array<double, 2> tangent) {
    constexpr double kSlack = 1e-9;
    const double tx = tangent[0], ty = tangent[1];
    std::vector<HalfSpace> all(cone.half_spaces().begin(), cone.half_spaces().end());
    all.push_back({{0, 0, 1}, 0});
    const auto is_inside = [&](const Place& w) {
        return std::ranges::all_of(
            all, [&](const HalfSpace& half) { return dot(half.normal, w) >= half.least - kSlack; });
    };
    std::vector<double> found;
    const auto add = [&](const std::optional<UnitVector>& w) {
        if (w && is_inside(*w)) found.push_back(std::clamp((*w)[0] * tx + (*w)[1] * ty, -1.0, 1.0));
    };
    const auto add_mix = [&](const Place& a, double x, const Place& b, double y, const Place& c,
                             double z) {
        Place w{};
        for (std::size_t i = 0; i < 3; ++i) w[i] = a[i] * x + b[i] * y + c[i] * z;
        add(unit_of(w));
    };
    for (const UnitVector& corner : cone.corners()) add(corner);
    const Place along{tx, ty, 0}, none{};
    add(along);
    add_mix(along, -1, none, 0, none, 0);
    for (const HalfSpace& half : all) {
        // ends of its circle along the tangent: c n +- sqrt(1 - c^2) times the tangent across n
        Place side{};
        const double rise = dot(along, half.normal);
        for (std::size_t i = 0; i < 3; ++i) side[i] = along[i] - rise * half.normal[i];
        const double sine = std::sqrt((1 - half.least) * (1 + half.least));
        if (const auto unit = unit_of(side))
            for (const double sign : {-1.0, 1.0})
                add_mix(half.normal, half.least, *unit, sign * sine, none, 0);
        // where it meets the horizon; edges meet each other in the corners
        const Place& n = half.normal;
        const double flat = std::hypot(n[0], n[1]);
        if (!(flat > 0) || std::abs(half.least) > flat) continue;
        const double c = half.least / flat, s = std::sqrt((1 - c) * (1 + c));
        const Place level{n[0] / flat, n[1] / flat, 0}, turned{-level[1], level[0], 0};
        for (const double sign : {-1.0, 1.0}) add_mix(level, c, turned, sign * s, none, 0);
    }
    std::ranges::sort(found);
    for (const double tau : found)
        if (breaks_.empty() || tau - breaks_.back() > 1e-15) breaks_.push_back(tau);
    if (breaks_.size() < 2) breaks_.clear();
}

}  // namespace irido
