#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scratch/scratch.hpp"

namespace irido {

/// Finds the scratches near a point of a rectangle: square cells, each listing all scratches whose
/// axis comes nearer to the cell than `reach`. The offsets and the lists are two plain buffers, as
/// an engine loads them: VWH18's per-triangle lists, for any surface with texture coordinates.
class ScratchGrid {
public:
    /// Throws DomainError for more than 2^24 cells or 2^31 entries.
    ///   scratches            to be listed by their index
    ///   origin               corner of cell 0
    ///   width_um, height_um  of the rectangle, (0, 1e9]
    ///   cell_um              side of a cell, (0, 1e9]
    ///   reach_um             distance within which scratches are listed, (0, 1e9]
    ScratchGrid(std::span<const Scratch> scratches, SurfacePoint origin, double width_um,
                double height_um, double cell_um, double reach_um);

    std::uint32_t columns() const { return columns_; }
    std::uint32_t rows() const { return rows_; }
    double cell_um() const { return cell_; }
    /// offsets()[cell] to offsets()[cell + 1] are its entries; cell = row columns() + column.
    std::span<const std::uint32_t> offsets() const { return offsets_; }
    std::span<const std::uint32_t> entries() const { return entries_; }
    /// Entries of the cell of a place, ascending; of the nearest cell outside the rectangle.
    std::span<const std::uint32_t> near(SurfacePoint at) const;

private:
    SurfacePoint origin_;
    double cell_;
    std::uint32_t columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> offsets_, entries_;
};

}  // namespace irido
