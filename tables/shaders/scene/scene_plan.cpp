#include "tables/shaders/scene/scene_plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/color/fourier/film_color.hpp"
#include "core/color/held_stack.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/sensitivity_transform.hpp"
#include "core/error.hpp"
#include "core/film/film.hpp"
#include "core/stack/index_table.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/documents/varied_stack.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/index_rows.hpp"
#include "tables/files/hash.hpp"
#include "tables/lut/color_values.hpp"
#include "tables/shaders/scene/scene_problems.hpp"
#include "tables/shaders/scene/scratched_material.hpp"

namespace irido::tables {

namespace {

using nlohmann::json;
using Kind = Omission::Kind;

constexpr double kMiddle_nm = kShaderIndices_nm;
constexpr std::size_t kRangeSize = 16;  ///< initial size of a range sized by the tolerance
constexpr double kRed_nm = 700;         ///< fringes at longer wavelengths are hardly visible

std::vector<double> samples_of(const schemas::ValueRange& range) {
    if (range.is_one()) return {range.first};
    return equally_spaced(range.first, range.last, kRangeSize);
}

/// Cosines from the largest angle to the smallest, that is ascending.
std::vector<double> cosines_of(const schemas::ValueRange& angles_deg) {
    return samples_of({cos_of_incidence(angles_deg.last), cos_of_incidence(angles_deg.first)});
}

double square(double x) {
    return x * x;
}

std::string in_text(const schemas::ValueRange& range) {
    return to_text(range.first) + " to " + to_text(range.last);
}

/// The option of a request that holds cosines of angles; "" if there is none.
std::string angle_option(const LutRequest& request) {
    for (const char* name : {"cos", "cos-theta"})
        if (request.has(name)) return name;
    return "";
}

/// Plans the materials one by one.
class Planner {
public:
    Planner(const schemas::Scene& scene, const Execution& execution)
        : scene_(scene),
          execution_(execution),
          sensitivity_(std::make_shared<Sensitivity>(observer(scene.observer_deg),
                                                     illuminant(scene.illuminant))) {}

    LutRequest color_request(const schemas::SceneMaterial& material) const {
        LutRequest request = request_of(material);
        request.options["cos"] = cosines_of(material.angles_deg);
        return request;
    }

    ScenePlan run() {
        for (const schemas::SceneMaterial& material : scene_.materials) {
            MaterialPlan& plan = result_.materials.emplace_back();
            plan.name = material.name;
            plan.shading = material.shading;
            plan.angles_deg = material.angles_deg;
            plan.vary = material.vary;
            plan.faults = material.faults;
            const std::size_t omissions = result_.omissions.size();
            try {
                if (plan.faults.empty()) plan.faults = shading_faults(material);
                if (plan.faults.empty()) plan_material(material, plan);
            } catch (const std::exception& error) {  // of any type: affects only this material
                plan.faults.push_back(schemas::fault_of(material, error));
                plan.tables.clear();
                result_.omissions.resize(omissions);
            }
        }
        drop_unused();
        result_.white_xyz = sensitivity_->white();
        const RgbTransform transform(
            rgb_space(scene_.space), result_.white_xyz,
            scene_.adaptation == "none" ? Adaptation::none : Adaptation::bradford);
        for (std::size_t column = 0; column < 3; ++column) {
            Triple unit{};
            unit[column] = 1;
            const Triple rgb = scene_.space == "xyz" ? unit : transform(unit);
            for (std::size_t row = 0; row < 3; ++row) result_.rgb_from_xyz[row][column] = rgb[row];
        }
        return std::move(result_);
    }

private:
    /// Requests in the scene that the shading does not support.
    std::vector<schemas::SceneFault> shading_faults(const schemas::SceneMaterial& material) const {
        const std::string name(name_of(material.shading));
        std::vector<schemas::SceneFault> faults;
        const auto add = [&](const std::string& step, const std::string& reason) {
            faults.push_back({material.pointer + step, reason});
        };
        const bool is_rough_layers = material.shading == schemas::Shading::rough_layers;
        if (!material.is_rough && (is_rough_layers || material.shading == schemas::Shading::facets))
            add("", name + " needs \"roughness\"");
        if (is_rough_layers || (material.shading == schemas::Shading::albedo && material.is_rough))
            for (const schemas::VariedRange& vary : material.vary)
                if (!vary.range.is_one())
                    add("/vary" + schemas::pointer_step(vary.path),
                        "shading " + name + " takes no varied value (got " + in_text(vary.range) +
                            ")");
        if (material.shading == schemas::Shading::bragg)
            if (const std::string fault = mirror_fault(material.document.stack); !fault.empty())
                add("/shading", "bragg needs " + fault);
        return faults;
    }

