#include "core/color/remapped_film.hpp"

#include <algorithm>
#include <cmath>

#include "core/color/baselines/bare_base.hpp"
#include "core/color/fourier/film_color.hpp"
#include "core/color/fourier/one_film.hpp"
#include "core/error.hpp"

namespace irido {

namespace {

/// Part of the way from the incident medium's index to the film's own.
double remapped_part(double n, double thickness_nm, double width_nm) {
    const double path_nm = 2 * n * thickness_nm;
    if (path_nm >= width_nm) return 1;
    const double t = path_nm / width_nm;
    return t * t * (3 - 2 * t);
}

/// Rows at which dispersive indices are mixed, 1 nm apart.
constexpr double kMixedFrom_nm = 360, kMixedTo_nm = 830;

}  // namespace

double remapped_index(double n1, double n, double thickness_nm, double width_nm) {
    return n1 + (n - n1) * remapped_part(n, thickness_nm, width_nm);
}

Stack with_remapped_film(Stack stack, double width_nm) {
    if (const std::string fault = film_fault(stack); !fault.empty())
        throw DomainError("a remapped index takes one film over a base, not " + fault);
    const Layer film = only_film(stack);
    const Material incident = stack.materials[stack.incident];
    const Material own = stack.materials[film.material];
    const double part =
        remapped_part(index_at(own, kMiddle_nm).real(), film.thickness_nm, width_nm);
    if (part == 1 || !only_layer(stack)) return stack;
    const auto mixed = [&](double wavelength_nm) {
        const double n1 = index_at(incident, wavelength_nm).real();
        return n1 + (index_at(own, wavelength_nm).real() - n1) * part;
    };
    Material made{own.name, RefractiveIndex{}, Outside::clamp};
    auto& n = std::get<RefractiveIndex>(made.model).n;
    if (is_constant(incident) && is_constant(own)) {
        n = Constant{mixed(kMiddle_nm)};
    } else {
        const WavelengthRange a = range_of(incident), b = range_of(own);
        const double first = std::max({kMixedFrom_nm, a.first_nm, b.first_nm});
        const double last = std::min({kMixedTo_nm, a.last_nm, b.last_nm});
        Table table;
        for (double nm = first; nm <= last; ++nm) {
            table.wavelength_nm.push_back(nm);
            table.value.push_back(mixed(nm));
        }
        n = std::move(table);
    }
    // the film's alone, whatever else is made of its material
    Element* element = &stack.elements.front();
    while (auto* group = std::get_if<Group>(&element->value)) element = &group->elements.front();
    std::get<Layer>(element->value).material = stack.materials.size();
    stack.materials.push_back(std::move(made));
    return stack;
}

}  // namespace irido
