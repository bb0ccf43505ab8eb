#include "core/coherent/media.hpp"

namespace irido {

void set_media(const IndexTable& table, std::size_t wavelength, IncidentAngle incidence,
               std::vector<Medium>& media) {
    const double n0 = table.n(table.incident())[wavelength];
    media.resize(table.materials() + 1);
    for (std::size_t m = 0; m < table.materials(); ++m)
        media[m] = medium(table.index(m, wavelength), n0, incidence);
    media.back() = medium(n0, n0, incidence);
}

}  // namespace irido
