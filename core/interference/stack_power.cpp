#include "core/interference/stack_power.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/gauss.hpp"

namespace irido {

namespace {

bool has_incoherent(const Group& group) {
    return std::ranges::any_of(group.elements, [](const Element& element) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) return !layer->coherent;
        return has_incoherent(std::get<Group>(element.value));
    });
}

/// Elements with groups that contain incoherent layers written out.
void expand_incoherent(const std::vector<Element>& elements, std::vector<Element>& out) {
    for (const Element& element : elements) {
        const Group* group = std::get_if<Group>(&element.value);
        if (!group || !has_incoherent(*group)) {
            out.push_back(element);
        } else {
            for (std::uint64_t i = 0; i < group->repeat; ++i) {
                expand_incoherent(group->elements, out);
                if (out.size() > StackPower::kLargestIncoherentStack)
                    throw DomainError("groups with incoherent layers must stand for at most " +
                                      std::to_string(StackPower::kLargestIncoherentStack) +
                                      " layers");
            }
        }
    }
}

std::vector<Element> reversed(const std::vector<Element>& elements) {
    std::vector<Element> result(elements.rbegin(), elements.rend());
    for (Element& element : result)
        if (Group* group = std::get_if<Group>(&element.value))
            group->elements = reversed(group->elements);
    return result;
}

/// Layers with a spread, in order, as they are written (a repeated group counts once).
void spread_layers(std::vector<Element>& elements, std::vector<Layer*>& out) {
    for (Element& element : elements) {
        if (Layer* layer = std::get_if<Layer>(&element.value)) {
            if (layer->thickness_sigma_nm > 0) out.push_back(layer);
        } else {
            spread_layers(std::get<Group>(element.value).elements, out);
        }
    }
}

Power operator*(double f, const Power& p) {
    return {f * p.R, f * p.T, f * p.A};
}

Power operator+(const Power& a, const Power& b) {
    return {a.R + b.R, a.T + b.T, a.A + b.A};
}

double distance(const Power& a, const Power& b) {
    return std::max({std::abs(a.R - b.R), std::abs(a.T - b.T), std::abs(a.A - b.A)});
}

/// Averages over a spread thickness agree to this when the panels double.
constexpr double kSpreadError = 1e-10;

/// A narrow line between two thicknesses turns the denominator by half a turn.
constexpr double kResolvedTurn = 1.5;

/// Of 16 thicknesses each; past it the last average is taken.
constexpr int kMostSpreadPanels = 4096;

/// exp(-2 k0 d Im kz) of an incoherent layer, and what it takes away.
struct Attenuation {
    double kept, lost;
};

Attenuation attenuation(const Medium& m, double k0_d) {
    const double exponent = -2 * k0_d * std::abs(std::sqrt(m.q2).imag());
    return {std::exp(exponent), -std::expm1(exponent)};
}

/// Powers of a block over a gap over all that lies below it; `down` and `up` are the block's own
/// powers for light from above and from the gap.
Power over_gap(const Power& down, const Power& up, const Attenuation& gap, const Power& below) {
    if (down.T == 0) return down;
    const double returned = gap.kept * below.R;  // of the light that enters the gap, at its bottom
    const double entering = down.T / (1 - up.R * gap.kept * returned);
    return {down.R + entering * gap.kept * returned * up.T, entering * gap.kept * below.T,
            down.A + entering * (gap.lost * (1 + returned) + gap.kept * below.A +
                                 gap.kept * returned * up.A)};
}

}  // namespace

StackPower::StackPower(const Stack& stack) : substrate_(stack.substrate) {
    expand_incoherent(stack.elements, elements_);
    chain_ = chain_of(elements_);
    std::vector<Layer*> spread;
    spread_layers(elements_, spread);
    spread_layers_ = spread.size();
    if (spread_layers_ > kLargestSpreadLayers)
        throw DomainError("at most " + std::to_string(kLargestSpreadLayers) +
                          " layers can have a thickness_sigma_nm (got " +
                          std::to_string(spread_layers_) + ")");
}

