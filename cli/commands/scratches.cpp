#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "cli/exit_status.hpp"
#include "cli/options/command.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/surface_options.hpp"
#include "core/math/constants.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/scratch/grid_file.hpp"

namespace irido::cli {

namespace {

constexpr double kLargestExtent_um = 1e6, kReachInRadii = 6;

struct ScratchesCommand {
    SurfaceOptions surface;
    std::string extent = "1000,1000", origin = "0,0", reach, grid, cell = "100";
    OutputOptions output;
    bool quiet = false;
};

std::array<double, 2> parse_two(const char* option, const std::string& text, double lowest) {
    const std::vector<std::string_view> parts = comma_separated(text);
    if (parts.size() != 2)
        throw UsageError(std::string(option) + ": must be two numbers in um (got '" + text + "')");
    return {parse_one_number(option, std::string(parts[0]), lowest, kLargestExtent_um),
            parse_one_number(option, std::string(parts[1]), lowest, kLargestExtent_um)};
}

tables::Records records_of(const std::vector<Scratch>& scratches) {
    constexpr std::array names{"x_um",   "y_um",     "angle_deg", "start_um",
                               "end_um", "width_um", "depth_um"};
    std::array<tables::Column::Numbers, names.size()> columns;
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const Scratch& scratch : scratches) {
        const bool is_endless = scratch.is_infinite();
        const std::array<double, names.size()> row{scratch.point.x_um,
                                                   scratch.point.y_um,
                                                   scratch.angle_deg,
                                                   is_endless ? none : scratch.start_um,
                                                   is_endless ? none : scratch.end_um,
                                                   scratch.width_um,
                                                   scratch.depth_um};
        for (std::size_t c = 0; c < row.size(); ++c) columns[c].push_back(row[c]);
    }
    tables::Records records;
    for (std::size_t c = 0; c < names.size(); ++c)
        records.columns.push_back({names[c], std::move(columns[c])});
    return records;
}

/// The ends of a scratch's part in a rectangle; nothing if it lies outside.
std::optional<std::array<tables::Point, 2>> part_within(const Scratch& scratch,
                                                        const tables::GridExtent& extent) {
    const std::array from{scratch.point.x_um, scratch.point.y_um},
        along{std::cos(scratch.angle_deg * kDegree), std::sin(scratch.angle_deg * kDegree)},
        low{extent.origin.x_um, extent.origin.y_um},
        high{low[0] + extent.width_um, low[1] + extent.height_um};
    double start = scratch.start_um, end = scratch.end_um;
    for (std::size_t i = 0; i < 2; ++i) {
        if (along[i] == 0) {
            if (from[i] < low[i] || from[i] > high[i]) return std::nullopt;
            continue;
        }
        const auto [first, last] =
            std::minmax({(low[i] - from[i]) / along[i], (high[i] - from[i]) / along[i]});
        start = std::max(start, first);
        end = std::min(end, last);
    }
    if (!(start < end)) return std::nullopt;
    const auto at = [&](double s) {
        return tables::Point{std::clamp(from[0] + s * along[0], low[0], high[0]),
                             std::clamp(from[1] + s * along[1], low[1], high[1])};
    };
    return std::array{at(start), at(end)};
}

/// The scratches as lines in the rectangle, without those that only reach it by their width.
tables::Figure figure_of(const std::vector<Scratch>& scratches, const tables::GridExtent& extent,
                         const std::string& title) {
    constexpr std::size_t kMostLines = 100000;
    tables::Panel panel{.x = {.quantity = "x",
                              .unit = "\u00b5m",
                              .first = extent.origin.x_um,
                              .last = extent.origin.x_um + extent.width_um},
                        .y = {.quantity = "y",
                              .unit = "\u00b5m",
                              .first = extent.origin.y_um,
                              .last = extent.origin.y_um + extent.height_um}};
    for (const Scratch& scratch : scratches)
        if (const auto part = part_within(scratch, extent))
            panel.series.push_back({.points = {part->begin(), part->end()}});
    const std::size_t lines = panel.series.size();
    if (lines == 0) throw tables::PictureError("no scratch lies in the rectangle");
    if (lines > kMostLines)
        throw tables::PictureError("too many scratches for one picture: " + std::to_string(lines) +
                                   ", at most " + std::to_string(kMostLines));
    tables::Figure figure{.title = title};
    figure.subtitle = std::to_string(lines) + (lines == 1 ? " scratch" : " scratches");
    const double aspect = extent.height_um / extent.width_um;
    figure.equal_units = aspect > 0.1 && aspect < 4;  // a narrow strip is stretched
    figure.panels.push_back(std::move(panel));
    return figure;
}

/// Refuses names that say another format than that of grids.
void require_binary_name(const std::string& file) {
    constexpr std::array<std::string_view, 11> others{
        ".csv", ".json", ".npy", ".h5", ".txt", ".svg", ".png", ".pdf", ".exr", ".ktx2", ".tsv"};
    const std::string ending = std::filesystem::path(file).extension().string();
    if (std::ranges::find(others, ending) != others.end())
        throw UsageError("--grid: a grid is binary; name it otherwise than " + ending +
                         ", such as grid.bin (got '" + file + "')");
}

int run_scratches(const ScratchesCommand& command) {
    const tables::PictureFormat* const picture = asked_picture(command.output);
    if (!picture) resolved_record_format(command.output, RecordTarget::stream_or_picture);
    const auto extent_um = parse_two("--extent", command.extent, 1e-3);
    const auto origin_um = parse_two("--origin", command.origin, -kLargestExtent_um);
    const schemas::SurfaceDocument document = read_noted_surface(command.surface, command.quiet);
    const auto* const surface = std::get_if<ScratchedSurface>(&document.surface);
    if (!surface) throw schemas::InputError(document.file, "", "must be a surface with scratches");
    tables::GridExtent extent{{origin_um[0], origin_um[1]}, extent_um[0], extent_um[1]};
    extent.reach_um = command.reach.empty()
                          ? kReachInRadii * surface->optics.coherence_radius_um
                          : parse_one_number("--reach", command.reach, 1e-3, kLargestExtent_um);
    extent.cell_um = parse_one_number("--cell", command.cell, 1e-3, kLargestExtent_um);
    check_writable(command.output);
    try {
        const std::vector<Scratch> scratches = tables::scratches_within(*surface, extent);
        if (command.grid.empty() && picture) {
            const std::string title = title_of(document, command.surface);
            write_picture([&] { return figure_of(scratches, extent, title); }, {}, *picture,
                          command.output);
            return 0;
        }
        if (command.grid.empty()) {
            write_records(records_of(scratches), command.output);
            return 0;
        }
        if (!command.output.file.empty())
            throw UsageError("--grid: cannot be combined with --output");
        if (command.grid == "-") throw UsageError("--grid: must name a file");
        require_binary_name(command.grid);
        tables::check_outputs({command.grid + ".json", command.grid});
        const tables::GridFile file = tables::grid_file(scratches, extent);
        tables::write_file(command.grid + ".json", file.header.dump(2) + "\n");
        tables::write_file(command.grid, file.bytes);
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
    return 0;
}

int check_grids(const std::vector<std::string>& files) {
    int status = 0;
    std::string out;
    for (const std::string& file : files) {
        const auto header = schemas::parse_json(schemas::read_text(file + ".json"), file + ".json");
        const auto problems = tables::grid_problems(schemas::read_bytes(file), header);
        if (problems.empty()) out += escaped(file) + ": ok\n";
        for (const std::string& problem : problems)
            out += message_line(file + ": " + problem) + "\n";
        if (!problems.empty()) status = kCheckFailed;
    }
    tables::write_stdout(out);
    return status;
}

}  // namespace

void add_scratches_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "scratches",
        "The scratches of a surface in a rectangle, as rows or as a grid for engines.");
    const auto options = std::make_shared<ScratchesCommand>();
    const auto checked = std::make_shared<std::vector<std::string>>();
    add_surface_options(*command, options->surface);
    command->get_option("SURFACE")->required(false)->description(
        "surface file with scratches (.json; see irido validate --schema surface),\n"
        "or - for standard input");
    command->remove_option(command->get_option("--alpha"));
    options->surface.takes_stacks = false;
    command->get_option("--set")->description(
        "override a value of the document by dotted path; repeatable:\n"
        "--set seed=2 --set fields.0.count_per_mm2=80");
    command
        ->add_option("--extent", options->extent,
                     "width and height of the rectangle, um, [0.001, 1e6] [1000,1000]")
        ->type_name("W,H");
    command->add_option("--origin", options->origin, "its lower left corner, um [0,0]")
        ->type_name("X,Y");
    command
        ->add_option("--reach", options->reach,
                     "how far outside scratches still count, um [6 coherence radii]")
        ->type_name("R");
    command
        ->add_option("--grid", options->grid,
                     "write FILE, buffers of all scratches and of those near every cell, and\n"
                     "FILE.json, which says where they begin, instead of rows")
        ->type_name("FILE");
    command->add_option("--cell", options->cell, "side of a cell of the grid, um [100]")
        ->type_name("C");
    command
        ->add_option("--check", *checked,
                     "verify grid files: sizes, checksum, order, and that no scratch is missing")
        ->type_name("FILE");
    add_output_options(*command, options->output,
                       record_formats_text(RecordTarget::stream_or_picture));

    add_quiet_option(*command, options->quiet);
    set_examples(
        *command,
        {"irido scratches schemas/examples/surfaces/worn-spoon.json --extent 500,500",
         "irido scratches schemas/examples/surfaces/worn-spoon.json --extent 4000,4000 "
         "--grid spoon.bin",
         "irido scratches schemas/examples/surfaces/worn-spoon.json -o spoon.svg",
         "irido scratches --check spoon.bin"},
        "Fields are endless: every extent sees the same scratches. The grid's buffers are\n"
        "little-endian: records (float32 x 8: place from the origin, tangent, start, end,\n"
        "width, depth), offsets (uint32, cells + 1) and entries (uint32): the scratches of\n"
        "a cell are records[entries[offsets[cell]]] up to offsets[cell + 1].");
    command->callback([options, checked, &run] {
        if (!checked->empty())
            run = [checked] { return check_grids(*checked); };
        else if (options->surface.source.stack.empty())
            throw UsageError("scratches: SURFACE is required (see irido scratches --help)");
        else
            run = [options] { return run_scratches(*options); };
    });
}

}  // namespace irido::cli
