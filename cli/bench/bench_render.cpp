#include <array>
#include <memory>

#include "cli/bench/bench.hpp"
#include "cli/stopwatch.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/render/picture.hpp"
#include "tables/view/view_page.hpp"

namespace irido::cli {

namespace {

struct RenderBenchOptions {
    std::string cases = "all", size = "500";
    unsigned threads = 0;
    OutputOptions output;
    bool quiet = false;
};

struct PictureCase {
    std::string_view name, summary, stack;
    ShapeKind shape = ShapeKind::sphere;
    bool noise = true;
    double alpha = 0;  ///< rough if above 0
};

constexpr std::array<PictureCase, 5> kPictureCases{{
    {"film", "a film on metal of one thickness", "air | 1.38@420 | 1.9+1.5i", ShapeKind::sphere,
     false},
    {"two-layer", "two layers on metal, one of which varies (Erskine and Poon 2025)",
     "air | 1.33@400 | 1.5@200 | 1.9+1.5i"},
    {"bubble", "a soap bubble whose wall varies", "air | 1.33@400 | air", ShapeKind::bubble},
    {"mirror", "a Bragg mirror of twenty periods", "1 | (1@125 | 1.5@375)^20 | 1",
     ShapeKind::sphere, false},
    {"rough", "the film on metal, of roughness 0.2, 64 samples per pixel",
     "air | 1.38@420 | 1.9+1.5i", ShapeKind::sphere, false, 0.2},
}};

struct MeasuredPicture {
    std::string_view picture;
    std::string method;
    double seconds = 0, mean = 0, worst = 0;
};

/// A prepared case.
class BenchPicture {
public:
    BenchPicture(const PictureCase& of, std::size_t size, const Execution& execution)
        : case_(of),
          execution_(execution),
          tables_(Sensitivity(observer(2), illuminant("D65"))),
          transform_(rgb_space("srgb"), tables_.sensitivity().white(), Adaptation::bradford) {
        surface_.stack = schemas::read_stack({std::string(of.stack), {}}).stack;
        scene_.camera = {size, size};
        scene_.shape = of.shape;
        scene_.environment = named_environment("studio");
        if (of.alpha > 0) {
            scene_.alpha = of.alpha;
            scene_.samples = 64;
        }
        if (!of.noise) return;
        scene_.noise = ThicknessNoise{100, 800, 3, 1, 1};
        surface_.varied = layer_number(surface_.stack, 1);
    }

    bool has_other_methods() const { return is_simple(case_.shape); }

    /// Seconds for everything that determines the pixels; data shared within a process are
    /// recomputed.
    double draw(bool exact, const ColorMethod& method, Picture& picture) const {
        return seconds_of([&] {
            const ColorTables tables(tables_.sensitivity());
            const Painter painter(scene_);
            const Painter::Survey survey = painter.survey(execution_.threads);
            const ColorPlan plan{.range = survey.range,
                                 .points = survey.points,
                                 .exact = exact,
                                 .method = method,
                                 .threads = execution_.threads,
                                 .simd = execution_.simd};
            const auto paint = [&](const auto& colors) {
                picture = painter.paint(colors, execution_.threads, [](double) {});
            };
            if (is_simple(case_.shape))
                paint(ReflectedColors(tables, transform_, surface_, plan));
            else
                paint(PathColors(tables, transform_, surface_, is_opaque(case_.shape), plan));
        });
    }

