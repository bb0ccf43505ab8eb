// bin: raw numbers, for anything that can read memory (THREE.DataTexture, LoadRawTextureData).
// - Little-endian values of the table's type, with nothing before, between or after them.
// - In axis order, then channels: the channel varies fastest, then the last axis.
// - Mip levels follow each other, the largest first.
// - The metadata is in the companion FILE.bin.json.

#include "tables/lut/lut_metadata.hpp"
#include "tables/lut/lut_values.hpp"

namespace irido::tables {

namespace {

std::vector<LutFile> write(const Lut& lut, const LutLayout& layout) {
    check_plain(layout, "bin");
    check_values(lut);
    std::vector<LutFile> files;
    files.push_back(companion_of(lut));
    std::string bytes = value_bytes(lut);
    files.push_back({"", std::move(bytes)});
    return files;
}

Lut read(std::string_view bytes, std::string_view companion) {
    Lut lut = lut_from_companion(companion);
    const std::size_t expected = values_of(lut) * bytes_of(lut.type);
    if (bytes.size() != expected)
        throw LutError("the file has " + std::to_string(bytes.size()) +
                       " bytes, its metadata requires " + std::to_string(expected));
    lut.values = values_from_bytes(bytes, lut.type);
    return lut;
}

}  // namespace

extern const LutFormat lut_format_bin{
    .name = "bin",
    .summary = "raw little-endian values; metadata in FILE.bin.json",
    .write = write,
    .read = read,
};

}  // namespace irido::tables
