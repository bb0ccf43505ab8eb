#include "cli/queries/color_cone.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/math/adaptive_integral.hpp"
#include "core/math/constants.hpp"

namespace irido::cli {

namespace {

constexpr double kIndexWavelength_nm = 550;
constexpr std::size_t kAnglesOfCone = 48;  ///< about
constexpr double kNodesShare = 0.1;        ///< of the tolerance

double cone_tolerance(const ColorRequest& request) {
    return std::min(kColorConeError, request.tolerance / 2);
}

Complex index_near(Material material) {
    material.outside = Outside::clamp;
    return index_at(material, kIndexWavelength_nm);
}

}  // namespace

std::vector<ColorRequest> cone_requests(const ColorRequest& request) {
    ColorRequest one = request;
    one.colors *= kAnglesOfCone;
    one.tolerance = std::max(kSmallestTolerance, kNodesShare * cone_tolerance(request));
    if (request.light == Light::unpolarized) return {one};
    ColorRequest other = one;
    one.light = Light::s;
    other.light = Light::p;
    return {one, other};
}

std::vector<StackColor> cone_colors(std::span<const ColorAlgorithm* const> algorithms,
                                    const Stack& stack, const ColorRequest& request,
                                    std::span<const double> angles_deg, const ConeSize& size,
                                    unsigned threads) {
    const std::size_t sides = request.sides.size();
    const double n0 = index_near(stack.materials[stack.incident]).real();
    std::vector<Complex> constant_indices;
    for (const Material& material : stack.materials) {
        if (!is_constant(material)) continue;
        constant_indices.push_back(index_near(material));
        if (is_uniaxial(material))
            constant_indices.push_back(extraordinary_index_at(material, kIndexWavelength_nm));
    }
    std::vector<StackColor> result;
    for (const double axis_deg : angles_deg) {
        const ConeLight light({axis_deg, size.half_angle(n0)});
        const std::vector<double> ends = light.smooth_ends(constant_indices, n0);
        std::vector<double> steps(ends.size());
        for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = static_cast<double>(i);
        std::vector<StackColor> mean(sides);
        for (StackColor& color : mean) color.error = 0;
        const auto values_at = [&](std::span<const double> points, std::span<double> values) {
            std::vector<double> angles;
            std::vector<ConeShares> shares;
            for (const double t : points) {
                const ConeNode node = light.node(t, ends);
                angles.push_back(std::min(kLargestAngle_deg, node.theta / kDegree));
                const auto [s, p] = node.shares;
                shares.push_back(request.light == Light::unpolarized ? ConeShares{s + p, 0}
                                 : request.light == Light::s         ? ConeShares{s, p}
                                                                     : ConeShares{p, s});
            }
            std::ranges::fill(values, 0);
            for (std::size_t a = 0; a < algorithms.size(); ++a) {
                const auto colors = stack_color(*algorithms[a], stack, sides, angles, threads);
                for (std::size_t i = 0; i < colors.size(); ++i) {
                    const ConeShares& of = shares[i / sides];
                    for (std::size_t c = 0; c < 3; ++c)
                        values[3 * i + c] += (a == 0 ? of.s : of.p) * colors[i].xyz[c];
                    StackColor& color = mean[i % sides];
                    color.error = std::max(color.error, colors[i].error);
                    color.evaluations += colors[i].evaluations;
                    color.method = colors[i].method;
                }
            }
        };
        const double tolerance = cone_tolerance(request);
        const auto found = integrals(steps, 3 * sides, tolerance, values_at);
        if (!found)
            throw ToleranceError("the colour over the cone cannot be found to " +
                                 to_text(tolerance) + " at " + to_text(axis_deg) + " degrees");
        for (std::size_t side = 0; side < sides; ++side) {
            std::copy_n(found->begin() + static_cast<std::ptrdiff_t>(3 * side), 3,
                        mean[side].xyz.begin());
            mean[side].error += tolerance;
        }
        result.insert(result.end(), mean.begin(), mean.end());
    }
    return result;
}

}  // namespace irido::cli
