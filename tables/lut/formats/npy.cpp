// npy: NumPy's array format 1.0, for numpy.load, Mitsuba's tensors and twenty lines of JavaScript.
// - One plain array of '<f2', '<f4' or '<f8', C order. Its shape is that of the axes, slowest
// first,
//   then the channels; a single channel gets no axis.
// - Tables with mip levels are refused.
// - The metadata is in the companion FILE.npy.json.
// - Only headers that are byte-identical to NumPy's for the table can be read back.
// Source: NumPy documentation, numpy.lib.format.

#include "tables/records/npy.hpp"

#include "tables/lut/lut_metadata.hpp"
#include "tables/lut/lut_values.hpp"

namespace irido::tables {

namespace {

std::string header(const Lut& lut) {
    const std::string type = "'<f" + std::to_string(bytes_of(lut.type)) + "'";
    std::vector<std::size_t> shape;
    for (const LutAxis& axis : lut.axes) shape.push_back(axis.count());
    if (lut.channels.size() > 1) shape.push_back(lut.channels.size());
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
    return npy_header(type, text + (shape.size() == 1 ? ",)" : ")"));
}

std::vector<LutFile> write(const Lut& lut, const LutLayout& layout) {
    check_plain(layout, "npy");
    if (lut.mips) throw LutError("npy has no mip levels; only ktx2, bin and csv do");
    check_values(lut);
    std::vector<LutFile> files;
    files.push_back(companion_of(lut));
    std::string bytes = header(lut) + value_bytes(lut);
    files.push_back({"", std::move(bytes)});
    return files;
}

Lut read(std::string_view bytes, std::string_view companion) {
    Lut lut = lut_from_companion(companion);
    if (lut.mips) throw LutError("metadata: npy has no mip levels");
    const std::string start = header(lut);
    if (!bytes.starts_with(start))
        throw LutError("the NumPy header does not match the metadata: the first " +
                       std::to_string(start.size()) + " bytes differ");
    bytes.remove_prefix(start.size());
    const std::size_t expected = values_of(lut) * bytes_of(lut.type);
    if (bytes.size() != expected)
        throw LutError("the array has " + std::to_string(bytes.size()) +
                       " bytes, its metadata requires " + std::to_string(expected));
    lut.values = values_from_bytes(bytes, lut.type);
    return lut;
}

}  // namespace

extern const LutFormat lut_format_npy{
    .name = "npy",
    .summary = "NumPy array, axes then channels; metadata in FILE.npy.json",
    .write = write,
    .read = read,
};

}  // namespace irido::tables
