#include "core/thickness/spread_mean.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/coherent/period.hpp"

namespace irido {

namespace {

bool is_spread(const Element& element) {
    if (const Layer* layer = std::get_if<Layer>(&element.value))
        return layer->thickness_sigma_nm > 0;
    return std::ranges::any_of(std::get<Group>(element.value).elements, is_spread);
}

/// Layers with a spread, in order, as they are written (a repeated group counts once).
void collect_spread(std::vector<Element>& elements, std::vector<Layer*>& out) {
    for (Element& element : elements) {
        if (Layer* layer = std::get_if<Layer>(&element.value)) {
            if (layer->thickness_sigma_nm > 0) out.push_back(layer);
        } else {
            collect_spread(std::get<Group>(element.value).elements, out);
        }
    }
}

bool stands_in(const std::vector<Element>& elements, const Layer* layer) {
    return std::ranges::any_of(elements, [&](const Element& element) {
        return std::get_if<Layer>(&element.value) == layer;
    });
}

void store(const Power& power, std::span<double> values) {
    values[0] = power.R;
    values[1] = power.T;
    values[2] = power.A;
}

}  // namespace

MovingElements::MovingElements(std::span<const Element> elements, const ChainLight& light)
    : light_(light) {
    for (std::size_t begin = 0; begin < elements.size();) {
        const bool moves = is_spread(elements[begin]);
        std::size_t end = begin + 1;
        while (!moves && end < elements.size() && !is_spread(elements[end])) ++end;
        const std::span<const Element> piece = elements.subspan(begin, end - begin);
        pieces_.push_back({piece, moves, moves ? Slab{} : slab_of(piece)});
        begin = end;
    }
}

Slab MovingElements::slab_of(std::span<const Element> elements) const {
    return coherent_slab(elements, light_.media(), light_.k0(), light_.polarization());
}

Slab MovingElements::slab(std::size_t begin, std::size_t end) const {
    Slab total;
    for (std::size_t i = end; i-- > begin;)
        total = (pieces_[i].moves ? slab_of(pieces_[i].elements) : pieces_[i].slab) * total;
    return total;
}

ThicknessSweep MovingElements::sweep(const Wave& in, const Layer* layer, const Wave& out) const {
    std::size_t at = 0;
    while (std::get_if<Layer>(&pieces_[at].elements[0].value) != layer) ++at;
    return {in,
            slab(0, at),
            light_.media()[layer->material],
            slab(at + 1, pieces_.size()),
            out,
            light_.k0(),
            light_.polarization()};
}

SpreadMean::SpreadMean(const Chain& chain, std::span<const SpreadLayer> spreads,
                       std::span<const std::size_t> spread_of, std::span<const Medium> media,
                       double k0, Polarization polarization)
    : spreads_(spreads),
      chain_(joined(chain, media).value_or(chain)),
      light_(chain_, media, k0, polarization),
      order_(spreads.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    find_places(spread_of);
}

void SpreadMean::find_places(std::span<const std::size_t> spread_of) {
    for (std::size_t i = 0; i < chain_.blocks.size(); ++i) {
        Block& block = chain_.blocks[i];
        std::vector<Layer*> down, up;
        collect_spread(block.down, down);
        collect_spread(block.up, up);
        for (std::size_t j = 0; j < down.size(); ++j)
            places_.push_back({spread_of[places_.size()], i, down[j],
                               up.empty() ? nullptr : up[up.size() - 1 - j],
                               stands_in(block.down, down[j])});
        if (i == chain_.gaps.size()) break;
        Layer& gap = chain_.gaps[i];
        if (gap.thickness_sigma_nm > 0)
            places_.push_back({spread_of[places_.size()], i, &gap, nullptr, false});
    }
}

SpreadMean::Direction SpreadMean::direction(const std::vector<Element>& elements, const Wave& in,
                                            const Wave& out) const {
    if (std::ranges::any_of(elements, is_spread)) return {{}, MovingElements(elements, light_)};
    return {
        coherent_response(in, elements, out, light_.media(), light_.k0(), light_.polarization()),
        {}};
}

Response SpreadMean::response_of(const Direction& direction, const Wave& in,
                                 const Wave& out) const {
    return direction.moving ? slab_response(in, direction.moving->slab(), out) : direction.fixed;
}

BlockPower SpreadMean::power_of(std::size_t block) const {
    const Wave in = light_.above(block), out = light_.below(block);
    BlockPower power{response_of(downs_[block], in, out).power, {}};
    if (block < light_.last_block()) power.up = response_of(ups_[block], out, in).power;
    return power;
}

SpreadMean::Surroundings SpreadMean::around(std::size_t block) const {
    Surroundings result;
    for (std::size_t i = 0; i < block; ++i) result.above.push_back(power_of(i));
    for (std::size_t i = 0; i < light_.last_block(); ++i) result.gaps.push_back(light_.gap(i));
    if (block == light_.last_block()) return result;
    result.below = power_of(light_.last_block()).down;
    for (std::size_t i = light_.last_block() - 1; i > block; --i)
        result.below = over_gap(power_of(i), result.gaps[i], result.below);
    return result;
}

Power SpreadMean::Surroundings::with(const BlockPower& block) const {
    std::size_t i = above.size();
    Power power = i == gaps.size() ? block.down : over_gap(block, gaps[i], below);
    while (i-- > 0) power = over_gap(above[i], gaps[i], power);
    return power;
}

Complex SpreadMean::turn_per_nm(std::size_t spread) const {
    return 2 * light_.k0() * onward_kz(light_.media()[spreads_[spread].material]);
}

/// The layer that can be swept and has the most fringes.
void SpreadMean::choose_innermost() {
    double most = -1;
    for (const Place& place : places_) {
        const double fringes =
            std::abs(turn_per_nm(place.spread)) * spreads_[place.spread].sigma_nm;
        const bool alone = std::ranges::count(places_, place.spread, &Place::spread) == 1;
        if (!place.sweepable || !alone || fringes <= most) continue;
        most = fringes;
        innermost_ = &place;
    }
    if (innermost_) std::swap(order_[innermost_->spread], order_.back());
}

void SpreadMean::set(std::size_t spread, double thickness_nm) {
    for (const Place& place : places_) {
        if (place.spread != spread) continue;
        place.down->thickness_nm = thickness_nm;
        if (place.up) place.up->thickness_nm = thickness_nm;
    }
}

/// Mean over the thicknesses from order_[level] on, all others as they are set; returns a
/// denominator at the mean thicknesses.
Complex SpreadMean::mean_from(std::size_t level, std::span<double> mean, const Evaluate& evaluate) {
    if (level == order_.size()) return evaluate(mean);
    const std::size_t spread = order_[level];
    const SpreadLayer& layer = spreads_[spread];
    ThicknessSpread thicknesses{layer.mean_nm, layer.sigma_nm, turn_per_nm(spread)};
    if (innermost_ && level + 1 == order_.size()) {
        thicknesses.has_phase = true;
        return mean_of_sweep(thicknesses, *innermost_, mean);
    }
    Complex guide;
    const ThicknessFunction at = [&](double thickness_nm, double, std::span<double> values) {
        set(spread, thickness_nm);
        return mean_from(level + 1, values, evaluate);
    };
    if (level > 0) guide = at(layer.mean_nm, 0, mean);
    thickness_mean(thicknesses, at, mean);
    set(spread, layer.mean_nm);
    return guide;
}

Complex SpreadMean::mean_of_sweep(const ThicknessSpread& thicknesses, const Place& place,
                                  std::span<double> mean) {
    const Wave in = light_.above(place.block), out = light_.below(place.block);
    const ThicknessSweep down = downs_[place.block].moving->sweep(in, place.down, out);
    std::optional<ThicknessSweep> up;
    if (place.up) up = ups_[place.block].moving->sweep(out, place.up, in);
    if (const auto power = series_mean(down, thicknesses)) {
        store(*power, mean);
        return down(thicknesses.mean_nm).denominator;
    }
    const Surroundings surroundings = around(place.block);
    const ThicknessFunction at = [&](double thickness_nm, double phase, std::span<double> values) {
        const Response response = down(thickness_nm, phase);
        const Power reverse = up ? (*up)(thickness_nm, phase).power : Power{};
        store(surroundings.with({response.power, reverse}), values);
        return response.denominator;
    };
    thickness_mean(thicknesses, at, mean);
    return down(thicknesses.mean_nm).denominator;
}

std::optional<Power> SpreadMean::series_mean(const ThicknessSweep& sweep,
                                             const ThicknessSpread& thicknesses) const {
    if (light_.last_block() > 0) return {};
    const auto mean = mean_fringes(sweep.fringes(), thicknesses.mean_nm, thicknesses.sigma_nm,
                                   needs_.T || needs_.A);
    if (!mean) return {};
    const double A = sweep.absorbs() ? 1 - mean->R - mean->T : 0;
    if (needs_.A && sweep.absorbs() && !(std::abs(A) > kSubtractable)) return {};
    return Power{mean->R, mean->T, A};
}

Complex SpreadMean::power_now(std::span<double> values) const {
    const std::size_t last = light_.last_block();
    Complex denominator = 1;
    Power power;
    for (std::size_t i = last + 1; i-- > 0;) {
        const Wave in = light_.above(i), out = light_.below(i);
        const Response down = response_of(downs_[i], in, out);
        denominator *= down.denominator / std::abs(down.denominator);
        power = i == last ? down.power
                          : over_gap({down.power, response_of(ups_[i], out, in).power},
                                     light_.gap(i), power);
    }
    store(power, values);
    return denominator;
}

/// Whether the wave in a gap depends on the gap's thickness.
bool SpreadMean::waves_move() const {
    return std::ranges::any_of(chain_.gaps, [&](const Layer& gap) {
        return gap.thickness_sigma_nm > 0 && light_.media()[gap.material].eps.imag() != 0;
    });
}

Power SpreadMean::power(const NeededPowers& needs) {
    needs_ = needs;
    std::array<double, 3> mean{};
    if (waves_move()) {
        mean_from(0, mean, [&](std::span<double> values) {
            const Response now = light_.response();
            store(now.power, values);
            return now.denominator;
        });
        return {mean[0], mean[1], mean[2]};
    }
    for (std::size_t i = 0; i <= light_.last_block(); ++i) {
        const Wave in = light_.above(i), out = light_.below(i);
        downs_.push_back(direction(chain_.blocks[i].down, in, out));
        if (i < light_.last_block()) ups_.push_back(direction(chain_.blocks[i].up, out, in));
    }
    choose_innermost();
    mean_from(0, mean, [&](std::span<double> values) { return power_now(values); });
    return {mean[0], mean[1], mean[2]};
}

void SpreadMean::layer_absorption(std::span<double> absorbed) {
    mean_from(0, absorbed, [&](std::span<double> values) {
        light_.layer_absorption(values);
        return light_.response().denominator;
    });
}

}  // namespace irido
