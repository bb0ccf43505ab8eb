#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <variant>

#include "cli/exit_status.hpp"
#include "cli/options/command.hpp"
#include "cli/options/long_work.hpp"
#include "cli/progress.hpp"
#include "cli/queries/picture_query.hpp"
#include "cli/sweep/space.hpp"
#include "core/error.hpp"
#include "core/rough/ggx.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "schemas/documents/document_kind.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/scene_document.hpp"
#include "schemas/documents/varied_stack.hpp"
#include "schemas/input_error.hpp"
#include "tables/pictures/glyphs.hpp"
#include "tables/pictures/png_file.hpp"
#include "tables/pictures/rendered.hpp"
#include "tables/version.hpp"

namespace irido::cli {

namespace {

constexpr std::size_t kMostSheetPictures = 1024;
constexpr std::string_view kRoughness = "alpha";  ///< varied, but not in the stack

struct RenderCommand {
    schemas::StackRequest stack;
    PictureQueryOptions picture;
    std::vector<std::string> vary;
    std::string show;  ///< a material of a scene, "" for all
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

/// Combines the progress of several pictures, with the remaining time.
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

std::string metadata_of_picture(const PictureQuery& query, nlohmann::json shown) {
    nlohmann::json metadata{{"irido", tables::this_build().version},
                            {"stack", std::move(shown)},
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

/// What one picture shows: a surface, or a stack and its roughness if that is not the one typed.
struct Shown {
    std::variant<schemas::StackDocument, schemas::SurfaceDocument> document;
    std::optional<double> alpha{};
    std::string label{};                               ///< in a sheet
    nlohmann::json written;                            ///< for the metadata
    const schemas::SceneMaterial* material = nullptr;  ///< of a scene
};

Shown shown_stack(schemas::StackDocument document, std::optional<double> alpha = {}) {
    nlohmann::json written = schemas::canonical_stack(document.stack);
    return {std::move(document), alpha, "", std::move(written)};
}

Shown shown_surface(const schemas::StackSource& source) {
    return {schemas::read_surface(source.document, source.file, source.folder),
            {},
            "",
            source.document};
}

/// What is to be said of a document before it is drawn.
void note_document(const RenderCommand& command, const PictureQuery& query, const Shown& shown,
                   Notes& notes) {
    const auto say = [&](const std::string& text) { notes(text); };
    const auto held = [&](schemas::StackDocument document) {
        report_held_ranges(document, query.sensitivity(), command.picture.light.strict, say);
    };
    if (const auto* const stack = std::get_if<schemas::StackDocument>(&shown.document)) {
        for (const std::string& text : stack->notes) say(text);
        return held(*stack);
    }
    const auto& surface = std::get<schemas::SurfaceDocument>(shown.document);
    for (const std::string& text : surface.notes) say(text);
    const auto part = [&](const Stack& stack, const std::string& pointer) {
        schemas::StackDocument document;
        document.stack = stack;
        document.file = surface.file;
        document.material_pointers.assign(stack.materials.size(), pointer);
        held(std::move(document));
    };
    if (const auto* const layered = std::get_if<LayeredSurface>(&surface.surface)) {
        for (std::size_t l = 0; l < layered->layers.size(); ++l)
            part(layered->layers[l].stack, "/layers/" + std::to_string(l) + "/stack");
    } else if (const auto& base = std::get<ScratchedSurface>(surface.surface).base) {
        part(*base, "/base");
    }
}

DrawnPicture draw_shown(const PictureQuery& query, const Shown& shown,
                        const std::function<void(double)>& progress) {
    if (const auto* const stack = std::get_if<schemas::StackDocument>(&shown.document))
        return query.draw(*stack, progress, shown.alpha);
    return query.draw(std::get<schemas::SurfaceDocument>(shown.document), progress);
}

int render_one(const RenderCommand& command, const PictureQuery& query, const Shown& shown,
               RenderFormat format) {
    Notes notes(command.quiet);
    note_document(command, query, shown, notes);
    RenderProgress progress(command.quiet, 1);
    const DrawnPicture drawn =
        draw_shown(query, shown, [&](double part) { progress.set(0, part); });
    progress.clear();
    const std::string metadata = metadata_of_picture(query, shown.written);
    write_bytes(format == RenderFormat::exr ? tables::exr_file(drawn.picture, metadata)
                                            : tables::png_file(tables::pixels_of(drawn.picture),
                                                               bits_of(command), 0, metadata),
                command.output, true);
    if (const std::string text = PictureQuery::caution(drawn); !text.empty())
        note(text, command.quiet);
    print_stats(command, query, drawn);
    return 0;
}

// --- contact sheets ---------------------------------------------------------------------------

/// Where the pictures of a sheet stand.
struct SheetLayout {
    static constexpr std::size_t kGap = 8, kLabel = 22;

    SheetLayout(std::size_t count, std::size_t in_a_row, const Camera& camera)
        : width(camera.width), height(camera.height), columns(in_a_row) {
        rows = (count + columns - 1) / columns;
    }
    std::size_t left(std::size_t i) const { return kGap + i % columns * (width + kGap); }
    std::size_t top(std::size_t i) const { return kGap + i / columns * (height + kLabel + kGap); }
    std::size_t total_width() const { return kGap + columns * (width + kGap); }
    std::size_t total_height() const { return kGap + rows * (height + kLabel + kGap); }

    std::size_t width, height, columns = 1, rows = 1;
};

/// As square as can be.
std::size_t square_columns(std::size_t count) {
    return static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
}

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
tables::Pixels labelled_ground(const std::vector<Shown>& all, const SheetLayout& layout) {
    constexpr double kSize = 11, kBaseline = 15;
    tables::Drawing drawing;
    drawing.width = static_cast<double>(layout.total_width());
    drawing.height = static_cast<double>(layout.total_height());
    tables::DrawnGroup labels{.name = "labels"};
    for (std::size_t i = 0; i < all.size(); ++i)
        labels.items.emplace_back(tables::Text{
            .at = {static_cast<double>(layout.left(i)) + static_cast<double>(layout.width) / 2,
                   static_cast<double>(layout.top(i) + layout.height) + kBaseline},
            .text = all[i].label,
            .anchor = tables::Anchor::middle,
            .size = kSize,
            .ink = tables::ink(0x222222)});
    drawing.groups.push_back(std::move(labels));
    return tables::rasterized(drawing, 1);
}

void require_room(const SheetLayout& layout) {
    constexpr std::size_t kMostSide = 16384;
    if (std::max(layout.total_width(), layout.total_height()) > kMostSide)
        throw UsageError("the sheet would be " + std::to_string(layout.total_width()) + " x " +
                         std::to_string(layout.total_height()) +
                         " pixels, at most 16384 a side are drawn");
}

/// Draws the pictures of a sheet. Where `left_out` is given, one that cannot be drawn leaves `all`,
/// and its error is passed there.
std::vector<tables::Pixels> draw_all(
    const RenderCommand& command, const PictureQuery& query, std::vector<Shown>& all,
    const std::function<void(const Shown&, const schemas::InputError&)>& left_out) {
    constexpr Triple kWhite{1, 1, 1};
    const std::size_t count = all.size();
    RenderProgress progress(command.quiet, count);
    std::vector<tables::Pixels> pictures;
    std::vector<Shown> kept;
    Notes notes(command.quiet);
    for (std::size_t i = 0; i < count; ++i) {
        try {
            const bool is_new = pictures.empty() || all[i].material;  // not a varied value
            if (is_new) note_document(command, query, all[i], notes);
            const DrawnPicture drawn =
                draw_shown(query, all[i], [&](double part) { progress.set(i, part); });
            pictures.push_back(tables::pixels_over(drawn.picture, kWhite));
            kept.push_back(std::move(all[i]));
            if (pictures.size() > 1) continue;
            progress.clear();
            print_stats(command, query, drawn);
        } catch (const schemas::InputError& error) {
            if (!left_out) throw;
            progress.clear();
            left_out(all[i], error);
        }
    }
    progress.clear();
    all = std::move(kept);
    return pictures;
}

void write_sheet(const RenderCommand& command, const PictureQuery& query,
                 const std::vector<Shown>& all, std::span<const tables::Pixels> pictures,
                 const SheetLayout& layout) {
    tables::Pixels sheet = labelled_ground(all, layout);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t y = 0; y < layout.height; ++y)
            std::copy_n(&pictures[i].inks[y * layout.width], layout.width,
                        &sheet.inks[(layout.top(i) + y) * sheet.width + layout.left(i)]);
    write_bytes(tables::png_file(sheet, bits_of(command), 0,
                                 metadata_of_picture(query, all.front().written)),
                command.output, true);
}

/// A picture for every combination of the varied values.
std::vector<Shown> varied_pictures(const schemas::StackSource& source, const SweepSpace& space,
                                   std::size_t width) {
    const bool is_surface = schemas::kind_of(source.document) == schemas::DocumentKind::surface;
    std::vector<std::string> paths;
    for (const SweptColumn& column : space.columns())
        if (column.path != kRoughness) paths.push_back(column.path);
    std::optional<schemas::VariedStack> varied;
    if (!is_surface) varied.emplace(source, paths);
    std::vector<Shown> all;
    for (std::size_t i = 0; i < static_cast<std::size_t>(space.size()); ++i) {
        std::vector<nlohmann::json> values;
        std::optional<double> alpha;
        schemas::StackSource other = source;
        for (std::size_t c = 0; c < space.columns().size(); ++c) {
            const SweptColumn& column = space.columns()[c];
            nlohmann::json value = column.value(space.at(c, i));
            if (column.path == kRoughness)
                alpha = value.get<double>();
            else if (is_surface)
                schemas::set_value(other.document, column.path, std::move(value));
            else
                values.push_back(std::move(value));
        }
        all.push_back(is_surface ? shown_surface(other)
                                 : shown_stack(varied->document(values), alpha));
        all.back().label =
            sheet_label(space, i, static_cast<double>(width + SheetLayout::kGap / 2));
    }
    return all;
}

// --- scenes -----------------------------------------------------------------------------------

using SceneFaults = std::vector<std::string>;

std::string fault_of_picture(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                             const schemas::InputError& error) {
    const schemas::SceneFault fault =
        material.scratches ? schemas::SceneFault{material.pointer + "/surface", error.message}
                           : schemas::fault_of(material, error);
    return schemas::fault_text(scene, material.name, fault);
}

/// Each material of a scene that has no faults, or the one that is asked for.
std::vector<Shown> scene_pictures(const RenderCommand& command, const schemas::Scene& scene,
                                  const nlohmann::json& document, SceneFaults& faults) {
    std::vector<Shown> all;
    std::vector<std::string_view> names;
    for (const schemas::SceneMaterial& material : scene.materials) {
        names.push_back(material.name);
        if (!command.show.empty() && command.show != material.name) continue;
        if (!material.faults.empty()) {
            faults.push_back(schemas::fault_text(scene, material.name, material.faults.front()));
            continue;
        }
        std::optional<double> alpha;
        if (material.is_rough) alpha = (material.alpha.first + material.alpha.last) / 2;
        if (material.scratches)
            all.push_back({schemas::SurfaceDocument{
                               material.scratches->surface, scene.file, material.name, {}},
                           {},
                           "",
                           document.at(nlohmann::json::json_pointer(material.pointer))});
        else
            all.push_back(shown_stack(material.document, alpha));
        all.back().label = material.name;
        all.back().material = &material;
    }
    if (all.empty() && faults.empty())
        throw UsageError("--show: " + not_one_of(names, command.show));
    return all;
}

int render_scene(const RenderCommand& command, const schemas::StackSource& source,
                 RenderFormat format) {
    const schemas::Scene scene = schemas::read_scene(source.document, source.file, source.folder);
    if (!command.vary.empty()) throw UsageError("--vary: takes a stack or a surface, not a scene");
    SceneFaults faults;
    std::vector<Shown> all = scene_pictures(command, scene, source.document, faults);
    PictureQueryOptions typed = command.picture;
    if (typed.light.illuminant == ColorOptions{}.illuminant)
        typed.light.illuminant = scene.illuminant;
    if (typed.light.observer == ColorOptions{}.observer)
        typed.light.observer = std::to_string(scene.observer_deg);
    const std::size_t count = all.size() + faults.size();
    const bool is_sheet = count > 1;
    const PictureQuery query(typed, execution_of(command.threads), is_sheet ? 192 : 512);
    check_writable(command.output);
    if (all.empty()) throw schemas::InputError("", "", faults.front());
    if (!is_sheet) {
        try {
            return render_one(command, query, all.front(), format);
        } catch (const schemas::InputError& error) {
            throw schemas::InputError("", "",
                                      fault_of_picture(scene, *all.front().material, error));
        }
    }
    if (format != RenderFormat::png)
        throw UsageError(
            "--output: a scene of several materials makes a contact sheet, .png; "
            "--show MATERIAL draws one");
    const auto layout = [&] {
        return SheetLayout(all.size(), square_columns(all.size()), query.scene().camera);
    };
    require_room(layout());
    const std::vector<tables::Pixels> pictures =
        draw_all(command, query, all, [&](const Shown& shown, const schemas::InputError& error) {
            faults.push_back(fault_of_picture(scene, *shown.material, error));
        });
    if (all.empty()) throw schemas::InputError("", "", faults.front());
    write_sheet(command, query, all, pictures, layout());
    for (const std::string& fault : faults) print_error(fault);
    if (faults.empty()) return 0;
    print_error(scene.file + ": " + std::to_string(faults.size()) + " of " + std::to_string(count) +
                " materials left out");
    return kCheckFailed;
}

/// Throws UsageError for values that pictures cannot vary.
void check_column(const SweptColumn& column, ShapeKind shape, bool is_surface) {
    if (column.is_light())
        throw UsageError("--vary: " + column.path + " is not a value of the stack");
    if (column.path != kRoughness) return;
    if (is_surface)
        throw UsageError("--vary alpha: a surface document has its own, such as layers.0.alpha");
    if (!is_opaque(shape))
        throw UsageError("--vary alpha: only spheres, planes and rings can be rough");
    if (column.is_text()) throw UsageError("--vary alpha: must be numbers");
    for (const double alpha : column.numbers)
        if (!(alpha >= kSmoothest && alpha <= kRoughest))
            throw UsageError("--vary alpha: must be in [0.0001, 1] (got " + to_text(alpha) + ")");
}

int run_render(const RenderCommand& command) {
    const RenderFormat format = render_format(command);
    const schemas::StackSource source = schemas::load_stack(command.stack);
    const schemas::DocumentKind kind = schemas::kind_of(source.document);
    const bool is_surface = kind == schemas::DocumentKind::surface;
    if (kind == schemas::DocumentKind::scene) return render_scene(command, source, format);
    if (!command.show.empty()) throw UsageError("--show: takes a scene, of which it is a material");
    const bool is_sheet = !command.vary.empty();
    const PictureQuery query(command.picture, execution_of(command.threads), is_sheet ? 192 : 512);
    check_writable(command.output);
    if (!is_sheet)
        return render_one(
            command, query,
            is_surface ? shown_surface(source) : shown_stack(schemas::read_source(source)), format);
    if (format != RenderFormat::png) throw UsageError("--vary: a contact sheet must be .png");
    const SweepSpace space(command.vary, "");
    for (const SweptColumn& column : space.columns())
        check_column(column, query.scene().shape, is_surface);
    if (space.size() > kMostSheetPictures)
        throw UsageError("--vary: must be at most " + std::to_string(kMostSheetPictures) +
                         " pictures (got " + std::to_string(space.size()) + ")");
    const auto count = static_cast<std::size_t>(space.size());
    const std::size_t columns =
        space.columns().size() > 1 ? space.columns().back().size() : square_columns(count);
    const Camera& camera = query.scene().camera;
    const SheetLayout layout(count, columns, camera);
    require_room(layout);
    std::vector<Shown> all = varied_pictures(source, space, camera.width);
    const std::vector<tables::Pixels> pictures = draw_all(command, query, all, {});
    write_sheet(command, query, all, pictures, layout);
    return 0;
}

}  // namespace

void add_render_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "render", "Pictures of a stack or a surface on a shape, and contact sheets of many.");
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
    command
        ->add_option("--show", options->show,
                     "of a scene: the material to draw [a contact sheet of all]")
        ->type_name("MATERIAL");
    add_output_options(*command, options->output, "png or exr", " (with -f)");
    add_bits_option(*command, options->bits);
    command->add_flag("--stats", options->stats,
                      "print on standard error how the colours were computed, and why");
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet, "no notes and no progress");
    set_examples(
        *command,
        {"irido render \"air | 1.33@400 | air\" --shape bubble --thickness-noise 100:800,3,1 "
         "-o bubble.png",
         "irido render schemas/examples/surfaces/green-on-pale.json --environment studio -o "
         "sphere.exr",
         "irido render \"air | 1.38@100 | 1.9+1.5i\" --vary layers.0.thickness_nm=100:700/6 "
         "--vary alpha=0.05,0.1,0.2 -o sheet.png"},
        "PNG is sRGB; EXR is linear, single precision, with alpha multiplied in. A pixel is the\n"
        "colour of irido color (D65, 2 degrees, Bradford) times the light that it mirrors. The\n"
        "sphere, of radius 0.9 times half of the smaller side, is seen by parallel rays: at the\n"
        "distance r from its centre the angle is asin(r/R). Walls of a bubble, and a ring that\n"
        "mirrors itself, are multiplied wavelength by wavelength. Pictures do not depend on -j.");
    set_run(*command, run, options, run_render);
}

}  // namespace irido::cli
