#include "tables/scratch/grid_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/math/degrees.hpp"
#include "tables/files/hash.hpp"
#include "tables/version.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kRecordNumbers = 8, kWord = 4;
constexpr float kEndless = 3e38F;

void append_word(std::string& bytes, std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<char>((word >> shift) & 0xffU));
}

std::uint32_t word_at(std::string_view bytes, std::size_t index) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < kWord; ++i)
        word |= std::uint32_t{static_cast<unsigned char>(bytes[index * kWord + i])} << (8 * i);
    return word;
}

float number_in(std::string_view bytes, std::size_t index) {
    return std::bit_cast<float>(word_at(bytes, index));
}

std::array<float, kRecordNumbers> record_of(const Scratch& scratch, SurfacePoint origin) {
    const auto single = [](double value) { return static_cast<float>(value); };
    const bool is_endless = scratch.is_infinite();
    return {single(scratch.point.x_um - origin.x_um),
            single(scratch.point.y_um - origin.y_um),
            single(cos_deg(scratch.angle_deg)),
            single(sin_deg(scratch.angle_deg)),
            is_endless ? -kEndless : single(scratch.start_um),
            is_endless ? kEndless : single(scratch.end_um),
            single(scratch.width_um),
            single(scratch.depth_um)};
}

/// A grid file whose sizes fit its header.
struct OpenGrid {
    std::string_view records, offsets, entries;
    std::uint32_t scratches = 0, columns = 0, rows = 0;
};

/// Every scratch must be in the cells in which its points are, a step of a quarter cell apart.
bool is_listed(const OpenGrid& grid, std::uint32_t scratch, double cell_um) {
    const auto number = [&](std::size_t i) {
        return static_cast<double>(number_in(grid.records, scratch * kRecordNumbers + i));
    };
    const double size = cell_um * static_cast<double>(grid.columns + grid.rows);
    const double middle = -(number(0) * number(2) + number(1) * number(3));
    const double start = std::max(number(4), middle - 2 * size),
                 end = std::min(number(5), middle + 2 * size);
    for (double along = start; along <= end; along += cell_um / 4) {
        const double column = std::floor((number(0) + along * number(2)) / cell_um),
                     row = std::floor((number(1) + along * number(3)) / cell_um);
        if (column < 0 || row < 0 || column >= grid.columns || row >= grid.rows) continue;
        const auto cell = static_cast<std::size_t>(row * grid.columns + column);
        const std::uint32_t first = word_at(grid.offsets, cell),
                            last = word_at(grid.offsets, cell + 1);
        bool found = false;
        for (std::uint32_t i = first; i < last && !found; ++i)
            found = word_at(grid.entries, i) == scratch;
        if (!found) return false;
    }
    return true;
}

}  // namespace

std::vector<Scratch> scratches_within(const ScratchedSurface& surface, const GridExtent& extent) {
    const SurfacePoint center{extent.origin.x_um + extent.width_um / 2,
                              extent.origin.y_um + extent.height_um / 2};
    return scratches_near(surface, center,
                          std::hypot(extent.width_um, extent.height_um) / 2 + extent.reach_um);
}

GridFile grid_file(std::span<const Scratch> scratches, const GridExtent& extent) {
    const ScratchGrid grid(scratches, extent.origin, extent.width_um, extent.height_um,
                           extent.cell_um, extent.reach_um);
    GridFile file;
    for (const Scratch& scratch : scratches)
        for (const float number : record_of(scratch, extent.origin))
            append_word(file.bytes, std::bit_cast<std::uint32_t>(number));
    const std::size_t offsets_at = file.bytes.size();
    for (const std::uint32_t offset : grid.offsets()) append_word(file.bytes, offset);
    const std::size_t entries_at = file.bytes.size();
    for (const std::uint32_t entry : grid.entries()) append_word(file.bytes, entry);
    file.header = {
        {"irido", this_build().version},
        {"kind", kGridKind},
        {"origin_um", {extent.origin.x_um, extent.origin.y_um}},
        {"columns", grid.columns()},
        {"rows", grid.rows()},
        {"cell_um", extent.cell_um},
        {"reach_um", extent.reach_um},
        {"records",
         {{"byte", 0},
          {"count", scratches.size()},
          {"type", "float32"},
          {"channels",
           {"x_um", "y_um", "tangent_x", "tangent_y", "start_um", "end_um", "width_um",
            "depth_um"}}}},
        {"offsets", {{"byte", offsets_at}, {"count", grid.offsets().size()}, {"type", "uint32"}}},
        {"entries", {{"byte", entries_at}, {"count", grid.entries().size()}, {"type", "uint32"}}},
        {"checksum", "sha256:" + sha256_of(file.bytes)}};
    return file;
}

std::vector<std::string> grid_problems(std::string_view bytes, const nlohmann::json& header) {
    OpenGrid grid;
    std::size_t offsets = 0, entries = 0;
    double cell_um = 0;
    try {
        grid.scratches = header.at("records").at("count").get<std::uint32_t>();
        grid.columns = header.at("columns").get<std::uint32_t>();
        grid.rows = header.at("rows").get<std::uint32_t>();
        offsets = header.at("offsets").at("count").get<std::size_t>();
        entries = header.at("entries").at("count").get<std::size_t>();
        cell_um = header.at("cell_um").get<double>();
        if (header.at("kind") != kGridKind) return {"the header is not that of a grid"};
    } catch (const nlohmann::json::exception&) {
        return {"the header lacks keys of a grid"};
    }
    const std::size_t records = std::size_t{grid.scratches} * kRecordNumbers;
    const std::size_t cells = std::size_t{grid.columns} * grid.rows;
    if (bytes.size() != kWord * (records + offsets + entries) || offsets != cells + 1)
        return {"the file has " + std::to_string(bytes.size()) + " bytes, its header requires " +
                std::to_string(kWord * (records + cells + 1 + entries))};
    if (header.value("checksum", "") != "sha256:" + sha256_of(bytes))
        return {"the checksum does not match"};
    grid.records = bytes.substr(0, kWord * records);
    grid.offsets = bytes.substr(kWord * records, kWord * offsets);
    grid.entries = bytes.substr(kWord * (records + offsets));
    if (word_at(grid.offsets, 0) != 0 || word_at(grid.offsets, cells) != entries)
        return {"the offsets must go from 0 to the number of entries"};
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::uint32_t first = word_at(grid.offsets, cell),
                            last = word_at(grid.offsets, cell + 1);
        if (first > last || last > entries)
            return {"the offsets must ascend (cell " + std::to_string(cell) + ")"};
        for (std::uint32_t i = first; i < last; ++i)
            if (word_at(grid.entries, i) >= grid.scratches ||
                (i > first && word_at(grid.entries, i) <= word_at(grid.entries, i - 1)))
                return {"the entries of cell " + std::to_string(cell) +
                        " must ascend and be below the number of scratches"};
    }
    for (std::uint32_t i = 0; i < grid.scratches; ++i)
        if (!is_listed(grid, i, cell_um))
            return {"scratch " + std::to_string(i) + " is missing in a cell that it crosses"};
    return {};
}

}  // namespace irido::tables
