#include "core/color/spread_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/color/held_stack.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

namespace {

/// Parts of the tolerance: of the colours without spread, and of thicknesses that are left out.
constexpr double kOfColors = 0.7, kOfTails = 0.05;

/// The error of a rule is the square of the one inside it, both as parts of how much the colours
/// differ, once the rule resolves them; beside narrow resonances it is larger, and the power 3/2 is
/// taken, this many times. Where nine points of one layer did not do, it is the error of the rule
/// inside: a resonance that passes a kink of the observer makes one in the colours.
constexpr double kSafety = 4;

/// Wavelength at which light turns most of what the observer sees.
constexpr double kShort_nm = 400;

/// Standard deviations of the phase of a round trip, radians, up to which nine points do, and from
/// which on spectra with their closed forms are quicker.
constexpr double kForNine = 0.67, kForAny = 12;

/// Round trips whose fringes are to be resolved, of one spread layer and of two, of which either
/// blurs the fringes of the other, and intervals that the Gaussian takes itself.
constexpr double kRoundTrips = 4, kRoundTripsOfTwo = 2, kOfGaussian = 10;

/// Colours for one: the finest rules of two layers.
constexpr std::size_t kMostNodes = 129 * 129;

constexpr std::size_t kMostLayers = 2;

/// Below it count the fringes of very many round trips, which fall slowly: the observer has kinks.
constexpr double kLeastTolerance = 5e-8;

/// One thickness of a rule, in standard deviations from the mean or in parts of a range.
struct RuleNode {
    double x, weight;
    double inner;  ///< weight in the rule inside
};

/// Rules for the weight exp(-x^2/2), for x >= 0.
constexpr std::array kNine{
    RuleNode{0, 0.253968253968253968, 0.666666666666666667},
    RuleNode{0.741095349994540842, 0.270074329577937871, 0},
    RuleNode{1.73205080756887729, 0.0948509485094850949, 0.166666666666666667},
    RuleNode{2.86127957605705812, 0.00799632547089353277, 0},
    RuleNode{4.18495601767273186, 0.0000942694575565174894, 0},
};
constexpr std::array<std::size_t, 4> kIntervals{16, 32, 64, 128};

/// Levels of a spread: nine points, then one for each of kIntervals.
constexpr std::size_t kGaussLevels = 1, kLevels = kGaussLevels + kIntervals.size();

/// Clenshaw and Curtis's weights on [-1, 1] at cos(pi j/n), n even.
std::vector<double> curtis_weights(std::size_t n) {
    std::vector<double> weights(n + 1);
    for (std::size_t j = 0; j <= n; ++j) {
        double sum = 1;
        for (std::size_t k = 1; 2 * k <= n; ++k) {
            const auto m = static_cast<double>(2 * k);
            const double angle = std::numbers::pi * static_cast<double>(2 * k * j % (2 * n)) /
                                 static_cast<double>(n);
            sum -= (2 * k == n ? 1 : 2) * std::cos(angle) / (m * m - 1);
        }
        weights[j] = (j == 0 || j == n ? 1 : 2) * sum / static_cast<double>(n);
    }
    return weights;
}

/// On [-1, 1]: equal steps for Gaussians, which vanish at both ends, else Clenshaw and Curtis's.
std::vector<RuleNode> rule_of(std::size_t n, bool equal_steps) {
    const auto steps = static_cast<double>(n);
    std::vector<double> all(n + 1, 1), inside(n / 2 + 1, 1);
    if (!equal_steps) {
        all = curtis_weights(n);
        inside = curtis_weights(n / 2);
    }
    std::vector<RuleNode> rule;
    for (std::size_t j = 0; j <= n; ++j) {
        const auto at = static_cast<double>(j);
        rule.push_back({equal_steps ? 2 * at / steps - 1 : std::cos(std::numbers::pi * at / steps),
                        all[j], j % 2 == 0 ? inside[j / 2] : 0});
    }
    return rule;
}

const std::vector<RuleNode>& shared_rule(std::size_t which, bool equal_steps) {
    static const auto rules = [] {
        std::array<std::array<std::vector<RuleNode>, 2>, kIntervals.size()> all;
        for (std::size_t i = 0; i < all.size(); ++i)
            all.at(i) = {rule_of(kIntervals.at(i), false), rule_of(kIntervals.at(i), true)};
        return all;
    }();
    return rules.at(which)[equal_steps ? 1 : 0];
}

/// A layer's thicknesses and their weights.
struct Nodes {
    std::vector<double> thickness_nm, weight, inner;

