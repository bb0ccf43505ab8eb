// OpenEXR: pictures for renderers and compositors (Mitsuba, pbrt, Blender, oiiotool).
// - f16 (half) or f32 (float), one part of scan lines, ZIP compression.
// - 1 channel is Y; 2 are R, G and a B of zeros (three's EXRLoader refuses R and G alone); 3 are
//   R, G, B, whatever they mean: also for XYZ, because readers take channels named X, Y, Z for
//   grey, and the metadata says what they are; 4 are R, G, B, A. More are blocks of three,
//   R, G, B, side by side along x; the metadata's key `blocks` gives their number.
// - The last axis is x, the one before it y. The first sample is the leftmost column of the topmost
//   row, which is the file's first line. (three's EXRLoader flips the rows: its data begin with the
//   bottom row and flipY is false, so that v = 1 is the first sample.)
// - A third axis is stacked: its slices lie below each other; the key `stacked` gives their number
//   if there are several.
// - Tables with mip levels are refused.
// - Attributes: `irido.metadata` (JSON), `irido.kind`, `irido.error` (if measured), and
//   `chromaticities` if the values are colours of an RGB space.
// - Nothing depends on the time, threads or the machine.
// Only files as written here can be read back.
// Source: OpenEXR 3.1, its C library (the "core" API).

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/colorimetry/space.hpp"
#include "tables/lut/lut_metadata.hpp"
#include "tables/lut/lut_texels.hpp"
#include "tables/lut/lut_values.hpp"
#include "tables/pictures/exr_stream.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

