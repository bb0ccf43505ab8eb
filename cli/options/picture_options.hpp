#pragma once

#include "cli/options/command.hpp"
#include "tables/pictures/figure.hpp"
#include "tables/pictures/inks.hpp"
#include "tables/pictures/picture_format.hpp"

namespace irido::cli {

/// How a picture of colours is drawn, as typed; "" if not typed.
struct PictureOptions {
    std::string gamut;
    std::string bits;
};

/// --bits and --gamut
void add_picture_options(CLI::App& command, PictureOptions& options);

/// The picture's format if the output is one, else nullptr. Throws UsageError if options of
/// pictures were typed for what is none.
const tables::PictureFormat* asked_picture(const OutputOptions& output,
                                           const PictureOptions& options = {});

/// The format of a picture's file by its extension. Throws UsageError that names `option`.
const tables::PictureFormat& picture_format_of(const std::string& option, const std::string& file);

tables::GamutMapping parse_gamut(const PictureOptions& options);

/// The bytes of a picture. Throws UsageError that names the file if it cannot be drawn.
std::string picture_bytes(const std::function<tables::Figure()>& figure,
                          const PictureOptions& options, const tables::PictureFormat& format,
                          const std::string& file);

/// Draws a figure and writes it to the file or to standard output.
void write_picture(const std::function<tables::Figure()>& figure, const PictureOptions& options,
                   const tables::PictureFormat& format, const OutputOptions& output);

}  // namespace irido::cli
