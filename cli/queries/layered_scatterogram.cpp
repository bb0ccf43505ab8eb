#include <algorithm>
#include <array>
#include <cmath>

#include "cli/queries/surface_colors.hpp"
#include "cli/queries/surface_query.hpp"
#include "core/math/constants.hpp"
#include "core/rough/layered/adding.hpp"
#include "core/rough/layered/layered_color.hpp"
#include "schemas/input_error.hpp"
#include "tables/pictures/scatterogram.hpp"

namespace irido::cli {

namespace {

/// Number of wavelengths, 4 nm apart: colours to 1e-4 unless the layers have sharp resonances.
constexpr std::size_t kScatterogramWavelengths = 118;
constexpr double kScatterogramTolerance = 1e-2;

/// Polar angles and azimuths on a disc: symmetric about the plane of incidence.
constexpr std::size_t kPolarSteps = 90, kAzimuthSteps = 60;
constexpr double kAzimuthStep_deg = 3;

constexpr std::size_t kDiscPixels = 360;

/// Colours of both discs: per polar angle, and per polar angle and azimuth.
struct DiscColors {
    std::vector<Triple> white, beam;
};

DiscColors disc_colors(const LayeredSurface& surface, const SurfaceQuery& query,
                       double light_theta_deg, const Sensitivity& sensitivity) {
    const LayeredScattering scattering(held_surface(surface, sensitivity),
                                       parse_crossings(query.transmission), query.execution);
    const Paths asked = parse_paths(query.paths);
    const bool is_added = asked == Paths::all && !scattering.is_closed();
    const Paths paths = is_added ? Paths::single : asked;
    const SampleRule rule = equal_rule(sensitivity, kScatterogramWavelengths);
    std::vector<double> thetas;
    std::vector<ScatterPair> pairs;
    for (std::size_t t = 0; t <= kPolarSteps; ++t) {
        thetas.push_back(static_cast<double>(t));
        for (std::size_t p = 0; p <= kAzimuthSteps; ++p)
            pairs.push_back(
                {light_theta_deg, thetas.back(), kAzimuthStep_deg * static_cast<double>(p)});
    }
    std::vector<double> a = scattering.albedo(thetas, rule.wavelength_nm, paths);
    std::vector<double> f = scattering.brdf(pairs, rule.wavelength_nm, paths);
    if (is_added) {
        const Adding adding(scattering, kScatterogramTolerance, query.execution);
        const std::vector<double> more_a = adding.albedo_rest(thetas, rule.wavelength_nm).values;
        const std::vector<double> more_f = adding.brdf_rest(pairs, rule.wavelength_nm).values;
        for (std::size_t k = 0; k < a.size(); ++k) a[k] += more_a[k];
        for (std::size_t k = 0; k < f.size(); ++k) f[k] += more_f[k];
    }
    for (double& one : f) one *= kPi;
    return {sampled_colors(sensitivity, rule, a), sampled_colors(sensitivity, rule, f)};
}

Triple mixed(const Triple& a, const Triple& b, double share) {
    Triple both{};
    for (std::size_t c = 0; c < 3; ++c) both[c] = a[c] + share * (b[c] - a[c]);
    return both;
}

}  // namespace

SurfaceRows layered_scatterogram(std::span<const schemas::SurfaceDocument> documents,
                                 const SurfaceQuery& query) {
    if (query.paths != "single" && query.paths != "all")
        throw UsageError("--scatterogram: requires --paths single or all (got '" + query.paths +
                         "')");
    if (query.quantity != "brdf")
        throw UsageError("--scatterogram: shows albedo and BRDF together; leave out --quantity");
    if (const std::string typed = query.scratch.typed(); !typed.empty())
        throw UsageError(typed + ": takes surfaces with scratches");
    if (query.color.sides != "R")
        throw UsageError("--scatterogram requires reflected light (got --side " +
                         query.color.sides + ")");
    if (query.color.method != "auto") throw UsageError("--method: requires --color");
    const std::vector<double> lights = parse_light_thetas(query.directions);
    if (lights.size() != 1)
        throw UsageError("--scatterogram: requires a single --light-theta, that of the beam");
    const ColorColumns columns(query.color);
    const Sensitivity& sensitivity = columns.illumination().tables.sensitivity();

    std::vector<Triple> all;                       // XYZ of all rows
    std::vector<std::vector<Triple>> white, beam;  // linear sRGB, of each surface
    double brightest = 1;
    for (const schemas::SurfaceDocument& document : documents) {
        const auto* surface = std::get_if<LayeredSurface>(&document.surface);
        if (!surface) throw schemas::InputError(document.file, "", "must be a layered surface");
        report_held_layers(*surface, document, sensitivity, query);
        const DiscColors colors = disc_colors(*surface, query, lights[0], sensitivity);
        all.insert(all.end(), colors.white.begin(), colors.white.end());
        all.insert(all.end(), colors.beam.begin(), colors.beam.end());
        white.emplace_back();
        beam.emplace_back();
        for (const Triple& xyz : colors.white) white.back().push_back(columns.drawn(xyz));
        for (const Triple& xyz : colors.beam) {
            beam.back().push_back(columns.drawn(xyz));
            brightest = std::max(brightest, std::ranges::max(beam.back().back()));
        }
    }
    NumberColumns keys{{"beam", {}}, {"view_theta_deg", {}}, {"view_phi_deg", {}}};
    if (documents.size() > 1) keys.insert(keys.begin(), {"surface", {}});
    const auto add = [&](std::size_t surface, double is_beam, double theta, double phi) {
        const std::array row{static_cast<double>(surface + 1), is_beam, theta, phi};
        for (std::size_t c = 0; c < keys.size(); ++c)
            keys[c].second.push_back(row[c + row.size() - keys.size()]);
    };
    for (std::size_t s = 0; s < documents.size(); ++s) {
        for (std::size_t t = 0; t <= kPolarSteps; ++t) add(s, 0, static_cast<double>(t), 0);
        for (std::size_t t = 0; t <= kPolarSteps; ++t)
            for (std::size_t p = 0; p <= kAzimuthSteps; ++p)
                add(s, 1, static_cast<double>(t), kAzimuthStep_deg * static_cast<double>(p));
    }
    SurfaceRows rows = columns.rows(std::move(keys), all);
    rows.plot.notes.clear();
    if (brightest > 1)
        rows.plot.notes.push_back("the beam's image is divided by " +
                                  to_text(std::ceil(brightest)));
    tables::InkMixer mixer(tables::GamutMapping::clip);
    const double exposure = 1 / std::ceil(brightest);
    const auto ink = [&](std::size_t row, std::size_t column, double theta, double phi) {
        const std::size_t discs = documents.size();
        const std::size_t s = discs > 1 ? column : 0;
        const bool is_beam = (discs > 1 ? row : column) > 0;
        const auto t = std::min(static_cast<std::size_t>(theta), kPolarSteps - 1);
        const double up = theta - static_cast<double>(t);
        if (!is_beam) return mixer(mixed(white[s][t], white[s][t + 1], up));
        const double folded = std::min(phi, 360 - phi) / kAzimuthStep_deg;
        const auto p = std::min(static_cast<std::size_t>(folded), kAzimuthSteps - 1);
        const double across = folded - static_cast<double>(p);
        const auto at = [&](std::size_t theta_step) {
            const std::size_t first = theta_step * (kAzimuthSteps + 1);
            return mixed(beam[s][first + p], beam[s][first + p + 1], across);
        };
        Triple color = mixed(at(t), at(t + 1), up);
        for (double& part : color) part *= exposure;
        return mixer(color);
    };
    rows.pixels = documents.size() > 1 ? tables::scatterogram(2, documents.size(), kDiscPixels, ink)
                                       : tables::scatterogram(1, 2, kDiscPixels, ink);
    if (std::string share = mixer.note(); !share.empty())
        rows.plot.notes.push_back(std::move(share));
    return rows;
}

}  // namespace irido::cli
