#pragma once

#include "tables/lut/lut.hpp"
#include "tables/pictures/inks.hpp"
#include "tables/pictures/rows_figure.hpp"

namespace irido::tables {

/// How a table looks: a table of colours as it is seen in sRGB, others by their values; its last
/// axis along x. The figure keeps the table's metadata. Throws PictureError for what cannot be
/// drawn.
Figure lut_figure(const Lut& lut, const std::string& title, GamutMapping gamut);

}  // namespace irido::tables
