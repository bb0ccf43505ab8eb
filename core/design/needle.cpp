#include "core/design/needle.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/parallel.hpp"
#include "core/math/random.hpp"

namespace irido {

namespace {

using Layers = std::vector<NeedleLayer>;

constexpr double kCoarseRelative = 1e-4, kNeedle_nm = 1, kVanished_nm = 1e-3;
constexpr std::size_t kNeedleRuns = 8, kTriedNeedles = 4;

/// Layers of a problem; throws DomainError if it has others than plain ones.
Layers layers_of(const DesignProblem& problem) {
    Layers layers;
    for (std::size_t i = 0; i < problem.stack.elements.size(); ++i) {
        const Layer* const layer = std::get_if<Layer>(&problem.stack.elements[i].value);
        if (!layer || !layer->coherent || layer->thickness_sigma_nm > 0)
            throw DomainError("method needle requires coherent layers without groups");
        layers.push_back({layer->material, layer->thickness_nm, i, true});
    }
    for (const FreeValue& value : problem.free) {
        const ThicknessOf* const place =
            value.places.size() == 1 ? std::get_if<ThicknessOf>(&value.places[0]) : nullptr;
        if (!place || place->layer.size() != 1)
            throw DomainError("method needle: only thicknesses of single layers can be free (got " +
                              value.name + ")");
        layers[place->layer[0]].is_fixed = false;
    }
    return layers;
}

/// Drops layers of no thickness and merges equal neighbours.
void clean(Layers& layers, double least_nm) {
    std::erase_if(layers, [&](const NeedleLayer& layer) {
        return !layer.is_fixed && layer.thickness_nm < least_nm;
    });
    for (std::size_t i = 1; i < layers.size();) {
        NeedleLayer &before = layers[i - 1], &here = layers[i];
        if (before.is_fixed || here.is_fixed || before.material != here.material) {
            ++i;
            continue;
        }
        before.thickness_nm += here.thickness_nm;
        if (before.origin == NeedleLayer::kNew) before.origin = here.origin;
        layers.erase(layers.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

std::size_t free_count(const Layers& layers) {
    return static_cast<std::size_t>(std::ranges::count(layers, false, &NeedleLayer::is_fixed));
}

double shortest_wavelength(const DesignProblem& problem) {
    double shortest = kInfinity;
    for (const DesignTarget& target : problem.targets) {
        if (target.quantity == DesignQuantity::lab) shortest = std::min(shortest, 400.0);
        for (const double nm : target.wavelength_nm) shortest = std::min(shortest, nm);
    }
    return shortest;
}

/// One run.
class Synthesis {
public:
    Synthesis(const DesignProblem& problem, const NeedleSettings& settings, std::uint64_t number,
              const std::function<void(double, const Layers&)>& offer)
        : problem_(problem),
          settings_(settings),
          random_(settings.search.seed * 0x9e3779b97f4a7c15U + number),
          budget_(std::max<std::size_t>(settings.search.evaluations / kNeedleRuns, 1)),
          offer_(offer) {}

    void run(Layers start) {
        current_ = std::move(start);
        refine(current_, current_f_);
        keep();
        int forced = 0;
        while (!is_over()) {
            const double before = current_f_;
            if (insert_needle() && current_f_ < before * (1 - 1e-3)) {
                keep();
                continue;
            }
            keep();
            if (++forced > 6 || !add_at_end()) break;
            if (best_f_ < before * (1 - 1e-3)) forced = 0;
        }
        finish();
    }

    Layers best;
    double merit = kInfinity;
    std::size_t evaluations = 0;

private:
    bool is_stopped() const {
        return settings_.search.should_stop && settings_.search.should_stop();
    }
    bool is_over() const { return evaluations >= budget_ || is_stopped(); }

    void refine(Layers& layers, double& f, double low_nm = 0, double relative = kCoarseRelative) {
        const DesignProblem own =
            problem_of_layers(problem_, layers, low_nm, settings_.max_thickness_nm);
        if (own.free.empty()) {
            DesignModel model(own, settings_.search.simd);
            f = model.objective({});
            return;
        }
        DesignModel model(own, settings_.search.simd);
        const std::vector<double> start = model.start();
        model.adapt_colors(start, settings_.search.color_tolerance);
        LocalLimits limits;
        limits.relative = relative;
        limits.evaluations = 40 + 12 * own.free.size();
        limits.should_stop = settings_.search.should_stop;
        const LocalResult local = quasi_newton(model, start, limits);
        evaluations += model.evaluations();
        f = local.objective;
        std::size_t next = 0;
        for (NeedleLayer& layer : layers)
            if (!layer.is_fixed) layer.thickness_nm = local.x[next++];
        clean(layers, kVanished_nm);
        to_merit_ = own.merit;
    }

    void keep() {
        if (!(current_f_ < best_f_)) return;
        if (free_count(current_) > settings_.max_layers) return;
        best_f_ = current_f_;
        best = current_;
        merit = merit_of(current_f_);
        offer_(merit, best);
    }

    double merit_of(double f) const {
        const bool is_root = to_merit_ != MeritKind::chi2 && to_merit_ != MeritKind::mean_abs;
        return is_root ? std::sqrt(f) : f;
    }

    /// Inserts the best of the most promising needles, if any lowers the objective.
    bool insert_needle() {
        if (free_count(current_) + 1 > settings_.max_layers) return false;
        std::vector<NeedleSlope> slopes =
            needle_slopes(problem_, current_, settings_.materials, settings_.search.simd);
        ++evaluations;
        std::ranges::stable_sort(slopes, {}, &NeedleSlope::slope);
        Layers found;
        double found_f = current_f_;
        std::size_t tried = 0;
        std::vector<std::pair<std::size_t, std::size_t>> hosts;
        for (const NeedleSlope& needle : slopes) {
            if (needle.slope >= 0 || tried == kTriedNeedles || is_over()) break;
            const std::pair host{needle.layer, needle.material};
            if (std::ranges::find(hosts, host) != hosts.end()) continue;
            hosts.push_back(host);
            ++tried;
            Layers layers = inserted(needle);
            double f = 0;
            refine(layers, f);
            if (!(f < found_f) || free_count(layers) > settings_.max_layers) continue;
            found = std::move(layers);
            found_f = f;
        }
        if (found.empty()) return false;
        current_ = std::move(found);
        current_f_ = found_f;
        return true;
    }

    Layers inserted(const NeedleSlope& needle) const {
        Layers layers = current_;
        const NeedleLayer host = layers[needle.layer];
        NeedleLayer lower = host;
        lower.thickness_nm = host.thickness_nm - needle.depth_nm;
        lower.origin = NeedleLayer::kNew;
        layers[needle.layer].thickness_nm = needle.depth_nm;
        const auto at = layers.begin() + static_cast<std::ptrdiff_t>(needle.layer) + 1;
        layers.insert(at, {{needle.material, kNeedle_nm}, lower});
        clean(layers, kVanished_nm);
        return layers;
    }

    /// A layer about a quarter wave thick at one of the ends, whatever it does to the objective.
    bool add_at_end() {
        if (free_count(current_) >= settings_.max_layers) return false;
        Layers found;
        double found_f = kInfinity;
        const bool top_is_free = current_.empty() || !current_.front().is_fixed;
        const bool bottom_is_free = current_.empty() || !current_.back().is_fixed;
        for (const bool top : {true, false}) {
            if (!(top ? top_is_free : bottom_is_free)) continue;
            for (const std::size_t material : settings_.materials) {
                if (is_over()) return false;
                if (!current_.empty() &&
                    (top ? current_.front() : current_.back()).material == material)
                    continue;
                Layers layers = current_;
                const NeedleLayer layer{material, random_.uniform(40, 160)};
                layers.insert(top ? layers.begin() : layers.end(), layer);
                double f = 0;
                refine(layers, f);
                if (!(f < found_f)) continue;
                found = std::move(layers);
                found_f = f;
            }
        }
        if (found.empty()) return false;
        current_ = std::move(found);
        current_f_ = found_f;
        keep();
        return true;
    }

    /// Thin layers of the best vanish, one after the other, and what is left is refined once more.
    void finish() {
        Layers layers = best;
        double f = best_f_;
        for (;;) {
            auto thinnest = layers.end();
            for (auto layer = layers.begin(); layer != layers.end(); ++layer)
                if (!layer->is_fixed && layer->thickness_nm < settings_.min_thickness_nm &&
                    (thinnest == layers.end() || layer->thickness_nm < thinnest->thickness_nm))
                    thinnest = layer;
            if (thinnest == layers.end()) break;
            layers.erase(thinnest);
            clean(layers, kVanished_nm);
            refine(layers, f);
        }
        if (!layers.empty()) refine(layers, f, settings_.min_thickness_nm, 1e-8);
        best = std::move(layers);
        merit = merit_of(f);
    }

    const DesignProblem& problem_;
    const NeedleSettings& settings_;
    Random random_;
    std::size_t budget_;
    const std::function<void(double, const Layers&)>& offer_;
    Layers current_;
    double current_f_ = kInfinity, best_f_ = kInfinity;
    MeritKind to_merit_ = MeritKind::rms;
};

/// Fixed layers stay; one or two of random materials and thicknesses stand where free ones were.
Layers random_start(const Layers& given, const NeedleSettings& settings, Random& random) {
    Layers layers;
    bool is_done = false;
    for (const NeedleLayer& layer : given) {
        if (layer.is_fixed) {
            layers.push_back(layer);
            continue;
        }
        if (is_done) continue;
        is_done = true;
        const std::size_t count = 1 + random.below(2);
        for (std::size_t i = 0; i < count; ++i)
            layers.push_back({settings.materials[random.below(settings.materials.size())],
                              random.uniform(50, settings.max_thickness_nm)});
    }
    clean(layers, kVanished_nm);
    return layers;
}

}  // namespace

DesignProblem problem_of_layers(const DesignProblem& problem,
                                const std::vector<NeedleLayer>& layers, double low_nm,
                                double high_nm) {
    DesignProblem own = problem;
    own.rebuild = nullptr;
    own.free.clear();
    own.stack.elements.clear();
    for (std::size_t i = 0; i < layers.size(); ++i) {
        own.stack.elements.push_back({Layer{layers[i].material, layers[i].thickness_nm}});
        if (layers[i].is_fixed) continue;
        own.free.push_back({"layers." + std::to_string(i) + ".thickness_nm",
                            layers[i].thickness_nm,
                            low_nm,
                            std::max(high_nm, layers[i].thickness_nm),
                            false,
                            {ThicknessOf{{i}}}});
    }
    return own;
}

std::vector<NeedleSlope> needle_slopes(const DesignProblem& problem,
                                       const std::vector<NeedleLayer>& layers,
                                       const std::vector<std::size_t>& materials, SimdLevel simd) {
    constexpr double kSamplesPerTurn = 8, kMostSamples = 64;
    const double shortest = shortest_wavelength(problem);
    std::vector<NeedleLayer> split;
    std::vector<NeedleSlope> needles;
    for (std::size_t l = 0; l < layers.size(); ++l) {
        const NeedleLayer& host = layers[l];
        if (host.is_fixed) {
            split.push_back(host);
            continue;
        }
        const double n = std::abs(index_at(problem.stack.materials[host.material], shortest));
        const double turns = 2 * n * host.thickness_nm / shortest;
        const auto parts = static_cast<std::size_t>(
            std::clamp(std::ceil(kSamplesPerTurn * turns), 2.0, kMostSamples));
        for (std::size_t part = 0; part <= parts; ++part) {
            const double depth =
                host.thickness_nm * static_cast<double>(part) / static_cast<double>(parts);
            for (const std::size_t material : materials) {
                if (material == host.material) continue;
                needles.push_back({l, depth, material, 0});
                split.push_back({material, 0});
            }
            if (part == parts) break;
            NeedleLayer piece = host;
            piece.thickness_nm /= static_cast<double>(parts);
            piece.is_fixed = true;
            split.push_back(piece);
        }
    }
    const DesignProblem own = problem_of_layers(problem, split, 0, 1);
    DesignModel model(own, simd);
    model.adapt_colors(model.start(), 0.1);
    std::vector<double> gradient(own.free.size());
    model.objective(model.start(), gradient);
    for (std::size_t i = 0; i < needles.size(); ++i) needles[i].slope = gradient[i];
    return needles;
}

NeedleResult needle_search(const DesignProblem& problem, const NeedleSettings& settings) {
    const Layers given = layers_of(problem);
    if (settings.materials.empty())
        throw DomainError("method needle requires at least one material to choose from");
    std::mutex lock;
    double best = kInfinity;
    std::size_t finished = 0;
    const std::function<void(double, const Layers&)> offer = [&](double merit,
                                                                 const Layers& layers) {
        const std::scoped_lock hold(lock);
        if (!(merit < best)) return;
        best = merit;
        if (settings.search.tell)
            settings.search.tell(
                {merit, static_cast<double>(finished) / kNeedleRuns, layers.size(), {}});
    };
    std::vector<std::unique_ptr<Synthesis>> runs(kNeedleRuns);
    parallel_for(kNeedleRuns, settings.search.threads, [&](std::size_t r) {
        const std::uint64_t number = settings.search.first_run + r;
        Random random(settings.search.seed * 0xbf58476d1ce4e5b9U + number);
        runs[r] = std::make_unique<Synthesis>(problem, settings, number, offer);
        runs[r]->run(number == 0 ? given : random_start(given, settings, random));
        const std::scoped_lock hold(lock);
        ++finished;
    });
    NeedleResult result;
    result.merit = kInfinity;
    for (const auto& run : runs) {
        result.evaluations += run->evaluations;
        result.runs.push_back(run->merit);
        if (!(run->merit < result.merit)) continue;
        result.merit = run->merit;
        result.layers = run->best;
    }
    if (!std::isfinite(result.merit))
        throw DomainError("the stack could not be computed with any of the layers tried");
    std::ranges::sort(result.runs);
    for (const double merit : result.runs)
        if (merit <= 1.01 * result.merit + 1e-12) ++result.runs_within;
    result.is_stopped = settings.search.should_stop && settings.search.should_stop();
    return result;
}

}  // namespace irido
