#include "core/scratch/scratch_grid.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/degrees.hpp"

namespace irido {

namespace {

/// Whether an axis comes within `reach` of a square, or a little more: the distance of its centre
/// against the half extent across the axis and along it.
struct GridAxis {
    explicit GridAxis(const Scratch& of)
        : tx(cos_deg(of.angle_deg)), ty(sin_deg(of.angle_deg)), scratch(of) {}

    bool touches(double x, double y, double half, double reach) const {
        const double dx = x - scratch.point.x_um, dy = y - scratch.point.y_um;
        const double along = dx * tx + dy * ty, across = std::abs(dy * tx - dx * ty);
        const double extent = half * (std::abs(tx) + std::abs(ty)) + reach;
        return across <= extent && along >= scratch.start_um - extent &&
               along <= scratch.end_um + extent;
    }

    double tx, ty;
    const Scratch& scratch;
};

}  // namespace

ScratchGrid::ScratchGrid(std::span<const Scratch> scratches, SurfacePoint origin, double width_um,
                         double height_um, double cell_um, double reach_um)
    : origin_(origin), cell_(cell_um) {
    constexpr double kMostCells = 1U << 24U, kMostEntries = 1U << 31U, kLargest_um = 1e9;
    for (const double size : {width_um, height_um, cell_um, reach_um})
        require_in_range("size of a grid, um", size, 1e-3, kLargest_um);
    const double columns = std::ceil(width_um / cell_um), rows = std::ceil(height_um / cell_um);
    require_in_range("cells", columns * rows, 1, kMostCells);
    columns_ = static_cast<std::uint32_t>(columns);
    rows_ = static_cast<std::uint32_t>(rows);
    // cell by cell of the box around each scratch: first how many, then which
    const auto for_each_cell = [&](const auto& visit) {
        const double half = cell_ / 2;
        for (std::size_t i = 0; i < scratches.size(); ++i) {
            const GridAxis axis(scratches[i]);
            const double box = (std::abs(axis.tx) + std::abs(axis.ty)) * cell_ + reach_um;
            double low_x = -kLargest_um, high_x = kLargest_um, low_y = low_x, high_y = high_x;
            if (!scratches[i].is_infinite()) {
                const double ax = axis.scratch.point.x_um + axis.scratch.start_um * axis.tx,
                             bx = axis.scratch.point.x_um + axis.scratch.end_um * axis.tx,
                             ay = axis.scratch.point.y_um + axis.scratch.start_um * axis.ty,
                             by = axis.scratch.point.y_um + axis.scratch.end_um * axis.ty;
                low_x = std::min(ax, bx) - box, high_x = std::max(ax, bx) + box;
                low_y = std::min(ay, by) - box, high_y = std::max(ay, by) + box;
            }
            const auto cell_of = [&](double place, double from, std::uint32_t count) {
                return std::clamp(std::floor((place - from) / cell_), -1.0,
                                  static_cast<double>(count));
            };
            const double left = std::max(0.0, cell_of(low_x, origin.x_um, columns_)),
                         right = std::min(columns - 1, cell_of(high_x, origin.x_um, columns_)),
                         low = std::max(0.0, cell_of(low_y, origin.y_um, rows_)),
                         high = std::min(rows - 1, cell_of(high_y, origin.y_um, rows_));
            for (double row = low; row <= high; ++row)
                for (double column = left; column <= right; ++column)
                    if (axis.touches(origin.x_um + (column + 0.5) * cell_,
                                     origin.y_um + (row + 0.5) * cell_, half, reach_um))
                        visit(static_cast<std::size_t>(row * columns + column),
                              static_cast<std::uint32_t>(i));
        }
    };
    std::vector<std::uint64_t> counts(static_cast<std::size_t>(columns * rows) + 1, 0);
    for_each_cell([&](std::size_t cell, std::uint32_t) { ++counts[cell + 1]; });
    for (std::size_t cell = 1; cell < counts.size(); ++cell) counts[cell] += counts[cell - 1];
    require_in_range("entries", static_cast<double>(counts.back()), 0, kMostEntries);
    offsets_.assign(counts.begin(), counts.end());
    entries_.resize(offsets_.back());
    for_each_cell([&](std::size_t cell, std::uint32_t i) {
        entries_[static_cast<std::size_t>(counts[cell]++)] = i;
    });
}

std::span<const std::uint32_t> ScratchGrid::near(SurfacePoint at) const {
    const auto cell_of = [&](double place, std::uint32_t count) {
        return static_cast<std::size_t>(
            std::clamp(std::floor(place / cell_), 0.0, static_cast<double>(count) - 1));
    };
    const std::size_t cell = cell_of(at.y_um - origin_.y_um, rows_) * columns_ +
                             cell_of(at.x_um - origin_.x_um, columns_);
    return std::span(entries_).subspan(offsets_[cell], offsets_[cell + 1] - offsets_[cell]);
}

}  // namespace irido
