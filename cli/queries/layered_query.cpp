#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "cli/queries/layered_simulation.hpp"
#include "cli/queries/surface_colors.hpp"
#include "cli/queries/surface_query.hpp"
#include "core/color/held_stack.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/rough/layered/adding.hpp"
#include "core/rough/layered/layered_color.hpp"
#include "core/rough/layered/refracted_light.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

Paths parse_paths(const std::string& text) {
    constexpr std::array<std::string_view, 4> names{"single", "all", "simulation",
                                                    "simulation-single"};
    if (text == names[0] || text == names[3]) return Paths::single;
    if (text == names[1] || text == names[2]) return Paths::all;
    throw UsageError("--paths: " + not_one_of(names, text));
}

Paths parse_closed_paths(const std::string& text) {
    constexpr std::array<std::string_view, 2> names{"single", "all"};
    if (text == names[0]) return Paths::single;
    if (text == names[1]) return Paths::all;
    throw UsageError("--paths: " + not_one_of(names, text));
}

Crossings parse_crossings(const std::string& text) {
    constexpr std::array<std::string_view, 2> names{"single", "multiple"};
    if (text == names[0]) return Crossings::single;
    if (text == names[1]) return Crossings::multiple;
    throw UsageError("--transmission: " + not_one_of(names, text));
}

nlohmann::json surface_facts(const LayeredSurface& surface, const SurfaceQuery& query) {
    nlohmann::json layers = nlohmann::json::array();
    for (const RoughLayer& layer : surface.layers)
        layers.push_back(
            {{"alpha", layer.alpha}, {"stack", schemas::canonical_stack(layer.stack)}});
    nlohmann::json albedo;
    if (const auto* table = std::get_if<Table>(&surface.base_albedo)) {
        for (std::size_t k = 0; k < table->value.size(); ++k)
            albedo.push_back({table->wavelength_nm[k], table->value[k]});
    } else {
        albedo = std::get<Constant>(surface.base_albedo).value;
    }
    return {{"request",
             {{"layers", layers},
              {"base", {{"albedo", albedo}}},
              {"paths", query.paths},
              {"transmission", query.transmission},
              {"illuminant", query.color.illuminant},
              {"observer", query.color.observer}}}};
}

void report_held_layers(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                        const Sensitivity& sensitivity, const SurfaceQuery& query) {
    for (std::size_t l = 0; l < surface.layers.size(); ++l) {
        schemas::StackDocument layer;
        layer.stack = surface.layers[l].stack;
        layer.file = document.file;
        layer.material_pointers.assign(layer.stack.materials.size(),
                                       "/layers/" + std::to_string(l) + "/stack");
        report_held_ranges(layer, sensitivity, query.color.strict, query.note);
    }
}

namespace {

/// Relative tolerance of all paths without a closed form.
constexpr double kDefaultAddingTolerance = 1e-3;

std::string two_digits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", value);
    return text.data();
}

using Numbers = tables::Column::Numbers;

std::vector<ScatterPair> pairs_of(const std::vector<Directions>& directions) {
    std::vector<ScatterPair> pairs;
    for (const Directions& one : directions)
        pairs.push_back({one.light_theta_deg, one.view_theta_deg, one.azimuth_deg()});
    return pairs;
}

/// Throws ToleranceError for the first colour that misses the tolerance; only notes it if the miss
/// is due to adding alone and no tolerance was given.
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

bool wants_transmission(const SurfaceQuery& query) {
    if (query.color.sides == "R") return false;
    if (query.color.sides == "T") return true;
    throw UsageError("--side: must be R or T (got '" + query.color.sides + "')");
}

/// The only layer of a surface whose light is refracted into its substrate. Throws UsageError.
const RoughLayer& refracting_layer(const LayeredSurface& surface, const SurfaceQuery& query) {
    if (query.quantity != "brdf")
        throw UsageError("--side T: requires --quantity brdf (got '" + query.quantity + "')");
    if (query.paths != "single")
        throw UsageError("--side T: requires --paths single (got '" + query.paths + "')");
    if (surface.is_coated() || surface.layers.size() != 1)
        throw UsageError("--side T: takes one rough layer without a coating");
    if (surface.layers.front().is_passable)
        throw UsageError(
            "--side T: light goes straight on through this layer (see --quantity transmissivity)");
    return surface.layers.front();
}

