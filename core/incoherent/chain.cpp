#include "core/incoherent/chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/stack/reversed.hpp"

namespace irido {

Chain chain_of(const std::vector<Element>& elements, std::size_t substrate) {
    Chain chain{{}, {}, substrate};
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
    for (std::size_t i = 0; i < chain.gaps.size(); ++i)
        chain.blocks[i].up = reversed(chain.blocks[i].down);
    return chain;
}

namespace {

/// Layers for which counts(layer) is true.
template <class Counts>
std::size_t count_if(std::span<const Element> elements, const Counts& counts) {
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    std::size_t count = 0;
    for (const Element& element : elements) {
        std::size_t more = 0;
        if (const Group* group = std::get_if<Group>(&element.value)) {
            more = count_if(group->elements, counts);
            if (more > most / group->repeat) return most;
            more *= group->repeat;
        } else if (counts(std::get<Layer>(element.value))) {
            more = 1;
        }
        if (more > most - count) return most;
        count += more;
    }
    return count;
}

void write_out(std::span<const Element> elements, std::vector<Layer>& to) {
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            to.push_back(*layer);
            continue;
        }
        const Group& group = std::get<Group>(element.value);
        for (std::uint64_t i = 0; i < group.repeat; ++i) write_out(group.elements, to);
    }
}

}  // namespace

std::size_t count_layers(std::span<const Element> elements) {
    return count_if(elements, [](const Layer&) { return true; });
}

std::size_t count_listed_layers(std::span<const Element> elements) {
    return count_if(elements, [](const Layer& layer) { return layer.part <= 1; });
}

std::vector<Layer> written_out(std::span<const Element> elements) {
    std::vector<Layer> layers;
    write_out(elements, layers);
    return layers;
}

std::vector<std::size_t> listed_layers(std::span<const Element> elements) {
    std::vector<std::size_t> places;
    std::size_t next = 0;
    std::uint32_t before = 0;
    for (const Layer& layer : written_out(elements)) {
        // parts follow each other, whichever end the stack is seen from
        const bool continues = layer.part != 0 && before != 0 &&
                               (layer.part == before + 1 || before == layer.part + 1);
        if (!continues) ++next;
        places.push_back(next - 1);
        before = layer.part;
    }
    return places;
}

std::optional<Chain> joined(const Chain& chain, std::span<const Medium> media) {
    const auto parts = [&](const Layer& gap) {
        return travels(media[gap.material]) && gap.thickness_nm + gap.thickness_sigma_nm > 0;
    };
    if (std::ranges::all_of(chain.gaps, parts)) return std::nullopt;
    std::vector<Element> elements = chain.blocks[0].down;
    for (std::size_t i = 0; i < chain.gaps.size(); ++i) {
        Layer gap = chain.gaps[i];
        gap.coherent = !parts(gap);
        elements.push_back({gap});
        const std::vector<Element>& below = chain.blocks[i + 1].down;
        elements.insert(elements.end(), below.begin(), below.end());
    }
    return chain_of(elements, chain.substrate);
}

Wave ChainLight::in_gap(std::size_t i) const {
    const Layer& layer = chain_.gaps[i];
    return wave_in_gap(media_[layer.material], k0_ * layer.thickness_nm, polarization_);
}

Wave ChainLight::above(std::size_t block) const {
    if (block == 0) return outgoing_wave(media_.back(), polarization_);
    return in_gap(block - 1);
}

Wave ChainLight::below(std::size_t block) const {
    if (block == last_block()) return outgoing_wave(media_[chain_.substrate], polarization_);
    return in_gap(block);
}

Attenuation ChainLight::gap(std::size_t i) const {
    const Layer& layer = chain_.gaps[i];
    return attenuation(media_[layer.material], k0_ * layer.thickness_nm);
}

Response ChainLight::down(std::size_t block) const {
    return coherent_response(above(block), chain_.blocks[block].down, below(block), media_, k0_,
                             polarization_);
}

Response ChainLight::up(std::size_t block) const {
    return coherent_response(below(block), chain_.blocks[block].up, above(block), media_, k0_,
                             polarization_);
}

Response ChainLight::response() const {
    if (last_block() == 0)
        return coherent_response(media_.back(), chain_.blocks[0].down, media_[chain_.substrate],
                                 media_, k0_, polarization_);
    Response total = down(last_block());
    for (std::size_t i = last_block(); i-- > 0;) {
        const Response block = down(i);
        total.power = over_gap({block.power, up(i).power}, gap(i), total.power);
        const double size = std::abs(block.denominator);
        total.denominator *= block.denominator / size;
        total.log_scale += block.log_scale + std::log(size);
    }
    total.r = total.t = 0;
    return total;
}

void ChainLight::add_block_layers(std::size_t i, double from_above, double from_below,
                                  std::span<double> absorbed) const {
    const Block& block = chain_.blocks[i];
    std::vector<double> part(absorbed.size());
    coherent_layer_absorption(above(i), block.down, below(i), media_, k0_, polarization_, part);
    for (std::size_t j = 0; j < part.size(); ++j) absorbed[j] = from_above * part[j];
    if (from_below == 0) return;
    coherent_layer_absorption(below(i), block.up, above(i), media_, k0_, polarization_, part);
    for (std::size_t j = 0; j < part.size(); ++j)
        absorbed[j] += from_below * part[part.size() - 1 - j];
}

void ChainLight::layer_absorption(std::span<double> absorbed) const {
    const std::size_t last = last_block();
    if (last == 0) return add_block_layers(0, 1, 0, absorbed);
    std::vector<Response> downs(last + 1), ups(last);
    for (std::size_t i = 0; i <= last; ++i) downs[i] = down(i);
    for (std::size_t i = 0; i < last; ++i) ups[i] = up(i);
    std::vector<Power> from(last + 1);  // powers of the chain from this block on
    from[last] = downs[last].power;
    for (std::size_t i = last; i-- > 0;)
        from[i] = over_gap({downs[i].power, ups[i].power}, gap(i), from[i + 1]);
    double incident = 1;
    for (std::size_t i = 0; i < last; ++i) {
        const Attenuation loss = gap(i);
        const LightInGap light = light_in_gap({downs[i].power, ups[i].power}, loss, from[i + 1]);
        const double arriving = incident * light.arriving, returned = incident * light.returned;
        const std::size_t count = count_layers(chain_.blocks[i].down);
        add_block_layers(i, incident, returned, absorbed.first(count));
        absorbed[count] = loss.lost * (incident * light.entering + arriving * from[i + 1].R) +
                          arriving * mixed_power(above(i + 1), downs[i + 1].r) +
                          returned * mixed_power(below(i), ups[i].r);
        absorbed = absorbed.subspan(count + 1);
        incident = arriving;
    }
    add_block_layers(last, incident, 0, absorbed);
}

}  // namespace irido
