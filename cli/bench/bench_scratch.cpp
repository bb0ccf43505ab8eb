#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <tuple>

#include "cli/bench/bench.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/stopwatch.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/sensitivity_transform.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/half.hpp"
#include "core/math/random.hpp"
#include "core/math/sine_integral.hpp"
#include "core/scratch/footprint.hpp"
#include "core/scratch/scratch_grid.hpp"
#include "core/scratch/scratched_scattering.hpp"
#include "core/scratch/slit_color.hpp"
#include "tables/pictures/figure.hpp"

namespace irido::cli {

namespace {

constexpr double kLargestScratchCount = 1e5;

struct ScratchBenchOptions {
    std::string count = "400", seed = "1", time = "0.01";
    std::optional<std::string> plot;
    OutputOptions output;
    bool quiet = false;
};

/// A light that covers u = W q from one end to the other, on a scratch of given depth.
struct SlitLight {
    double from_um, to_um, depth_um;
};

/// Widths 0.8 to 6 um, depths 0.05 to 3 um, q from -1 to 1.
std::vector<SlitLight> random_lights(double least, double most, std::uint64_t count,
                                     std::uint64_t seed) {
    Random random(seed);
    std::vector<SlitLight> lights;
    for (std::uint64_t i = 0; i < count; ++i) {
        const double width = random.uniform(0.8, 6), extent = random.uniform(least, most),
                     q = random.uniform(-1, 1 - extent);
        lights.push_back({width * q, width * (q + extent), random.uniform(0.05, 3)});
    }
    return lights;
}

/// Colour from spectral nodes, with F or an approximation of it.
template <class Slit>
Triple color_by_nodes(const SpectralNodes& nodes, const SlitLight& light, const Slit& slit) {
    Triple sum{};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double nu = nodes.nu_per_um[i], sine = std::sin(kTwoPi * light.depth_um * nu);
        const double value =
            4 * sine * sine / kPi * slit(kTwoPi * light.from_um * nu, kTwoPi * light.to_um * nu);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += nodes.weight[c][i] * value;
    }
    return sum;
}

double exact_lobe(double from, double to) {
    return slit_integral(from, to);
}
double published_lobe(double from, double to) {
    return published_slit_integral(to) - published_slit_integral(from);
}

/// A texture of Q, or of its derivative with respect to x = u/(u + 2 um), sampled like a shader
/// does.
class SlitTexture {
public:
    SlitTexture(const Sensitivity& sensitivity, bool is_slope, bool is_half)
        : is_slope_(is_slope), bytes_(kPlaces * kDepths * 8 * (is_half ? 2 : 4)) {
        std::vector<double> u, depth;
        for (std::size_t i = 0; i < kPlaces; ++i) {
            const double x = static_cast<double>(i) / kPlaces;
            u.push_back(kScale_um * x / (1 - x));
        }
        for (std::size_t i = 0; i < kDepths; ++i) {
            const double x = deep_place(kDeepest) * static_cast<double>(i) / (kDepths - 1);
            depth.push_back(x / (1 - x));
        }
        const SlitColors colors(sensitivity, u.back(), kDeepest);
        const auto q = is_slope ? colors.carried_slope(u, depth, kSlitCarriers_um)
                                : colors.carried(u, depth, kSlitCarriers_um);
        for (std::size_t i = 0; i < q.size(); ++i) {
            const double per_x = std::pow(u[i / kDepths] + kScale_um, 2) / kScale_um;
            for (const Complex& value : q[i])
                for (const double part : {value.real(), value.imag()}) {
                    const double stored = is_slope ? part * per_x : part;
                    texels_.push_back(
                        static_cast<float>(is_half ? rounded_to_half(stored) : stored));
                }
        }
    }

    std::size_t bytes() const { return bytes_; }