/// Makes the errors of colours by a method that has none their distances from exact ones.
void measure(std::vector<SurfaceColor>& colors, const std::vector<SurfaceColor>& exact) {
    for (std::size_t k = 0; k < colors.size(); ++k) {
        colors[k].error = exact[k].error;
        for (std::size_t c = 0; c < 3; ++c)
            colors[k].error = std::max(
                colors[k].error, exact[k].error + std::abs(colors[k].xyz[c] - exact[k].xyz[c]));
    }
}

/// Colours of light that is refracted into the substrate.
SurfaceRows refracted_colors(const LayeredSurface& surface,
                             const schemas::SurfaceDocument& document, const SurfaceQuery& query) {
    const RoughLayer& layer = refracting_layer(surface, query);
    const ColorColumns columns(query.color);
    const ColorTables& tables = columns.illumination().tables;
    const double tolerance = parse_tolerance(query.color.tolerance);
    report_held_layers(surface, document, tables.sensitivity(), query);
    const std::vector<Directions> directions = parse_directions(query.directions);
    const std::vector<ScatterPair> pairs = pairs_of(directions);
    const RefractedLight light(held_stack(layer.stack, tables.sensitivity()), layer.alpha,
                               query.execution);
    const ColorMethod method = parse_method(query.color);
    std::vector<SurfaceColor> colors = light.color(tables, pairs, method, tolerance);
    if (!query.color.tolerance.empty() || method.is("auto")) {
        if (!method.is("auto")) measure(colors, light.color(tables, pairs, {}, tolerance));
        check_tolerance(document, query, false, colors);
    }
    std::vector<Triple> xyz;
    for (const SurfaceColor& one : colors) xyz.push_back(one.xyz);
    return columns.rows(direction_columns(directions, 1), xyz);
}

/// Colours by simulation, at wavelengths 4 nm apart.
SurfaceRows simulated_colors(const LayeredSurface& surface,
                             const schemas::SurfaceDocument& document, const SurfaceQuery& query) {
    constexpr std::size_t kWavelengths = 119;
    const Crossings crossings = parse_crossings(query.transmission);
    const SimulationPlan plan = parse_simulation(surface, query, crossings);
    if (query.color.method != "auto")
        throw UsageError("--method: requires --paths single or all (got '" + query.paths + "')");
    const ColorColumns columns(query.color);
    const Sensitivity& sensitivity = columns.illumination().tables.sensitivity();
    report_held_layers(surface, document, sensitivity, query);
    const LayeredScattering scattering(held_surface(surface, sensitivity), crossings,
                                       query.execution);
    const SampleRule rule = equal_rule(sensitivity, kWavelengths);
    LayeredSimulation simulation(scattering, plan.request, rule.wavelength_nm, query.execution);
    const bool is_brdf = query.quantity == "brdf";
    if (!is_brdf && query.quantity != "albedo")
        throw UsageError("--color: requires --quantity brdf or albedo (got '" + query.quantity +
                         "')");
    LayeredSimulation::ColorWeights weights = rule.weight;
    for (std::size_t c = 0; c < 3; ++c) {
        double light = 0;
        for (const double weight : weights[c]) light += weight;
        for (double& weight : weights[c])
            weight *= (is_brdf ? kPi : 1) * sensitivity.white()[c] / light;
    }
    simulation.set_colors(std::move(weights));
    NumberColumns keys;
    std::function<LayeredSimulation::Values()> once;
    if (is_brdf) {
        const std::vector<Directions> directions = parse_directions(query.directions);
        keys = direction_columns(directions, 1);
        once = [&simulation, pairs = pairs_of(directions)] { return simulation.brdf(pairs); };
    } else {
        const std::vector<double> thetas = parse_light_thetas(query.directions);
        keys.emplace_back("light_theta_deg", thetas);
        once = [&simulation, thetas] { return simulation.albedo(thetas); };
    }
    const std::vector<std::string> names{"X", "Y", "Z"};
    const SimulatedValues simulated = simulate(document, plan, simulation, once, keys, names, 1);
    std::vector<Triple> xyz;
    for (std::size_t k = 0; k < simulated.values.mean.size(); k += 3)
        xyz.push_back(
            {simulated.values.mean[k], simulated.values.mean[k + 1], simulated.values.mean[k + 2]});
    SurfaceRows rows = columns.rows(std::move(keys), xyz);
    add_simulated_columns(simulated, names, rows);
    if (simulated.shard) add_shard_marks(query, rows);
    return rows;
}