    void add(double nm, double w, double inside) {
        thickness_nm.push_back(nm);
        weight.push_back(w);
        inner.push_back(inside);
    }
};

Nodes nodes_of(const Layer& layer, std::size_t level, double reach) {
    Nodes nodes;
    const double mean = layer.thickness_nm, sigma = layer.thickness_sigma_nm;
    if (level < kGaussLevels) {
        for (const RuleNode& node : kNine) {
            nodes.add(mean + sigma * node.x, node.weight, node.inner);
            if (node.x > 0) nodes.add(mean - sigma * node.x, node.weight, node.inner);
        }
        return nodes;
    }
    const double from = std::max(0.0, mean - reach * sigma), to = mean + reach * sigma;
    double all = 0, inside = 0;
    for (const RuleNode& node : shared_rule(level - kGaussLevels, mean >= reach * sigma)) {
        const double nm = std::clamp((from + to) / 2 + (to - from) / 2 * node.x, from, to);
        const double density = std::exp(-std::pow((nm - mean) / sigma, 2) / 2);
        nodes.add(nm, density * node.weight, density * node.inner);
        all += nodes.weight.back();
        inside += nodes.inner.back();
    }
    for (double& weight : nodes.weight) weight /= all;
    for (double& weight : nodes.inner) weight /= inside;
    return nodes;
}

void collect_places(std::span<const Element> elements, LayerPlace& here,
                    std::vector<LayerPlace>& places) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
        here.push_back(i);
        if (const Layer* layer = std::get_if<Layer>(&elements[i].value)) {
            if (layer->thickness_sigma_nm > 0) places.push_back(here);
        } else {
            collect_places(std::get<Group>(elements[i].value).elements, here, places);
        }
        here.pop_back();
    }
}

std::vector<LayerPlace> spread_places(const Stack& stack) {
    std::vector<LayerPlace> places;
    LayerPlace here;
    collect_places(stack.elements, here, places);
    return places;
}

Layer& layer_at(std::vector<Element>& elements, std::span<const std::size_t> place) {
    Element& element = elements.at(place[0]);
    if (place.size() == 1) return std::get<Layer>(element.value);
    return layer_at(std::get<Group>(element.value).elements, place.subspan(1));
}

/// How often a layer is there.
double repetitions(std::span<const Element> elements, std::span<const std::size_t> place) {
    if (place.size() == 1) return 1;
    const Group& group = std::get<Group>(elements[place[0]].value);
    return static_cast<double>(group.repeat) * repetitions(group.elements, place.subspan(1));
}

/// The stack with the mean thicknesses.
Stack without_spread(Stack stack, const std::vector<LayerPlace>& places) {
    for (const LayerPlace& place : places) layer_at(stack.elements, place).thickness_sigma_nm = 0;
    return stack;
}

