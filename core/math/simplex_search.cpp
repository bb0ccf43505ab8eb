#include "core/math/simplex_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irido {

namespace {

using Objective = std::function<double(std::span<const double>)>;

/// One simplex, its corners sorted by value.
class Simplex {
public:
    Simplex(const Objective& function, const std::vector<double>& start, double size,
            std::size_t& left)
        : function_(function), left_(left), n_(start.size()) {
        corners_.push_back({start, evaluate(start)});
        for (std::size_t i = 0; i < n_; ++i) {
            std::vector<double> x = start;
            x[i] += x[i] + size <= 1 ? size : -size;
            corners_.push_back({x, evaluate(x)});
        }
        sort();
    }

    const SimplexMinimum& best() const { return corners_.front(); }

    /// Moves the worst corner until all values, and all corners, nearly coincide.
    void descend() {
        const auto n = static_cast<double>(n_);
        const double expansion = 1 + 2 / n, contraction = 0.75 - 1 / (2 * n), shrinking = 1 - 1 / n;
        while (left_ > 2 * n_ + 2 && !is_flat()) {
            SimplexMinimum& worst = corners_.back();
            const SimplexMinimum reflected = along(1);
            if (reflected.value < best().value) {
                const SimplexMinimum expanded = along(expansion);
                worst = expanded.value < reflected.value ? expanded : reflected;
            } else if (reflected.value < corners_[n_ - 1].value) {
                worst = reflected;
            } else {
                const bool outside = reflected.value < worst.value;
                const SimplexMinimum contracted = along(outside ? contraction : -contraction);
                if (contracted.value < std::min(reflected.value, worst.value)) {
                    worst = contracted;
                } else {
                    shrink(n_ == 1 ? 0.5 : shrinking);
                }
            }
            sort();
        }
    }

private:
    double evaluate(std::vector<double>& x) {
        for (double& value : x) value = std::clamp(value, 0.0, 1.0);
        --left_;
        return function_(x);
    }
    double evaluate(const std::vector<double>& x) {
        std::vector<double> copy = x;
        return evaluate(copy);
    }

    /// Moves from the worst corner past the centroid of the others, by `factor` times its distance.
    SimplexMinimum along(double factor) {
        SimplexMinimum point{std::vector<double>(n_), 0};
        for (std::size_t i = 0; i < n_; ++i) {
            double middle = 0;
            for (std::size_t c = 0; c < n_; ++c) middle += corners_[c].x[i];
            middle /= static_cast<double>(n_);
            point.x[i] = middle + factor * (middle - corners_.back().x[i]);
        }
        point.value = evaluate(point.x);
        return point;
    }

    void shrink(double factor) {
        for (std::size_t c = 1; c <= n_; ++c) {
            for (std::size_t i = 0; i < n_; ++i)
                corners_[c].x[i] = best().x[i] + factor * (corners_[c].x[i] - best().x[i]);
            corners_[c].value = evaluate(corners_[c].x);
        }
    }

    bool is_flat() const {
        double extent = 0;
        for (std::size_t i = 0; i < n_; ++i)
            extent = std::max(extent, std::abs(corners_.back().x[i] - best().x[i]));
        return corners_.back().value - best().value <= 1e-7 * (std::abs(best().value) + 1e-9) ||
               extent < 1e-9;
    }

    void sort() { std::ranges::stable_sort(corners_, {}, &SimplexMinimum::value); }

    const Objective& function_;
    std::size_t& left_;
    std::size_t n_;
    std::vector<SimplexMinimum> corners_;
};

}  // namespace

SimplexMinimum simplex_search(const Objective& function, std::vector<double> start, double size,
                              std::size_t evaluations) {
    std::size_t left = std::max(evaluations, start.size() + 2);
    SimplexMinimum best{start, std::numeric_limits<double>::infinity()};
    for (double step = size; left > 3 * start.size() + 3; step *= 0.5) {
        Simplex simplex(function, best.x, step, left);
        simplex.descend();
        const double gain = best.value - simplex.best().value;
        if (simplex.best().value < best.value) best = simplex.best();
        if (!(gain > 1e-6 * std::abs(best.value))) break;
    }
    return best;
}

}  // namespace irido