StackPower::Chain StackPower::chain_of(const std::vector<Element>& elements) {
    Chain chain;
    chain.blocks.emplace_back();
    for (const Element& element : elements) {
        const Layer* layer = std::get_if<Layer>(&element.value);
        if (layer && !layer->coherent) {
            chain.gaps.push_back(*layer);
            chain.blocks.emplace_back();
        } else {
            chain.blocks.back().down.push_back(element);
        }
    }
    if (!chain.gaps.empty())
        for (Block& block : chain.blocks) block.up = reversed(block.down);
    return chain;
}

Response StackPower::of_chain(const Chain& chain, std::span<const Medium> media, double k0,
                              Polarization polarization) const {
    const auto above = [&](std::size_t block) -> const Medium& {
        return block == 0 ? media.back() : media[chain.gaps[block - 1].material];
    };
    Response total = coherent_response(above(chain.gaps.size()), chain.blocks.back().down,
                                       media[substrate_], media, k0, polarization);
    for (std::size_t i = chain.gaps.size(); i-- > 0;) {
        const Layer& gap = chain.gaps[i];
        const Medium& inside = media[gap.material];
        const Block& block = chain.blocks[i];
        const Response down =
            coherent_response(above(i), block.down, inside, media, k0, polarization);
        const Power up =
            coherent_response(inside, block.up, above(i), media, k0, polarization).power;
        total.power =
            over_gap(down.power, up, attenuation(inside, k0 * gap.thickness_nm), total.power);
        total.denominator *= down.denominator / std::abs(down.denominator);
        total.log_scale += down.log_scale + std::log(std::abs(down.denominator));
    }
    return total;
}

Response StackPower::averaged(std::vector<Element>& elements, std::size_t spread,
                              std::span<const Medium> media, double k0,
                              Polarization polarization) const {
    if (spread == spread_layers_) return of_chain(chain_of(elements), media, k0, polarization);
    std::vector<Layer*> layers;
    spread_layers(elements, layers);
    Layer& layer = *layers[spread];
    const double mean = layer.thickness_nm, sigma = layer.thickness_sigma_nm;
    const double first = std::max(-8.0, -mean / sigma), last = 8;
    double largest_turn = 0;  // of the denominator between neighbouring thicknesses
    const auto average = [&](int panels) {
        Power sum;
        double weight = 0;
        Complex before = 0;
        largest_turn = 0;
        for (int panel = 0; panel < panels; ++panel) {
            const double width = (last - first) / panels, start = first + panel * width;
            for (const GaussNode& node : gauss_legendre<16>()) {
                const double z = start + width * (node.x + 1) / 2;
                const double w = node.weight * std::exp(-z * z / 2);
                layer.thickness_nm = mean + z * sigma;
                const Response here = averaged(elements, spread + 1, media, k0, polarization);
                sum = sum + w * here.power;
                weight += w;
                if (before != 0.0)
                    largest_turn = std::max(
                        largest_turn, std::abs(std::arg(here.denominator * std::conj(before))));
                before = here.denominator;
            }
        }
        layer.thickness_nm = mean;
        return (1 / weight) * sum;
    };
    const double fringes = k0 * sigma * std::abs(std::sqrt(media[layer.material].eps).real());
    int panels = 2 + static_cast<int>(std::min(2 * fringes, kMostSpreadPanels / 8.0));
    Power coarse = average(panels);
    for (;;) {
        panels *= 2;
        const Power fine = average(panels);
        const bool met = distance(coarse, fine) < kSpreadError && largest_turn < kResolvedTurn;
        if (met || panels > kMostSpreadPanels) return {fine};
        coarse = fine;
    }
}

Response StackPower::operator()(std::span<const Medium> media, double k0,
                                Polarization polarization) const {
    Response response = of_chain(chain_, media, k0, polarization);
    if (spread_layers_ == 0) return response;
    std::vector<Element> elements = elements_;
    response.power = averaged(elements, 0, media, k0, polarization).power;
    return response;
}

}  // namespace irido