    void plan_material(const schemas::SceneMaterial& material, MaterialPlan& plan) {
        if (material.document.stack.materials.empty()) return plan_scratches(material, plan);
        for (const HeldRange& held : held_ranges(material.document.stack, *sensitivity_))
            if (!held.usable)
                throw schemas::InputError(
                    material.source.file, material.document.material_pointers[held.material],
                    material.document.stack.materials[held.material].name + " is known from " +
                        schemas::in_words(held.range) + "; a colour needs data from 400 to 700 nm");
        const schemas::ValueRange all_angles{0, 90};
        if (material.angles_deg.first > all_angles.first ||
            material.angles_deg.last < all_angles.last)
            omit(material, "angles",
                 "those outside " + in_text(material.angles_deg) + " degrees do not occur",
                 Kind::given);
        for (const schemas::VariedRange& vary : material.vary)
            if (vary.range.is_one())
                omit(material, vary.path, "is always " + to_text(vary.range.first), Kind::given);
        plan_ignored(material);
        switch (material.shading) {
            case schemas::Shading::color:
            case schemas::Shading::facets:
                return plan_color(material, plan);
            case schemas::Shading::fourier:
                return plan_fourier(material, plan);
            case schemas::Shading::bragg:
                return plan_bragg(material, plan);
            case schemas::Shading::rough_layers:
                return plan_rough_layers(material, plan);
            case schemas::Shading::albedo:
                return plan_albedo(material, plan);
            case schemas::Shading::scratches:
                return plan_scratches(material, plan);
        }
    }

    /// Lists settings that this shading ignores.
    void plan_ignored(const schemas::SceneMaterial& material) {
        const schemas::Shading shading = material.shading;
        const std::string name(name_of(shading));
        if (material.is_rough &&
            (shading == schemas::Shading::color || shading == schemas::Shading::fourier ||
             shading == schemas::Shading::bragg))
            omit(material, "roughness", "the shading " + name + " is for smooth surfaces only",
                 Kind::loss);
        if (material.thickness_spread_nm != 0 &&
            (shading == schemas::Shading::bragg || shading == schemas::Shading::rough_layers ||
             (shading == schemas::Shading::albedo && material.is_rough)))
            omit(material, "mip levels", "the shading " + name + " ignores thickness_spread_nm",
                 Kind::loss);
        const bool has_constants =
            shading == schemas::Shading::fourier || shading == schemas::Shading::bragg;
        const bool has_dispersion = !std::ranges::all_of(
            material.document.stack.materials, [](const Material& m) { return is_constant(m); });
        if (has_constants && has_dispersion)
            omit(material, "dispersion",
                 "the shader uses the indices at " + to_text(kMiddle_nm) + " nm", Kind::loss);
    }

    void omit_transmission(const schemas::SceneMaterial& material, const std::string& reason) {
        if (material.transmission)
            omit(material, "transmission", reason);
        else
            omit(material, "transmission", "was not requested", Kind::given);
    }

    void omit(const schemas::SceneMaterial& material, const std::string& what,
              const std::string& reason, Kind kind = Kind::skipped) {
        result_.omissions.push_back({material.name, what, reason, kind});
    }

    /// The request to a kind of table, without its own options.
    LutRequest request_of(const schemas::SceneMaterial& material) const {
        LutRequest request;
        request.execution = execution_;
        request.source = material.source;
        request.document = material.document;
        request.sensitivity = sensitivity_;
        request.illuminant = scene_.illuminant;
        request.observer = std::to_string(scene_.observer_deg);
        request.color.simd = execution_.simd;
        request.space = &rgb_space(scene_.space);
        request.adaptation = scene_.adaptation == "none" ? Adaptation::none : Adaptation::bradford;
        for (const schemas::VariedRange& vary : material.vary)
            if (!vary.range.is_one()) request.vary.push_back({vary.path, samples_of(vary.range)});
        return request;
    }

