#pragma once

#include <set>

#include "tables/pictures/axis.hpp"

namespace irido::tables {

inline constexpr Ink kLetters = ink(0x222222), kFrame = ink(0x666666), kGridLine = ink(0xe4e4e4);
inline constexpr double kHueStrip = 9;  ///< height along a wavelength axis, including its gap

/// The axes of a panel in their positions.
struct PanelPlaces {
    Box box;
    AxisPlaces x, y;
    std::optional<AxisPlaces> bar;  ///< for values, from bottom to top
};

/// Maps a panel's numbers to a box. Throws PictureError.
PanelPlaces panel_places(const Panel& panel, const Box& box);

/// Draws a panel's grid lines, cells, areas, curves, frame and labels.
/// panel   the panel
/// places  its axes, from panel_places()
/// to      receives the shapes
/// notes   receives a note for whatever is not drawn point by point
void draw_panel(const Panel& panel, const PanelPlaces& places, std::vector<DrawnGroup>& to,
                std::set<std::string>& notes);

/// The legend's sample of a series, centred on `at`: a line, its marker, or a patch of an area.
std::vector<Path> legend_sample(const Series& series, Point at);
Path legend_patch(std::size_t style, double opacity, Point at);

/// Strip of spectral colours along a wavelength axis, along x or y.
std::optional<Cells> hue_strip(const AxisPlaces& axis, const Box& box, bool is_x);

inline constexpr double kAreaOpacity = 0.32;

}  // namespace irido::tables
