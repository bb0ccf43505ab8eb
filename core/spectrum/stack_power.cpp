#include "core/spectrum/stack_power.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace irido {

namespace {

bool any_layer(std::span<const Element> elements, bool (*is_one)(const Layer&)) {
    return std::ranges::any_of(elements, [&](const Element& element) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) return is_one(*layer);
        return any_layer(std::get<Group>(element.value).elements, is_one);
    });
}

bool needs_expansion(const Layer& layer) {
    return !layer.coherent || layer.thickness_sigma_nm != 0;
}

}  // namespace

bool has_incoherent_layers(std::span<const Element> elements) {
    return any_layer(elements, [](const Layer& layer) { return !layer.coherent; });
}

namespace {

/// A stack with its groups of incoherent layers written out.
class Expansion {
public:
    std::vector<Element> elements;
    std::vector<SpreadLayer> spreads;
    std::vector<std::size_t> spread_of;

    /// Spread layers of repetitions are one spread: `spread` is the first one's number.
    void add(const std::vector<Element>& more, std::size_t& spread) {
        for (const Element& element : more) {
            const Group* group = std::get_if<Group>(&element.value);
            if (group && has_incoherent_layers(group->elements)) {
                add_repeated(*group, spread);
            } else {
                elements.push_back(element);
                add_spreads(element, spread);
            }
            if (elements.size() > StackPower::kLargestIncoherentStack && incoherent_groups_ > 0)
                throw DomainError("groups with incoherent layers must stand for at most " +
                                  std::to_string(StackPower::kLargestIncoherentStack) + " layers");
        }
    }

private:
    void add_repeated(const Group& group, std::size_t& spread) {
        ++incoherent_groups_;
        const std::size_t first = spread;
        for (std::uint64_t i = 0; i < group.repeat; ++i) {
            spread = first;
            add(group.elements, spread);
        }
    }

    void add_spreads(const Element& element, std::size_t& spread) {
        if (const Group* group = std::get_if<Group>(&element.value)) {
            for (const Element& inside : group->elements) add_spreads(inside, spread);
            return;
        }
        const Layer& layer = std::get<Layer>(element.value);
        if (layer.thickness_sigma_nm == 0) return;
        if (spread == spreads.size())
            spreads.push_back({layer.material, layer.thickness_nm, layer.thickness_sigma_nm});
        spread_of.push_back(spread++);
    }

    std::size_t incoherent_groups_ = 0;
};

}  // namespace

void StackPower::assign(const Stack& stack) {
    layer_count_ = count_listed_layers(stack.elements);
    listed_.clear();
    if (layer_count_ <= kLargestLayerList && layer_count_ < count_layers(stack.elements))
        listed_ = listed_layers(stack.elements);
    spreads_.clear();
    spread_of_.clear();
    if (any_layer(stack.elements, needs_expansion)) {
        Expansion expansion;
        std::size_t spread = 0;
        expansion.add(stack.elements, spread);
        if (expansion.spreads.size() > kLargestSpreadLayers)
            throw DomainError("at most " + std::to_string(kLargestSpreadLayers) +
                              " layers can have a thickness_sigma_nm (got " +
                              std::to_string(expansion.spreads.size()) + ")");
        chain_ = chain_of(expansion.elements, stack.substrate);
        spreads_ = std::move(expansion.spreads);
        spread_of_ = std::move(expansion.spread_of);
    } else {
        chain_.blocks.resize(1);
        chain_.blocks[0].down = stack.elements;
        chain_.blocks[0].up.clear();
        chain_.gaps.clear();
        chain_.substrate = stack.substrate;
    }
    mirror_.reset();
    if (has_amplitudes() && !first_uniaxial(stack.materials))
        mirror_ = hosted_mirror(chain_.blocks[0].down, stack.incident, stack.substrate);
}

Response StackPower::operator()(std::span<const Medium> media, double k0, Polarization polarization,
                                const NeededPowers& needs) const {
    Response response = ChainLight(chain_, media, k0, polarization).response();
    if (!has_amplitudes()) response.r = response.t = 0;
    if (mirror_) {
        const auto power =
            mirror_power(*mirror_, media[mirror_->host], media[mirror_->other], k0, polarization);
        if (power) response.power = *power;
    }
    const bool lit = outgoing_wave(media.back(), polarization).flux > 0;
    if (lit && !spreads_.empty())
        response.power =
            SpreadMean(chain_, spreads_, spread_of_, media, k0, polarization).power(needs);
    return response;
}

void StackPower::require_layer_list() const {
    if (layer_count_ > kLargestLayerList)
        throw DomainError("the layers to list must be at most " +
                          std::to_string(kLargestLayerList) + " (got " +
                          std::to_string(layer_count_) + ")");
}

void StackPower::layer_absorption(std::span<const Medium> media, double k0,
                                  Polarization polarization, std::span<double> absorbed) const {
    require_layer_list();
    const bool lit = outgoing_wave(media.back(), polarization).flux > 0;
    std::vector<double> parts(listed_.size());
    const std::span<double> all = listed_.empty() ? absorbed : std::span(parts);
    if (!lit || spreads_.empty())
        ChainLight(chain_, media, k0, polarization).layer_absorption(all);
    else
        SpreadMean(chain_, spreads_, spread_of_, media, k0, polarization).layer_absorption(all);
    if (listed_.empty()) return;
    std::ranges::fill(absorbed, 0);
    for (std::size_t i = 0; i < parts.size(); ++i) absorbed[listed_[i]] += parts[i];
}

}  // namespace irido
