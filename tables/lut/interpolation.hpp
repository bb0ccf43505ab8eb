#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "tables/lut/lut_maker.hpp"

namespace irido::tables {

/// Samples of the axes [first, last).
std::size_t size_of(const std::vector<LutAxis>& axes, std::size_t first, std::size_t last);

/// Values as they are read back from a table.
std::vector<double> as_stored(std::vector<double> values, LutType type);

/// The parts of a table that are sampled together, as grids of the plan's axes.
std::vector<std::vector<LutAxis>> grids_of(const Lut& lut);

/// A plan's function on grids, in pieces along the plan's axis; the latest grids are remembered.
class Sampler {
public:
    /// Refers to the plan.
    Sampler(const LutPlan& plan, const LutMaking& making)
        : plan_(plan), threads_(making.threads), progress_(making.progress) {}

    const LutPlan& plan() const { return plan_; }

    /// Of what follows, for whoever watches; `shares` if its progress is that of the whole table.
    void says(std::string what, bool shares);

    /// Values [axes][channel].
    std::vector<double> operator()(const std::vector<LutAxis>& axes);

private:
    struct Remembered {
        std::vector<std::vector<double>> axes;
        std::vector<double> values;
    };

    void tell(double done) const;
    std::vector<double> evaluated(const std::vector<LutAxis>& axes) const;

    const LutPlan& plan_;
    unsigned threads_;
    std::function<void(double, const std::string&)> progress_;
    std::string what_;
    bool shares_ = false;
    std::deque<Remembered> known_;
    std::size_t remembered_ = 0;
};

/// Values on a grid, linearly interpolated at other samples along one of its axes.
std::vector<double> resampled(const std::vector<double>& values, const std::vector<LutAxis>& axes,
                              std::size_t a, const std::vector<double>& at, std::size_t channels);

/// One grid with its stored values, for comparison with the plan's function.
class Comparison {
public:
    Comparison(Sampler& exact, std::vector<LutAxis> axes, std::vector<double> stored)
        : plan_(exact.plan()), axes_(std::move(axes)), stored_(std::move(stored)), exact_(exact) {}

    /// Samples between those of the grid at which an axis is checked; none if it is a list.
    std::vector<double> between(std::size_t a) const;

    struct Difference {
        double value = 0;
        std::vector<double> at;
    };

    /// The largest differences at the samples of `targets`, the largest first, and where.
    std::vector<Difference> largest(const std::vector<LutAxis>& targets, std::size_t most) const;

    /// As InterpolationError says.
    InterpolationError error() const;

    /// Number of evaluations of error(), about.
    ///   samples  of the grid
    ///   ranges   axes that are interpolated
    static double evaluations(double samples, std::size_t ranges);

    /// About as much, by the curvature of the stored values alone.
    double foreseen() const;

    /// The largest differences at the middles of all cells, and where.
    std::vector<Difference> worst_middles() const;

    /// The samples of the grid around a place.
    std::vector<LutAxis> ends_of_cell(const std::vector<double>& at) const;

private:
    std::size_t channels() const { return plan_.channels.size(); }
    std::vector<LutAxis> all_middles() const;
    std::vector<double> foreseen(const std::vector<LutAxis>& targets) const;
    std::vector<double> interpolated(const std::vector<LutAxis>& targets) const;
    std::vector<LutAxis> promising(const std::vector<LutAxis>& targets) const;
    std::vector<LutAxis> cell_of(const std::vector<double>& at) const;

    const LutPlan& plan_;
    std::vector<LutAxis> axes_;
    std::vector<double> stored_;
    Sampler& exact_;
};

}  // namespace irido::tables
