#include "cli/options/table_options.hpp"

#include <algorithm>

#include "cli/exit_status.hpp"
#include "cli/options/long_work.hpp"
#include "cli/progress.hpp"
#include "core/error.hpp"
#include "tables/lut/lut_figure.hpp"
#include "tables/lut/lut_file.hpp"
#include "tables/lut/lut_texels.hpp"

namespace irido::cli {

namespace {

constexpr double kMostSamples = 8192;

std::vector<std::string_view> table_format_names(bool has_pictures = true) {
    std::vector<std::string_view> names;
    for (const tables::LutFormat* format : tables::lut_formats()) names.push_back(format->name);
    if (!has_pictures) return names;
    for (const tables::PictureFormat* format : tables::picture_formats())
        names.push_back(format->name);
    return names;
}

/// "64x512": one number for each axis; one number alone is for all.
std::vector<std::size_t> parse_size(std::string text, std::size_t axes) {
    std::vector<std::size_t> counts;
    if (text.empty()) return counts;
    std::ranges::replace(text, 'x', ',');
    for (const std::string_view part : comma_separated(text))
        counts.push_back(
            static_cast<std::size_t>(parse_whole_number("--size", part, 1, kMostSamples)));
    if (counts.size() == 1) counts.resize(axes, counts.front());
    return counts;
}

}  // namespace

void add_dtype_option(CLI::App& command, std::string& type, const std::string& usual) {
    const std::vector<std::string_view> names = names_of(tables::kLutTypes);
    command
        .add_option("--dtype", type,
                    "number format: " + one_of({names.begin(), names.end()}) + " " + usual)
        ->type_name("NAME");
    offer(command, "dtype", [] { return names_of(tables::kLutTypes); });
}

void add_table_size_options(CLI::App& command, TableOptions& options, const std::string& usual) {
    add_dtype_option(command, options.type, usual);
    command
        .add_option("--size", options.size,
                    "samples per axis, [1, 8192]: 64x512, in the order of the axes, or one\n"
                    "number for all [as many as the axes' lists have]")
        ->type_name("SIZE");
    command
        .add_option("--tolerance", options.tolerance,
                    "choose the smallest size with this interpolation error (in CIEDE2000\n"
                    "for colours, else as defined below); an axis along which the table\n"
                    "is constant gets one sample. Exit status 1 if it cannot be met")
        ->type_name("E");
    command.add_flag("--any-size", options.any_size,
                     "with --tolerance: allow sizes other than powers of two");
}

void add_table_layout_options(CLI::App& command, TableOptions& options) {
    command.add_flag("--zstd", options.layout.zstd, "ktx2: compress with Zstandard");
    command.add_flag("--layers", options.layout.layers,
                     "ktx2: store a third axis as array layers, not as depth or mip levels");
}

std::string table_formats_text() {
    std::string text;
    for (const std::string_view name : table_format_names())
        text.append(text.empty() ? "" : ", ").append(name);
    return text + " [csv]; pictures are for\nlooking only";
}

const tables::LutFormat& resolved_lut_format(const OutputOptions& output, bool has_pictures) {
    const std::string name = resolved_format(output);
    const std::size_t dot = output.file.find_last_of('.');
    const std::string extension = dot == std::string::npos ? "" : output.file.substr(dot + 1);
    if (!output.format.empty() && extension != name && tables::find_lut_format(extension))
        throw UsageError("--format: " + name + " contradicts the extension ." + extension);
    if (const tables::LutFormat* format = tables::find_lut_format(name)) return *format;
    throw UsageError((output.format.empty() ? "--output: the extension " : "--format: ") +
                     not_one_of(table_format_names(has_pictures), name));
}

tables::LutType parse_type(std::string_view text) {
    return named("--dtype", tables::kLutTypes, text);
}

tables::LutMaking making_of(const TableOptions& options, const tables::LutFormat* format,
                            std::string_view text_type, std::size_t axes) {
    tables::LutMaking making;
    making.sizing.counts = parse_size(options.size, axes);
    making.sizing.power_of_two = !options.any_size;
    if (options.any_size && options.tolerance.empty())
        throw UsageError("--any-size: requires --tolerance");
    if (!options.tolerance.empty()) {
        if (!making.sizing.counts.empty())
            throw UsageError("--tolerance: cannot be combined with --size");
        making.sizing.tolerance = parse_one_number("--tolerance", options.tolerance, 1e-12, 1e3);
    }
    const std::string_view usual = format && format->name == "csv" ? text_type : "f32";
    making.type = parse_type(options.type.empty() ? usual : options.type);
    making.mips = format && format->name == "ktx2" && !options.layout.layers;
    return making;
}

namespace {

/// Notes textures that graphics processors do not take.
void note_large_texture(const tables::Lut& lut, const tables::LutLayout& layout, bool quiet) {
    constexpr std::size_t kMostFlat = 16384, kMostDeep = 2048;
    const std::vector<tables::LutAxis> axes = lut.axes_of_level(0);
    const bool has_depth = axes.size() == 3 && axes.front().count() > 1;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const std::size_t blocks = i + 1 == axes.size() ? tables::texel_blocks(lut).count : 1;
        const std::size_t texels = blocks * axes[i].count();
        const bool is_flat = !has_depth || (layout.layers && i > 0);
        const std::size_t most = is_flat ? kMostFlat : kMostDeep;
        if (texels <= most) continue;
        const std::string where = is_flat ? "" : layout.layers ? " array layers" : " in 3D";
        note(axes[i].name + ": " + std::to_string(texels) + " texels; most GPUs take at most " +
                 std::to_string(most) + where,
             quiet);
    }
}

}  // namespace