    Triple operator()(const SlitLight& light) const {
        if (!is_slope_) {
            Triple high = at(place(light.to_um), light.depth_um);
            const Triple low = at(place(light.from_um), light.depth_um);
            for (std::size_t c = 0; c < 3; ++c)
                high[c] =
                    (light.to_um < 0 ? -high[c] : high[c]) - (light.from_um < 0 ? -low[c] : low[c]);
            return high;
        }
        const double x0 = place(light.from_um), x1 = place(light.to_um);
        const double middle = (x0 + x1) / 2, reach = (x1 - x0) / (2 * std::sqrt(3.0));
        Triple sum = at(middle - reach, light.depth_um);
        const Triple more = at(middle + reach, light.depth_um);
        for (std::size_t c = 0; c < 3; ++c) sum[c] = (sum[c] + more[c]) * (x1 - x0) / 2;
        return sum;
    }

private:
    static constexpr std::size_t kPlaces = 256, kDepths = 64;
    static constexpr double kScale_um = 2, kDeepest = 3.15;

    static double place(double u) { return u / (std::abs(u) + kScale_um); }
    static double deep_place(double depth) { return depth / (depth + 1); }

    Triple at(double x, double depth) const {
        const double row = std::min(std::abs(x) * kPlaces, static_cast<double>(kPlaces - 1));
        const double column = deep_place(depth) / deep_place(kDeepest) * (kDepths - 1);
        const auto r = std::min(static_cast<std::size_t>(row), kPlaces - 2),
                   c = std::min(static_cast<std::size_t>(column), kDepths - 2);
        const double s = row - static_cast<double>(r), t = column - static_cast<double>(c);
        const auto texel = [&](std::size_t i, std::size_t j) {
            return texels_.data() + (i * kDepths + j) * 6;
        };
        Triple value{};
        for (std::size_t j = 0; j < 3; ++j) {
            const auto read = [&](std::size_t part) {
                return (1 - s) * ((1 - t) * texel(r, c)[part] + t * texel(r, c + 1)[part]) +
                       s * ((1 - t) * texel(r + 1, c)[part] + t * texel(r + 1, c + 1)[part]);
            };
            const double flat = (1 - s) * texel(r, 0)[2 * j] + s * texel(r + 1, 0)[2 * j];
            const double turn = 2 * kTwoPi * depth / kSlitCarriers_um[j];
            value[j] = 2 * (flat - std::cos(turn) * read(2 * j) + std::sin(turn) * read(2 * j + 1));
        }
        return value;
    }

    bool is_slope_;
    std::size_t bytes_;
    std::vector<float> texels_;
};

struct ScratchBenchRow {
    std::string light, method;
    double bytes = 0, ns = 0, p95 = 0, most = 0, negative = 0;
};

/// A point light on a scratch of a width and a depth, seen at xi_2 across it.
struct PointCase {
    double width_um, xi2, depth_um;
};

/// Where u = W xi_2 is above 0.3 um: below, tables of the transform cancel.
std::vector<PointCase> random_points(std::uint64_t count, std::uint64_t seed) {
    constexpr double kLeast_um = 0.3;
    Random random(seed);
    std::vector<PointCase> points;
    while (points.size() < count) {
        const PointCase one{random.uniform(0.8, 6), random.uniform(-1, 1), random.uniform(0.05, 3)};
        if (std::abs(one.width_um * one.xi2) > kLeast_um) points.push_back(one);
    }
    return points;
}

/// Per W^2, of which the lobe's middle at mean depth is 4 nu^2.
Triple point_by_nodes(const SpectralNodes& nodes, const PointCase& light) {
    Triple sum{};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double nu = nodes.nu_per_um[i], x = kPi * light.width_um * light.xi2 * nu,
                     amplitude =
                         nu * sinc_of(x, std::sin(x)) * std::sin(kTwoPi * light.depth_um * nu);
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += 8 * nodes.weight[c][i] * amplitude * amplitude;
    }
    return sum;
}

