#include "core/design/local_search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <deque>

#include "core/math/constants.hpp"

namespace irido {

namespace {

/// Number of consecutive insufficient decreases before stopping.
constexpr int kPatience = 2;

class Bounds {
public:
    explicit Bounds(const DesignProblem& problem) : free_(problem.free) {}

    double clamped(std::size_t i, double x) const {
        return std::clamp(x, free_[i].low, free_[i].high);
    }
    bool moves(std::size_t i) const {
        return !free_[i].is_integer && free_[i].low < free_[i].high && !is_repeat(i);
    }
    /// Whether x_i can move against its derivative.
    bool is_free(std::size_t i, double x, double slope) const {
        if (!moves(i)) return false;
        return !(x <= free_[i].low && slope > 0) && !(x >= free_[i].high && slope < 0);
    }
    /// Length scale of a large step.
    double scale(std::size_t i, double x) const {
        const double range = free_[i].high - free_[i].low;
        return std::isfinite(range) ? range : std::max(std::abs(x), 1e-3);
    }

private:
    bool is_repeat(std::size_t i) const {
        return !free_[i].places.empty() &&
               std::holds_alternative<RepeatOf>(free_[i].places.front());
    }

    const std::vector<FreeValue>& free_;
};

/// A damped Gauss-Newton step with bounds.
class DampedStep {
public:
    DampedStep(const Bounds& bounds, std::size_t size) : bounds_(bounds), size_(size) {}

    std::vector<double> operator()(const std::vector<double>& x,
                                   const std::vector<double>& gradient,
                                   const std::vector<double>& hessian,
                                   const std::vector<double>& damping) const {
        std::vector<double> step(size_, 0);
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < size_; ++i)
            if (bounds_.is_free(i, x[i], gradient[i])) open.push_back(i);
        while (!open.empty()) {
            solve(open, gradient, hessian, damping, step);
            std::vector<std::size_t> still;
            for (const std::size_t i : open) {
                const double to = bounds_.clamped(i, x[i] + step[i]);
                if (to == x[i] + step[i]) {
                    still.push_back(i);
                } else {
                    step[i] = to - x[i];
                }
            }
            if (still.size() == open.size()) break;
            open = std::move(still);
        }
        return step;
    }

private:
    /// Solves for the steps of the `open` values, with those of the others fixed.
    void solve(const std::vector<std::size_t>& open, const std::vector<double>& gradient,
               const std::vector<double>& hessian, const std::vector<double>& damping,
               std::vector<double>& step) const {
        const auto count = static_cast<Eigen::Index>(open.size());
        Eigen::MatrixXd matrix(count, count);
        Eigen::VectorXd right(count);
        for (Eigen::Index a = 0; a < count; ++a) {
            const std::size_t i = open[static_cast<std::size_t>(a)];
            for (Eigen::Index b = 0; b < count; ++b)
                matrix(a, b) = hessian[i * size_ + open[static_cast<std::size_t>(b)]];
            matrix(a, a) += damping[i];
            right(a) = -gradient[i];
        }
        for (std::size_t j = 0; j < size_; ++j) {
            if (step[j] == 0 || std::ranges::find(open, j) != open.end()) continue;
            for (Eigen::Index a = 0; a < count; ++a)
                right(a) -= hessian[open[static_cast<std::size_t>(a)] * size_ + j] * step[j];
        }
        const Eigen::VectorXd solution = matrix.ldlt().solve(right);
        for (Eigen::Index a = 0; a < count; ++a) {
            const double value = solution(a);
            step[open[static_cast<std::size_t>(a)]] = std::isfinite(value) ? value : 0;
        }
    }

    const Bounds& bounds_;
    std::size_t size_;
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// Limits of one search, counted from its start.
class Effort {
public:
    Effort(const DesignModel& model, const LocalLimits& limits)
        : model_(model), limits_(limits), first_(model.evaluations()) {}

