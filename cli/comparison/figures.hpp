#pragma once

#include <string>

#include "tables/pictures/figure.hpp"
#include "tables/pictures/inks.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// Rows of compare for one stack: the exact colour and those of the engines over the angle as
/// stacked strips, with Delta E below. For a single angle: patches of the engines above the exact
/// colour, and bars of Delta E.
tables::Figure strip_figure(const tables::Records& rows, const std::string& title,
                            tables::GamutMapping gamut);

/// Histogram of rows of films: for each engine, the percentage of films by Delta E. Throws
/// PictureError if no film has one.
tables::Figure histogram_figure(const tables::Records& rows, const std::string& title);

}  // namespace irido::cli
