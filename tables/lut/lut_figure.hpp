#pragma once

#include "tables/lut/lut.hpp"
#include "tables/pictures/inks.hpp"
#include "tables/pictures/rows_figure.hpp"

namespace irido::tables {

/// Draws a table: colours as seen in sRGB, other tables by their values, with the last axis along
/// x. The figure keeps the table's metadata. Throws PictureError for tables that cannot be drawn.
/// lut    the table
/// title  of the figure
/// gamut  how colours outside sRGB are shown
/// gain   multiplies colours
Figure lut_figure(const Lut& lut, const std::string& title, GamutMapping gamut, double gain = 1);

}  // namespace irido::tables