    double write_page() const {
        const nlohmann::json nothing;
        tables::ViewRequest request;
        request.source = &nothing;
        request.stack = &surface_.stack;
        request.threads = execution_.threads;
        return seconds_of(
            [&] { tables::view_page(ColorTables(tables_.sensitivity()), transform_, request); });
    }

private:
    const PictureCase& case_;
    Execution execution_;
    ColorTables tables_;
    RgbTransform transform_;
    SurfaceStack surface_;
    PictureScene scene_;
};

/// CIEDE2000 over the pixels that show the shape.
void compare(const Picture& exact, const Picture& picture, MeasuredPicture& row) {
    double sum = 0;
    std::size_t count = 0;
    const auto color = [](const Picture& of, std::size_t i) {
        return Triple{static_cast<double>(of.rgba[i]), static_cast<double>(of.rgba[i + 1]),
                      static_cast<double>(of.rgba[i + 2])};
    };
    for (std::size_t i = 0; i < exact.rgba.size(); i += 4) {
        if (exact.rgba[i + 3] == 0) continue;
        const double off = srgb_difference(color(exact, i), color(picture, i));
        sum += off;
        row.worst = std::max(row.worst, off);
        ++count;
    }
    row.mean = count > 0 ? sum / static_cast<double>(count) : 0;
}

void measure_case(const PictureCase& of, std::size_t size, const Execution& execution,
                  std::vector<MeasuredPicture>& rows) {
    struct Method {
        const char* name;
        bool exact;
        ColorMethod method;
    };
    const std::array methods{Method{"exact", true, {}}, Method{"irido", false, {}},
                             Method{"41 wavelengths", true, color_method("equal", 41)},
                             Method{"9 wavelengths", true, color_method("equal", 9)},
                             Method{"3 wavelengths", true, color_method("naive")}};
    const BenchPicture bench(of, size, execution);
    Picture exact, picture;
    for (const Method& method : methods) {
        if (!bench.has_other_methods() && !method.method.is("auto")) continue;
        if (of.alpha > 0 && method.exact) continue;  // millions of colours
        MeasuredPicture row{of.name, method.name};
        row.seconds = bench.draw(method.exact, method.method, picture);
        if (rows.empty() || rows.back().picture != of.name) exact = picture;
        compare(exact, picture, row);
        rows.push_back(row);
    }
    if (of.alpha == 0) rows.push_back({of.name, "view", bench.write_page()});
}

int run_bench_render(const RenderBenchOptions& options) {
    resolved_record_format(options.output);
    check_writable(options.output);
    const std::size_t size = parse_whole_number("--size", options.size, 1, 8192);
    std::vector<MeasuredPicture> rows;
    const auto chosen =
        chosen_cases(options.cases, std::span<const PictureCase>(kPictureCases), "render");
    StepProgress progress(options.quiet, chosen.size());
    for (const PictureCase& one : chosen) {
        progress.begin(std::string(one.name));
        measure_case(one, size, execution_of(options.threads), rows);
    }
    progress.clear();
    tables::Column::Texts cases, methods;
    for (const MeasuredPicture& row : rows) {
        cases.emplace_back(row.picture);
        methods.push_back(row.method);
    }
    tables::Records records{{{"case", std::move(cases)}, {"method", std::move(methods)}}};
    add_numbers(records, "seconds", rows, [](const MeasuredPicture& row) { return row.seconds; });
    add_numbers(records, "mean_delta_e", rows, [](const MeasuredPicture& row) { return row.mean; });
    add_numbers(records, "worst_delta_e", rows,
                [](const MeasuredPicture& row) { return row.worst; });
    write_records(records, options.output);
    return 0;
}

}  // namespace

void add_bench_render(CLI::App& bench, Run& run) {
    CLI::App* command = bench.add_subcommand(
        "render", "Time of pictures, and their error by tables and by few wavelengths.");
    const auto options = std::make_shared<RenderBenchOptions>();
    command
        ->add_option("--cases", options->cases,
                     cases_help(std::span<const PictureCase>(kPictureCases)))
        ->type_name("NAMES");
    offer(
        *command, "cases", [] { return case_names(std::span<const PictureCase>(kPictureCases)); },
        OfferedWords::Use::several);
    command->add_option("--size", options->size, "width and height in pixels, [1, 8192] [500]")
        ->type_name("N");
    add_output_options(*command, options->output, record_formats_text());
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet, "no progress");
    set_examples(
        *command, {"irido bench render", "irido bench render --cases two-layer --size 256"},
        "Methods: exact: every pixel by irido color; irido: the table of irido render; 41, 9\n"
        "and 3 wavelengths for every pixel, as others do; view: the page of irido view, without\n"
        "an error.\n"
        "Columns: seconds without starting the program and writing; mean_delta_e and\n"
        "worst_delta_e: CIEDE2000 to exact over all pixels that show the stack.");
    set_run(*command, run, options, run_bench_render);
}

}  // namespace irido::cli