namespace {

constexpr const char* kMetadata = "irido.metadata";
constexpr int kZipLevel = 6;
/// The compression limit of Deflate, rounded up.
constexpr std::size_t kZipLargestRatio = 1100;

/// Width, height and the names of the texels' components, in order.
struct Picture {
    std::int32_t width = 0, height = 0;
    std::vector<const char*> channels;
};

std::int32_t checked_size(std::size_t size) {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 64;  // bytes per row
    if (size > most) throw LutError("a picture cannot be " + std::to_string(size) + " texels wide");
    return static_cast<std::int32_t>(size);
}

/// Throws LutError naming what a picture cannot represent.
Picture picture_of(const Lut& lut) {
    if (lut.type == LutType::f64) throw LutError("exr holds f16 and f32, not f64");
    if (lut.mips) throw LutError("exr has no mip levels; only ktx2, bin and csv do");
    const auto [blocks, channels] = texel_blocks(lut);
    Picture picture;
    picture.width = checked_size(blocks * lut.axes.back().count());
    std::size_t height = 1;
    for (std::size_t a = 0; a + 1 < lut.axes.size(); ++a) height *= lut.axes[a].count();
    picture.height = checked_size(height);
    if (channels == 1)
        picture.channels = {"Y"};
    else
        picture.channels = {"R", "G", "B"};
    if (channels == 4) picture.channels.push_back("A");
    return picture;
}

std::string metadata_for(const Lut& lut) {
    nlohmann::json metadata = metadata_of(lut);
    if (texel_blocks(lut).count > 1) metadata["blocks"] = texel_blocks(lut).count;
    if (lut.axes.size() == 3 && lut.axes.front().count() > 1)
        metadata["stacked"] = lut.axes.front().count();
    return metadata_text(metadata);
}

ExrPixels pixels_of(const Picture& picture, LutType type) {
    return {picture.width, picture.height, picture.channels,
            type == LutType::f16 ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT};
}

/// Converts errors of pictures to those of tables.
auto in_words_of_tables(const auto& work) {
    try {
        return work();
    } catch (const PictureError& error) {
        throw LutError(error.what());
    }
}

// --- writing --------------------------------------------------------------------------------

void set_text(const ExrFile& file, const char* name, const std::string& text) {
    file.check(exr_attr_set_string(file, 0, name, text.c_str()));
}

void set_color_space(const ExrFile& file, const Lut& lut) {
    const auto found = lut.facts.find("color_space");
    if (found == lut.facts.end() || *found == "xyz") return;
    const std::string name = *found;
    if (std::ranges::find(rgb_space_names(), name) == rgb_space_names().end()) return;
    set_chromaticities(file, rgb_space(name));
}

void set_header(const ExrFile& file, const Picture& picture, const Lut& lut) {
    const std::string metadata = metadata_for(lut);  // checked before any of it is used
    int part = 0;
    file.check(exr_add_part(file, "table", EXR_STORAGE_SCANLINE, &part));
    file.check(exr_initialize_required_attr_simple(file, part, picture.width, picture.height,
                                                   EXR_COMPRESSION_ZIP));
    file.check(exr_set_zip_compression_level(file, part, kZipLevel));
    const exr_pixel_type_t type = lut.type == LutType::f16 ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
    for (const char* channel : picture.channels)
        file.check(exr_add_channel(file, part, channel, type, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    set_color_space(file, lut);
    set_text(file, "irido.kind", lut.kind);
    const auto error = lut.facts.find("error");
    if (error != lut.facts.end() && error->is_object())
        set_text(file, "irido.error", error->dump());
    set_text(file, kMetadata, metadata);
}

std::string written(const Lut& lut, const Picture& picture) {
    const std::string texels = texels_of(lut, 0, picture.channels.size());
    ExrFile file;
    set_header(file, picture, lut);
    file.check(exr_write_header(file));
    write_rows(file, pixels_of(picture, lut.type), texels.data());
    return file.finish();
}

std::vector<LutFile> write(const Lut& lut, const LutLayout& layout) {
    check_plain(layout, "exr");
    const Picture picture = picture_of(lut);
    check_values(lut);
    std::vector<LutFile> files;
    std::string bytes = in_words_of_tables([&] { return written(lut, picture); });
    files.push_back({"", std::move(bytes)});
    return files;
}

// --- reading --------------------------------------------------------------------------------

std::string metadata_in(const ExrFile& file) {
    std::int32_t length = 0;
    const char* text = nullptr;
    if (exr_attr_get_string(file, 0, kMetadata, &length, &text) != EXR_ERR_SUCCESS)
        throw LutError(std::string("not a picture made by irido: it has no ") + kMetadata);
    return {text, static_cast<std::size_t>(length)};
}

/// Throws LutError if the header does not match the table.
void check_header(const ExrFile& file, const Picture& picture, LutType type) {
    int parts = 0;
    exr_storage_t storage{};
    exr_compression_t compression{};
    exr_attr_box2i_t window{};
    const exr_attr_chlist_t* channels = nullptr;
    file.check(exr_get_count(file, &parts));
    file.check(exr_get_storage(file, 0, &storage));
    file.check(exr_get_compression(file, 0, &compression));
    file.check(exr_get_data_window(file, 0, &window));
    file.check(exr_get_channels(file, 0, &channels));
    bool is_ours = parts == 1 && storage == EXR_STORAGE_SCANLINE &&
                   compression == EXR_COMPRESSION_ZIP && window.min.x == 0 && window.min.y == 0 &&
                   window.max.x == picture.width - 1 && window.max.y == picture.height - 1 &&
                   channels->num_channels == static_cast<int>(picture.channels.size());
    std::vector<std::string_view> names(picture.channels.begin(), picture.channels.end());
    std::ranges::sort(names);
    for (std::size_t c = 0; is_ours && c < names.size(); ++c) {
        const exr_attr_chlist_entry_t& channel = channels->entries[c];
        is_ours = std::string_view(channel.name.str) == names[c] && channel.x_sampling == 1 &&
                  channel.y_sampling == 1 &&
                  channel.pixel_type == (type == LutType::f16 ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT);
    }
    if (!is_ours) throw LutError("the header does not match the metadata");
}

Lut read_table(std::string_view bytes) {
    const ExrFile file(bytes);
    Lut lut = lut_from_metadata(metadata_in(file));
    const Picture picture = picture_of(lut);
    check_header(file, picture, lut.type);
    const ExrPixels pixels = pixels_of(picture, lut.type);
    if (pixels.bytes() / kZipLargestRatio > bytes.size())
        throw LutError("the file is truncated: " + std::to_string(bytes.size()) +
                       " bytes cannot hold " + std::to_string(pixels.bytes()));
    std::string texels(pixels.bytes(), '\0');
    read_rows(file, pixels, texels.data());
    append_values(lut, 0, picture.channels.size(), texels);
    return lut;
}

Lut read(std::string_view bytes, std::string_view /*companion*/) {
    return in_words_of_tables([&] { return read_table(bytes); });
}

}  // namespace

extern const LutFormat lut_format_exr{
    .name = "exr",
    .summary = "OpenEXR picture for renderers and compositors, f16 or f32",
    .write = write,
    .read = read,
};

}  // namespace irido::tables
