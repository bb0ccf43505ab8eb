#include "core/design/global_search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/parallel.hpp"
#include "core/math/random.hpp"

namespace irido {

namespace {

constexpr double kAgreement = 1e-2, kWithin = 0.01, kFineColor = 1e-7, kCoarseColor = 0.5;

/// A normal deviate by adding up twelve uniform ones.
double normal(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.uniform(0, 1);
    return sum;
}

std::vector<double> drawn(const DesignProblem& problem, const std::vector<double>& like,
                          Random& random) {
    std::vector<double> x = like;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (!problem.free[i].is_integer)
            x[i] = random.uniform(problem.free[i].low, problem.free[i].high);
    return x;
}

/// Tells of the best of all runs, one at a time.
class Teller {
public:
    Teller(const SearchSettings& settings) : settings_(settings) {}

    void offer(double merit, const std::vector<double>& x) {
        const std::scoped_lock hold(lock_);
        if (!(merit < best_)) return;
        best_ = merit;
        x_ = x;
        if (settings_.tell) settings_.tell({best_, done_, 0, x_});
    }
    void progress(double done) {
        const std::scoped_lock hold(lock_);
        done_ = std::max(done_, std::min(done, 1.0));
        if (settings_.tell) settings_.tell({best_, done_, 0, x_});
    }

private:
    const SearchSettings& settings_;
    std::mutex lock_;
    double best_ = kInfinity, done_ = 0;
    std::vector<double> x_;
};

/// One run of hops, which can be continued.
class Hopper {
public:
    Hopper(const DesignProblem& problem, const SearchSettings& settings, std::uint64_t number,
           bool from_start, Teller& teller)
        : settings_(settings),
          teller_(teller),
          model_(problem, settings.simd),
          random_(settings.seed * 0x9e3779b97f4a7c15U + number),
          from_start_(from_start) {
        for (std::size_t i = 0; i < model_.size(); ++i)
            if (!problem.free[i].is_integer) movable_.push_back(i);
    }

    /// Goes on until so many evaluations are made in all.
    void run(std::size_t evaluations) {
        while (model_.evaluations() < evaluations && !is_stopped()) hop();
    }

    const std::vector<double>& best() const { return best_; }
    double best_objective() const { return best_f_; }
    DesignModel& model() { return model_; }

private:
    bool is_stopped() const { return settings_.should_stop && settings_.should_stop(); }

    void hop() {
        std::vector<double> x;
        const bool is_new = best_.empty() || idle_ > 40 + 8 * movable_.size();
        if (is_new) {
            x = best_.empty() && from_start_ ? model_.start()
                                             : drawn(model_.problem(), model_.start(), random_);
            model_.adapt_colors(x, settings_.color_tolerance);
            idle_ = 0;
            current_f_ = kInfinity;
            own_f_ = kInfinity;
        } else {
            x = proposed();
        }
        LocalLimits limits;
        limits.relative = 1e-3;
        limits.evaluations = 60 + 10 * movable_.size();
        limits.should_stop = settings_.should_stop;
        const LocalResult local = quasi_newton(model_, std::move(x), limits);
        ++idle_;
        if (!std::isfinite(local.objective)) {
            if (best_.empty()) ++failures_;
            if (failures_ > 1000) best_ = local.x;
            return;
        }
        if (local.objective < current_f_ * 1.1) {  // 5 % of the merit
            current_ = local.x;
            current_f_ = local.objective;
        }
        if (local.objective < own_f_ * (1 - 1e-4)) {
            own_f_ = local.objective;
            idle_ = 0;
        }
        if (best_.empty() || local.objective < best_f_) {
            best_ = local.x;
            best_f_ = local.objective;
            teller_.offer(model_.merit(best_f_), best_);
        }
    }

