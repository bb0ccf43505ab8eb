#include "cli/options/picture_options.hpp"

#include "cli/options/words.hpp"

namespace irido::cli {

void add_bits_option(CLI::App& command, std::string& bits) {
    command.add_option("--bits", bits, "bits of a component of .png: 8 or 16 [8]")->type_name("N");
    offer(command, "bits", "8 16");
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
    add_bits_option(command, options.bits);
    command
        .add_option("--gamut", options.gamut,
                    "colours outside sRGB in a picture: clip each component, or compress:\n"
                    "mix with the grey of the same luminance until it fits [clip]")
        ->type_name("NAME");
    offer(command, "gamut", [] { return names_of(tables::kGamutMappings); });
}

const tables::PictureFormat* asked_picture(const OutputOptions& output,
                                           const PictureOptions& options) {
    const tables::PictureFormat* const format =
        tables::find_picture_format(resolved_format(output));
    if (!options.bits.empty() && (!format || format->name != "png"))
        throw UsageError("--bits: requires a picture as .png");
    if (!options.gamut.empty() && !format)
        throw UsageError("--gamut: requires a picture, such as --output FILE.svg");
    if (format) {
        parse_gamut(options);
        if (!options.bits.empty() && options.bits != "8" && options.bits != "16")
            throw UsageError("--bits: must be 8 or 16 (got '" + options.bits + "')");
    }
    return format;
}

const tables::PictureFormat& picture_format_of(const std::string& option, const std::string& file) {
    std::vector<std::string> endings;
    for (const tables::PictureFormat* const format : tables::picture_formats()) {
        endings.push_back("." + std::string(format->name));
        if (file.ends_with(endings.back())) return *format;
    }
    throw UsageError(option + ": must end in " + one_of(endings) + " (got '" + file + "')");
}

tables::GamutMapping parse_gamut(const PictureOptions& options) {
    return options.gamut.empty() ? tables::GamutMapping::clip
                                 : named("--gamut", tables::kGamutMappings, options.gamut);
}

std::string picture_bytes(const std::function<tables::Figure()>& figure,
                          const PictureOptions& options, const tables::PictureFormat& format,
                          const std::string& file) {
    try {
        tables::Drawing drawing = tables::drawn(figure());
        if (options.bits == "16") drawing.bits = 16;
        return format.write(drawing);
    } catch (const tables::PictureError& error) {
        throw UsageError((file.empty() ? "<stdout>" : file) + ": " + error.what());
    }
}

void write_picture(const std::function<tables::Figure()>& figure, const PictureOptions& options,
                   const tables::PictureFormat& format, const OutputOptions& output) {
    write_bytes(picture_bytes(figure, options, format, output.file), output, format.is_binary);
}

}  // namespace irido::cli
