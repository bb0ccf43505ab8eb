#include "core/color/spread_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/color/held_stack.hpp"
#include "core/color/stack_color.hpp"
#include "core/complex.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

namespace {

/// Parts of the tolerance: of the colours without spread, and of thicknesses that are left out.
constexpr double kOfColors = 0.7, kOfTails = 0.05;

/// A rule averages waves wrongly that turn by as much as twice what its nodes resolve. In smooth
/// functions these are far smaller than the fastest ones that it resolves; but a narrow resonance
/// that passes a kink of the observer makes one in the colours, whose waves fall slowly, with the
/// square of their frequency at most. The error is taken to be so much of the largest of the
/// latter: all of one layer's, and of two layers, either of which blurs the kinks of the other.
constexpr double kOfOne = 1, kOfTwo = 0.25;

/// Fastest waves that a rule resolves, as parts of the fastest one.
constexpr std::array kFastest{0.75, 0.9, 1.0};

/// Degree of polynomials that have no part in these, and those that stand for them in nine points.
constexpr std::size_t kSmooth = 6;
constexpr std::array<std::size_t, kFastest.size()> kSteepest{8, 7, 6};

/// Wavelength at which light turns most of what the observer sees.
constexpr double kShort_nm = 400;

/// Standard deviations of the phase of a round trip, radians, up to which nine points do, and from
/// which on spectra with their closed forms are quicker.
constexpr double kForNine = 0.67, kForAny = 12;

/// Round trips whose fringes are to be resolved, of one spread layer and of two, of which either
/// blurs the fringes of the other, and intervals that the Gaussian takes itself.
constexpr double kRoundTrips = 4, kRoundTripsOfTwo = 2, kOfGaussian = 10;

constexpr std::size_t kMostLayers = 2;

/// Below it count the fringes of very many round trips, which fall slowly: the observer has kinks.
constexpr double kLeastTolerance = 5e-8;

/// One thickness of a rule, in standard deviations from the mean or in parts of a range.
struct RuleNode {
    double x, weight;
    double probing = 0;  ///< weight in the sums that probe: of Chebyshev coefficients, twice these
};

/// Rules for the weight exp(-x^2/2), for x >= 0.
constexpr std::array kNine{
    RuleNode{0, 0.253968253968253968},
    RuleNode{0.741095349994540842, 0.270074329577937871},
    RuleNode{1.73205080756887729, 0.0948509485094850949},
    RuleNode{2.86127957605705812, 0.00799632547089353277},
    RuleNode{4.18495601767273186, 0.0000942694575565174894},
};
constexpr std::array<std::size_t, 5> kIntervals{16, 32, 64, 128, 256};

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
    std::vector<RuleNode> rule;
    const std::vector<double> curtis = equal_steps ? std::vector<double>() : curtis_weights(n);
    for (std::size_t j = 0; j <= n; ++j) {
        const double part = static_cast<double>(j) / static_cast<double>(n);
        if (equal_steps) {
            rule.push_back({2 * part - 1, 1, 1});
        } else {
            const double end = j == 0 || j == n ? 0.5 : 1;
            rule.push_back(
                {-std::cos(std::numbers::pi * part), curtis[j], 4 * end / static_cast<double>(n)});
        }
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

/// A layer's thicknesses, their weights, and sums that tell what these do not resolve.
struct Nodes {
    using Probe = std::array<Complex, kFastest.size()>;

    std::vector<double> thickness_nm, weight;
    std::vector<Probe> probe;

    void add(double nm, double w) {
        thickness_nm.push_back(nm);
        weight.push_back(w);
        probe.emplace_back();
    }
};

/// Polynomials up to a degree that are orthonormal under the weights of nodes.
std::vector<std::vector<double>> orthonormal(const std::vector<double>& x,
                                             const std::vector<double>& weight,
                                             std::size_t degree) {
    std::vector<std::vector<double>> all;
    std::vector<double> next(x.size(), 1);
    for (std::size_t k = 0; k <= degree; ++k) {
        for (const std::vector<double>& known : all) {
            double along = 0;
            for (std::size_t j = 0; j < x.size(); ++j) along += weight[j] * known[j] * next[j];
            for (std::size_t j = 0; j < x.size(); ++j) next[j] -= along * known[j];
        }
        double squares = 0;
        for (std::size_t j = 0; j < x.size(); ++j) squares += weight[j] * next[j] * next[j];
        for (double& value : next) value /= std::sqrt(squares);
        all.push_back(next);
        for (std::size_t j = 0; j < x.size(); ++j) next[j] *= x[j];
    }
    return all;
}

/// Nine points, which are probed by polynomials.
Nodes nine_nodes(double mean, double sigma) {
    static const auto rule = [] {
        std::vector<double> x, weight;
        for (const RuleNode& node : kNine)
            for (const double sign : {1.0, -1.0}) {
                if (node.x == 0 && sign < 0) continue;
                x.push_back(sign * node.x);
                weight.push_back(node.weight);
            }
        const auto steep = orthonormal(x, weight, kSteepest[0]);
        Nodes nodes;
        for (std::size_t j = 0; j < x.size(); ++j) {
            nodes.add(x[j], weight[j]);
            for (std::size_t f = 0; f < kSteepest.size(); ++f)
                nodes.probe[j].at(f) = weight[j] * steep[kSteepest.at(f)][j];
        }
        return nodes;
    }();
    Nodes nodes = rule;
    for (double& nm : nodes.thickness_nm) nm = mean + sigma * nm;
    return nodes;
}

/// Steps, equal in the thickness or, from the cut on, in the angle of its cosine, are probed by
/// waves along them without what polynomials have of these.
///   weight  that of the steps
void probe_steps(double mean, double sigma, bool is_cut, const std::vector<double>& weight,
                 Nodes& nodes) {
    std::vector<double> x;
    for (const double nm : nodes.thickness_nm) x.push_back((nm - mean) / sigma);
    const auto smooth = orthonormal(x, weight, kSmooth);
    for (std::size_t f = 0; f < kFastest.size(); ++f) {
        std::vector<Complex> wave;
        for (std::size_t j = 0; j < x.size(); ++j) {
            const Complex turn =
                std::polar(1.0, kFastest.at(f) * std::numbers::pi * static_cast<double>(j));
            wave.push_back(is_cut ? turn.real() : turn);
        }
        for (const std::vector<double>& polynomial : smooth) {
            Complex along = 0;
            for (std::size_t j = 0; j < x.size(); ++j) along += weight[j] * polynomial[j] * wave[j];
            for (std::size_t j = 0; j < x.size(); ++j) wave[j] -= along * polynomial[j];
        }
        for (std::size_t j = 0; j < x.size(); ++j) nodes.probe[j].at(f) = weight[j] * wave[j];
    }
}

Nodes nodes_of(const Layer& layer, std::size_t level, double reach) {
    const double mean = layer.thickness_nm, sigma = layer.thickness_sigma_nm;
    if (level < kGaussLevels) return nine_nodes(mean, sigma);
    Nodes nodes;
    const double from = std::max(0.0, mean - reach * sigma), to = mean + reach * sigma;
    const bool is_cut = mean < reach * sigma;
    std::vector<double> probing;
    double all = 0;
    for (const RuleNode& node : shared_rule(level - kGaussLevels, !is_cut)) {
        const double nm = std::clamp((from + to) / 2 + (to - from) / 2 * node.x, from, to);
        const double density = std::exp(-std::pow((nm - mean) / sigma, 2) / 2);
        nodes.add(nm, density * node.weight);
        probing.push_back(density * node.probing);
        all += nodes.weight.back();
    }
    for (double& weight : nodes.weight) weight /= all;
    for (double& weight : probing) weight /= all;
    probe_steps(mean, sigma, is_cut, probing, nodes);
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
            for (std::size_t s = 0; s < layers.size(); ++s)
                nodes.push_back(nodes_of(layers[s], levels[s], reach_));
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
        const bool has_nine = layer.thickness_nm >= kNine.back().x * layer.thickness_sigma_nm;
        if (!is_cut(layer) && has_nine && phase < kForNine) return 0;
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
        std::vector<Sum> sums(fresh.size());
        for (bool more = true; more;) {
            for (std::size_t s = 0; s < nodes.size(); ++s)
                thickness_nm[s] = nodes[s].thickness_nm[at[s]];
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
            const Node node = node_at(nodes, at);
            for (std::size_t i = 0; i < sums.size(); ++i)
                sums[i].add(node, of_node[open[i / sides_] * sides_ + i % sides_]);
            more = false;
            for (std::size_t s = nodes.size(); s-- > 0 && !more;) {
                more = ++at[s] < nodes[s].weight.size();
                if (!more) at[s] = 0;
            }
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            colors[open[i / sides_] * sides_ + i % sides_] = {
                sums[i].xyz, sums[i].error + sums[i].of_rules(nodes.size()) + kOfTails * tolerance_,
                sums[i].evaluations, "quadrature"};
    }

    /// Waves along one of two layers, along the other one, and along both in the same direction
    /// and in the opposite one.
    static constexpr std::size_t kDirections = 4;

    /// The weight of a point of all spread layers, and its probes.
    struct Node {
        double weight;
        std::array<Nodes::Probe, kDirections> probe{};
    };
    static Node node_at(std::span<const Nodes> nodes, const std::vector<std::size_t>& at) {
        const double first = nodes[0].weight[at[0]];
        const Nodes::Probe& along = nodes[0].probe[at[0]];
        if (nodes.size() == 1) return {first, {along}};
        const double second = nodes[1].weight[at[1]];
        Node node{first * second};
        for (std::size_t f = 0; f < along.size(); ++f) {
            const Complex one = along.at(f), other = nodes[1].probe[at[1]].at(f);
            node.probe[0].at(f) = one * second;
            node.probe[1].at(f) = first * other;
            node.probe[2].at(f) = one * other;
            node.probe[3].at(f) = one * std::conj(other);
        }
        return node;
    }

    /// Of colours at all nodes.
    struct Sum {
        Triple xyz{};
        double error = 0;  ///< of the colours
        std::size_t evaluations = 0;
        std::array<std::array<Nodes::Probe, 3>, kDirections> probes{};

        void add(const Node& node, const StackColor& color) {
            error += node.weight * color.error;
            evaluations += color.evaluations;
            for (std::size_t c = 0; c < 3; ++c) {
                xyz[c] += node.weight * color.xyz[c];
                for (std::size_t d = 0; d < kDirections; ++d)
                    for (std::size_t f = 0; f < kFastest.size(); ++f)
                        probes.at(d).at(c).at(f) += node.probe.at(d).at(f) * color.xyz[c];
            }
        }

        /// Error of the rules of so many layers.
        double of_rules(std::size_t layers) const {
            double error_of_rules = 0;
            for (std::size_t d = 0; d < (layers == 1 ? 1 : kDirections); ++d) {
                double largest = 0;
                for (const Nodes::Probe& channel : probes.at(d))
                    for (const Complex probe : channel)
                        largest = std::max(largest, std::abs(probe));
                error_of_rules += (layers == 1 ? kOfOne : kOfTwo) * largest;
            }
            return error_of_rules;
        }
    };

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
