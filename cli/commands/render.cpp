#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options/command.hpp"
#include "cli/options/long_work.hpp"
#include "cli/progress.hpp"
#include "cli/queries/other_documents.hpp"
#include "cli/queries/picture_query.hpp"
#include "cli/sweep/space.hpp"
#include "core/error.hpp"
#include "core/rough/ggx.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "schemas/documents/varied_stack.hpp"
#include "tables/pictures/glyphs.hpp"
#include "tables/pictures/png_file.hpp"
#include "tables/pictures/rendered.hpp"
#include "tables/version.hpp"

namespace irido::cli {

namespace {

constexpr std::size_t kMostSheetPictures = 1024;
constexpr std::string_view kRoughness = "alpha";  ///< the one varied value outside the stack

struct RenderCommand {
    schemas::StackRequest stack;
    PictureQueryOptions picture;
    std::vector<std::string> vary;
    OutputOptions output;
    std::string bits;
    unsigned threads = 0;
    bool stats = false, quiet = false;
};

enum class RenderFormat { png, exr };

RenderFormat render_format(const RenderCommand& command) {
    if (command.output.file.empty() && command.output.format.empty())
        throw UsageError("--output: must name a picture, .png or .exr, or be given with --format");
    const std::string name = resolved_format(command.output);
    if (name != "png" && name != "exr")
        throw UsageError(
            (command.output.format.empty() ? "--output: the extension " : "--format: ") +
            not_one_of(std::array<std::string_view, 2>{"png", "exr"}, name));
    if (!command.bits.empty() && name != "png") throw UsageError("--bits: requires .png");
    if (!command.bits.empty() && command.bits != "8" && command.bits != "16")
        throw UsageError("--bits: must be 8 or 16 (got '" + command.bits + "')");
    return name == "png" ? RenderFormat::png : RenderFormat::exr;
}

/// Fractions of several pictures as one, with the time that is left.
class RenderProgress {
public:
    RenderProgress(bool quiet, std::size_t pictures)
        : progress_(quiet), pictures_(static_cast<double>(pictures)) {}