    std::vector<double> proposed() {
        std::vector<double> x = current_;
        const std::size_t count = movable_.size();
        const auto& free = model_.problem().free;
        const auto clamp = [&](std::size_t i) {
            x[i] = std::clamp(x[i], free[i].low, free[i].high);
        };
        const std::size_t kind = random_.below(10);
        if (kind < 5 || count < 4) {  // move some
            const std::size_t moved = 1 + random_.below(std::max<std::size_t>(1, count / 2));
            const double size = random_.log_uniform(0.02, 0.4);
            for (std::size_t m = 0; m < moved; ++m) {
                const std::size_t i = movable_[random_.below(count)];
                x[i] += size * normal(random_) * (free[i].high - free[i].low);
                clamp(i);
            }
        } else if (kind < 8) {  // redraw two
            for (int m = 0; m < 2; ++m) {
                const std::size_t i = movable_[random_.below(count)];
                x[i] = random_.uniform(free[i].low, free[i].high);
            }
        } else {  // a pair of neighbours goes elsewhere
            const std::size_t from = random_.below(count - 1);
            std::vector<double> values;
            for (const std::size_t i : movable_) values.push_back(x[i]);
            const std::array pair{values[from], values[from + 1]};
            const auto at = values.begin() + static_cast<std::ptrdiff_t>(from);
            values.erase(at, at + 2);
            const std::size_t to = 2 * random_.below(values.size() / 2 + 1);
            values.insert(values.begin() + static_cast<std::ptrdiff_t>(to), pair.begin(),
                          pair.end());
            for (std::size_t m = 0; m < count; ++m) {
                x[movable_[m]] = values[m];
                clamp(movable_[m]);
            }
        }
        return x;
    }

    const SearchSettings& settings_;
    Teller& teller_;
    DesignModel model_;
    Random random_;
    bool from_start_;
    std::vector<std::size_t> movable_;
    std::vector<double> current_, best_;
    double current_f_ = kInfinity, own_f_ = kInfinity, best_f_ = kInfinity;
    std::size_t idle_ = 0, failures_ = 0;
};

void require_bounds(const DesignProblem& problem) {
    for (const FreeValue& value : problem.free)
        if (!std::isfinite(value.low) || !std::isfinite(value.high))
            throw DomainError(value.name + ": method global requires bounds");
}

/// Sorts runs, best first, and fills in what follows from them.
void rank(SearchResult& result) {
    std::ranges::stable_sort(result.runs, {}, &SearchRun::merit);
    result.x = result.runs.front().x;
    result.merit = result.runs.front().merit;
    result.runs_within = 0;
    for (const SearchRun& run : result.runs)
        if (run.merit <= result.merit * (1 + kWithin) + 1e-12) ++result.runs_within;
}

/// Polishes runs that are not far from the best.
void polish(const DesignProblem& problem, const SearchSettings& settings, SearchResult& result) {
    constexpr double kHopeful = 1.3;
    std::vector<std::size_t> used(result.runs.size(), 0);
    std::vector<LocalEnd> ends(result.runs.size(), LocalEnd::flat);
    double best = kInfinity;
    for (const SearchRun& run : result.runs) best = std::min(best, run.merit);
    parallel_for(result.runs.size(), settings.threads, [&](std::size_t i) {
        SearchRun& run = result.runs[i];
        if (!(run.merit <= kHopeful * best + 1e-9) && run.merit > best) return;
        DesignModel model(problem, settings.simd);
        LocalLimits limits;
        limits.evaluations = 2000;
        const LocalResult local = refined(model, run.x, limits, kFineColor);
        used[i] = model.evaluations();
        ends[i] = local.end;
        if (!std::isfinite(local.objective)) return;
        run = {local.x, model.merit(local.objective)};
    });
    for (std::size_t i = 0; i < used.size(); ++i) result.evaluations += used[i];
    const std::vector<SearchRun> runs = result.runs;
    rank(result);
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (runs[i].merit == result.merit) result.end = ends[i];
}

SearchResult hop_search(const DesignProblem& problem, const SearchSettings& settings) {
    Teller teller(settings);
    std::vector<std::unique_ptr<Hopper>> hoppers(kSearchRuns);
    for (std::size_t r = 0; r < kSearchRuns; ++r)
        hoppers[r] = std::make_unique<Hopper>(problem, settings, settings.first_run + r,
                                              settings.first_run + r == 0, teller);
    // runs take turns, so that few threads serve all of them
    constexpr std::size_t kRounds = 24, kLongest = 4000;
    const std::size_t share = std::max<std::size_t>(settings.evaluations / kSearchRuns, 1);
    const std::size_t turn = std::clamp<std::size_t>(share / kRounds, 1, kLongest);
    SearchResult result;
    for (std::size_t round = 1, due = 0; due < share && !result.is_stopped; ++round) {
        due = std::min(share, due + turn);
        parallel_for(kSearchRuns, settings.threads, [&](std::size_t r) { hoppers[r]->run(due); });
        result.is_stopped = settings.should_stop && settings.should_stop();
        teller.progress(static_cast<double>(due) / static_cast<double>(share));
        std::vector<double> found;
        for (const auto& hopper : hoppers) found.push_back(hopper->best_objective());
        std::ranges::sort(found);
        if (round > 2 && found[kSearchRuns / 2 - 1] <= found[0] * (1 + kAgreement) + 1e-16) break;
    }
    for (const auto& hopper : hoppers) {
        result.evaluations += hopper->model().evaluations();
        if (!hopper->best().empty() && std::isfinite(hopper->best_objective()))
            result.runs.push_back(
                {hopper->best(), hopper->model().merit(hopper->best_objective())});
    }
    if (result.runs.empty())
        throw DomainError("the stack could not be computed at any start within the bounds");
    polish(problem, settings, result);
    return result;
}

/// Values of the integers, every combination.
std::vector<std::vector<double>> combinations(const DesignProblem& problem) {
    constexpr std::size_t kMost = 1000;
    std::vector<double> start;
    for (const FreeValue& value : problem.free)
        start.push_back(std::clamp(value.start, value.low, value.high));
    std::vector<std::vector<double>> all{start};
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        const FreeValue& value = problem.free[i];
        if (!value.is_integer) continue;
        std::vector<std::vector<double>> more;
        for (const std::vector<double>& one : all)
            for (double n = std::ceil(value.low); n <= value.high; ++n) {
                more.push_back(one);
                more.back()[i] = n;
                if (more.size() > kMost)
                    throw DomainError("the integers must have at most 1000 combinations");
            }
        all = std::move(more);
    }
    return all;
}

/// One combination of integers: samples, of which the best are refined.
class Cell {
public:
    Cell(std::vector<double> fixed, std::uint64_t number)
        : fixed_(std::move(fixed)), number_(number) {}

