#include "cli/comparison/asset.hpp"

#include <algorithm>
#include <array>

#include "core/coherent/fresnel.hpp"
#include "core/comparison/film_set.hpp"
#include "core/engines/series.hpp"
#include "schemas/documents/gltf_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::cli {

namespace {

/// Its real index, 9998, is within irido's range.
constexpr double kLargestF0 = 0.9996;

/// The material's film with one thickness, over the real index with its F0.
EngineFilm asset_film(const schemas::GltfIridescence& material, double thickness_nm) {
    EngineFilm film;
    film.film_n = material.film_n;
    film.thickness_nm = thickness_nm;
    for (std::size_t c = 0; c < 3; ++c)
        film.base_n[c] = index_of_f0(std::min(material.base_f0[c], kLargestF0));
    return film;
}

/// Applies the extension's factor, which blends between the bare base and the film.
void apply_factor(double factor, const ComparedFilm& film, const Triple& white,
                  const EngineDifference& difference, const ComparedEngine& engine,
                  EngineColor& color) {
    if (factor == 1) return;
    const double cos_theta = film.film.cos_theta;
    Triple rgb = color.rgb.value();
    for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = mixed(schlick(film.film.base_f0[c], cos_theta), rgb[c], factor);
    color.rgb = rgb;
    if (!color.exact_xyz) return;
    const double bare = bare_reflectance(film.film.base_n[0], 0, cos_theta);
    Triple xyz = *color.exact_xyz;
    for (std::size_t c = 0; c < 3; ++c) xyz[c] = mixed(bare * white[c], xyz[c], factor);
    color.exact_xyz = xyz;
    color.delta_e = difference(engine, rgb, xyz);
}

}  // namespace

tables::Records asset_rows(const std::string& file, const ComparisonQueryOptions& typed,
                           const Execution& execution,
                           const std::function<void(const std::string&)>& say) {
    ComparisonQueryOptions options = typed;
    if (options.comparison.engines == "all") options.comparison.engines = kAssetEngines;
    const ComparisonQuery query(options, {.execution = execution, .note = say});
    constexpr std::array<std::string_view, 5> kTakeF0{"gltf", "three", "babylon", "unity",
                                                      "materialx-gltf"};
    for (const ComparedEngine& engine : query.engines())
        if (std::ranges::find(kTakeF0, engine.name) == kTakeF0.end())
            throw UsageError("--engine: " + engine.name + " does not take the inputs of glTF");
    const std::string shown = schemas::shown_path(file);
    const auto materials = schemas::read_gltf(schemas::read_text(file), shown);
    if (materials.empty())
        throw schemas::InputError(shown, "", "no material has KHR_materials_iridescence");

    const Triple& white = query.tables().sensitivity().white();
    EngineRows rows(white);
    tables::Column::Texts name;
    tables::Column::Numbers thickness;
    ColorRequest request;
    request.tolerance = kComparisonTolerance;
    request.simd = execution.simd;
    for (const schemas::GltfIridescence& material : materials) {
        if (!material.textures.empty())
            say(shown + ": " + material.name + ": values of " + joined(material.textures, ", ") +
                " are not read");
        std::vector<double> ends{material.thinnest_nm};
        if (material.thickest_nm != material.thinnest_nm) ends.push_back(material.thickest_nm);
        for (const double thickness_nm : ends) {
            std::vector<ComparedFilm> films;
            for (const double angle_deg : query.angles_deg()) {
                films.push_back(compared_film("", angle_deg, asset_film(material, thickness_nm)));
                films.back().film.base_f0 = material.base_f0;
            }
            std::vector<EngineColor> colors = compare_films(query.tables(), query.engines(),
                                                            query.difference(), films, request, 1);
            for (std::size_t e = 0; e < query.engines().size(); ++e) {
                for (std::size_t f = 0; f < films.size(); ++f) {
                    const ComparedEngine& engine = query.engines()[e];
                    EngineColor& color = colors[f * query.engines().size() + e];
                    apply_factor(material.factor, films[f], white, query.difference(), engine,
                                 color);
                    rows.add(engine.name, films[f].angle_deg, color);
                    name.push_back(material.name);
                    thickness.push_back(thickness_nm);
                }
            }
        }
    }
    tables::Records records{
        {{"material", std::move(name)}, {"thickness_nm", std::move(thickness)}}};
    for (tables::Column& column : rows.take()) records.columns.push_back(std::move(column));
    return records;
}

}  // namespace irido::cli