/// Real parts of the transform as a texture of one row, read as a shader reads it.
class TransformTexture {
public:
    explicit TransformTexture(const Sensitivity& sensitivity) : texels_(kCount) {
        constexpr double kNmPerUm = 1000;
        const SensitivityTransform transform(sensitivity, kLongest_um * kNmPerUm, 1e-12);
        for (std::size_t i = 0; i < kCount; ++i) {
            const ComplexTriple h = transform(kLongest_um * kNmPerUm * static_cast<double>(i) /
                                              static_cast<double>(kCount - 1));
            for (std::size_t c = 0; c < 3; ++c) texels_[i][c] = static_cast<float>(h[c].real());
        }
    }
    double bytes() const { return kCount * 16.0; }

    Triple operator()(const PointCase& light) const {
        const double u = std::abs(light.width_um * light.xi2), v = 2 * light.depth_um;
        const Triple zero = at(0), of_u = at(u), of_v = at(v), sum = at(u + v),
                     difference = at(std::abs(u - v));
        const double scale = 2 / (kPi * kPi * u * u);
        Triple value{};
        for (std::size_t c = 0; c < 3; ++c)
            value[c] = scale * (zero[c] - of_u[c] - of_v[c] + (sum[c] + difference[c]) / 2);
        return value;
    }

private:
    static constexpr std::size_t kCount = 4096;
    static constexpr double kLongest_um = 24;

    Triple at(double path_um) const {
        const double place = std::min(path_um / kLongest_um, 1.0) * static_cast<double>(kCount - 1);
        const std::size_t i = std::min(static_cast<std::size_t>(place), kCount - 2);
        const double t = place - static_cast<double>(i);
        Triple value{};
        for (std::size_t c = 0; c < 3; ++c)
            value[c] = (1 - t) * texels_[i][c] + t * texels_[i + 1][c];
        return value;
    }

    std::vector<std::array<float, 3>> texels_;
};

/// Methods against exact colours; white is the full lobe, or the middle of the lobe of a point
/// light, at mean depth.
template <class Case>
class ScratchBench {
public:
    template <class Exact>
    ScratchBench(const Sensitivity& sensitivity, std::string name, std::vector<Case> lights,
                 double seconds, double white, const Exact& exact)
        : sensitivity_(sensitivity),
          name_(std::move(name)),
          lights_(std::move(lights)),
          seconds_(seconds),
          white_(white) {
        for (const Case& light : lights_) exact_.push_back(exact(light));
    }

    template <class Method>
    void add(std::vector<ScratchBenchRow>& rows, const std::string& name, double bytes,
             const Method& method) const {
        std::vector<Triple> colors(lights_.size());
        const double spent = best_seconds(seconds_, [&] {
            for (std::size_t i = 0; i < lights_.size(); ++i) colors[i] = method(lights_[i]);
        });
        ScratchBenchRow row{name_, name, bytes, spent / static_cast<double>(lights_.size()) * 1e9};
        std::vector<double> differences;
        for (std::size_t i = 0; i < colors.size(); ++i) {
            differences.push_back(ciede2000(seen(exact_[i]), seen(colors[i])));
            row.negative += colors[i][1] < 0 ? 1 : 0;
        }
        row.negative /= static_cast<double>(colors.size());
        std::ranges::sort(differences);
        row.most = differences.back();
        row.p95 = differences[(differences.size() - 1) * 95 / 100];
        rows.push_back(std::move(row));
    }

private:
    Triple seen(Triple xyz) const {
        for (double& value : xyz) value /= white_;
        return lab(xyz, sensitivity_.white());
    }

    const Sensitivity& sensitivity_;
    std::string name_;
    std::vector<Case> lights_;
    double seconds_, white_;
    std::vector<Triple> exact_;
};