    void search(const DesignProblem& problem, const SearchSettings& settings, std::size_t samples,
                std::size_t refinements, double color_tolerance, Teller& teller) {
        DesignModel model(problem, settings.simd);
        Random random(settings.seed * 0x9e3779b97f4a7c15U + 1000 * number_ + visits_);
        const auto is_stopped = [&] { return settings.should_stop && settings.should_stop(); };
        std::vector<SearchRun> tried;
        for (std::size_t i = 0; i < samples && !is_stopped(); ++i) {
            std::vector<double> x =
                i == 0 && visits_ == 0 ? fixed_ : drawn(problem, fixed_, random);
            const double f = model.objective(x);
            if (std::isfinite(f)) tried.push_back({std::move(x), f});
        }
        ++visits_;
        std::ranges::stable_sort(tried, {}, &SearchRun::merit);
        for (std::size_t i = 0; i < std::min(refinements, tried.size()) && !is_stopped(); ++i) {
            LocalLimits limits;
            limits.relative = 1e-4;
            limits.evaluations = 60;
            limits.should_stop = settings.should_stop;
            const LocalResult local = refined(model, tried[i].x, limits, color_tolerance);
            if (!std::isfinite(local.objective)) continue;
            const double merit = model.merit(local.objective);
            if (!best.x.empty() && best.merit <= merit) continue;
            best = {local.x, merit};
            teller.offer(merit, best.x);
        }
        evaluations += model.evaluations();
    }

