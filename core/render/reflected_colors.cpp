#include "core/render/reflected_colors.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/math/angle_of_cosine.hpp"
#include "core/render/color_nodes.hpp"

namespace irido {

namespace {

/// A colour that no table is made for.
constexpr double kExactTolerance = 1e-6;
/// Of X, Y, Z in a table: 0.01 CIEDE2000 at black.
constexpr double kTableTolerance = 1e-5;
/// Tables over the angle alone cost next to nothing.
constexpr double kUniformTolerance = 0.002;

Triple triple(std::span<const float> values) {
    return {static_cast<double>(values[0]), static_cast<double>(values[1]),
            static_cast<double>(values[2])};
}

}  // namespace

ReflectedColors::ReflectedColors(const ColorTables& tables, const RgbTransform& to_srgb,
                                 SurfaceStack stack, const ColorPlan& plan)
    : stack_(std::move(stack)), to_srgb_(to_srgb) {
    const bool uniform = plan.range.is_uniform();
    ColorRequest request{.tolerance = plan.exact ? kExactTolerance : kTableTolerance,
                         .colors = std::max<std::size_t>(1, plan.points),
                         .simd = plan.simd};
    if (!stack_.varied.empty()) request.varied = {stack_.varied};
    algorithm_ = color_algorithm(tables, stack_.at(plan.range.least_nm), plan.method, request);
    if (plan.exact) {
        report_.reason = "asked for";
        return;
    }
    table_.emplace(
        GridTable::Plan{
            .range = plan.range,
            .channels = 3,
            .tolerance = uniform ? std::min(plan.tolerance, kUniformTolerance) : plan.tolerance,
            .most_samples = plan.points,
            .threads = plan.threads},
        [this](double nm, std::span<const double> cosines, std::span<float> values) {
            compute(nm, cosines, values);
        },
        [](std::span<const float> a, std::span<const float> b) {
            return srgb_difference(triple(a), triple(b));
        });
    report_.cosines = table_->cosines();
    report_.thicknesses = table_->thicknesses();
    report_.evaluations = table_->evaluations();
    report_.error = table_->error();
    if (table_->is_good()) {
        report_.reason = "fewer colours than points";
        return;
    }
    table_.reset();
    report_.cosines = report_.thicknesses = 0;
    report_.reason = "a table would have more colours than the picture";
}

void ReflectedColors::compute(double thickness_nm, std::span<const double> cosines,
                              std::span<float> values) const {
    std::vector<double> angles_deg;
    for (const double cosine : cosines) angles_deg.push_back(angle_of_cosine(cosine));
    std::vector<StackColor> colors(cosines.size());
    (*algorithm_)(stack_.at(thickness_nm), angles_deg, colors);
    const double worst = std::ranges::max(colors, {}, &StackColor::error).error;
    for (double before = color_error_; before < worst;)
        if (color_error_.compare_exchange_weak(before, worst)) break;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const Triple rgb = to_srgb_(colors[i].xyz);
        for (std::size_t c = 0; c < 3; ++c) values[3 * i + c] = static_cast<float>(rgb[c]);
    }
}

ColorReport ReflectedColors::report() const {
    ColorReport report = report_;
    report.color_error = color_error_;
    return report;
}

/// Those of one thickness together, equal ones once.
void ReflectedColors::compute_each(std::span<const FilmPoint> points,
                                   std::span<Triple> colors) const {
    const auto key = [&](std::size_t i) {
        return std::pair(points[i].thickness_nm, points[i].cosine);
    };
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, key);
    std::vector<double> cosines;
    std::vector<float> values;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        const double nm = points[order[begin]].thickness_nm;
        cosines.clear();
        for (end = begin; end < order.size() && points[order[end]].thickness_nm == nm; ++end)
            if (cosines.empty() || cosines.back() != points[order[end]].cosine)
                cosines.push_back(points[order[end]].cosine);
        values.resize(3 * cosines.size());
        compute(nm, cosines, values);
        for (std::size_t i = begin, at = 0; i < end; ++i) {
            if (points[order[i]].cosine != cosines[at]) ++at;
            colors[order[i]] = triple(std::span(values).subspan(3 * at, 3));
        }
    }
}

void ReflectedColors::operator()(std::span<const FilmPoint> points,
                                 std::span<Triple> colors) const {
    if (!table_) return compute_each(points, colors);
    std::array<float, 3> found{};
    for (std::size_t i = 0; i < points.size(); ++i) {
        table_->lookup(points[i].cosine, points[i].thickness_nm, found);
        colors[i] = triple(found);
    }
}

}  // namespace irido
