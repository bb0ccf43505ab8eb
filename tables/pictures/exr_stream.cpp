#include "tables/pictures/exr_stream.hpp"

#include <algorithm>
#include <cstring>

namespace irido::tables {

namespace {

ExrFile::Stream& stream_of(exr_const_context_t context) {
    void* stream = nullptr;
    exr_get_user_data(context, &stream);
    return *static_cast<ExrFile::Stream*>(stream);
}

void keep_message(exr_const_context_t context, exr_result_t /*code*/, const char* text) {
    if (context) stream_of(context).message = text;
}

std::int64_t size_of_input(exr_const_context_t /*context*/, void* stream) {
    return static_cast<std::int64_t>(static_cast<ExrFile::Stream*>(stream)->input.size());
}

std::int64_t read_input(exr_const_context_t /*context*/, void* stream, void* to, std::uint64_t size,
                        std::uint64_t offset, exr_stream_error_func_ptr_t /*error*/) {
    const std::string_view input = static_cast<ExrFile::Stream*>(stream)->input;
    if (offset > input.size()) return -1;
    const std::size_t count = std::min<std::uint64_t>(size, input.size() - offset);
    std::memcpy(to, input.data() + offset, count);
    return static_cast<std::int64_t>(count);
}

std::int64_t write_output(exr_const_context_t /*context*/, void* stream, const void* from,
                          std::uint64_t size, std::uint64_t offset,
                          exr_stream_error_func_ptr_t /*error*/) {
    std::string& output = static_cast<ExrFile::Stream*>(stream)->output;
    output.resize(std::max<std::uint64_t>(output.size(), offset + size));
    std::memcpy(output.data() + offset, from, size);
    return static_cast<std::int64_t>(size);
}

struct Encoder {
    explicit Encoder(const ExrFile& file) : context(file) {}
    ~Encoder() { exr_encoding_destroy(context, &pipeline); }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    exr_context_t context;
    exr_encode_pipeline_t pipeline{};
};

struct Decoder {
    explicit Decoder(const ExrFile& file) : context(file) {}
    ~Decoder() { exr_decoding_destroy(context, &pipeline); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    exr_context_t context;
    exr_decode_pipeline_t pipeline{};
};

int component_bytes(exr_pixel_type_t type) {
    return type == EXR_PIXEL_HALF ? 2 : 4;
}

/// Tells an encoder or a decoder where each channel's numbers are; `first` is the first pixel of
/// its chunk.
template <class Pipeline, class Bytes>
void aim_channels(Pipeline& pipeline, const ExrPixels& pixels, Bytes* first) {
    const int component = component_bytes(pixels.type);
    for (int c = 0; c < pipeline.channel_count; ++c) {
        exr_coding_channel_info_t& channel = pipeline.channels[c];
        const auto name = std::ranges::find(pixels.channels, std::string_view(channel.channel_name),
                                            [](const char* n) { return std::string_view(n); });
        Bytes* const place = name == pixels.channels.end()
                                 ? nullptr
                                 : first + component * (name - pixels.channels.begin());
        if constexpr (std::is_const_v<Bytes>)
            channel.encode_from_ptr = reinterpret_cast<const std::uint8_t*>(place);
        else
            channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(place);
        channel.user_pixel_stride = component * static_cast<int>(pixels.channels.size());
        channel.user_line_stride = static_cast<int>(pixels.row_bytes());
        channel.user_bytes_per_element = static_cast<std::int16_t>(component);
        channel.user_data_type = static_cast<std::uint16_t>(pixels.type);
    }
}

/// Decodes chunks one after the other.
class ChunkReader {
public:
    ChunkReader(const ExrFile& file, const ExrPixels& pixels, char* texels)
        : file_(file), pixels_(pixels), texels_(texels), decoder_(file) {}

