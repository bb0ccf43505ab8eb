#include <algorithm>
#include <array>

#include "cli/queries/surface_colors.hpp"
#include "cli/queries/surface_query.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "schemas/documents/light_document.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

namespace {

using ScratchNumbers = tables::Column::Numbers;

ScratchNumbers repeated(const ScratchNumbers& numbers, std::size_t times) {
    ScratchNumbers all;
    for (std::size_t i = 0; i < times; ++i) all.insert(all.end(), numbers.begin(), numbers.end());
    return all;
}

std::vector<SkyPair> sky_pairs(const std::vector<Directions>& directions) {
    std::vector<SkyPair> pairs;
    for (const Directions& one : directions)
        pairs.push_back({direction_of(one.light_theta_deg, one.light_phi_deg),
                         direction_of(one.view_theta_deg, one.view_phi_deg)});
    return pairs;
}

ScratchSight sight_of(const ScratchOptions& options) {
    if (const auto footprint = parse_footprint(options)) return *footprint;
    return parse_at(options);
}

/// Evaluates a scratched surface.
class ScratchAnswers {
public:
    ScratchAnswers(const ScratchedSurface& surface, const schemas::SurfaceDocument& document,
                   const SurfaceQuery& query)
        : surface_(surface),
          document_(document),
          query_(query),
          sum_(parse_scratch_sum(query.scratch)),
          method_(parse_light_integral(query.scratch)),
          scattering_(surface, sight_of(query.scratch), sum_, query.execution) {
        constexpr std::array<std::string_view, 2> quantities{"brdf", "density"};
        if (std::ranges::find(quantities, query.quantity) == quantities.end())
            throw UsageError("--quantity of a scratched surface: " +
                             not_one_of(quantities, query.quantity));
        if (query.paths != "single" || query.transmission != "single")
            throw UsageError("--paths and --transmission apply to layered surfaces only");
        if (!query.samples.empty() || !query.facets.empty() || query.scatterogram)
            throw UsageError(
                "--samples, --facets and --scatterogram apply to layered surfaces only");
        if (!query.shard.empty() || !query.merge.empty())
            throw UsageError("--shard and --merge apply to simulations of layered surfaces only");
        if (query.color.sides != "R" || query.color.method != "auto")
            throw UsageError("--side and --method apply to layered surfaces only");
        if (!query.seed.empty())
            throw UsageError("--seed: is of simulations; --set seed=N is of fields of scratches");
        if (sum_.kind == ScratchSum::Kind::ensemble && surface.fields.empty())
            throw UsageError("--ensemble: requires fields of scratches");
        if (!query.scratch.area_light.empty() && method_.kind != LightIntegral::Kind::exact &&
            scattering_.ends_nearby())
            query.note(
                "ends of scratches lie within 3 coherence radii: only --light-integral exact "
                "accounts for them");
    }

    SurfaceRows rows() const {
        if (query_.quantity == "density") return density();
        if (!query_.scratch.area_light.empty())
            return query_.wants_color ? light_colors() : light();
        return query_.wants_color ? colors() : brdf();
    }

private:
    /// Notes materials of the base that colours clamp to their end values.
    void report_held_base(const ColorColumns& columns) const {
        if (!surface_.base) return;
        schemas::StackDocument base;
        base.stack = *surface_.base;
        base.file = document_.file;
        base.material_pointers.assign(base.stack.materials.size(), "/base");
        report_held_ranges(base, columns.illumination().tables.sensitivity(), query_.color.strict,
                           query_.note);
    }

    SurfaceRows density() const {
        if (query_.wants_color || !query_.scratch.area_light.empty())
            throw UsageError("--quantity density: cannot be combined with --color and lights");
        const SurfacePoint at = parse_at(query_.scratch);
        return rows_of({{"x_um", ScratchNumbers{at.x_um}},
                        {"y_um", ScratchNumbers{at.y_um}},
                        {"density", ScratchNumbers{scattering_.density()}}},
                       2);
    }

    SurfaceRows brdf() const {
        const std::vector<Directions> directions = parse_directions(query_.directions);
        const std::vector<double>& wavelengths = query_.wavelengths_nm;
        require_few_rows(static_cast<double>(directions.size()) *
                         static_cast<double>(wavelengths.size()));
        auto columns = direction_columns(directions, wavelengths.size());
        columns.emplace_back("wavelength_nm", repeated(wavelengths, directions.size()));
        columns.emplace_back("brdf_per_sr", scattering_.brdf(sky_pairs(directions), wavelengths));
        return rows_of(std::move(columns), 5);
    }

    SurfaceRows colors() const {
        const std::vector<Directions> directions = parse_directions(query_.directions);
        require_few_rows(static_cast<double>(directions.size()));
        const ColorColumns columns(query_.color);
        report_held_base(columns);
        std::vector<Triple> xyz =
            scattering_.colors(sky_pairs(directions), columns.illumination().tables.sensitivity());
        for (Triple& color : xyz)
            for (double& value : color) value *= kPi;
        return columns.rows(direction_columns(directions, 1), xyz);
    }

    std::vector<LightCone> lights() const {
        const DirectionOptions untyped;
        const DirectionOptions& typed = query_.directions;
        if (typed.light_theta != untyped.light_theta || typed.light_phi != untyped.light_phi ||
            !typed.file.empty())
            throw UsageError(
                "--area-light cannot be combined with --light-theta, --light-phi and --directions");
        std::vector<LightCone> cones;
        for (const AreaLight& light : schemas::read_lights(query_.scratch.area_light))
            cones.emplace_back(light);
        return cones;
    }

    /// Angles of all views, each repeated for its rows.
    NumberColumns view_columns(std::vector<UnitVector>& views, std::size_t times) const {
        NumberColumns columns{{"view_theta_deg", {}}, {"view_phi_deg", {}}};
        for (const Directions& one : parse_directions(query_.directions)) {
            views.push_back(direction_of(one.view_theta_deg, one.view_phi_deg));
            columns[0].second.insert(columns[0].second.end(), times, one.view_theta_deg);
            columns[1].second.insert(columns[1].second.end(), times, one.view_phi_deg);
        }
        require_few_rows(static_cast<double>(views.size()) * static_cast<double>(times));
        return columns;
    }

    SurfaceRows light() const {
        const std::vector<LightCone> cones = lights();
        const std::vector<double>& wavelengths = query_.wavelengths_nm;
        std::vector<UnitVector> views;
        NumberColumns columns = view_columns(views, wavelengths.size());
        columns.emplace_back("wavelength_nm", repeated(wavelengths, views.size()));
        columns.emplace_back("radiance_ratio",
                             scattering_.light_ratios(cones, views, wavelengths, method_));
        return rows_of(std::move(columns), 3);
    }

    SurfaceRows light_colors() const {
        const std::vector<LightCone> cones = lights();
        std::vector<UnitVector> views;
        NumberColumns keys = view_columns(views, 1);
        const ColorColumns columns(query_.color);
        report_held_base(columns);
        return columns.rows(
            std::move(keys),
            scattering_.light_colors(cones, views, columns.illumination().tables.sensitivity(),
                                     method_));
    }

    const ScratchedSurface& surface_;
    const schemas::SurfaceDocument& document_;
    const SurfaceQuery& query_;
    ScratchSum sum_;
    LightIntegral method_;
    ScratchedScattering scattering_;
};

}  // namespace

SurfaceRows rows_of_surface(const ScratchedSurface& surface,
                            const schemas::SurfaceDocument& document, const SurfaceQuery& query) {
    try {
        return ScratchAnswers(surface, document, query).rows();
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
}

}  // namespace irido::cli
