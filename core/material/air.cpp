#include "core/material/air.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace irido {

double index_of_air(double wavelength_nm, double temperature_c) {
    require_in_range("temperature_c", temperature_c, -40, 100);
    const double um = std::clamp(wavelength_nm, kAirKnown.first_nm, kAirKnown.last_nm) / 1000;
    return air_index(1 / (um * um), temperature_c);
}

double vacuum_wavelength(double in_air_nm, double temperature_c) {
    double vacuum_nm = in_air_nm;
    for (int i = 0; i < 3; ++i) vacuum_nm = in_air_nm * index_of_air(vacuum_nm, temperature_c);
    return vacuum_nm;
}

double air_wavelength(double in_vacuum_nm, double temperature_c) {
    return in_vacuum_nm / index_of_air(in_vacuum_nm, temperature_c);
}

Table in_vacuum(Table table, const Reference& reference, bool is_n) {
    const double first_nm = table.wavelength_nm.front();
    for (std::size_t i = 0; i < table.value.size(); ++i) {
        double& nm = table.wavelength_nm[i];
        if (reference.wavelength_in_air) nm = vacuum_wavelength(nm, reference.temperature_c);
        if (is_n && reference.index_to_air)
            table.value[i] *= index_of_air(nm, reference.temperature_c);
    }
    if (!is_n && reference.wavelength_in_air) {
        table.wavelength_nm.insert(table.wavelength_nm.begin(), first_nm);
        table.value.insert(table.value.begin(), table.value.front());
    }
    return table;
}

}  // namespace irido