    LutMaking making_of(bool is_color) const {
        LutMaking making;
        making.sizing.tolerance = is_color ? scene_.delta_e : scene_.relative;
        making.type = find_lut_type(scene_.type).value_or(making.type);
        making.mips = scene_.format == "ktx2";
        return making;
    }

    /// Adds a table, or reuses an equal one.
    void use(const schemas::SceneMaterial& material, MaterialPlan& plan, const std::string& role,
             std::string_view kind, LutRequest request, const LutMaking& making) {
        SceneTable table;
        table.kind = find_lut_kind(kind);
        table.request = std::move(request);
        table.making = making;
        if (!angle_option(table.request).empty()) {
            table.largest_angle_deg = material.angles_deg.last;
            table.may_end_early = !material.has_angles;
        }
        table.inputs = inputs_of(table);
        add_table(material, plan, role, std::move(table), scene_.format);
    }

    void add_table(const schemas::SceneMaterial& material, MaterialPlan& plan,
                   const std::string& role, SceneTable table, const std::string& format) {
        table.id = sha256_of(table.inputs.dump()).substr(0, 16);
        table.file = std::string(table.kind_name()) + "-" + table.id + "." + format;
        const auto same = std::ranges::find(result_.tables, table.id, &SceneTable::id);
        const auto place = static_cast<std::size_t>(same - result_.tables.begin());
        if (same == result_.tables.end()) result_.tables.push_back(std::move(table));
        std::vector<std::string>& users = result_.tables[place].materials;
        if (!users.empty() && users.front() != material.name)
            omit(material, role, "the same physics as " + users.front() + ": one table for both");
        users.push_back(material.name);
        plan.tables.push_back({role, place});
    }

    /// All inputs that affect a table's values.
    json inputs_of(const SceneTable& table) const {
        const LutRequest& request = table.request;
        json inputs = {{"numbers", kNumbersVersion},
                       {"kind", table.kind->name},
                       {"tolerance", *table.making.sizing.tolerance},
                       {"type", name_of(table.making.type)},
                       {"mips", table.making.mips},
                       {"format", scene_.format}};
        for (const auto& [name, value] : request.options)
            std::visit([&, &key = name](const auto& v) { inputs["options"][key] = v; }, value);
        if (table.kind->stack) inputs["stack"] = schemas::canonical_stack(request.document.stack);
        if (table.may_end_early) inputs["may_end_early"] = true;
        for (const VariedValue& vary : request.vary)
            inputs["vary"][vary.path] = {vary.values.front(), vary.values.back()};
        if (table.kind->stack && !request.vary.empty()) inputs["stack_at_end"] = end_of(request);
        if (table.kind->light) inputs["light"] = {request.illuminant, request.observer};
        if (table.kind->space) inputs["space"] = request.space->name;
        if (table.kind->color)
            inputs["color"] = {request.space->name, request.adaptation == Adaptation::none,
                               request.color.sides.front() == Side::reflected,
                               static_cast<int>(request.color.light)};
        return inputs;
    }

    /// The stack at the other end of the varied ranges: a path may affect more than its own value,
    /// for example a material shared by several layers.
    static json end_of(const LutRequest& request) {
        std::vector<double> last;
        for (const VariedValue& vary : request.vary) last.push_back(vary.values.back());
        return schemas::canonical_stack(
            schemas::VariedStack(request.source, paths_of(request.vary)).at(last));
    }

    // --- colours ----------------------------------------------------------------------------

    void plan_color(const schemas::SceneMaterial& material, MaterialPlan& plan) {
        LutRequest request = color_request(material);
        if (material.angles_deg.last == 0) {
            request.color.light = Light::s;
            omit(material, "polarization p", "at normal incidence both are the same");
        }
        plan_spread(material, request);
        use(material, plan, "reflection", "color", request, making_of(true));
        plan.snippets = {"color"};
        if (material.shading == schemas::Shading::facets) {
            plan.snippets.emplace_back("facets");
            plan.constants["alpha"] = {material.alpha.first, material.alpha.last};
            omit_transmission(material, "facets is for reflected light only");
        } else if (!material.transmission) {
            omit_transmission(material, "");
        } else if (is_opaque(material.document.stack, *sensitivity_)) {
            omit(material, "transmission", "the base absorbs all that enters it");
        } else {
            request.color.sides = {Side::transmitted};
            use(material, plan, "transmission", "color", request, making_of(true));
        }
    }