class SpreadColor : public ColorAlgorithm {
public:
    SpreadColor(const ColorTables& tables, const Stack& stack, const ColorMethod& method,
                const ColorRequest& request, std::vector<LayerPlace> places)
        : places_(std::move(places)),
          sides_(request.sides.size()),
          tolerance_(request.tolerance),
          reach_(std::sqrt(-2 * std::log(kOfTails * request.tolerance))) {
        ColorRequest plain = request;
        plain.tolerance = std::max(kSmallestTolerance, kOfColors * request.tolerance);
        plain.colors *= kNine.size();
        if (!plain.varied.empty())
            plain.varied.insert(plain.varied.end(), places_.begin(), places_.end());
        plain_ = color_algorithm(tables, without_spread(stack, places_), method, plain);
        Stack layers = stack;
        for (const LayerPlace& place : places_) {
            const Layer& layer = layer_at(layers.elements, place);
            const double n = std::abs(index_at(stack.materials[layer.material], kShort_nm));
            turn_per_nm_.push_back(4 * std::numbers::pi * n / kShort_nm *
                                   repetitions(stack.elements, place));
        }
    }

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        for (StackColor& color : colors) color = {};
        Stack plain = without_spread(stack, places_);
        std::vector<Layer> layers;
        Stack read = stack;
        for (const LayerPlace& place : places_) layers.push_back(layer_at(read.elements, place));
        std::map<std::vector<double>, std::vector<StackColor>> known;
        std::vector<std::size_t> open(angles_deg.size());  // angles
        for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
        std::vector<std::size_t> levels;
        for (std::size_t s = 0; s < layers.size(); ++s) levels.push_back(first_level(layers[s], s));
        for (; !open.empty() && std::ranges::max(levels) < kLevels; next(levels)) {
            std::vector<Nodes> nodes;
            std::size_t count = 1;
            for (std::size_t s = 0; s < layers.size(); ++s) {
                nodes.push_back(nodes_of(layers[s], levels[s], reach_));
                count *= nodes.back().weight.size();
            }
            if (count > kMostNodes) return;
            add_up(plain, nodes, angles_deg, open, known, colors);
            std::erase_if(open, [&](std::size_t angle) {
                return std::ranges::all_of(
                    colors.subspan(angle * sides_, sides_),
                    [&](const StackColor& color) { return color.error <= tolerance_; });
            });
        }
    }

