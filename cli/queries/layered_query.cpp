#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "cli/queries/surface_colors.hpp"
#include "cli/queries/surface_query.hpp"
#include "core/error.hpp"
#include "core/rough/layered/adding.hpp"
#include "core/rough/layered/layered_color.hpp"
#include "core/rough/walk/simulation.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

Paths parse_paths(const std::string& text) {
    constexpr std::array<std::string_view, 4> names{"single", "all", "simulation",
                                                    "simulation-single"};
    if (text == names[0] || text == names[3]) return Paths::single;
    if (text == names[1] || text == names[2]) return Paths::all;
    throw UsageError("--paths: " + not_one_of(names, text));
}

Crossings parse_crossings(const std::string& text) {
    constexpr std::array<std::string_view, 2> names{"single", "multiple"};
    if (text == names[0]) return Crossings::single;
    if (text == names[1]) return Crossings::multiple;
    throw UsageError("--transmission: " + not_one_of(names, text));
}

void report_held_layers(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                        const Sensitivity& sensitivity, const SurfaceQuery& query) {
    for (std::size_t l = 0; l < surface.layers.size(); ++l) {
        schemas::StackDocument layer;
        layer.stack = surface.layers[l].stack;
        layer.file = document.file;
        layer.material_pointers.assign(layer.stack.materials.size(),
                                       "/layers/" + std::to_string(l) + "/stack");
        report_held_ranges(layer, sensitivity, false, query.note);
    }
}

namespace {

/// Relative, of all paths where there is no closed form.
constexpr double kDefaultAddingTolerance = 1e-3;

std::string two_digits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", value);
    return text.data();
}

bool is_simulated(const SurfaceQuery& query) {
    return query.paths.starts_with("simulation");
}

SimulationRequest parse_simulation(const SurfaceQuery& query, Crossings crossings) {
    constexpr double kMostSamples = 1e12, kMostSeed = 9007199254740992;
    constexpr std::array<std::string_view, 2> choices{"sampled", "filter"};
    SimulationRequest request;
    request.paths = parse_paths(query.paths);
    request.crossings = crossings;
    if (!query.samples.empty())
        request.samples = parse_whole_number("--samples", query.samples, 2, kMostSamples);
    if (!query.seed.empty()) request.seed = parse_whole_number("--seed", query.seed, 0, kMostSeed);
    if (query.facets == choices[1])
        request.facets = FacetChoice::filter;
    else if (!query.facets.empty() && query.facets != choices[0])
        throw UsageError("--facets: " + not_one_of(choices, query.facets));
    if (crossings == Crossings::multiple && request.facets == FacetChoice::sampled)
        throw UsageError("--transmission multiple: a simulation takes it with --facets filter");
    if (!query.color.tolerance.empty())
        throw UsageError("--tolerance: a simulation takes --samples instead");
    return request;
}

/// Throws UsageError if options of simulations were typed for none.
void require_no_simulation(const SurfaceQuery& query) {
    for (const auto& [name, typed] : {std::pair("--samples", &query.samples),
                                      {"--seed", &query.seed},
                                      {"--facets", &query.facets}})
        if (!typed->empty())
            throw UsageError(std::string(name) +
                             ": requires --paths simulation or simulation-single");
}

using Numbers = tables::Column::Numbers;

std::vector<ScatterPair> pairs_of(const std::vector<Directions>& directions) {
    std::vector<ScatterPair> pairs;
    for (const Directions& one : directions)
        pairs.push_back({one.light_theta_deg, one.view_theta_deg, one.azimuth_deg()});
    return pairs;
}

/// Throws ToleranceError for the first colour that misses it; says so where adding is all that is
/// missing and no tolerance was typed.
void check_tolerance(const schemas::SurfaceDocument& document, const SurfaceQuery& query,
                     bool is_added, const std::vector<SurfaceColor>& colors) {
    double tolerance = parse_tolerance(query.color.tolerance);
    if (is_added && query.color.tolerance.empty()) {
        tolerance = kDefaultAddingTolerance;
        double error = 0;
        for (const SurfaceColor& color : colors) error = std::max(error, color.error);
        if (error > tolerance)
            query.note(document.file + ": --paths all: the error of X, Y, Z is up to " +
                       two_digits(error));
        return;
    }
    for (const SurfaceColor& color : colors)
        if (!(color.error <= tolerance))
            throw ToleranceError(
                document.file + ": the tolerance " + to_text(tolerance) +
                " cannot be met; the best value is X, Y, Z = " + to_text(color.xyz[0]) + ", " +
                to_text(color.xyz[1]) + ", " + to_text(color.xyz[2]) + " with an error of " +
                to_text(color.error));
}

