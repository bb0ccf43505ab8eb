#pragma once

#include <string>

#include "tables/pictures/figure.hpp"
#include "tables/pictures/inks.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// Rows of compare for one stack: the exact colour and those of the engines over the angle, one
/// strip above the other, and Delta E under them. For one angle patches of the engines above the
/// exact colour, and bars of Delta E.
tables::Figure strip_figure(const tables::Records& rows, const std::string& title,
                            tables::GamutMapping gamut);

/// Rows of films: for each engine, how many per cent of the films have which Delta E. Throws
/// PictureError if none has one.
tables::Figure histogram_figure(const tables::Records& rows, const std::string& title);

}  // namespace irido::cli
