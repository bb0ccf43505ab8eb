#include "core/color/baselines/adapted_srgb.hpp"
#include "core/color/baselines/bare_base.hpp"
#include "core/color/baselines/closed_form.hpp"
#include "core/color/held_stack.hpp"
#include "core/engines/engine.hpp"
#include "core/engines/series.hpp"
#include "core/error.hpp"

namespace irido {

namespace {

class Gltf : public ClosedForm {
public:
    Gltf(const Sensitivity& sensitivity, const Stack& held, const Triple& base_color)
        : ClosedForm(middle_index("gltf", held), sensitivity.white(), "gltf"),
          xyz_from_rgb_(xyz_from_srgb(sensitivity.white())) {
        film_.outside_n = index_.incident;
        film_.film_n = index_.film.real();
        film_.base_f0 = base_color;
    }

private:
    Triple xyz(double cos_theta, const Medium&, double thickness_nm, double) const override {
        EngineFilm film = film_;
        film.cos_theta = cos_theta;
        film.thickness_nm = thickness_nm;
        return product(xyz_from_rgb_, gltf_reflectance(film));
    }

    ColorMatrix xyz_from_rgb_;
    EngineFilm film_;
};

std::unique_ptr<ColorAlgorithm> gltf_color(const ColorTables& tables, const Stack& stack,
                                           const ColorMethod& method, const ColorRequest& request) {
    const Stack held = held_stack(stack, tables.sensitivity());
    const Triple base_color =
        method.base_color ? *method.base_color : bare_base_color(tables, held, Material(), 1);
    if (request.light != Light::unpolarized)
        throw DomainError("method gltf must have unpolarized light (got " +
                          std::string(request.light == Light::s ? "s" : "p") + ")");
    for (const double component : base_color) require_in_range("base colour", component, 0, 1);
    return std::make_unique<Gltf>(tables.sensitivity(), held, base_color);
}

}  // namespace

/// What the glTF extension KHR_materials_iridescence tells a shader to do: BB17's series to order 2
/// with Schlick's terms, phases 0 or pi, a base of real index. Indices at 550 nm stand for all
/// wavelengths, at which the film must not absorb.
///
/// iridescenceIor and iridescenceThickness are the film's, outsideIor the incident medium's index.
/// Base F0, a colour, is the base colour of a metallic material, [0, 1] each: that of the bare base
/// in air at normal incidence as bare_base_color() has it, or ColorMethod::base_color. The result
/// is that of gltf_reflectance(), linear sRGB, adapted from its white to the illuminant's. The
/// formulas know no polarization: Light::unpolarized only.
/// Source: Khronos Group, KHR_materials_iridescence (2022), section Iridescence Fresnel.
extern constinit const ColorMethodKind color_method_gltf = {
    .name = "gltf",
    .place = 10,
    .help = "gltf (-p u): the formulas of KHR_materials_iridescence, as in three.js",
    .trials = {.counts = kNoNumber, .what = "the\nformulas of KHR_materials_iridescence"},
    .needs_reflected_film = true,
    .takes_base_color = true,
    .prepare = gltf_color,
};

}  // namespace irido