/// Colours of a layered surface.
SurfaceRows layered_colors(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                           const SurfaceQuery& query) {
    if (is_simulated(query)) return simulated_colors(surface, document, query);
    require_no_simulation(query);
    const ColorColumns columns(query.color);
    const double tolerance = parse_tolerance(query.color.tolerance);
    const Illumination& illumination = columns.illumination();
    report_held_layers(surface, document, illumination.tables.sensitivity(), query);
    const ColorMethod method = parse_method(query.color);
    const bool is_approximate = !method.is("auto");
    const Crossings crossings = parse_crossings(query.transmission);
    const LayeredColor color(illumination.tables, surface, crossings, tolerance, query.execution,
                             method);
    if (is_approximate && (query.quantity != "brdf" || color.scattering().layers() != 1 ||
                           color.scattering().has_base()))
        throw UsageError("--method: takes the BRDF of one rough layer over a black base");
    const Paths paths = parse_paths(query.paths);
    NumberColumns keys;
    std::vector<SurfaceColor> colors;
    if (query.quantity == "brdf") {
        const std::vector<Directions> directions = parse_directions(query.directions);
        colors = color.brdf(pairs_of(directions), paths);
        if (is_approximate && !query.color.tolerance.empty())
            measure(colors, LayeredColor(illumination.tables, surface, crossings, tolerance,
                                         query.execution)
                                .brdf(pairs_of(directions), paths));
        keys = direction_columns(directions, 1);
    } else if (query.quantity == "albedo") {
        const std::vector<double> thetas = parse_light_thetas(query.directions);
        colors = color.albedo(thetas, paths);
        keys.emplace_back("light_theta_deg", thetas);
    } else {
        throw UsageError("--color: requires --quantity brdf or albedo (got '" + query.quantity +
                         "')");
    }
    const bool is_added = paths == Paths::all && !color.scattering().is_closed();
    if (!is_approximate || !query.color.tolerance.empty())
        check_tolerance(document, query, is_added, colors);
    std::vector<Triple> xyz;
    for (const SurfaceColor& one : colors) xyz.push_back(one.xyz);
    return columns.rows(std::move(keys), xyz);
}

/// Light that is refracted into the substrate, at wavelengths.
SurfaceRows refracted_rows(const LayeredSurface& surface, const SurfaceQuery& query) {
    const RoughLayer& layer = refracting_layer(surface, query);
    const std::vector<Directions> directions = parse_directions(query.directions);
    const std::size_t W = query.wavelengths_nm.size();
    require_few_rows(static_cast<double>(directions.size()) * static_cast<double>(W));
    auto columns = direction_columns(directions, W);
    Numbers wavelength;
    for (std::size_t i = 0; i < directions.size(); ++i)
        wavelength.insert(wavelength.end(), query.wavelengths_nm.begin(),
                          query.wavelengths_nm.end());
    columns.emplace_back("wavelength_nm", std::move(wavelength));
    columns.emplace_back("btdf_per_sr", RefractedLight(layer.stack, layer.alpha, query.execution)
                                            .btdf(pairs_of(directions), query.wavelengths_nm));
    return rows_of(std::move(columns), 5);
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
            simulation_ = parse_simulation(surface, query, parse_crossings(query.transmission));
        else
            require_no_simulation(query);
    }

    SurfaceRows rows() const {
        if (query_.quantity == "brdf") return brdf();
        if (query_.quantity == "albedo") return albedo();
        if (is_simulated(query_))
            throw UsageError("--paths " + query_.paths +
                             ": requires --quantity brdf or albedo (got '" + query_.quantity +
                             "')");
        if (query_.quantity == "transmissivity") return transmissivity();
        if (query_.quantity == "sampling") return sampling();
        constexpr std::array<std::string_view, 4> names{"brdf", "albedo", "transmissivity",
                                                        "sampling"};
        throw UsageError("--quantity of a layered surface: " + not_one_of(names, query_.quantity));
    }