void add_points(std::vector<ScratchBenchRow>& rows, const Sensitivity& sensitivity,
                const std::vector<PointCase>& points, double seconds) {
    const SpectralNodes exact = spectral_nodes(sensitivity, 24);
    double white = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
        white += 4 * exact.weight[1][i] * exact.nu_per_um[i] * exact.nu_per_um[i];
    const ScratchBench<PointCase> bench(
        sensitivity, "point", points, seconds, white,
        [&](const PointCase& light) { return point_by_nodes(exact, light); });
    const PointColors colors(sensitivity);
    const auto by = [&](const auto& method) {
        return [&](const PointCase& light) {
            Triple xyz = method(PointLobe{light.width_um, light.xi2, 2 * light.depth_um});
            for (double& value : xyz) value /= light.width_um * light.width_um;
            return xyz;
        };
    };
    bench.add(rows, "exact", 0, by([&](const PointLobe& lobe) { return colors(lobe); }));
    bench.add(rows, "transform", 0,
              by([&](const PointLobe& lobe) { return colors.by_transform(lobe); }));
    const auto add_nodes = [&](const std::string& method, const SpectralNodes& nodes) {
        bench.add(rows, method, 0,
                  [&](const PointCase& light) { return point_by_nodes(nodes, light); });
    };
    add_nodes("three-wavelengths", three_wavelengths());
    add_nodes("equal/32", equal_nodes(sensitivity, 32));
    for (const std::size_t n : {33U, 49U})
        add_nodes("nodes/" + std::to_string(n), one_panel_nodes(sensitivity, n));
    const TransformTexture texture(sensitivity);
    bench.add(rows, "table-f32", texture.bytes(), texture);
}

/// Nearly ten thousand scratches about a footprint, which a grid finds: time of each, as a colour
/// by the formulas of infinite ones, and exactly, ends and all, as a value at a wavelength.
void add_fields(std::vector<ScratchBenchRow>& rows, const Sensitivity& sensitivity,
                double seconds) {
    constexpr double kReach_um = 510, kCell_um = 60, kStep_nm = 6, kLongest_um = 0.83;
    constexpr double kDark = 6.5;  // y from which on exp(-y^2) is below 1e-18
    constexpr int kFootprintPoints = 16;
    ScratchedSurface surface;
    surface.fields = {{4000, {200, 3000}, {0.8, 6}, {0.05, 0.6}, {-180, 180}}};
    const Footprint footprint{Footprint::Kind::ellipse, {500, 500}, 150, 80, 20};
    const SkyPair pair{direction_of(19.7, 206.5), direction_of(20, 40)};
    const std::vector<Scratch> scratches = scratches_near(surface, {500, 500}, 1000);
    const ScratchGrid grid(scratches, {0, 0}, 1000, 1000, kCell_um, kReach_um);
    const PointColors colors(sensitivity);
    const double sigma = surface.optics.coherence_radius_um;
    const double x = pair.light[0] + pair.view[0], y = pair.light[1] + pair.view[1];
    const auto color_of = [&](std::span<const std::uint32_t> numbers) {
        Triple sum{};
        for (const std::uint32_t number : numbers) {
            const Scratch& scratch = scratches[number];
            const double tx = cos_deg(scratch.angle_deg), ty = sin_deg(scratch.angle_deg);
            const double blur = sigma * std::abs(x * tx + y * ty);
            if (kTwoPi * blur > kDark * kLongest_um) continue;
            if (distance_um(scratch, footprint.center) > kReach_um) continue;
            const FootprintFrame frame = frame_of(footprint, scratch);
            const double weight = ellipse_mean_by_points(frame.offset_um / sigma,
                                                         frame.across_um / sigma, kFootprintPoints);
            const Triple xyz = colors({scratch.width_um, y * tx - x * ty,
                                       scratch.depth_um * (pair.light[2] + pair.view[2]), blur});
            for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * xyz[c];
        }
        return sum;
    };
    std::vector<std::uint32_t> all(scratches.size());
    std::iota(all.begin(), all.end(), 0U);
    const std::span<const std::uint32_t> near = grid.near(footprint.center);
    Triple by_grid = color_of(near), by_all = color_of(all);
    const double spent = best_seconds(seconds, [&] { by_grid = color_of(near); });
    ScratchBenchRow row{"field", "grid", 0, spent / static_cast<double>(near.size()) * 1e9};
    row.bytes = static_cast<double>(4 * (grid.offsets().size() + grid.entries().size()) +
                                    32 * scratches.size());
    const double bright = 2 * by_all[1];
    for (std::size_t c = 0; c < 3; ++c) by_grid[c] /= bright, by_all[c] /= bright;
    row.most = row.p95 =
        ciede2000(lab(by_grid, sensitivity.white()), lab(by_all, sensitivity.white()));
    rows.push_back(row);
    std::vector<double> wavelength_nm;
    for (double at = 380; at <= 780; at += kStep_nm) wavelength_nm.push_back(at);
    const ScratchedScattering scattering(surface, footprint, {}, Execution(1));
    const double spectrum =
        best_seconds(seconds, [&] { scattering.brdf(std::array{pair}, wavelength_nm); });
    rows.push_back({"field", "exact-spectrum", 0,
                    spectrum * 1e9 / static_cast<double>(scattering.scratches()) /
                        static_cast<double>(wavelength_nm.size())});
}