void write_table(const tables::Lut& lut, const tables::LutFormat& format,
                 const tables::LutLayout& layout, const OutputOptions& output, bool quiet) {
    if (output.file.empty()) {
        const std::vector<tables::LutFile> files = format.write(lut, layout);
        const auto table = std::ranges::find(files, std::string(), &tables::LutFile::suffix);
        write_bytes(table->bytes, output, format.is_binary);
    } else {
        tables::write_lut(lut, output.file, format, layout);
    }
    if (format.name == "ktx2") note_large_texture(lut, layout, quiet);
    if (layout.layers) note("three.js reads only the first array layer of a file", quiet);
    if (format.name == "ktx2" || format.name == "exr")
        for (const tables::LutAxis& axis : lut.axes)
            if (!axis.is_linear() && axis.half_at == 0 && !(lut.mips && &axis == &lut.axes.front()))
                note(axis.name + ": samples are not equally spaced: fetch texels, do not filter",
                     quiet);
}

int make_table(const tables::LutKind& kind, tables::LutPlan plan, const TableOutput& typed,
               const std::string& title, bool is_announced, double gain) {
    const tables::PictureFormat* const picture = asked_picture(typed.output, typed.picture);
    const tables::LutFormat* const format = picture ? nullptr : &resolved_lut_format(typed.output);
    tables::LutMaking making = making_of(typed.table, format, kind.text_type, plan.axes.size());
    making.measure = !typed.output.file.empty();
    making.threads = typed.threads;
    const auto say = [&](const std::string& text) { note(text, typed.quiet); };
    if (is_announced)
        note_long_work(least_seconds(plan, making), making.sizing.tolerance.has_value(), say);
    Progress progress(typed.quiet);
    making.progress = [&progress](double done, const std::string& what) {
        progress.set(done, what);
    };
    tables::Lut lut;
    try {
        lut = tables::make_lut(kind, std::move(plan), making);
    } catch (const ToleranceError& error) {
        progress.clear();
        print_error(error.what());
        return kCheckFailed;
    }
    progress.clear();
    for (const auto& text : lut.facts["notes"]) say(text.get<std::string>());
    if (!picture) {
        write_table(lut, *format, typed.table.layout, typed.output, typed.quiet);
        return 0;
    }
    const auto figure = [&] {
        tables::Figure drawn = tables::lut_figure(lut, title, parse_gamut(typed.picture), gain);
        for (const std::string& text : drawn.notes) say(text);
        return drawn;
    };
    write_picture(figure, typed.picture, *picture, typed.output);
    return 0;
}

}  // namespace irido::cli