private:
    using Known = std::map<std::vector<double>, std::vector<StackColor>>;

    bool is_cut(const Layer& layer) const {
        return layer.thickness_nm < reach_ * layer.thickness_sigma_nm;
    }

    std::size_t first_level(const Layer& layer, std::size_t spread) const {
        const double phase = turn_per_nm_[spread] * layer.thickness_sigma_nm;
        if (!(phase < kForAny)) return kLevels;
        if (!is_cut(layer) && phase < kForNine) return 0;
        const double wide = reach_ * layer.thickness_sigma_nm +
                            std::min(layer.thickness_nm, reach_ * layer.thickness_sigma_nm);
        // equal steps need two a wave, Clenshaw and Curtis's pi
        const double trips = places_.size() > 1 ? kRoundTripsOfTwo : kRoundTrips;
        const double waves = trips * turn_per_nm_[spread] * wide / (2 * std::numbers::pi);
        const double least = kOfGaussian + (is_cut(layer) ? std::numbers::pi : 2) * waves;
        std::size_t level = kGaussLevels;
        while (level < kLevels && static_cast<double>(kIntervals.at(level - kGaussLevels)) < least)
            ++level;
        return level;
    }

    static void next(std::vector<std::size_t>& levels) {
        for (std::size_t& level : levels) ++level;
    }

    /// The means of the angles that are open. Colours are computed at the thicknesses that are not
    /// known, and only at these angles: which of them are open depends on nothing else.
    void add_up(Stack& plain, std::span<const Nodes> nodes, std::span<const double> angles_deg,
                const std::vector<std::size_t>& open, Known& known,
                std::span<StackColor> colors) const {
        std::vector<double> some_deg;
        for (const std::size_t angle : open) some_deg.push_back(angles_deg[angle]);
        std::vector<StackColor> fresh(some_deg.size() * sides_);
        std::vector<std::size_t> at(nodes.size());
        std::vector<double> thickness_nm(nodes.size());
        struct Sum {
            Triple all{}, inside{}, least{}, most{};
            double error = 0;
            std::size_t evaluations = 0;
        };
        std::vector<Sum> sums(fresh.size());
        for (Sum& sum : sums) {
            sum.least.fill(std::numeric_limits<double>::infinity());
            sum.most.fill(-std::numeric_limits<double>::infinity());
        }
        for (bool more = true; more;) {
            double weight = 1, inner = 1;
            for (std::size_t s = 0; s < nodes.size(); ++s) {
                thickness_nm[s] = nodes[s].thickness_nm[at[s]];
                weight *= nodes[s].weight[at[s]];
                inner *= nodes[s].inner[at[s]];
            }
            auto [entry, is_new] = known.try_emplace(thickness_nm);
            std::vector<StackColor>& of_node = entry->second;
            if (is_new) {
                for (std::size_t s = 0; s < nodes.size(); ++s)
                    layer_at(plain.elements, places_[s]).thickness_nm = thickness_nm[s];
                (*plain_)(plain, some_deg, fresh);
                of_node.resize(angles_deg.size() * sides_);
                for (std::size_t i = 0; i < fresh.size(); ++i)
                    of_node[open[i / sides_] * sides_ + i % sides_] = fresh[i];
            }
            for (std::size_t i = 0; i < sums.size(); ++i) {
                const StackColor& color = of_node[open[i / sides_] * sides_ + i % sides_];
                Sum& sum = sums[i];
                for (std::size_t c = 0; c < 3; ++c) {
                    sum.all[c] += weight * color.xyz[c];
                    sum.inside[c] += inner * color.xyz[c];
                    sum.least[c] = std::min(sum.least[c], color.xyz[c]);
                    sum.most[c] = std::max(sum.most[c], color.xyz[c]);
                }
                sum.error += std::abs(weight) * color.error;
                sum.evaluations += color.evaluations;
            }
            more = false;
            for (std::size_t s = nodes.size(); s-- > 0 && !more;) {
                more = ++at[s] < nodes[s].weight.size();
                if (!more) at[s] = 0;
            }
        }
        const bool may_have_kinks =
            nodes.size() == 1 && nodes[0].weight.size() > 2 * kNine.size() - 1;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const Sum& sum = sums[i];
            const double range = largest_difference(sum.most, sum.least);
            const double agreement = largest_difference(sum.all, sum.inside);
            double rule = agreement;
            if (agreement > 0 && !may_have_kinks)
                rule = std::min(agreement, kSafety * agreement * std::sqrt(agreement / range));
            StackColor& color = colors[open[i / sides_] * sides_ + i % sides_];
            color = {sum.all, sum.error + rule + kOfTails * tolerance_, sum.evaluations,
                     "quadrature"};
        }
    }

    std::vector<LayerPlace> places_;
    std::size_t sides_;
    double tolerance_;
    double reach_;  ///< standard deviations from the mean to the last thickness that counts
    std::unique_ptr<ColorAlgorithm> plain_;
    std::vector<double> turn_per_nm_;  ///< phase of a round trip through each spread layer
};

}  // namespace

bool has_spread(const Stack& stack) {
    return !spread_places(stack).empty();
}

std::unique_ptr<ColorAlgorithm> spread_color(const ColorTables& tables, const Stack& stack,
                                             const ColorMethod& method,
                                             const ColorRequest& request) {
    std::vector<LayerPlace> places = spread_places(stack);
    if (places.empty() || places.size() > kMostLayers || request.tolerance < kLeastTolerance)
        return nullptr;
    const WavelengthRange seen = tables.sensitivity().support();
    Stack held = held_stack(stack, tables.sensitivity());
    for (const LayerPlace& place : places)
        if (!layer_at(held.elements, place).coherent) return nullptr;
    const IndexTable survey(held, smooth_pieces(held, seen));
    if (std::ranges::find(survey.amplifies(), true) != survey.amplifies().end()) return nullptr;
    return std::make_unique<SpreadColor>(tables, held, method, request, std::move(places));
}

}  // namespace irido