std::vector<ScratchBenchRow> measured(const ScratchBenchOptions& options) {
    const std::uint64_t count =
        parse_whole_number("--count", options.count, 2, kLargestScratchCount);
    const std::uint64_t seed = parse_whole_number("--seed", options.seed, 0, kLargestSeed);
    const double seconds = parse_one_number("--time", options.time, 0.0001, 60);
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    const SlitTexture wide(sensitivity, false, false), narrow(sensitivity, true, true);
    const SpectralNodes exact = spectral_nodes(sensitivity, 24);
    std::vector<ScratchBenchRow> rows;
    StepProgress progress(options.quiet, 4);
    for (const auto& [name, least, most] :
         {std::tuple("wide", 0.2, 0.8), std::tuple("narrow", 0.003, 0.05)}) {
        progress.begin(std::string(name) + " lights");
        const ScratchBench<SlitLight> bench(
            sensitivity, name, random_lights(least, most, count, seed), seconds, 2,
            [&](const SlitLight& light) { return color_by_nodes(exact, light, exact_lobe); });
        const auto add_nodes = [&](const std::string& method, const SpectralNodes& nodes) {
            bench.add(rows, method, 0, [&](const SlitLight& light) {
                return color_by_nodes(nodes, light, exact_lobe);
            });
        };
        add_nodes("exact", exact);
        bench.add(rows, "published-fit", 0, [&](const SlitLight& light) {
            return color_by_nodes(exact, light, published_lobe);
        });
        add_nodes("three-wavelengths", three_wavelengths());
        for (const std::size_t n : {16U, 32U, 64U})
            add_nodes("equal/" + std::to_string(n), equal_nodes(sensitivity, n));
        for (const std::size_t n : {17U, 33U, 49U, 65U})
            add_nodes("nodes/" + std::to_string(n), one_panel_nodes(sensitivity, n));
        bench.add(rows, "table-carrier-f32", static_cast<double>(wide.bytes()), wide);
        bench.add(rows, "table-slope-f16", static_cast<double>(narrow.bytes()), narrow);
    }
    progress.begin("point lights");
    add_points(rows, sensitivity, random_points(count, seed), seconds);
    progress.begin("fields");
    add_fields(rows, sensitivity, seconds);
    return rows;
}

tables::Figure scratch_picture(const std::vector<ScratchBenchRow>& rows) {
    constexpr double kLeast = 1e-6;
    tables::Figure figure{.title = "Colours of scratches: run time against error"};
    for (const std::string light : {"wide", "narrow", "point"}) {
        tables::Panel panel{.title = light + " lights"};
        std::size_t style = 0;
        for (const ScratchBenchRow& row : rows)
            if (row.light == light)
                panel.series.push_back({row.method,
                                        style++,
                                        {{row.ns, std::max(row.most, kLeast)}},
                                        tables::Series::Form::line_with_points,
                                        {}});
        panel.x = {.quantity = "time per colour",
                   .unit = "ns",
                   .logarithmic = true,
                   .first = 10,
                   .last = 1e6};
        panel.y = {
            .quantity = "largest CIEDE2000", .logarithmic = true, .first = kLeast, .last = 100};
        figure.panels.push_back(std::move(panel));
    }
    figure.columns = 3;
    figure.shared_x = figure.shared_y = true;
    return figure;
}