/// Colours of a layered surface.
SurfaceRows layered_colors(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                           const SurfaceQuery& query) {
    if (is_simulated(query))
        throw UsageError("--color: takes --paths single or all (got " + query.paths + ")");
    require_no_simulation(query);
    const ColorColumns columns(query.color);
    const double tolerance = parse_tolerance(query.color.tolerance);
    const Illumination& illumination = columns.illumination();
    report_held_layers(surface, document, illumination.tables.sensitivity(), query);
    const LayeredColor color(illumination.tables, surface, parse_crossings(query.transmission),
                             tolerance, query.execution);
    const Paths paths = parse_paths(query.paths);
    NumberColumns keys;
    std::vector<SurfaceColor> colors;
    if (query.quantity == "brdf") {
        const std::vector<Directions> directions = parse_directions(query.directions);
        colors = color.brdf(pairs_of(directions), paths);
        keys = direction_columns(directions, 1);
    } else if (query.quantity == "albedo") {
        const std::vector<double> thetas = parse_light_thetas(query.directions);
        colors = color.albedo(thetas, paths);
        keys.emplace_back("light_theta_deg", thetas);
    } else {
        throw UsageError("--color: takes --quantity brdf or albedo (got " + query.quantity + ")");
    }
    const bool is_added = paths == Paths::all && !color.scattering().is_closed();
    check_tolerance(document, query, is_added, colors);
    std::vector<Triple> xyz;
    for (const SurfaceColor& one : colors) xyz.push_back(one.xyz);
    return columns.rows(std::move(keys), xyz);
}

/// Numbers of a layered surface at wavelengths.
class LayeredAnswers {
public:
    LayeredAnswers(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                   const SurfaceQuery& query)
        : document_(document),
          query_(query),
          paths_(parse_paths(query.paths)),
          scattering_(surface, parse_crossings(query.transmission), query.execution) {
        if (is_simulated(query))
            simulation_ = parse_simulation(query, parse_crossings(query.transmission));
        else
            require_no_simulation(query);
    }

    SurfaceRows rows() const {
        if (query_.quantity == "brdf") return brdf();
        if (query_.quantity == "albedo") return albedo();
        if (is_simulated(query_))
            throw UsageError("--paths " + query_.paths + ": takes --quantity brdf or albedo (got " +
                             query_.quantity + ")");
        if (query_.quantity == "transmissivity") return transmissivity();
        if (query_.quantity == "sampling") return sampling();
        constexpr std::array<std::string_view, 4> names{"brdf", "albedo", "transmissivity",
                                                        "sampling"};
        throw UsageError("--quantity: " + not_one_of(names, query_.quantity) +
                         " for a layered surface");
    }

private:
    const std::vector<double>& wavelengths() const { return query_.wavelengths_nm; }

    /// Whether all paths are asked for and have no closed form.
    bool is_added() const { return paths_ == Paths::all && !scattering_.is_closed(); }
    Paths closed_paths() const { return is_added() ? Paths::single : paths_; }

    /// Adds the rest of all paths to single reflections. A tolerance that was typed is one that is
    /// held; else a note says what is not met.
    template <class Rest>
    void add(Numbers& once, const Rest& rest_by) const {
        const bool is_held = !query_.color.tolerance.empty();
        const double tolerance =
            is_held ? parse_tolerance(query_.color.tolerance) : kDefaultAddingTolerance;
        const Adding adding(scattering_, tolerance, query_.execution);
        const Adding::Values rest = rest_by(adding);
        for (std::size_t k = 0; k < once.size(); ++k) once[k] += rest.values[k];
        if (rest.error <= tolerance) return;
        const std::string words =
            document_.file + ": --paths all: the relative error is up to " + two_digits(rest.error);
        if (is_held)
            throw ToleranceError(words + "; the tolerance " + to_text(tolerance) +
                                 " cannot be met (simulation has no such limit)");
        query_.note(words);
    }