private:
    const std::vector<double>& wavelengths() const { return query_.wavelengths_nm; }

    /// Whether all paths are requested and have no closed form.
    bool is_added() const { return paths_ == Paths::all && !scattering_.is_closed(); }
    Paths closed_paths() const { return is_added() ? Paths::single : paths_; }

    /// Adds the remaining paths to single reflections. A given tolerance is enforced; otherwise a
    /// note says what is not met.
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
        if (is_simulated(query_))
            return simulated(
                std::move(columns), "brdf_per_sr",
                [&](const LayeredSimulation& simulation) { return simulation.brdf(pairs); });
        Numbers f = scattering_.brdf(pairs, wavelengths(), closed_paths());
        if (is_added())
            add(f, [&](const Adding& adding) { return adding.brdf_rest(pairs, wavelengths()); });
        columns.emplace_back("brdf_per_sr", std::move(f));
        return rows_of(std::move(columns), 5);
    }

    SurfaceRows albedo() const {
        const std::vector<double> thetas = parse_light_thetas(query_.directions);
        Numbers theta, wavelength;
        for (const double angle : thetas)
            for (const double nm : wavelengths()) {
                theta.push_back(angle);
                wavelength.push_back(nm);
            }
        NumberColumns columns{{"light_theta_deg", std::move(theta)},
                              {"wavelength_nm", std::move(wavelength)}};
        if (is_simulated(query_))
            return simulated(
                std::move(columns), "albedo",
                [&](const LayeredSimulation& simulation) { return simulation.albedo(thetas); });
        Numbers a = scattering_.albedo(thetas, wavelengths(), closed_paths());
        if (is_added())
            add(a, [&](const Adding& adding) { return adding.albedo_rest(thetas, wavelengths()); });
        columns.emplace_back("albedo", std::move(a));
        return rows_of(std::move(columns), 2);
    }

    /// Rows of means and standard errors. by(simulation)  its values
    template <class By>
    SurfaceRows simulated(NumberColumns keys, const char* name, const By& by) const {
        LayeredSimulation simulation(scattering_, simulation_.request, wavelengths(),
                                     query_.execution);
        SimulatedValues found = simulate(
            document_, simulation_, simulation, [&] { return by(simulation); }, keys, {name}, 0);
        const std::size_t key_count = keys.size();
        keys.emplace_back(name, found.values.mean);
        SurfaceRows rows = rows_of(std::move(keys), key_count);
        add_simulated_columns(found, {name}, rows);
        if (found.shard) add_shard_marks(query_, rows);
        return rows;
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
    SimulationPlan simulation_;
};

}  // namespace

SurfaceRows rows_of_surface(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                            const SurfaceQuery& query) {
    if (const std::string typed = query.scratch.typed(); !typed.empty())
        throw UsageError(typed + " applies to surfaces with scratches only");
    try {
        const bool is_transmitted = wants_transmission(query);
        if (!query.wants_color && query.color.method != "auto")
            throw UsageError("--method: requires --color");
        if (is_transmitted)
            return query.wants_color ? refracted_colors(surface, document, query)
                                     : refracted_rows(surface, query);
        return query.wants_color ? layered_colors(surface, document, query)
                                 : LayeredAnswers(surface, document, query).rows();
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
}

}  // namespace irido::cli
