#include "core/comparison/given_film.hpp"

#include <algorithm>
#include <cmath>

#include "core/color/baselines/bare_base.hpp"
#include "core/color/held_stack.hpp"
#include "core/incoherent/chain.hpp"

namespace irido {

namespace {

/// Finds the first layer.
bool find_layer(const std::vector<Element>& elements, LayerPlace& place) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
        place.push_back(i);
        const Element& element = elements[i];
        if (std::holds_alternative<Layer>(element.value)) return true;
        if (find_layer(std::get<Group>(element.value).elements, place)) return true;
        place.pop_back();
    }
    return false;
}

const Layer& layer_at(const std::vector<Element>& elements, const LayerPlace& place) {
    const std::vector<Element>* inside = &elements;
    for (std::size_t i = 0; i + 1 < place.size(); ++i)
        inside = &std::get<Group>((*inside)[place[i]].value).elements;
    return std::get<Layer>((*inside)[place.back()].value);
}

/// Whether k is nonzero anywhere in the visible range.
bool absorbs(const Material& material) {
    if (is_real(material)) return false;
    constexpr double kFirst_nm = 400, kLast_nm = 700, kStep_nm = 10;
    for (double nm = kFirst_nm; nm <= kLast_nm; nm += kStep_nm)
        if (index_at(material, nm).imag() != 0) return true;
    return false;
}

/// Whether an incident medium counts as air, which engines assume; real air has n = 1.0003.
bool is_air(double n) {
    return std::abs(n - 1) < 5e-4;
}

/// Materials of the reduced stack.
enum : std::size_t { kAbove, kFilm, kBase };

Stack reduced_stack(const Stack& held, double film_n, double thickness_nm) {
    Material film;
    film.model = RefractiveIndex{Constant{film_n}, Constant{0}};
    Layer layer;
    layer.material = kFilm;
    layer.thickness_nm = thickness_nm;
    return {{held.materials[held.incident], std::move(film), held.materials[held.substrate]},
            kAbove,
            {{layer}},
            kBase};
}

}  // namespace

EngineFilm GivenFilm::with_thickness_of(const Stack& stack) const {
    EngineFilm result = film;
    if (!layer.empty())
        result.thickness_nm = thickness_scale * layer_at(stack.elements, layer).thickness_nm;
    return result;
}

Stack GivenFilm::reduced_of(const Stack& stack) const {
    Stack result = reduced;
    if (!layer.empty())
        std::get<Layer>(result.elements.front().value).thickness_nm =
            layer_at(stack.elements, layer).thickness_nm;
    return result;
}

GivenFilm given_film(const EngineFilm& film, const Stack& held) {
    GivenFilm given;
    given.film = film;
    find_layer(held.elements, given.layer);
    given.reduced = reduced_stack(held, film.film_n, film.thickness_nm);
    return given;
}

GivenFilm given_film(const ColorTables& tables, const Stack& held) {
    GivenFilm given;
    const Material& above = held.materials[held.incident];
    const Material& base = held.materials[held.substrate];
    const auto drop = [&](std::string what) { given.dropped.push_back(std::move(what)); };
    const double n0 = index_at(above, kMiddle_nm).real();
    if (!is_air(n0)) drop("an incident medium other than air");
    if (!is_air(n0) && !is_constant(above)) drop("its dispersion");
    given.thickness_scale = n0;

    double film_n = n0, thickness_nm = 0;
    if (find_layer(held.elements, given.layer)) {
        const Layer& layer = layer_at(held.elements, given.layer);
        const Material& material = held.materials[layer.material];
        const Complex n = index_at(material, kMiddle_nm);
        film_n = n.real();
        thickness_nm = layer.thickness_nm;
        if (!is_constant(material)) drop("dispersion of the film");
        if (absorbs(material)) drop("absorption of the film");
        if (layer.thickness_sigma_nm > 0) drop("the thickness distribution of the film");
        if (!layer.coherent) drop("incoherence of the film");
    }
    const std::size_t layers = count_layers(held.elements);
    if (layers > 1) drop("all layers but the first (" + std::to_string(layers - 1) + " more)");
    given.reduced = reduced_stack(held, film_n, thickness_nm);

    EngineFilm film;
    film.film_n = film_n / n0;
    film.thickness_nm = n0 * thickness_nm;
    const bool conducts = std::ranges::any_of(
        kBaseWavelengths_nm, [&](double nm) { return index_at(base, nm).imag() > 0; });
    bool amplifies = false;
    for (std::size_t c = 0; c < 3; ++c) {
        const double nm = conducts ? kBaseWavelengths_nm[c] : kMiddle_nm;
        const Complex n = index_at(base, nm) / index_at(above, nm).real();
        film.base_n[c] = n.real();
        film.base_k[c] = std::max(n.imag(), 0.0);
        amplifies = amplifies || n.imag() < 0;
    }
    if (amplifies) drop("amplification in the base");
    if (!conducts && !is_constant(base)) drop("dispersion of the base");
    given.film = with_base(film);
    if (conducts) {
        given.film.base_f0 = bare_base_color(tables, held, above, 1);
        const Triple at_f82 = bare_base_color(tables, held, above, kF82Cosine);
        for (std::size_t c = 0; c < 3; ++c)
            given.film.base_f82_tint[c] = f82_tint(given.film.base_f0[c], at_f82[c]);
    }
    return given;
}

}  // namespace irido
