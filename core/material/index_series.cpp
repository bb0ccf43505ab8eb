#include "core/material/index_series.hpp"

#include <algorithm>

#include "core/material/air.hpp"
#include "core/material/formula.hpp"
#include "core/math/constants.hpp"

namespace irido {

namespace {

/// A wavelength clamped to a range, as a series.
Series<double> held_wavelength(double wavelength_nm, WavelengthRange range) {
    if (wavelength_nm < range.first_nm) return range.first_nm;
    if (wavelength_nm > range.last_nm) return range.last_nm;
    return wavelength_nm / relative_frequency();
}

/// The same for a wavelength that is a series.
Series<double> held_wavelength(const Series<double>& nm, WavelengthRange range) {
    if (nm[0] < range.first_nm) return range.first_nm;
    if (nm[0] > range.last_nm) return range.last_nm;
    return nm;
}

Series<double> series_of_air(const Series<double>& nm, double temperature_c) {
    const Series<double> um = held_wavelength(nm, kAirKnown) / 1000;
    return air_index(1 / (um * um), temperature_c);
}

Series<double> series_of(const Constant& constant, double) {
    return constant.value;
}

Series<double> series_of(const Formula& formula, double wavelength_nm) {
    const auto& [index_to_air, wavelength_in_air, temperature_c] = formula.reference;
    const Series<double> nm = held_wavelength(wavelength_nm, formula.range);
    const Series<double> own = wavelength_in_air ? nm / series_of_air(nm, temperature_c) : nm;
    const FormulaAt<Series<double>> at(formula, own / 1000);
    const Series<double> value = at.is_square() ? sqrt(at.value()) : at.value();
    return index_to_air ? value * series_of_air(nm, temperature_c) : value;
}

Series<double> series_of(const Table& table, double wavelength_nm) {
    const auto& x = table.wavelength_nm;
    const auto& y = table.value;
    const Series<double> nm = held_wavelength(wavelength_nm, {x.front(), x.back()});
    if (x.size() == 1) return y.front();
    auto above = std::upper_bound(x.begin(), x.end(), nm[0]);
    if (above == x.end()) --above;
    const auto i = static_cast<std::size_t>(above - x.begin());
    return y[i - 1] + (nm - x[i - 1]) * ((y[i] - y[i - 1]) / (x[i] - x[i - 1]));
}

Series<Complex> complex_series(const Series<double>& re, const Series<double>& im) {
    Series<Complex> result;
    for (std::size_t i = 0; i < Series<double>::kTerms; ++i) result[i] = {re[i], im[i]};
    return result;
}

Series<Complex> series_of(const RefractiveIndex& index, double wavelength_nm) {
    const auto series = [&](const auto& dispersion) {
        return series_of(dispersion, wavelength_nm);
    };
    return complex_series(std::visit(series, index.n), std::visit(series, index.k));
}

Series<Complex> series_of(const LorentzDrude& model, double wavelength_nm) {
    const Series<double> energy = kPhotonEnergy_eVnm / held_wavelength(wavelength_nm, model.range);
    Series<Complex> eps(model.eps_infinity);
    for (const auto& [strength, damping, resonance] : model.oscillators)
        if (strength != 0)
            eps += strength * model.plasma_ev * model.plasma_ev /
                   complex_series(resonance * resonance - energy * energy, -damping * energy);
    return root_of(eps, std::sqrt(eps[0]));
}

Series<Complex> series_of(const Material& material, double wavelength_nm);

/// In-plane and normal index.
std::array<Series<Complex>, 2> series_of_both(const GradedPart& part, double wavelength_nm) {
    const std::vector<Material>& ends = *part.ends;
    const auto eps = GradedHalfStep(part.half, part.steps)
                         .permittivity(part.profile, series_of(ends[0], wavelength_nm),
                                       series_of(ends[1], wavelength_nm));
    return {root_near(eps[0]), root_near(eps[1])};
}

Series<Complex> series_of(const GradedPart& part, double wavelength_nm) {
    return series_of_both(part, wavelength_nm)[0];
}

Series<Complex> series_of(const Uniaxial& medium, double wavelength_nm) {
    return series_of(medium.parts[0], wavelength_nm);
}

Series<Complex> series_of(const Mixture& mixture, double wavelength_nm) {
    const auto part = [&](std::size_t i) { return series_of(mixture.parts[i], wavelength_nm); };
    if (mixture.fraction == 0) return part(1);
    if (mixture.fraction == 1) return part(0);
    return root_near(mixed_permittivity(mixture.rule, part(0), part(1), mixture.fraction));
}

Series<Complex> series_of(const Material& material, double wavelength_nm) {
    return std::visit([&](const auto& model) { return series_of(model, wavelength_nm); },
                      material.model);
}

}  // namespace

Series<double> relative_frequency() {
    return Series<double>({1, 1, 0, 0});
}

Series<Complex> index_series(const Material& material, double wavelength_nm) {
    const Complex index = index_at(material, wavelength_nm);
    Series<Complex> series = series_of(material, wavelength_nm);
    series[0] = index;
    return series;
}

Series<Complex> extraordinary_series(const Material& material, double wavelength_nm) {
    if (!is_uniaxial(material)) return index_series(material, wavelength_nm);
    const Complex index = extraordinary_index_at(material, wavelength_nm);
    const auto* medium = std::get_if<Uniaxial>(&material.model);
    Series<Complex> series =
        medium ? series_of(medium->parts[1], wavelength_nm)
               : series_of_both(std::get<GradedPart>(material.model), wavelength_nm)[1];
    series[0] = index;
    return series;
}

bool has_rows(const Material& material) {
    if (std::ranges::any_of(parts_of(material), has_rows)) return true;
    const auto* index = std::get_if<RefractiveIndex>(&material.model);
    return index != nullptr &&
           (std::holds_alternative<Table>(index->n) || std::holds_alternative<Table>(index->k));
}

}  // namespace irido