int run_scratch_bench(const ScratchBenchOptions& options) {
    resolved_record_format(options.output);
    check_writable(options.output);
    check_plot(options.plot, options.output);
    const std::vector<ScratchBenchRow> rows = measured(options);
    tables::Column::Texts lights, methods;
    for (const ScratchBenchRow& row : rows) {
        lights.push_back(row.light);
        methods.push_back(row.method);
    }
    tables::Records records{{{"light", std::move(lights)}, {"method", std::move(methods)}}};
    const auto add = [&](std::string name, auto value) {
        add_numbers(records, std::move(name), rows, value);
    };
    add("bytes", [](const ScratchBenchRow& r) { return r.bytes; });
    add("ns_per_color", [](const ScratchBenchRow& r) { return r.ns; });
    add("dE2000_p95", [](const ScratchBenchRow& r) { return r.p95; });
    add("dE2000_max", [](const ScratchBenchRow& r) { return r.most; });
    add("negative", [](const ScratchBenchRow& r) { return r.negative; });
    write_records(records, options.output);
    if (options.plot)
        write_picture([&] { return scratch_picture(rows); }, {},
                      picture_format_of("--plot", *options.plot), {*options.plot, ""});
    return 0;
}

}  // namespace

void add_bench_scratch(CLI::App& bench, Run& run) {
    CLI::App* command = bench.add_subcommand(
        "scratch", "Run time against error of ways to colour scratches under lights.");
    const auto options = std::make_shared<ScratchBenchOptions>();
    command->add_option("-n,--count", options->count, "random scratches and lights, [2, 1e5] [400]")
        ->type_name("N");
    command->add_option("-s,--seed", options->seed, "seed of these, [0, 2^53] [1]")->type_name("S");
    command
        ->add_option("-t,--time", options->time,
                     "seconds spent on the time of each row, [0.0001, 60] [0.01]")
        ->type_name("S");
    command
        ->add_option("--plot", options->plot, "also plot the rows into FILE (.svg, .png or .pdf)")
        ->type_name("FILE");
    add_output_options(*command, options->output, record_formats_text());
    add_quiet_option(*command, options->quiet, "no progress");
    set_examples(*command,
                 {"irido bench scratch", "irido bench scratch --count 5000 --plot scratch.svg"},
                 "Widths 0.8 to 6 um, depths 0.05 to 3 um; wide lights cover 0.2 to 0.8 of q, the\n"
                 "sum of the directions across the scratch, narrow ones 0.003 to 0.05. D65, 2\n"
                 "degrees; white is the full lobe at mean depth. Methods:\n"
                 "exact: closed form in q, exact spectrum; published-fit: the same with VWH18's\n"
                 "eq. 29; three-wavelengths: 650, 510, 475 nm; equal/N: equally spaced from 380\n"
                 "to 780 nm; nodes/N: lut scratch-nodes; table-carrier-f32, table-slope-f16:\n"
                 "lut scratch --carrier, and with --per-place, 256 x 64, bilinear. Point lights\n"
                 "have u = W xi_2 above 0.3 um: transform: five values of H_j; table-f32: those\n"
                 "of a texture of 4096 texels. field: ten thousand scratches about a footprint,\n"
                 "per scratch: grid finds them and takes them as infinite ones, of which it skips\n"
                 "those in the dark; exact-spectrum is per wavelength, of 67, ends and all.\n"
                 "negative: share of colours with a luminance below 0.");
    set_run(*command, run, options, run_scratch_bench);
}

}  // namespace irido::cli
