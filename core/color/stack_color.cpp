#include "core/color/stack_color.hpp"

#include <algorithm>

#include "core/color/quadrature_color.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace irido {

namespace {

/// Every material must be known here, or say what it does outside its range.
constexpr WavelengthRange kEssential{400, 700};

/// Angles that one thread takes at a time.
constexpr std::size_t kAnglesTogether = 16;

}  // namespace

std::vector<HeldRange> held_ranges(const Stack& stack, const Sensitivity& sensitivity) {
    const WavelengthRange support = sensitivity.support();
    std::vector<HeldRange> held;
    for (std::size_t m = 0; m < stack.materials.size(); ++m) {
        const Material& material = stack.materials[m];
        const WavelengthRange range = range_of(material);
        if (material.outside == Outside::clamp ||
            (range.first_nm <= support.first_nm && range.last_nm >= support.last_nm))
            continue;
        HeldRange entry{m, range, true, {}};
        entry.usable = range.first_nm <= kEssential.first_nm && range.last_nm >= kEssential.last_nm;
        const WavelengthRange inside{std::max(range.first_nm, support.first_nm),
                                     std::min(range.last_nm, support.last_nm)};
        const Triple known =
            inside.first_nm < inside.last_nm ? sensitivity.integral(inside) : Triple{};
        for (std::size_t c = 0; c < 3; ++c)
            entry.weight[c] = std::max(0.0, 1 - known[c] / sensitivity.white()[c]);
        held.push_back(entry);
    }
    return held;
}

std::vector<ColorIntegral> stack_color(const Stack& stack, const Sensitivity& sensitivity,
                                       std::span<const double> angles_deg,
                                       std::span<const Side> sides, const IntegrationLimits& limits,
                                       const Execution& execution, Light light) {
    for (const HeldRange& entry : held_ranges(stack, sensitivity))
        if (!entry.usable)
            throw DomainError(
                stack.materials[entry.material].name + " must be known from 400 to 700 nm (got " +
                to_text(entry.range.first_nm) + " to " + to_text(entry.range.last_nm) + " nm)");
    const ColorTables tables(sensitivity);
    const ColorRequest request{
        {sides.begin(), sides.end()}, light, limits.tolerance, limits.evaluations, execution.simd};
    const std::unique_ptr<ColorAlgorithm> algorithm = quadrature_color(tables, stack, request);
    std::vector<StackColor> colors(angles_deg.size() * sides.size());
    const std::size_t blocks = (angles_deg.size() + kAnglesTogether - 1) / kAnglesTogether;
    parallel_for(blocks, execution.threads, [&](std::size_t block) {
        const std::size_t begin = block * kAnglesTogether;
        const std::size_t count = std::min(kAnglesTogether, angles_deg.size() - begin);
        (*algorithm)(stack, angles_deg.subspan(begin, count),
                     std::span(colors).subspan(begin * sides.size(), count * sides.size()));
    });
    std::vector<ColorIntegral> result;
    for (const StackColor& color : colors)
        result.push_back({color.xyz, color.error, color.evaluations});
    return result;
}

}  // namespace irido
