#pragma once

#include "cli/options/command.hpp"
#include "tables/pictures/figure.hpp"
#include "tables/pictures/inks.hpp"
#include "tables/pictures/picture_format.hpp"

namespace irido::cli {

/// Exposures of pictures, EV, lie in [-kMostExposure, kMostExposure].
inline constexpr double kMostExposure = 40;

/// How to draw a picture of colours, as given on the command line; "" if not given.
struct PictureOptions {
    std::string gamut;
    std::string bits;
};

/// Adds --bits.
void add_bits_option(CLI::App& command, std::string& bits);

/// Adds --bits and --gamut.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// The picture's format if the output is a picture, else nullptr. Throws UsageError if picture
/// options were given for another output.
const tables::PictureFormat* asked_picture(const OutputOptions& output,
                                           const PictureOptions& options = {});

/// The format of a picture file by its extension. Throws UsageError, which names `option`.
const tables::PictureFormat& picture_format_of(const std::string& option, const std::string& file);

tables::GamutMapping parse_gamut(const PictureOptions& options);

/// The bytes of a picture. Throws UsageError, which names the file, if it cannot be drawn.
/// figure   makes the figure
/// options  picture options, as given
/// format   the file format
/// file     name of the file, for errors
std::string picture_bytes(const std::function<tables::Figure()>& figure,
                          const PictureOptions& options, const tables::PictureFormat& format,
                          const std::string& file);

/// Draws a figure and writes it to the file or to standard output.
/// figure   makes the figure
/// options  picture options, as given
/// format   the file format
/// output   the destination
void write_picture(const std::function<tables::Figure()>& figure, const PictureOptions& options,
                   const tables::PictureFormat& format, const OutputOptions& output);

}  // namespace irido::cli
