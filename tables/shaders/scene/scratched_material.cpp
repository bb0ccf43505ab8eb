#include "tables/shaders/scene/scratched_material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/color/held_stack.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"
#include "core/math/sine_integral.hpp"
#include "core/scratch/slit_color.hpp"
#include "core/spectrum/spectrum.hpp"
#include "tables/files/hash.hpp"
#include "tables/lut/color_values.hpp"

namespace irido::tables {

namespace {

/// CIEDE2000 that halves of the derivative keep.
constexpr double kHalves = 0.5;
constexpr double kSlitScale_um = 2, kDepthScale_um = 1;  ///< of the places of u and of the depth

/// Widths or depths that occur.
DrawnRange range_over(const ScratchedSurface& surface, double Scratch::*of_one,
                      DrawnRange ScratchField::*of_field) {
    DrawnRange range{kInfinity, 0};
    const auto add = [&](double low, double high) {
        range = {std::min(range.low, low), std::max(range.high, high)};
    };
    for (const Scratch& scratch : surface.scratches) add(scratch.*of_one, scratch.*of_one);
    for (const ScratchField& field : surface.fields)
        add((field.*of_field).low, (field.*of_field).high);
    return range.high < range.low ? DrawnRange{0, 0} : range;
}

std::string rounded_text(double value) {
    std::ostringstream text;
    text.precision(2);
    text << value;
    return text.str();
}

/// What lights cover of x.
class Coverage {
public:
    Coverage(const schemas::Scene& scene, const DrawnRange& width_um) : width_(width_um) {
        if (scene.lights.empty()) add({0, 180});
        for (const schemas::SceneLight& light : scene.lights) add(light.diameter_deg);
        is_stated_ = !scene.lights.empty();
    }

    bool has_points() const { return has_points_; }
    bool has_areas() const { return largest_deg_ > 0; }
    bool is_stated() const { return is_stated_; }
    /// About the mirror direction, of the widest scratch.
    double most() const {
        const double reach = width_.high * std::sin(largest_deg_ / 2 * kDegree);
        return 2 * reach / (reach + kSlitScale_um);
    }
    /// At q = 2, of the narrowest light; 0 where points and lights alike have no end.
    double least() const {
        const double wide = place(2 * width_.low),
                     q = 2 - 2 * std::sin(smallest_deg_ / 2 * kDegree);
        return std::min(wide - place(width_.low * q),
                        place(2 * width_.high) - place(width_.high * q));
    }

private:
    static double place(double u) { return u / (std::abs(u) + kSlitScale_um); }
    void add(const schemas::ValueRange& diameter_deg) {
        if (diameter_deg.first == 0) has_points_ = true;
        if (diameter_deg.last == 0) return;
        largest_deg_ = std::max(largest_deg_, diameter_deg.last);
        smallest_deg_ = std::min(smallest_deg_, diameter_deg.first);
    }

