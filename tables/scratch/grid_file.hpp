#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scratch/scratch_grid.hpp"
#include "core/scratch/scratched_surface.hpp"

namespace irido::tables {

/// A rectangle of a surface, cut into square cells.
struct GridExtent {
    SurfacePoint origin{};  ///< the corner of cell 0, um
    double width_um = 1000, height_um = 1000, cell_um = 100;
    double reach_um = 360;  ///< how far off a scratch counts
};

/// The scratches of a surface that come nearer to the rectangle than its reach, and some more
/// around its corners.
std::vector<Scratch> scratches_within(const ScratchedSurface& surface, const GridExtent& extent);

/// Scratches and their grid as engines load them, little-endian, one buffer after the other:
///     records  float32 [scratches][8]: x, y (from the origin), tangent x, y, start, end, width,
///              depth, um; ends of endless scratches are -+3e38
///     offsets  uint32 [cells + 1]; cell = row columns + column
///     entries  uint32: those of a cell are records[entries[offsets[cell]]] and so on, ascending
/// The header says where each of them begins, and what the rectangle is.
struct GridFile {
    std::string bytes;
    nlohmann::json header;
};
inline constexpr const char* kGridKind = "scratch-grid";
GridFile grid_file(std::span<const Scratch> scratches, const GridExtent& extent);

/// What is wrong with the bytes of a grid file, one line each: a size, the checksum, an entry out
/// of range or order, a scratch that is missing in a cell that it crosses.
std::vector<std::string> grid_problems(std::string_view bytes, const nlohmann::json& header);

}  // namespace irido::tables
