#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/math/gauss.hpp"

namespace irido {

/// Quadrature nodes theta in degrees, with weights that include the weight function and dtheta.
struct WeightedAngles {
    std::vector<double> theta_deg, weight;
};

/// Functions of an angle in [0, 90] degrees as Chebyshev series on panels 90 [i, i + 1] / 2^level.
class AngleSeries {
public:
    static constexpr std::size_t kPanelDegree = 16;
    using Coefficients = std::array<double, kPanelDegree + 1>;

    struct Panel {
        unsigned level = 0;
        std::uint64_t index = 0;
        double begin_deg() const;
        double end_deg() const;
        /// Index among all panels, numbered as in a binary heap.
        std::uint64_t key() const { return (std::uint64_t{1} << level) + index; }
    };

    /// Halves panels until the last three coefficients of every function are below `tolerance`, up
    /// to 2^30 panels a quarter turn and about kMostPanels in all.
    ///   evaluate(theta_deg)  values [angle][function] in any order of angles
    AngleSeries(std::size_t functions, double tolerance,
                const std::function<std::vector<double>(std::span<const double>)>& evaluate);
    /// The same on 2^level panels of one width.
    AngleSeries(std::size_t functions, unsigned level,
                const std::function<std::vector<double>(std::span<const double>)>& evaluate);

    static constexpr std::size_t kMostPanels = 1U << 13;

    std::size_t functions() const { return functions_; }
    std::span<const Panel> panels() const { return panels_; }
    const Coefficients& coefficients(std::size_t panel, std::size_t function) const {
        return coefficients_[panel * functions_ + function];
    }
    /// Error estimate of a function's series on a panel: twice its last three coefficients, as
    /// those behind them are aliased into the series.
    double error(std::size_t panel, std::size_t function) const;
    double value(std::size_t function, double theta_deg) const;
    /// Values of all functions.
    void values(double theta_deg, std::span<double> out) const;
    /// Largest error() of all functions on the panel that contains the angle.
    double error_at(double theta_deg) const;

private:
    AngleSeries(std::size_t functions, double tolerance, unsigned first, unsigned last,
                const std::function<std::vector<double>(std::span<const double>)>& evaluate);
    std::size_t panel_of(double theta_deg) const;

    std::size_t functions_;
    std::vector<Panel> panels_;  ///< ascending
    std::vector<Coefficients> coefficients_;
};

/// Integrals of a weight times T_0 .. T_16 on each panel, computed once per panel: all that
/// integrals of any number of series against this weight need.
class AngleMoments {
public:
    using Nodes = std::function<WeightedAngles(double begin_deg, double end_deg)>;
    /// `nodes` returns the weight's quadrature nodes between two angles.
    explicit AngleMoments(Nodes nodes) : nodes_(std::move(nodes)) {}

    struct Integral {
        double value = 0;
        double error = 0;   ///< due to the series
        double weight = 0;  ///< integral of the weight alone
    };
    /// Integral of the weight times a function.
    Integral operator()(const AngleSeries& series, std::size_t function);
    /// The values of functions, as many as there is room for, from `first` on.
    void values(const AngleSeries& series, std::size_t first, std::span<double> out);

private:
    const AngleSeries::Coefficients& of(const AngleSeries::Panel& panel);

    Nodes nodes_;
    std::unordered_map<std::uint64_t, AngleSeries::Coefficients> moments_;  ///< by key
};

/// A place where a function varies on the scale of `width`: a pole or branch point near the axis.
struct Feature {
    double at, width;
};

/// Panel boundaries from begin to end, no panel wider than its distance to any feature, so that a
/// 16-point Gauss rule converges to rounding on each.
std::vector<double> graded_panels(double begin, double end, std::span<const Feature> features);

/// Calls add(x, weight) at the Gauss nodes of all panels inside [begin, end], of a rule of `points`
/// each.
template <int points = 16, class Add>
void for_each_node(std::span<const double> ends, double begin, double end, const Add& add) {
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double from = std::max(begin, ends[i]), to = std::min(end, ends[i + 1]);
        if (!(from < to)) continue;
        for (const GaussNode& node : gauss_legendre<points>())
            add(0.5 * (from + to) + 0.5 * (to - from) * node.x, 0.5 * (to - from) * node.weight);
    }
}

}  // namespace irido