    DrawnRange width_;
    bool has_points_ = false, is_stated_ = false;
    double largest_deg_ = 0, smallest_deg_ = 180;
};

LutOptions slit_options(double deepest_um, double tolerance, bool is_slope) {
    constexpr double kCoarse = 0.4;  // CIEDE2000 that 256 places keep
    constexpr double kPlaces = 256, kFinePlaces = 512, kFineScale_um = 1.9;
    const bool is_fine = tolerance < kCoarse;
    LutOptions options{{"carrier", std::string("true")},
                       {"u-count", is_fine ? kFinePlaces : kPlaces},
                       {"u-scale", is_fine ? kFineScale_um : kSlitScale_um},
                       {"depth-scale", kDepthScale_um},
                       {"depth-max", std::max(0.01, deepest_um)}};
    if (is_slope) options["per-place"] = std::string("true");
    return options;
}

/// Nodes whose error the paths of all scratches leave below 1e-4 of the white.
double node_count(double path_um) {
    constexpr std::array<std::array<double, 2>, 4> kEnough{
        {{5, 33}, {7.5, 49}, {16, 65}, {24, 97}}};
    for (const auto& [path, count] : kEnough)
        if (path_um <= path) return count;
    return 129;
}

}  // namespace

std::string grid_checksum(const SceneGrid& grid) {
    return sha256_of(grid_file(grid.scratches, grid.extent).bytes);
}

ScratchNeeds needs_of_scratches(const schemas::Scene& scene,
                                const schemas::SceneScratches& scratches) {
    const ScratchedSurface& surface = scratches.surface;
    const DrawnRange width = range_over(surface, &Scratch::width_um, &ScratchField::width_um),
                     depth = range_over(surface, &Scratch::depth_um, &ScratchField::depth_um);
    const Coverage lights(scene, width);
    const std::string of_x = " of x = u/(u + " + to_text(kSlitScale_um) + " um)",
                      any = lights.is_stated() ? "" : "no lights are given: any may occur; ",
                      limit = to_text(kNarrowLight) + of_x;
    ScratchNeeds needs;
    const auto add = [&](std::string role, std::string kind, LutOptions options, bool is_needed,
                         std::string why) -> ScratchNeed& {
        return needs.tables.emplace_back(ScratchNeed{std::move(role), std::move(kind),
                                                     std::move(options), is_needed, false, false,
                                                     std::move(why)});
    };
    const double most = lights.most(), least = lights.least();
    const bool has_wide = lights.has_areas() && most >= kNarrowLight,
               has_narrow = lights.has_areas() && least < kNarrowLight;
    ScratchNeed& wide =
        add("wide", "scratch", slit_options(depth.high, scene.delta_e, false), has_wide,
            has_wide ? any + "lights cover up to " + rounded_text(most) + of_x +
                           ": differences of T, which need f32"
            : lights.has_areas() ? "no light covers " + limit + ", at most " + rounded_text(most)
                                 : "all lights are points");
    wide.is_single = wide.is_color = true;
    ScratchNeed& narrow = add(
        "narrow", "scratch", slit_options(depth.high, scene.delta_e, true), has_narrow,
        has_narrow ? any + "lights cover as little as " + rounded_text(least) + of_x + ", below " +
                         to_text(kNarrowLight) + ": its derivative, which does not cancel"
        : lights.has_areas()
            ? "every light covers " + limit + " or more, at least " + rounded_text(least)
            : "all lights are points");
    narrow.is_color = true;
    narrow.is_single = scene.delta_e < kHalves;
    const double path_um = 2 * (width.high + depth.high);
    const double count = node_count(path_um);
    ScratchNeed& points = add(
        "points", "scratch-nodes", {{"count", count}}, lights.has_points(),
        lights.has_points() ? any + "points have no width: " + to_text(count) +
                                  " wavenumbers hold paths up to " + rounded_text(path_um) + " um"
                            : "no light is a point");
    points.is_single = true;
    add("footprint", "scratch-footprint", {}, scratches.footprint_um > 0,
        scratches.footprint_um > 0
            ? "pixels see up to " + to_text(scratches.footprint_um) + " um around their centre"
            : "footprint_um is 0: pixels see points");
    constexpr double kReach = 3;  // coherence radii, as the footprint's table has it
    const double sigma_um = surface.optics.coherence_radius_um;
    needs.grid.extent = {{0, 0},
                         scratches.extent_um[0],
                         scratches.extent_um[1],
                         std::max(sigma_um, scratches.footprint_um),
                         kReach * sigma_um + scratches.footprint_um};
    needs.grid.scratches = scratches_within(surface, needs.grid.extent);
    double density = 0;
    for (const ScratchField& field : surface.fields) density += expected_density(field);
    needs.constants = {
        {"coherence_radius_um", sigma_um},
        {"depth_phase", surface.optics.depth_phase == DepthPhase::slanted ? "slanted" : "vertical"},
        {"width_um", {width.low, width.high}},
        {"depth_um", {depth.low, depth.high}},
        {"footprint_um", scratches.footprint_um},
        {"density", density}};
    if (surface.alpha && surface.base) needs.constants["alpha"] = *surface.alpha;
    if (has_wide || has_narrow || scratches.footprint_um > 0)
        needs.snippets.emplace_back("scratch");
    if (lights.has_points()) needs.snippets.emplace_back("scratch-nodes");
    return needs;
}

double product_difference(const schemas::Scene& scene, const schemas::SceneScratches& scratches,
                          const LutRequest& request) {
    constexpr int kCount = 300;
    constexpr double kUm = 1000, kLongest_um = 24;
    const ScratchedSurface& surface = scratches.surface;
    const DrawnRange width = range_over(surface, &Scratch::width_um, &ScratchField::width_um),
                     depth = range_over(surface, &Scratch::depth_um, &ScratchField::depth_um);
    const ColorValues values(request);
    const SpectralNodes nodes = spectral_nodes(
        *request.sensitivity, std::min(kLongest_um, 2 * (width.high + depth.high)) + kLongest_um);
    std::vector<double> wavelength_nm;
    for (const double nu : nodes.nu_per_um) wavelength_nm.push_back(kUm / nu);
    const Stack held = held_stack(request.document.stack, *request.sensitivity);
    const std::array cosines{std::cos(60 * kDegree), std::cos(30 * kDegree), 1.0};
    const Spectra both = spectra(StackPower(held), IndexTable(held, wavelength_nm), cosines,
                                 {.T = false, .A = false}, request.execution);
    const std::size_t size = nodes.size();
    Random random(1);
    double worst = 0;
    for (int i = 0; i < kCount; ++i) {
        const double w = random.uniform(width.low, width.high),
                     d = random.uniform(depth.low, depth.high);
        double degrees = random.uniform(0, 60);
        if (!scene.lights.empty()) {
            const auto& range = scene.lights[random.below(scene.lights.size())].diameter_deg;
            degrees = random.uniform(range.first, range.last);
        }
        const double extent = std::max(0.002, 2 * std::sin(degrees / 2 * kDegree)),
                     q = random.uniform(-1, 1);
        const std::size_t angle = random.below(cosines.size());
        Triple mirror{}, base{}, exact{};
        double whole = 0;  // of the lobe, brought to where a camera would have it
        for (std::size_t k = 0; k < size; ++k) {
            const double nu = nodes.nu_per_um[k], sine = std::sin(kTwoPi * d * nu);
            const double slit = slit_integral(kTwoPi * w * (q - extent / 2) * nu,
                                              kTwoPi * w * (q + extent / 2) * nu);
            const double lobe = 4 * sine * sine / kPi * slit;
            const double R = (both.s.R[angle * size + k] + both.p.R[angle * size + k]) / 2;
            for (std::size_t c = 0; c < 3; ++c) {
                mirror[c] += nodes.weight[c][k] * lobe;
                base[c] += nodes.weight[c][k] * R;
                exact[c] += nodes.weight[c][k] * lobe * R;
            }
            whole += nodes.weight[1][k] * lobe * R;
        }
        const double scale = 0.5 / std::max(0.01, whole);
        const Triple a = values(mirror), b = values(base), right = values(exact);
        Triple product{}, shown{};
        for (std::size_t c = 0; c < 3; ++c) {
            product[c] = scale * a[c] * b[c];
            shown[c] = scale * right[c];
        }
        worst = std::max(worst, ciede2000(values.to_lab(shown), values.to_lab(product)));
    }
    return worst;
}

}  // namespace irido::tables