    SurfaceRows brdf() const {
        const std::vector<Directions> directions = parse_directions(query_.directions);
        const std::size_t W = wavelengths().size();
        require_few_rows(static_cast<double>(directions.size()) * static_cast<double>(W));
        auto columns = direction_columns(directions, W);
        Numbers wavelength;
        for (std::size_t i = 0; i < directions.size(); ++i)
            wavelength.insert(wavelength.end(), wavelengths().begin(), wavelengths().end());
        columns.emplace_back("wavelength_nm", std::move(wavelength));
        const std::vector<ScatterPair> pairs = pairs_of(directions);
        if (is_simulated(query_)) {
            LayeredSimulation::Values values = simulation().brdf(pairs);
            columns.emplace_back("brdf_per_sr", std::move(values.mean));
            columns.emplace_back("stderr", std::move(values.error));
            return rows_of(std::move(columns), 5);
        }
        Numbers f = scattering_.brdf(pairs, wavelengths(), closed_paths());
        if (is_added())
            add(f, [&](const Adding& adding) { return adding.brdf_rest(pairs, wavelengths()); });
        columns.emplace_back("brdf_per_sr", std::move(f));
        return rows_of(std::move(columns), 5);
    }

    SurfaceRows albedo() const {
        const std::vector<double> thetas = parse_light_thetas(query_.directions);
        if (is_simulated(query_)) {
            LayeredSimulation::Values values = simulation().albedo(thetas);
            return albedo_rows(thetas, std::move(values.mean), std::move(values.error));
        }
        Numbers a = scattering_.albedo(thetas, wavelengths(), closed_paths());
        if (is_added())
            add(a, [&](const Adding& adding) { return adding.albedo_rest(thetas, wavelengths()); });
        return albedo_rows(thetas, std::move(a), {});
    }

    SurfaceRows albedo_rows(const std::vector<double>& thetas, Numbers a, Numbers error) const {
        Numbers theta, wavelength;
        for (const double angle : thetas)
            for (const double nm : wavelengths()) {
                theta.push_back(angle);
                wavelength.push_back(nm);
            }
        std::vector<std::pair<std::string, Numbers>> columns{
            {"light_theta_deg", std::move(theta)},
            {"wavelength_nm", std::move(wavelength)},
            {"albedo", std::move(a)}};
        if (!error.empty()) columns.emplace_back("stderr", std::move(error));
        return rows_of(std::move(columns), 2);
    }

    LayeredSimulation simulation() const {
        return {scattering_, simulation_, wavelengths(), query_.execution};
    }

    SurfaceRows transmissivity() const {
        const std::vector<double> thetas = parse_light_thetas(query_.directions);
        Numbers layer, theta, wavelength, straight, passing;
        for (std::size_t l = 0; l < scattering_.layers(); ++l) {
            const std::vector<double> tau = scattering_.straight(l, thetas, wavelengths());
            for (std::size_t i = 0; i < tau.size(); ++i) {
                const double angle = thetas[i / wavelengths().size()];
                layer.push_back(static_cast<double>(l + 1));
                theta.push_back(angle);
                wavelength.push_back(wavelengths()[i % wavelengths().size()]);
                straight.push_back(tau[i]);
                passing.push_back(scattering_.passing(l, angle, tau[i]));
            }
        }
        return rows_of({{"layer", std::move(layer)},
                        {"theta_deg", std::move(theta)},
                        {"wavelength_nm", std::move(wavelength)},
                        {"ft_cos", std::move(straight)},
                        {"p_trans", std::move(passing)}},
                       3);
    }

    SurfaceRows sampling() const {
        const std::vector<double> thetas = parse_light_thetas(query_.directions);
        Numbers p = scattering_.sampling(thetas, wavelengths());
        Numbers theta, wavelength, layer;
        for (const double angle : thetas)
            for (const double nm : wavelengths())
                for (std::size_t l = 0; l < scattering_.layers() + 2; ++l) {
                    theta.push_back(angle);
                    wavelength.push_back(nm);
                    layer.push_back(static_cast<double>(l));
                }
        return rows_of({{"light_theta_deg", std::move(theta)},
                        {"wavelength_nm", std::move(wavelength)},
                        {"layer", std::move(layer)},
                        {"probability", std::move(p)}},
                       3);
    }

    const schemas::SurfaceDocument& document_;
    const SurfaceQuery& query_;
    Paths paths_;
    LayeredScattering scattering_;
    SimulationRequest simulation_;
};

}  // namespace

SurfaceRows rows_of_surface(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                            const SurfaceQuery& query) {
    if (const std::string typed = query.scratch.typed(); !typed.empty())
        throw UsageError(typed + ": takes surfaces with scratches");
    try {
        return query.wants_color ? layered_colors(surface, document, query)
                                 : LayeredAnswers(surface, document, query).rows();
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
}

}  // namespace irido::cli