    bool is_spent() const { return model_.evaluations() - first_ >= limits_.evaluations; }
    bool is_stopped() const { return limits_.should_stop && limits_.should_stop(); }

private:
    const DesignModel& model_;
    const LocalLimits& limits_;
    std::size_t first_;
};

/// Recent steps and gradient changes, which approximate the inverse Hessian.
class Memory {
public:
    void add(std::vector<double> step, std::vector<double> change) {
        constexpr std::size_t kMost = 12;
        const double curvature = dot(step, change);
        if (!(curvature > 1e-10 * dot(change, change) * 1e-6)) return;
        if (pairs_.size() == kMost) pairs_.pop_front();
        pairs_.push_back({std::move(step), std::move(change), curvature});
    }
    void clear() { pairs_.clear(); }
    bool is_empty() const { return pairs_.empty(); }

    /// Quasi-Newton direction for a gradient.
    std::vector<double> direction(std::vector<double> q) const {
        std::vector<double> alpha(pairs_.size());
        for (std::size_t k = pairs_.size(); k-- > 0;) {
            alpha[k] = dot(pairs_[k].step, q) / pairs_[k].curvature;
            for (std::size_t i = 0; i < q.size(); ++i) q[i] -= alpha[k] * pairs_[k].change[i];
        }
        if (!pairs_.empty()) {
            const Pair& last = pairs_.back();
            const double factor = last.curvature / dot(last.change, last.change);
            for (double& one : q) one *= factor;
        }
        for (std::size_t k = 0; k < pairs_.size(); ++k) {
            const double beta = dot(pairs_[k].change, q) / pairs_[k].curvature;
            for (std::size_t i = 0; i < q.size(); ++i)
                q[i] += (alpha[k] - beta) * pairs_[k].step[i];
        }
        for (double& one : q) one = -one;
        return q;
    }

private:
    struct Pair {
        std::vector<double> step, change;
        double curvature;
    };
    std::deque<Pair> pairs_;
};

/// Whether a step is below the resolution of every value.
bool is_tiny(const Bounds& bounds, const std::vector<double>& x, const std::vector<double>& step) {
    for (std::size_t i = 0; i < x.size(); ++i)
        if (std::abs(step[i]) > 1e-13 * (std::abs(x[i]) + bounds.scale(i, x[i]))) return false;
    return true;
}

}  // namespace

std::string_view words_of(LocalEnd end) {
    switch (end) {
        case LocalEnd::flat:
            return "the merit no longer falls";
        case LocalEnd::gradient:
            return "no direction inside the bounds leads down";
        case LocalEnd::evaluations:
            return "the evaluations are spent";
        case LocalEnd::stopped:
            return "stopped";
        case LocalEnd::failed:
            break;
    }
    return "the stack cannot be computed";
}

LocalResult least_squares(DesignModel& model, std::vector<double> x, const LocalLimits& limits) {
    const std::size_t size = model.size();
    const Bounds bounds(model.problem());
    const DampedStep step_of(bounds, size);
    const Effort effort(model, limits);
    std::vector<double> gradient(size), hessian(size * size), next_gradient(size),
        next_hessian(size * size), scale(size, 0), damping(size), to(size);
    double f = model.objective(x, gradient, hessian);
    if (!std::isfinite(f)) return {x, f, LocalEnd::failed};
    double lambda = 1, growth = 2;
    int idle = 0;
    for (;;) {
        if (f == 0) return {x, f, LocalEnd::gradient};
        if (effort.is_spent()) return {x, f, LocalEnd::evaluations};
        if (effort.is_stopped()) return {x, f, LocalEnd::stopped};
        for (std::size_t i = 0; i < size; ++i) {
            scale[i] = std::max(scale[i], hessian[i * size + i]);
            damping[i] = lambda * std::max(scale[i], 1e-300);
        }
        const std::vector<double> step = step_of(x, gradient, hessian, damping);
        double promised = -dot(gradient, step);
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t j = 0; j < size; ++j)
                promised -= 0.5 * step[i] * hessian[i * size + j] * step[j];
        if (!(promised > 0) || is_tiny(bounds, x, step)) return {x, f, LocalEnd::gradient};
        for (std::size_t i = 0; i < size; ++i) to[i] = bounds.clamped(i, x[i] + step[i]);
        const double next = model.objective(to, next_gradient, next_hessian);
        if (next < f) {
            const double gain = (f - next) / promised;
            lambda *= std::max(0.2, 1 - std::pow(2 * std::min(gain, 1.5) - 1, 3));
            growth = 2;
            idle = f - next < limits.relative * f ? idle + 1 : 0;
            x = to;
            f = next;
            gradient.swap(next_gradient);
            hessian.swap(next_hessian);
            if (idle >= kPatience) return {x, f, LocalEnd::flat};
        } else {
            lambda *= growth;
            growth *= 2;
            if (promised < limits.relative * f * 1e-3 || lambda > 1e15)
                return {x, f, LocalEnd::flat};
        }
    }
}

