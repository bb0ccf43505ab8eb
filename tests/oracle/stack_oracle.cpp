#include "tests/oracle/stack_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/truth/reference.hpp"
#include "core/truth/textbook.hpp"
#include "tests/oracle/legendre.hpp"

namespace irido::oracle {

namespace {

using Digits100 = textbook::Digits<100>;

template <class R>
Power as_power(const std::array<R, 2>& rt) {
    return {static_cast<double>(rt[0]), static_cast<double>(rt[1]),
            static_cast<double>(R(1 - rt[0] - rt[1]))};
}

using Extended = long double;
using Mean = std::array<Extended, 2>;

/// A stack whose layers are modified.
struct Averaged {
    textbook::Transfer<Extended> transfer;
    Polarization polarization;

    Averaged(const Stack& stack, const Query& query)
        : transfer(stack, query.wavelength_nm, query.angle_deg), polarization(query.polarization) {}
};

/// Mean over a full period of each incoherent layer's phase.
/// stack     the stack, modified by the call
/// elements  its elements
/// points    number of points per phase
/// phases    current phases
/// layer     index of the layer to average
Mean phase_mean(Averaged& stack, std::span<const Element> elements, int points,
                std::vector<Extended>& phases, std::size_t layer) {
    if (layer == phases.size()) {
        stack.transfer.set_layers(elements, phases);
        return stack.transfer.powers(stack.polarization);
    }
    Mean sum{};
    for (int i = 0; i < points; ++i) {
        phases[layer] =
            std::numbers::pi_v<Extended> * static_cast<Extended>(i) / static_cast<Extended>(points);
        const Mean one = phase_mean(stack, elements, points, phases, layer + 1);
        for (std::size_t k = 0; k < 2; ++k) sum[k] += one[k] / static_cast<Extended>(points);
    }
    return sum;
}

Mean phase_mean(Averaged& stack, std::span<const Element> elements, int points) {
    const auto count = std::ranges::count_if(elements, [](const Element& element) {
        const Layer* layer = std::get_if<Layer>(&element.value);
        return layer && !layer->coherent;
    });
    std::vector<Extended> phases(static_cast<std::size_t>(count));
    return phase_mean(stack, elements, points, phases, 0);
}

Layer* first_spread(std::vector<Element>& elements) {
    for (Element& element : elements) {
        if (Layer* layer = std::get_if<Layer>(&element.value)) {
            if (layer->thickness_sigma_nm > 0) return layer;
        } else if (Layer* inside = first_spread(std::get<Group>(element.value).elements)) {
            return inside;
        }
    }
    return nullptr;
}

Mean spread_mean(Averaged& stack, std::vector<Element> elements, int panels, int points) {
    Layer* layer = first_spread(elements);
    if (!layer) return phase_mean(stack, elements, points);
    static const LegendreRule<Extended> rule(20);
    const double mean = layer->thickness_nm, sigma = layer->thickness_sigma_nm;
    layer->thickness_sigma_nm = 0;
    const double first = std::max(-8.0, -mean / sigma), width = (8 - first) / panels;
    Mean sum{};
    Extended total = 0;
    for (int panel = 0; panel < panels; ++panel) {
        for (std::size_t i = 0; i < rule.x.size(); ++i) {
            const double z = first + width * (panel + 0.5 * (1 + static_cast<double>(rule.x[i])));
            const Extended weight = rule.weight[i] * std::exp(-Extended(z) * z / 2);
            layer->thickness_nm = mean + z * sigma;
            const Mean one = spread_mean(stack, elements, panels, points);
            for (std::size_t k = 0; k < 2; ++k) sum[k] += weight * one[k];
            total += weight;
        }
    }
    for (Extended& value : sum) value /= total;
    return sum;
}

double relative(double a, double b) {
    return b == 0 ? std::abs(a) : std::abs((a - b) / b);
}

}  // namespace

Power coherent(const Stack& stack, const Query& query, std::uint64_t seed) {
    textbook::Transfer<Digits100> transfer(stack, query.wavelength_nm, query.angle_deg,
                                           textbook::Shift::random(seed));
    transfer.set_layers(stack.elements);
    return as_power(transfer.powers(query.polarization));
}

Power coherent(const Medium& above, std::span<const Element> elements, const Medium& below,
               std::span<const Medium> media, double k0, Polarization polarization) {
    textbook::Transfer<Digits100> transfer(above, below, media, k0);
    transfer.set_layers(elements);
    return as_power(transfer.powers(polarization));
}

Power coherent_fast(const Stack& stack, const Query& query) {
    return reference_power(stack, query.wavelength_nm, query.angle_deg, query.polarization,
                           Precision::double_);
}

Scatter scatter(const Stack& stack, const Query& query, int draws) {
    const Power exact = coherent(stack, query);
    Scatter result;
    for (int i = 1; i <= draws; ++i) {
        const Power shifted = coherent(stack, query, static_cast<std::uint64_t>(i) * 7919);
        result.R = std::max(result.R, std::abs(shifted.R - exact.R));
        result.T = std::max(result.T, relative(shifted.T, exact.T));
        result.A = std::max(result.A, relative(shifted.A, exact.A));
    }
    return result;
}

Power incoherent(const Stack& stack, const Query& query, int points) {
    Averaged evaluation(stack, query);
    return as_power(phase_mean(evaluation, stack.elements, points));
}

Power spread(const Stack& stack, const Query& query, int panels, int points) {
    Averaged evaluation(stack, query);
    return as_power(spread_mean(evaluation, stack.elements, panels, points));
}

}  // namespace irido::oracle
