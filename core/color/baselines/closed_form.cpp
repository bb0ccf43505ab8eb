#include "core/color/baselines/closed_form.hpp"

#include <cmath>

#include "core/color/baselines/bare_base.hpp"
#include "core/error.hpp"

namespace irido {

FilmIndex middle_index(const std::string& method, const Stack& held) {
    const FilmIndex index = film_index(held, kMiddle_nm);
    if (index.film.imag() != 0)
        throw DomainError("method " + method + " must have a film that does not absorb (got k = " +
                          to_text(index.film.imag()) + " at 550 nm)");
    return index;
}

void ClosedForm::operator()(const Stack& stack, std::span<const double> angles_deg,
                            std::span<StackColor> colors) const {
    const double thickness_nm = film_of(stack).thickness_nm;
    for (std::size_t a = 0; a < angles_deg.size(); ++a) {
        const double cos_theta = cos_of_incidence(angles_deg[a]);
        const Medium film = medium(index_.film, index_.incident, cos_theta);
        colors[a] = {};
        colors[a].method = method_;
        colors[a].xyz = film.q2.real() > 0 ? xyz(cos_theta, film, thickness_nm,
                                                 2 * thickness_nm * std::sqrt(film.q2.real()))
                                           : white_;
    }
}

}  // namespace irido
