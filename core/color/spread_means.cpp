#include "core/color/spread_means.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/color/held_stack.hpp"
#include "core/color/quadrature/quadrature_color.hpp"
#include "core/color/spread_color.hpp"
#include "core/spectrum/stack_power.hpp"
#include "core/stack/index_table.hpp"
#include "core/vector/spread_program.hpp"

namespace irido {

namespace {

/// Parts of the tolerance: of the means at each wavelength, and of thicknesses below zero, which
/// count with the others; quadrature has the rest.
constexpr double kOfMeans = 0.2, kOfCutTails = 0.05;

/// The means are within reach of roundings below it.
constexpr double kLeastMeanTolerance = 1e-10;

class SpreadMeans : public ColorAlgorithm {
public:
    SpreadMeans(std::unique_ptr<ColorAlgorithm> quadrature, double error)
        : quadrature_(std::move(quadrature)), error_(error) {}

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        (*quadrature_)(stack, angles_deg, colors);
        for (StackColor& color : colors) color.error += error_;
    }

private:
    std::unique_ptr<ColorAlgorithm> quadrature_;
    double error_;  ///< of the means
};

/// Standard deviations of the phase of a round trip, radians, from which on absorbers take too many
/// thicknesses, and the wavelength at which light turns most of what the observer sees. A single
/// absorber takes no longer as a mean of colours.
constexpr double kWideForAbsorber = 1.5, kShortWave_nm = 400;

/// Spread layers thick enough for their distributions: those of other stacks may be, too.
void thicken(std::vector<Element>& elements) {
    constexpr double kDeep = 100;
    for (Element& element : elements) {
        if (Group* group = std::get_if<Group>(&element.value)) {
            thicken(group->elements);
        } else {
            Layer& layer = std::get<Layer>(element.value);
            layer.thickness_nm = std::max(layer.thickness_nm, kDeep * layer.thickness_sigma_nm);
        }
    }
}

/// Whether the vector kernel is likely to have the means for some thicknesses.
bool has_means(Stack stack, const std::vector<bool>& absorbs) {
    thicken(stack.elements);
    const StackPower power(stack);
    SpreadProgram spread;
    if (!power.spread_block() ||
        !compile(power.spread_block()->down, stack.substrate, absorbs, 0, spread))
        return false;
    const Program& program = spread.program;
    const auto spreads =
        std::ranges::count_if(spread.sigma_nm, [](double sigma_nm) { return sigma_nm > 0; });
    for (std::size_t i = 0; i < spread.sigma_nm.size(); ++i) {
        const std::size_t material =
            program.media[program.layers[program.order[i]].medium].material;
        const double turn = 4 * std::numbers::pi / kShortWave_nm * spread.sigma_nm[i] *
                            index_at(stack.materials[material], kShortWave_nm).real();
        if (turn > 0 && absorbs[material] && (spreads == 1 || turn > kWideForAbsorber))
            return false;
    }
    return true;
}

}  // namespace

std::unique_ptr<ColorAlgorithm> spread_means(const ColorTables& tables, const Stack& stack,
                                             const ColorRequest& request) {
    if (!has_spread(stack) || request.tolerance < kLeastMeanTolerance ||
        request.simd == SimdLevel::plain)
        return nullptr;
    const Sensitivity& sensitivity = tables.sensitivity();
    const Stack held = held_stack(stack, sensitivity);
    const IndexTable survey(held, smooth_pieces(held, sensitivity.support()));
    if (std::ranges::find(survey.amplifies(), true) != survey.amplifies().end()) return nullptr;
    ColorRequest means = request;
    means.spread_reach = std::sqrt(-2 * std::log(kOfCutTails * request.tolerance));
    if (!has_means(held, survey.absorbs())) return nullptr;
    means.spread_error = kOfMeans * request.tolerance /
                         std::max(1.0, *std::ranges::max_element(sensitivity.white()));
    means.tolerance = (1 - kOfMeans - kOfCutTails) * request.tolerance;
    return std::make_unique<SpreadMeans>(quadrature_color(tables, stack, means),
                                         (kOfMeans + kOfCutTails) * request.tolerance);
}

}  // namespace irido