    /// Standard deviations of the thickness, for use as mip levels.
    void plan_spread(const schemas::SceneMaterial& material, LutRequest& request) {
        const double spread = material.thickness_spread_nm;
        if (spread == 0)
            return omit(material, "mip levels", "no thickness_spread_nm is given", Kind::given);
        if (request.vary.size() != 1 || !request.vary.front().path.ends_with("thickness_nm"))
            return omit(material, "mip levels", "the one value that varies must be a thickness",
                        Kind::loss);
        request.options["sigma"] = std::vector{0.0, spread / 4, spread / 2, spread};
    }

    // --- the series in the shader -----------------------------------------------------------

    /// Films at the ends and midpoints of the varied ranges, with the shaders' indices.
    std::vector<Film> films_of(const schemas::SceneMaterial& material) const {
        const LutRequest request = request_of(material);
        const std::vector<std::string> paths = paths_of(request.vary);
        const schemas::VariedStack varied(material.source, paths);
        std::vector<Film> films;
        const std::size_t steps = paths.empty() ? 1 : kRangeSize;
        for (std::size_t i = 0; i < steps * (paths.size() > 1 ? steps : 1); ++i) {
            std::vector<double> values;
            if (!paths.empty()) values.push_back(request.vary[0].values[i % steps]);
            if (paths.size() > 1) values.push_back(request.vary[1].values[i / steps]);
            const Stack stack = varied.at(values);
            const std::string fault = stack.elements.empty() ? "no layer" : film_fault(stack);
            if (!fault.empty())
                throw schemas::InputError(
                    "", material.pointer + "/shading",
                    "fourier needs one coherent film of a real index (got " + fault + ")");
            films.push_back(shader_film(stack));
        }
        return films;
    }

    void plan_fourier(const schemas::SceneMaterial& material, MaterialPlan& plan) {
        const std::vector<Film> films = films_of(material);
        const bool is_real =
            std::ranges::all_of(films, [](const Film& f) { return f.base.imag() == 0; });
        const Film& first = films.front();
        plan.constants = {{"n1", first.incident},
                          {"n2", first.film},
                          {"n3", {first.base.real(), first.base.imag()}},
                          {"thickness_nm", first.thickness_nm},
                          {"at_nm", kMiddle_nm}};
        plan.snippets = {"fourier"};
        double longest_nm = 0;
        const int orders = orders_of(material, films, longest_nm);
        plan.constants["orders"] = orders;
        omit_transmission(material, is_real ? "what is not reflected is transmitted"
                                            : "the base absorbs all that enters it");
        if (orders == 0)
            return omit(material, "sensitivity",
                        "no fringes are left at these optical path differences: C_0 only");
        if (std::ranges::any_of(films, [&](const Film& f) {
                return f.incident *
                           std::sqrt(1 - square(cos_of_incidence(material.angles_deg.last))) >=
                       f.film;
            }))
            omit(material, kPastCriticalAngle,
                 "the series cannot represent it: the shader gives white (the shading color is "
                 "exact)",
                 Kind::loss);
        omit(material, "orders " + std::to_string(orders + 1) + " and above",
             "are below the tolerance");
        LutRequest request = request_of(material);
        request.vary.clear();
        request.options["opd"] = equally_spaced(0, longest_nm, kRangeSize);
        request.options["opd-max"] = longest_nm;
        const std::vector<double> sigmas = sigmas_of(material, films, orders);
        request.options["sigma"] = sigmas;
        plan.constants["level_sigma_nm"] = sigmas.size() > 1 ? sigmas : std::vector<double>(4, 0.0);
        if (is_real) {
            request.options["real"] = std::string("true");
            omit(material, "imaginary half", "the base does not absorb: its phase is 0 or pi");
        } else {
            request.options["carrier"] = std::string("true");
        }
        use(material, plan, "sensitivity", "sensitivity", std::move(request), making_of(false));
    }