LocalResult quasi_newton(DesignModel& model, std::vector<double> x, const LocalLimits& limits) {
    const std::size_t size = model.size();
    const Bounds bounds(model.problem());
    const Effort effort(model, limits);
    std::vector<double> gradient(size), next_gradient(size), to(size), scale(size);
    for (std::size_t i = 0; i < size; ++i) scale[i] = bounds.scale(i, x[i]);
    double f = model.objective(x, gradient);
    if (!std::isfinite(f)) return {x, f, LocalEnd::failed};
    Memory memory;
    int idle = 0;
    for (;;) {
        if (f == 0) return {x, f, LocalEnd::gradient};
        if (effort.is_spent()) return {x, f, LocalEnd::evaluations};
        if (effort.is_stopped()) return {x, f, LocalEnd::stopped};
        std::vector<double> masked(size, 0);  // in units of the ranges
        for (std::size_t i = 0; i < size; ++i)
            if (bounds.is_free(i, x[i], gradient[i])) masked[i] = gradient[i] * scale[i];
        std::vector<double> direction = memory.direction(masked);
        for (std::size_t i = 0; i < size; ++i)
            if (masked[i] == 0) direction[i] = 0;
        double slope = dot(direction, masked);
        if (!(slope < 0)) {
            memory.clear();
            for (std::size_t i = 0; i < size; ++i) direction[i] = -masked[i];
            slope = -dot(masked, masked);
            if (slope == 0) return {x, f, LocalEnd::gradient};
        }
        constexpr double kFirst = 0.02, kFarthest = 0.5;
        double largest = 0;
        for (const double one : direction) largest = std::max(largest, std::abs(one));
        double length = std::min(1.0, kFarthest / largest);
        if (memory.is_empty()) length = kFirst / largest;
        double next = kInfinity, moved_slope = 0;
        for (int attempt = 0; attempt < 30; ++attempt) {
            std::vector<double> moved(size);
            for (std::size_t i = 0; i < size; ++i) {
                to[i] = bounds.clamped(i, x[i] + length * direction[i] * scale[i]);
                moved[i] = (to[i] - x[i]) / scale[i];
            }
            moved_slope = dot(moved, masked);
            next = model.objective(to, next_gradient);
            if (next <= f + 1e-4 * moved_slope) break;
            const double bend = 2 * (next - f - length * slope);
            const double wanted =
                std::isfinite(bend) && bend > 0 ? -slope * length * length / bend : 0.0;
            length = std::clamp(wanted, 0.1 * length, 0.5 * length);
            if (effort.is_spent()) break;
        }
        if (!(next < f)) {
            if (memory.is_empty()) return {x, f, LocalEnd::flat};
            memory.clear();
            continue;
        }
        std::vector<double> step(size), change(size);
        for (std::size_t i = 0; i < size; ++i) {
            step[i] = (to[i] - x[i]) / scale[i];
            change[i] = masked[i] == 0 ? 0 : (next_gradient[i] - gradient[i]) * scale[i];
        }
        memory.add(std::move(step), std::move(change));
        idle = f - next < limits.relative * f ? idle + 1 : 0;
        x = to;
        f = next;
        gradient.swap(next_gradient);
        if (idle >= kPatience) return {x, f, LocalEnd::flat};
    }
}

LocalResult refined(DesignModel& model, std::vector<double> x, const LocalLimits& limits,
                    double color_tolerance) {
    constexpr int kRounds = 4;
    LocalResult result;
    for (int round = 0; round < kRounds; ++round) {
        model.adapt_colors(x, color_tolerance);
        if (model.problem().merit == MeritKind::mean_abs) {
            result = quasi_newton(model, x, limits);
        } else {
            result = least_squares(model, x, limits);
        }
        if (result.end == LocalEnd::failed || result.end == LocalEnd::stopped) return result;
        x = result.x;
        if (!model.adapt_colors(x, color_tolerance)) break;
        result.objective = model.objective(x);
    }
    return result;
}

}  // namespace irido
