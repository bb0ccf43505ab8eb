#include "cli/bench/color_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "cli/stopwatch.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "schemas/readers/stack_expression.hpp"

namespace irido::cli {

namespace {

constexpr double kReferenceTolerance = 1e-11;

/// A first run that takes this many times the time budget is not repeated.
constexpr double kSlow = 10;

std::size_t colors_of(const ColorFamily& family) {
    return family.variants.size() * family.angles_deg.size();
}

}  // namespace

ColorComparison::ColorComparison(const ColorTables& tables, std::vector<ColorFamily> families,
                                 bool is_set, double seconds, SimdLevel simd)
    : tables_(tables),
      families_(std::move(families)),
      is_set_(is_set),
      seconds_(seconds),
      simd_(simd) {
    for (const ColorFamily& family : families_) count_ += colors_of(family);
    const Algorithms exact = algorithms(color_method("quadrature"), request(kReferenceTolerance));
    for (const StackColor& color : colors(exact)) exact_.push_back(color.xyz);
}

ColorRequest ColorComparison::request(double tolerance) const {
    ColorRequest result;
    result.tolerance = tolerance;
    result.colors = std::size_t{1} << 30;
    if (is_set_) result.structures = result.colors;
    result.simd = simd_;
    return result;
}

ColorComparison::Algorithms ColorComparison::algorithms(const ColorMethod& method,
                                                        const ColorRequest& request) const {
    Algorithms result;
    for (const ColorFamily& family : families_)
        result.push_back(color_algorithm(tables_, family.variants.front(), method, request));
    return result;
}

void ColorComparison::compute(const ColorAlgorithm& algorithm, const ColorFamily& family,
                              std::span<StackColor> colors) const {
    const std::size_t angles = family.angles_deg.size();
    for (std::size_t v = 0; v < family.variants.size(); ++v)
        algorithm(family.variants[v], family.angles_deg, colors.subspan(v * angles, angles));
}

std::vector<StackColor> ColorComparison::colors(const Algorithms& algorithms) const {
    std::vector<StackColor> result(count_);
    std::size_t first = 0;
    for (std::size_t i = 0; i < families_.size(); ++i) {
        compute(*algorithms[i], families_[i], std::span(result).subspan(first));
        first += colors_of(families_[i]);
    }
    return result;
}

ColorComparison::Run ColorComparison::run(const ColorMethod& method, double tolerance) const {
    const ColorRequest asked = request(tolerance);
    Algorithms ready;
    std::vector<StackColor> found;
    const double preparing = thread_seconds_of([&] { ready = algorithms(method, asked); });
    const double calling = thread_seconds_of([&] { found = colors(ready); });
    double seconds = is_set_ ? preparing + calling : calling;
    if (seconds < kSlow * seconds_)
        seconds = best_thread_seconds(seconds_, [&] {
            if (is_set_) ready = algorithms(method, asked);
            found = colors(ready);
        });
    return {std::move(found), 1e9 * seconds / static_cast<double>(count_)};
}

double ColorComparison::max_error(const std::vector<StackColor>& colors) const {
    double largest = 0;
    for (std::size_t i = 0; i < count_; ++i)
        largest = std::max(largest, largest_difference(colors[i].xyz, exact_[i]));
    return largest;
}

std::optional<MethodReport> ColorComparison::measure(const ColorMethod& method,
                                                     double tolerance) const {
    Run done;
    try {
        done = run(method, tolerance);
    } catch (const DomainError&) {
        return std::nullopt;
    }
    const std::vector<StackColor>& found = done.colors;
    MethodReport report;
    report.colors = static_cast<double>(count_);
    report.max_error = max_error(found);
    report.ns_per_color = done.ns_per_color;
    const Triple& white = tables_.sensitivity().white();
    std::vector<double> differences;
    for (std::size_t i = 0; i < count_; ++i) {
        report.evaluations += static_cast<double>(found[i].evaluations);
        differences.push_back(ciede2000(lab(found[i].xyz, white), lab(exact_[i], white)));
        report.mean_de += differences.back() / report.colors;
    }
    report.evaluations /= report.colors;
    auto worst =
        static_cast<std::size_t>(std::ranges::max_element(differences) - differences.begin());
    report.max_de = differences[worst];
    const RgbSpace& srgb = rgb_space("srgb");
    const RgbTransform transform(srgb, white, Adaptation::bradford);
    report.worst_hex = hex(srgb, transform(found[worst].xyz));
    report.exact_hex = hex(srgb, transform(exact_[worst]));
    auto family = families_.begin();
    for (; worst >= colors_of(*family); ++family) worst -= colors_of(*family);
    const std::size_t angles = family->angles_deg.size();
    report.worst_stack = schemas::stack_expression(family->variants[worst / angles]).text;
    report.worst_angle_deg = family->angles_deg[worst % angles];
    std::ranges::sort(differences);
    report.p95_de = differences[(differences.size() * 95 + 99) / 100 - 1];
    return report;
}

double ColorComparison::equal_error(std::size_t count) {
    const auto [known, is_new] = equal_errors_.try_emplace(count, 0);
    if (is_new)
        known->second = max_error(colors(algorithms(color_method("equal", count), request(1))));
    return known->second;
}

EqualMatch ColorComparison::equal_match(double max_error) {
    std::size_t enough = 4, few = 2;
    while (equal_error(enough) > max_error) {
        few = enough;
        enough *= 2;
        if (enough > kMostEqual) return {};
    }
    while (enough - few > enough / 32 + 1) {
        const std::size_t middle = few + (enough - few) / 2;
        (equal_error(middle) > max_error ? few : enough) = middle;
    }
    const auto [known, is_new] = equal_ns_.try_emplace(enough, 0);
    if (is_new) known->second = run(color_method("equal", enough), 1).ns_per_color;
    return {static_cast<double>(enough), known->second};
}

}  // namespace irido::cli