    /// column, row  of the chunk's first pixel, from the first of the picture
    void read(const exr_chunk_info_t& chunk, std::int32_t column, std::int32_t row) {
        file_.check(is_first_ ? exr_decoding_initialize(file_, 0, &chunk, &decoder_.pipeline)
                              : exr_decoding_update(file_, 0, &chunk, &decoder_.pipeline));
        const std::ptrdiff_t pixel =
            component_bytes(pixels_.type) * static_cast<std::ptrdiff_t>(pixels_.channels.size());
        aim_channels(decoder_.pipeline, pixels_,
                     texels_ + row * pixels_.row_bytes() + column * pixel);
        if (is_first_)
            file_.check(exr_decoding_choose_default_routines(file_, 0, &decoder_.pipeline));
        file_.check(exr_decoding_run(file_, 0, &decoder_.pipeline));
        is_first_ = false;
    }

private:
    const ExrFile& file_;
    const ExrPixels& pixels_;
    char* texels_;
    Decoder decoder_;
    bool is_first_ = true;
};

}  // namespace

ExrFile::ExrFile(std::string_view input) : is_reading_(true) {
    stream_.input = input;
    exr_context_initializer_t setup = common_setup();
    setup.read_fn = read_input;
    setup.size_fn = size_of_input;
    setup.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    check(exr_start_read(&context_, "table.exr", &setup));
}

ExrFile::ExrFile() {
    exr_context_initializer_t setup = common_setup();
    setup.write_fn = write_output;
    check(exr_start_write(&context_, "table.exr", EXR_WRITE_FILE_DIRECTLY, &setup));
}

ExrFile::~ExrFile() {
    if (context_) exr_finish(&context_);
}

void ExrFile::check(exr_result_t result) const {
    if (result == EXR_ERR_SUCCESS) return;
    std::string words = stream_.message;
    if (words.empty()) words = exr_get_default_error_message(result);
    throw PictureError((is_reading_ ? "this OpenEXR file cannot be read: " : "OpenEXR: ") + words);
}

std::string ExrFile::finish() {
    check(exr_finish(&context_));
    return std::move(stream_.output);
}

exr_context_initializer_t ExrFile::common_setup() {
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = keep_message;
    setup.user_data = &stream_;
    return setup;
}

std::ptrdiff_t ExrPixels::row_bytes() const {
    return static_cast<std::ptrdiff_t>(channels.size()) * component_bytes(type) * width;
}

std::size_t ExrPixels::bytes() const {
    return static_cast<std::size_t>(row_bytes()) * static_cast<std::size_t>(height);
}

void set_chromaticities(const ExrFile& file, const RgbSpace& space) {
    const auto& [red, green, blue] = space.primaries;
    const double sum = space.white[0] + space.white[1] + space.white[2];
    const auto single = [](double value) { return static_cast<float>(value); };
    const exr_attr_chromaticities_t chromaticities{single(red.x),
                                                   single(red.y),
                                                   single(green.x),
                                                   single(green.y),
                                                   single(blue.x),
                                                   single(blue.y),
                                                   single(space.white[0] / sum),
                                                   single(space.white[1] / sum)};
    file.check(exr_attr_set_chromaticities(file, 0, "chromaticities", &chromaticities));
}

void write_rows(const ExrFile& file, const ExrPixels& pixels, const char* texels) {
    std::int32_t rows = 0;
    file.check(exr_get_scanlines_per_chunk(file, 0, &rows));
    Encoder encoder(file);
    for (std::int32_t y = 0; y < pixels.height; y += rows) {
        exr_chunk_info_t chunk{};
        file.check(exr_write_scanline_chunk_info(file, 0, y, &chunk));
        file.check(y == 0 ? exr_encoding_initialize(file, 0, &chunk, &encoder.pipeline)
                          : exr_encoding_update(file, 0, &chunk, &encoder.pipeline));
        aim_channels(encoder.pipeline, pixels, texels + y * pixels.row_bytes());
        if (y == 0) file.check(exr_encoding_choose_default_routines(file, 0, &encoder.pipeline));
        file.check(exr_encoding_run(file, 0, &encoder.pipeline));
    }
}

void read_rows(const ExrFile& file, const ExrPixels& pixels, char* texels) {
    exr_storage_t storage{};
    exr_attr_box2i_t window{};
    file.check(exr_get_storage(file, 0, &storage));
    file.check(exr_get_data_window(file, 0, &window));
    ChunkReader reader(file, pixels, texels);
    if (storage == EXR_STORAGE_SCANLINE) {
        std::int32_t rows = 0;
        file.check(exr_get_scanlines_per_chunk(file, 0, &rows));
        for (std::int32_t y = 0; y < pixels.height; y += rows) {
            exr_chunk_info_t chunk{};
            file.check(exr_read_scanline_chunk_info(file, 0, window.min.y + y, &chunk));
            reader.read(chunk, 0, y);
        }
    } else if (storage == EXR_STORAGE_TILED) {
        std::uint32_t width = 0, height = 0;
        exr_tile_level_mode_t levels{};
        exr_tile_round_mode_t rounding{};
        file.check(exr_get_tile_descriptor(file, 0, &width, &height, &levels, &rounding));
        const auto across = static_cast<std::int32_t>(width),
                   down = static_cast<std::int32_t>(height);
        for (std::int32_t row = 0; row * down < pixels.height; ++row)
            for (std::int32_t column = 0; column * across < pixels.width; ++column) {
                exr_chunk_info_t chunk{};
                file.check(exr_read_tile_chunk_info(file, 0, column, row, 0, 0, &chunk));
                reader.read(chunk, column * across, row * down);
            }
    } else {
        throw PictureError("this OpenEXR file cannot be read: deep images are not supported");
    }
}

}  // namespace irido::tables
