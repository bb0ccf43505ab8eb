#include "core/color/stack_color.hpp"

#include <algorithm>
#include <cmath>

#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace irido {

namespace {

/// Angles that one thread takes at a time.
constexpr std::size_t kAnglesTogether = 16;

/// Errors are measured against colours of this tolerance.
constexpr double kMeasuringTolerance = 1e-9;

}  // namespace

std::unique_ptr<ColorAlgorithm> color_algorithm(const ColorTables& tables, const Stack& stack,
                                                const ColorMethod& method,
                                                const ColorRequest& request) {
    require_in_range("tolerance", request.tolerance, kSmallestTolerance, 1);
    const ColorMethodKind& kind = *method.kind;
    if (method.base_color && !kind.takes_base_color)
        throw DomainError("method " + std::string(kind.name) + " takes no base colour");
    if (const std::string fault = kind.fault_in(stack, request); !fault.empty())
        throw DomainError(fault);
    return kind.prepare(tables, stack, method, request);
}

std::vector<StackColor> stack_color(const ColorAlgorithm& algorithm, const Stack& stack,
                                    std::size_t sides, std::span<const double> angles_deg,
                                    unsigned threads) {
    std::vector<StackColor> colors(angles_deg.size() * sides);
    const std::size_t blocks = (angles_deg.size() + kAnglesTogether - 1) / kAnglesTogether;
    parallel_for(blocks, threads, [&](std::size_t block) {
        const std::size_t begin = block * kAnglesTogether;
        const std::size_t count = std::min(kAnglesTogether, angles_deg.size() - begin);
        algorithm(stack, angles_deg.subspan(begin, count),
                  std::span(colors).subspan(begin * sides, count * sides));
    });
    return colors;
}

std::vector<StackColor> stack_color(const ColorTables& tables, const Stack& stack,
                                    const ColorMethod& method, const ColorRequest& request,
                                    std::span<const double> angles_deg, unsigned threads) {
    ColorRequest all = request;
    all.colors = std::max(request.colors, angles_deg.size());
    return stack_color(*color_algorithm(tables, stack, method, all), stack, request.sides.size(),
                       angles_deg, threads);
}

bool measure_errors(const ColorTables& tables, const Stack& stack, const ColorRequest& request,
                    std::span<const double> angles_deg, unsigned threads,
                    std::span<StackColor> colors) {
    if (std::ranges::all_of(colors, [](const StackColor& c) { return std::isfinite(c.error); }))
        return false;
    ColorRequest exactly = request;
    exactly.tolerance = std::min(request.tolerance, kMeasuringTolerance);
    const std::vector<StackColor> exact =
        stack_color(tables, stack, {}, exactly, angles_deg, threads);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        if (std::isfinite(colors[i].error)) continue;
        colors[i].error = exact[i].error + largest_difference(colors[i].xyz, exact[i].xyz);
    }
    return true;
}

}  // namespace irido