    /// The last significant order, and the largest significant path difference m D.
    int orders_of(const schemas::SceneMaterial& material, const std::vector<Film>& films,
                  double& longest_nm) const {
        constexpr int most = 1000, angles = 17;
        const SensitivityTransform& transform = this->transform();
        int orders = 0;
        for (const double angle_deg :
             equally_spaced(material.angles_deg.first, material.angles_deg.last, angles))
            for (const Film& film : films)
                for (const Polarization p : {Polarization::s, Polarization::p}) {
                    const auto series = film_series(film, incident_angle(angle_deg), p);
                    if (!series) continue;
                    for (int m = 1; m <= most; ++m) {
                        const double path = m * series->opd_nm;
                        const double size = 2 * std::abs(series->coefficient(false, m));
                        if (size < scene_.relative) break;
                        if (size * transform.bound(path) < scene_.relative) continue;
                        orders = std::max(orders, m);
                        longest_nm = std::max(longest_nm, path);
                    }
                }
        longest_nm = std::max(1.0, std::ceil(longest_nm));
        return orders;
    }

    /// Standard deviations of the optical path difference. For order m it is m 2 n2 cos(theta2)
    /// sigma, where sigma is that of the thickness; the shader picks the level for each order. The
    /// last level is the largest that occurs, or one at which the fringes have vanished.
    std::vector<double> sigmas_of(const schemas::SceneMaterial& material,
                                  const std::vector<Film>& films, int orders) {
        const double spread = material.thickness_spread_nm;
        if (spread == 0) {
            omit(material, "mip levels", "no thickness_spread_nm is given", Kind::given);
            return {0};
        }
        double largest = 0;
        for (const Film& film : films) largest = std::max(largest, 2 * film.film * orders * spread);
        // exp(-2 pi^2 sigma^2 / lambda^2) is below the tolerance
        const double gone =
            kRed_nm * std::sqrt(std::log(1 / scene_.relative) / 2) / std::numbers::pi;
        if (largest > gone && gone > 0)
            omit(material,
                 "standard deviations from " + to_text(std::ceil(gone)) + " nm of path difference",
                 "no fringes are left there");
        const double most = std::max(1.0, std::ceil(std::min(largest, gone)));
        return {0, most / 4, most / 2, most};
    }

    const SensitivityTransform& transform() const {
        constexpr double opd_max_nm = 2e5, accuracy = 1e-8;
        if (!transform_)
            transform_ =
                std::make_shared<SensitivityTransform>(*sensitivity_, opd_max_nm, accuracy);
        return *transform_;
    }

    // --- Yeh's reflectance in the shader ------------------------------------------------------

    void plan_bragg(const schemas::SceneMaterial& material, MaterialPlan& plan) {
        const Stack& stack = material.document.stack;
        const auto& group = std::get<Group>(stack.elements[0].value);
        const auto& first = std::get<Layer>(group.elements[0].value);
        const auto& second = std::get<Layer>(group.elements[1].value);
        const IndexTable table(stack, {kMiddle_nm});
        plan.constants = {{"n1", table.n(first.material, 0)},  {"d1_nm", first.thickness_nm},
                          {"n2", table.n(second.material, 0)}, {"d2_nm", second.thickness_nm},
                          {"periods", group.repeat},           {"at_nm", kMiddle_nm}};
        plan.snippets = {"bragg", "cumulative"};
        omit(material, "color", "closed form in the shader: snippet bragg");
        omit_transmission(material, "what is not reflected is transmitted");
        LutRequest request = request_of(material);
        request.vary.clear();
        request.options["wavelengths"] = equally_spaced(
            sensitivity_->support().first_nm, sensitivity_->support().last_nm, kRangeSize);
        use(material, plan, "cumulative", "cumulative", std::move(request), making_of(false));
    }

    // --- rough surfaces -----------------------------------------------------------------------

    void plan_rough_layers(const schemas::SceneMaterial& material, MaterialPlan& plan) {
        omit_transmission(material, "rough-layers is for reflected light only");
        if (is_opaque(material.document.stack, *sensitivity_)) {
            plan.constants = {{"ft_cos", 0}};
            omit(material, "transmissivity",
                 "the substrate keeps what passes: a path is always reflected, ft_cos = 0");
            return;
        }
        plan.snippets = {"transmissivity"};
        const std::vector<double> angles = samples_of(
            {material.angles_deg.first, std::min(material.angles_deg.last, kGrazing_deg)});
        if (material.alpha.is_one()) {
            LutRequest request = request_of(material);
            request.options["alpha"] = std::vector{material.alpha.first};
            request.options["theta-i"] = angles;
            request.options["theta-d"] = equally_spaced(0, kGrazing_deg, kRangeSize);
            use(material, plan, "falpha", "falpha", std::move(request), making_of(false));
            plan.snippets.emplace_back("falpha");
        } else {
            omit(material, "falpha", "closed form in the shader: snippet falpha-closed");
            plan.snippets.emplace_back("falpha-closed");
        }
        LutRequest request = request_of(material);
        request.options["alpha"] = samples_of(material.alpha);
        request.options["theta-i"] = angles;
        request.options["wavelengths"] = equally_spaced(
            sensitivity_->support().first_nm, sensitivity_->support().last_nm, kRangeSize);
        request.options["polarization"] = std::string("u");
        use(material, plan, "transmissivity", "transmissivity", std::move(request),
            making_of(false));
    }