    SearchRun best{{}, kInfinity};
    std::size_t evaluations = 0;
    const std::vector<double>& fixed() const { return fixed_; }

private:
    std::vector<double> fixed_;
    std::uint64_t number_, visits_ = 0;
};

SearchResult integer_search(const DesignProblem& problem, const SearchSettings& settings) {
    Teller teller(settings);
    std::vector<Cell> cells;
    for (std::vector<double>& fixed : combinations(problem))
        cells.emplace_back(std::move(fixed), 1000 * settings.first_run + cells.size());
    const std::size_t movable =
        static_cast<std::size_t>(std::ranges::count(problem.free, false, &FreeValue::is_integer));
    const std::size_t samples = movable == 0 ? 1 : 30 * movable, starts = movable == 0 ? 1 : 4;
    SearchResult result;
    // colours are coarse at first, which leaves their order, and finer where it counts
    const auto visit = [&](const std::vector<std::size_t>& chosen, std::size_t factor) {
        const double color_tolerance = factor == 1 ? kCoarseColor : settings.color_tolerance;
        parallel_for(chosen.size(), settings.threads, [&](std::size_t i) {
            cells[chosen[i]].search(problem, settings, factor * samples, factor * starts,
                                    color_tolerance, teller);
        });
        result.is_stopped = settings.should_stop && settings.should_stop();
    };
    std::vector<std::size_t> order(cells.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    visit(order, 1);
    teller.progress(0.3);
    // the best ones and their neighbours again, until nothing changes or the evaluations are spent
    double before = kInfinity;
    for (int round = 0; round < 8 && !result.is_stopped && movable > 0; ++round) {
        std::size_t spent = 0;
        for (const Cell& cell : cells) spent += cell.evaluations;
        if (spent >= settings.evaluations) break;
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return cells[i].best.merit; });
        const double best = cells[order[0]].best.merit;
        if (round > 1 && best > before * (1 - 1e-3)) break;
        before = best;
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i)
            for (const std::size_t near : {order[i], order[i] + 1, order[i] - 1})
                if (near < cells.size() && std::ranges::find(chosen, near) == chosen.end())
                    chosen.push_back(near);
        visit(chosen, 2);
        teller.progress(0.3 + 0.08 * round);
    }
    for (const Cell& cell : cells) {
        result.evaluations += cell.evaluations;
        if (!cell.best.x.empty()) result.runs.push_back(cell.best);
    }
    if (result.runs.empty()) throw DomainError("no start inside the bounds can be computed");
    polish(problem, settings, result);
    return result;
}

}  // namespace

SearchResult refine(const DesignProblem& problem, const SearchSettings& settings) {
    DesignModel model(problem, settings.simd);
    LocalLimits limits;
    limits.evaluations = settings.evaluations;
    limits.should_stop = settings.should_stop;
    std::vector<double> x = model.start();
    LocalResult best = refined(model, x, limits, kFineColor);
    if (best.end == LocalEnd::failed)
        throw DomainError("the stack cannot be computed with the given values");
    for (bool moved = true; moved;) {
        moved = false;
        for (std::size_t i = 0; i < model.size(); ++i) {
            const FreeValue& value = problem.free[i];
            if (!value.is_integer) continue;
            for (const double step : {1.0, -1.0}) {
                x = best.x;
                x[i] += step;
                if (x[i] < value.low || x[i] > value.high) continue;
                const LocalResult next = refined(model, x, limits, kFineColor);
                if (!(next.objective < best.objective)) continue;
                best = next;
                moved = true;
            }
        }
    }
    SearchResult result;
    result.x = best.x;
    result.merit = model.merit(best.objective);
    result.evaluations = model.evaluations();
    result.end = best.end;
    result.runs = {{result.x, result.merit}};
    result.runs_within = 1;
    result.is_stopped = best.end == LocalEnd::stopped;
    return result;
}

SearchResult search(const DesignProblem& problem, const SearchSettings& settings) {
    require_bounds(problem);
    for (const FreeValue& value : problem.free)
        if (value.is_integer) return integer_search(problem, settings);
    return hop_search(problem, settings);
}

}  // namespace irido