    void set(std::size_t picture, double part) {
        constexpr double kSoonest = 0.02;
        const double done = (static_cast<double>(picture) + part) / pictures_;
        const double spent =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        progress_.set(done,
                      done < kSoonest ? "" : coarse_time(spent * (1 - done) / done) + " left");
    }
    void clear() { progress_.clear(); }

private:
    Progress progress_;
    double pictures_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

unsigned bits_of(const RenderCommand& command) {
    return command.bits == "16" ? 16 : 8;
}

std::string metadata_of_picture(const PictureQuery& query, nlohmann::json stack) {
    nlohmann::json metadata{{"irido", tables::this_build().version},
                            {"stack", std::move(stack)},
                            {"request", query.request()}};
    if (!tables::this_build().commit.empty()) metadata["commit"] = tables::this_build().commit;
    return metadata.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void print_stats(const RenderCommand& command, const PictureQuery& query,
                 const DrawnPicture& drawn) {
    if (!command.stats) return;
    for (const std::string& line : query.stats(drawn))
        std::cerr << "irido: stats: " << line << '\n';
}

int render_one(const RenderCommand& command, const PictureQuery& query,
               const schemas::StackSource& source, RenderFormat format) {
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    const schemas::StackDocument document = schemas::read_source(source);
    for (const std::string& text : document.notes) say(text);
    report_held_ranges(document, query.sensitivity(), false, say);
    RenderProgress progress(command.quiet, 1);
    const DrawnPicture drawn = query.draw(document, [&](double part) { progress.set(0, part); });
    progress.clear();
    const std::string metadata =
        metadata_of_picture(query, schemas::canonical_stack(document.stack));
    write_bytes(format == RenderFormat::exr ? tables::exr_file(drawn.picture, metadata)
                                            : tables::png_file(tables::pixels_of(drawn.picture),
                                                               bits_of(command), 0, metadata),
                command.output, true);
    if (const std::string text = PictureQuery::caution(drawn); !text.empty()) say(text);
    print_stats(command, query, drawn);
    return 0;
}

// --- contact sheets ---------------------------------------------------------------------------

/// Where the pictures of a sheet stand: the last varied value along rows, or as square as can be
/// where there is only one.
struct SheetLayout {
    static constexpr std::size_t kGap = 8, kLabel = 22;

    SheetLayout(const SweepSpace& space, const Camera& camera)
        : width(camera.width), height(camera.height) {
        const auto count = static_cast<std::size_t>(space.size());
        const auto& columns_varied = space.columns();
        columns = columns_varied.size() > 1
                      ? columns_varied.back().size()
                      : static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
        rows = (count + columns - 1) / columns;
    }
    std::size_t left(std::size_t i) const { return kGap + i % columns * (width + kGap); }
    std::size_t top(std::size_t i) const { return kGap + i / columns * (height + kLabel + kGap); }
    std::size_t total_width() const { return kGap + columns * (width + kGap); }
    std::size_t total_height() const { return kGap + rows * (height + kLabel + kGap); }

    std::size_t width, height, columns = 1, rows = 1;
};

/// "thickness_nm=100" of "layers.0.thickness_nm=100", as much as the room for it has.
std::string sheet_label(const SweepSpace& space, std::size_t i, double room) {
    constexpr double kSmallest = 11;
    const auto text_of = [&](bool with_names) {
        std::string text;
        for (std::size_t c = 0; c < space.columns().size(); ++c) {
            const SweptColumn& column = space.columns()[c];
            const std::string value = column.text(space.at(c, i));
            const std::string name = column.path.substr(column.path.find_last_of('.') + 1);
            text += (text.empty() ? "" : ", ") + (with_names ? name + " " + value : value);
        }
        return text;
    };
    const std::string whole = text_of(true);
    return tables::text_width(whole, kSmallest) <= room ? whole : text_of(false);
}

/// The sheet's ground with the labels of all pictures.
tables::Pixels labelled_ground(const SweepSpace& space, const SheetLayout& layout) {
    constexpr double kSize = 11, kBaseline = 15;
    tables::Drawing drawing;
    drawing.width = static_cast<double>(layout.total_width());
    drawing.height = static_cast<double>(layout.total_height());
    tables::DrawnGroup labels{.name = "labels"};
    for (std::size_t i = 0; i < space.size(); ++i) {
        const auto room = static_cast<double>(layout.width + SheetLayout::kGap / 2);
        labels.items.emplace_back(tables::Text{
            .at = {static_cast<double>(layout.left(i)) + static_cast<double>(layout.width) / 2,
                   static_cast<double>(layout.top(i) + layout.height) + kBaseline},
            .text = sheet_label(space, i, room),
            .anchor = tables::Anchor::middle,
            .size = kSize,
            .ink = tables::ink(0x222222)});
    }
    drawing.groups.push_back(std::move(labels));
    return tables::rasterized(drawing, 1);
}

int render_sheet(const RenderCommand& command, const PictureQuery& query,
                 const schemas::StackSource& source, const SweepSpace& space) {
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    std::vector<std::string> paths;
    for (const SweptColumn& column : space.columns())
        if (column.path != kRoughness) paths.push_back(column.path);
    const schemas::VariedStack varied(source, paths);
    const SheetLayout layout(space, query.scene().camera);
    constexpr std::size_t kMostSide = 16384;
    if (std::max(layout.total_width(), layout.total_height()) > kMostSide)
        throw UsageError("--vary: the sheet would be " + std::to_string(layout.total_width()) +
                         " x " + std::to_string(layout.total_height()) +
                         " pixels, at most 16384 a side are drawn");
    const auto count = static_cast<std::size_t>(space.size());
    std::vector<schemas::StackDocument> documents;
    std::vector<std::optional<double>> alphas(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<nlohmann::json> values;
        for (std::size_t c = 0; c < space.columns().size(); ++c) {
            nlohmann::json value = space.columns()[c].value(space.at(c, i));
            if (space.columns()[c].path == kRoughness)
                alphas[i] = value.get<double>();
            else
                values.push_back(std::move(value));
        }
        documents.push_back(varied.document(values));
    }
    for (const std::string& text : documents.front().notes) say(text);
    report_held_ranges(documents.front(), query.sensitivity(), false, say);
    tables::Pixels sheet = labelled_ground(space, layout);
    RenderProgress progress(command.quiet, count);
    constexpr Triple kWhite{1, 1, 1};
    for (std::size_t i = 0; i < count; ++i) {
        const DrawnPicture drawn = query.draw(
            documents[i], [&](double part) { progress.set(i, part); }, alphas[i]);
        const tables::Pixels pixels = tables::pixels_over(drawn.picture, kWhite);
        for (std::size_t y = 0; y < layout.height; ++y)
            std::copy_n(&pixels.inks[y * layout.width], layout.width,
                        &sheet.inks[(layout.top(i) + y) * sheet.width + layout.left(i)]);
        if (i == 0) {
            progress.clear();
            print_stats(command, query, drawn);
        }
    }
    progress.clear();
    nlohmann::json stack = schemas::canonical_stack(documents.front().stack);
    write_bytes(
        tables::png_file(sheet, bits_of(command), 0, metadata_of_picture(query, std::move(stack))),
        command.output, true);
    return 0;
}

/// Throws UsageError for values that pictures cannot vary.
void check_column(const SweptColumn& column, ShapeKind shape) {
    if (column.is_light())
        throw UsageError("--vary: " + column.path + " is not a value of the stack");
    if (column.path != kRoughness) return;
    if (!is_simple(shape)) throw UsageError("--vary alpha: only spheres and planes can be rough");
    if (column.is_text()) throw UsageError("--vary alpha: must be numbers");
    for (const double alpha : column.numbers)
        if (!(alpha >= kSmoothest && alpha <= kRoughest))
            throw UsageError("--vary alpha: must be in [0.0001, 1] (got " + to_text(alpha) + ")");
}

int run_render(const RenderCommand& command) {
    const RenderFormat format = render_format(command);
    const bool is_sheet = !command.vary.empty();
    const PictureQuery query(command.picture, execution_of(command.threads), is_sheet ? 192 : 512);
    const schemas::StackSource source = schemas::load_stack(command.stack);
    refuse_other_documents(source, "drawn");
    check_writable(command.output);
    if (!is_sheet) return render_one(command, query, source, format);
    if (format != RenderFormat::png) throw UsageError("--vary: a contact sheet must be .png");
    const SweepSpace space(command.vary, "");
    for (const SweptColumn& column : space.columns()) check_column(column, query.scene().shape);
    if (space.size() > kMostSheetPictures)
        throw UsageError("--vary: must be at most " + std::to_string(kMostSheetPictures) +
                         " pictures (got " + std::to_string(space.size()) + ")");
    return render_sheet(command, query, source, space);
}

}  // namespace

void add_render_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "render", "Pictures of a stack on a shape, and contact sheets of many.");
    const auto options = std::make_shared<RenderCommand>();
    add_stack_options(*command, options->stack);
    options->picture.add(*command);
    command
        ->add_option("--vary", options->vary,
                     "draw a picture for every value of a number of the stack, by dotted path,\n"
                     "and make a labelled sheet of them; repeatable, the last changes fastest:\n"
                     "layers.0.thickness_nm=100:700/6; alpha is the roughness")
        ->type_name("PATH=LIST")
        ->allow_extra_args(false);
    add_output_options(*command, options->output, "png or exr");
    command->add_option("--bits", options->bits, "bits of a component of .png: 8 or 16 [8]")
        ->type_name("N");
    offer(*command, "bits", "8 16");
    command->add_flag("--stats", options->stats,
                      "print on standard error how the colours were computed, and why");
    add_threads_option(*command, options->threads);
    command->add_flag("--quiet", options->quiet, "no notes and no progress on standard error");
    set_examples(
        *command,
        {"irido render \"air | 1.33@400 | air\" --shape bubble --thickness-noise 100:800,3,1 "
         "-o bubble.png",
         "irido render \"air | TiO2@60 | Ti\" --environment white -o sphere.exr",
         "irido render \"air | 1.38@100 | 1.9+1.5i\" --vary layers.0.thickness_nm=100:700/6 "
         "--vary alpha=0.05,0.1,0.2 -o sheet.png"},
        "PNG is sRGB; EXR is linear, single precision, with alpha multiplied in. A pixel is the\n"
        "colour of irido color (D65, 2 degrees, Bradford) times the light that it mirrors. The\n"
        "sphere, of radius 0.9 times half of the smaller side, is seen by parallel rays: at the\n"
        "distance r from its centre the angle is asin(r/R). Walls of a bubble, and a ring that\n"
        "mirrors itself, are multiplied wavelength by wavelength. Pictures do not depend on -j.");
    command->callback([options, &run] { run = [options] { return run_render(*options); }; });
}

}  // namespace irido::cli