    void plan_albedo(const schemas::SceneMaterial& material, MaterialPlan& plan) {
        if (!material.is_rough) {
            omit(material, "alpha", "the surface is smooth: its albedo is its colour");
            return plan_color(material, plan);
        }
        LutRequest request = request_of(material);
        request.options["cos-theta"] = cosines_of(material.angles_deg);
        request.options["alpha"] = samples_of(material.alpha);
        use(material, plan, "albedo", "albedo", std::move(request), making_of(true));
        plan.snippets = {"albedo"};
        omit_transmission(material, "albedo is for reflected light only");
    }

    void plan_scratches(const schemas::SceneMaterial& material, MaterialPlan& plan) {
        ScratchNeeds needs = needs_of_scratches(scene_, *material.scratches);
        plan.constants = needs.constants;
        plan.snippets = needs.snippets;
        for (ScratchNeed& need : needs.tables) {
            if (!need.is_needed) {
                omit(material, need.role + " table", need.why);
                continue;
            }
            LutRequest request = request_of(material);
            request.options = std::move(need.options);
            request.space = &rgb_space("xyz");
            LutMaking making = making_of(need.is_color);
            if (need.is_single) making.type = LutType::f32;
            use(material, plan, need.role, need.kind, std::move(request), making);
            plan.tables.back().why = std::move(need.why);
        }
        SceneTable grid;
        grid.grid = std::make_shared<const SceneGrid>(std::move(needs.grid));
        grid.making = making_of(false);
        grid.inputs = {{"numbers", kNumbersVersion}, {"grid", grid_checksum(*grid.grid)}};
        add_table(material, plan, "grid", std::move(grid), "bin");
        if (material.document.stack.materials.empty()) return;
        use(material, plan, "base", "color", color_request(material), making_of(true));
        plan.snippets.emplace_back("color");
        omit(material, kProductOfColors,
             "the shader multiplies the colours of scratches and base, not their spectra",
             Kind::loss);
    }

    /// Tables of materials that failed.
    void drop_unused() {
        std::vector<SceneTable> kept;
        std::map<std::size_t, std::size_t> places;
        for (MaterialPlan& material : result_.materials)
            for (MaterialPlan::Use& used : material.tables) {
                const auto [place, is_new] = places.try_emplace(used.table, kept.size());
                if (is_new) kept.push_back(std::move(result_.tables[used.table]));
                used.table = place->second;
            }
        result_.tables = std::move(kept);
    }

    static constexpr double kGrazing_deg = 89.75;

    const schemas::Scene& scene_;
    Execution execution_;
    std::shared_ptr<const Sensitivity> sensitivity_;
    mutable std::shared_ptr<const SensitivityTransform> transform_;
    ScenePlan result_;
};

}  // namespace

ScenePlan plan_scene(const schemas::Scene& scene, const Execution& execution) {
    return Planner(scene, execution).run();
}

LutRequest request_up_to(const SceneTable& table, double largest_angle_deg) {
    LutRequest request = table.request;
    auto& cosines = std::get<std::vector<double>>(request.options.at(angle_option(request)));
    cosines = samples_of({cos_of_incidence(largest_angle_deg), cosines.back()});
    return request;
}

LutRequest color_request_of(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                            const Execution& execution) {
    return Planner(scene, execution).color_request(material);
}

Film shader_film(const Stack& stack) {
    const Layer layer = only_film(stack);
    const IndexTable table(stack, {kMiddle_nm});
    return {table.n(stack.incident, 0), table.n(layer.material, 0), table.index(stack.substrate, 0),
            layer.thickness_nm};
}

const LutFormat& format_of(const schemas::Scene& scene) {
    return *find_lut_format(scene.format);
}

}  // namespace irido::tables
