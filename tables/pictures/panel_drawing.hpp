#pragma once

#include <set>

#include "tables/pictures/axis.hpp"

namespace irido::tables {

inline constexpr Ink kLetters = ink(0x222222), kFrame = ink(0x666666), kGridLine = ink(0xe4e4e4);
inline constexpr double kHueStrip = 9;  ///< along an axis of wavelengths, with its gap

/// Both axes of a panel in its place.
struct PanelPlaces {
    Box box;
    AxisPlaces x, y;
    std::optional<AxisPlaces> bar;  ///< of values, from the bottom to the top
};

/// Where a panel's numbers lie in a box. Throws PictureError.
PanelPlaces panel_places(const Panel& panel, const Box& box);

/// Of a panel: grid lines, cells, areas, curves, frame, labels. Says in `notes` what is not drawn
/// point by point.
void draw_panel(const Panel& panel, const PanelPlaces& places, std::vector<DrawnGroup>& to,
                std::set<std::string>& notes);

/// The sample in the legend: a line of a series, its marker, or a patch of an area, around `at`.
std::vector<Path> legend_sample(const Series& series, Point at);
Path legend_patch(std::size_t style, double opacity, Point at);

/// Strip of hues between two wavelengths, along x or along y.
std::optional<Cells> hue_strip(const AxisPlaces& axis, const Box& box, bool is_x);

inline constexpr double kAreaOpacity = 0.32;

}  // namespace irido::tables
