#include "core/coherent/media.hpp"

namespace irido {

Medium medium_of(const IndexTable& table, std::size_t material, std::size_t wavelength,
                 IncidentAngle incidence, Polarization polarization) {
    const double n0 = table.n(table.incident(), wavelength);
    const std::size_t row = table.extraordinary(material);
    const Complex index = table.index(material, wavelength);
    if (row == material || polarization == Polarization::s) return medium(index, n0, incidence);
    return extraordinary_medium(index, table.index(row, wavelength), n0, incidence);
}

void set_media(const IndexTable& table, std::size_t wavelength, IncidentAngle incidence,
               Polarization polarization, std::vector<Medium>& media) {
    const double n0 = table.n(table.incident(), wavelength);
    media.resize(table.materials() + 1);
    for (std::size_t m = 0; m < table.materials(); ++m)
        media[m] = medium_of(table, m, wavelength, incidence, polarization);
    media.back() = medium(n0, n0, incidence);
}

}  // namespace irido
