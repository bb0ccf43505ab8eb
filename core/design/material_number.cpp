#include "core/design/material_number.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"

namespace irido {

namespace {

using Part = MaterialNumber::Part;

/// The material's model of n or of k as a T. Throws DomainError.
template <class T>
T& model_of(Material& material, Dispersion RefractiveIndex::*which) {
    if (auto* index = std::get_if<RefractiveIndex>(&material.model))
        if (T* model = std::get_if<T>(&(index->*which))) return *model;
    throw DomainError("the material " + material.name + " has no such number");
}

LorentzDrude& oscillators_of(Material& material) {
    if (auto* model = std::get_if<LorentzDrude>(&material.model)) return *model;
    throw DomainError("the material " + material.name + " has no such number");
}

/// Weight of one row in the interpolated value of a table.
double share_of_row(const Table& table, std::size_t row, double nm) {
    const std::vector<double>& x = table.wavelength_nm;
    if (nm <= x.front()) return row == 0 ? 1 : 0;
    if (nm >= x.back()) return row + 1 == x.size() ? 1 : 0;
    const auto upper = static_cast<std::size_t>(std::ranges::upper_bound(x, nm) - x.begin());
    const double part = (nm - x[upper - 1]) / (x[upper] - x[upper - 1]);
    if (row == upper) return part;
    return row + 1 == upper ? 1 - part : 0;
}

/// dn / dc for Sellmeier's and Cauchy's formulas.
double formula_slope(const Formula& formula, std::size_t index, double um, double n) {
    const std::vector<double>& c = formula.coefficients;
    if (formula.number == 5) {
        if (index == 0) return 1;
        return index % 2 == 1 ? std::pow(um, c[index + 1]) : 0;
    }
    if (formula.number != 2) return 0;
    const double l2 = um * um;
    if (index == 0) return 0.5 / n;
    const bool is_pole = index % 2 == 0;
    const double pole = is_pole ? c[index] : index + 1 < c.size() ? c[index + 1] : 0;
    const double term = l2 / (l2 - pole);
    return (is_pole ? c[index - 1] * term / (l2 - pole) : term) / (2 * n);
}

/// deps/dx of eps = eps_infinity + sum f wp^2 / (w^2 - E^2 - i E G)
Complex permittivity_slope(const LorentzDrude& model, const MaterialNumber& number, double nm) {
    if (number.part == Part::eps_infinity) return 1;
    const double energy = kPhotonEnergy_eVnm / nm, plasma2 = model.plasma_ev * model.plasma_ev;
    const auto denominator = [&](const LorentzDrude::Oscillator& o) {
        return Complex(o.resonance_ev * o.resonance_ev - energy * energy, -energy * o.damping_ev);
    };
    if (number.part == Part::plasma) {
        Complex sum = 0;
        for (const auto& o : model.oscillators) sum += o.strength / denominator(o);
        return 2 * model.plasma_ev * sum;
    }
    const auto& o = model.oscillators[number.index];
    const Complex below = denominator(o);
    if (number.part == Part::strength) return plasma2 / below;
    const Complex by_below = -o.strength * plasma2 / (below * below);
    return by_below *
           (number.part == Part::damping ? Complex(0, -energy) : Complex(2 * o.resonance_ev));
}

}  // namespace

double& value_of(Material& material, const MaterialNumber& number) {
    switch (number.part) {
        case Part::n:
            return model_of<Constant>(material, &RefractiveIndex::n).value;
        case Part::k:
            return model_of<Constant>(material, &RefractiveIndex::k).value;
        case Part::coefficient:
            return model_of<Formula>(material, &RefractiveIndex::n).coefficients.at(number.index);
        case Part::n_row:
            return model_of<Table>(material, &RefractiveIndex::n).value.at(number.index);
        case Part::k_row:
            return model_of<Table>(material, &RefractiveIndex::k).value.at(number.index);
        case Part::eps_infinity:
            return oscillators_of(material).eps_infinity;
        case Part::plasma:
            return oscillators_of(material).plasma_ev;
        case Part::strength:
            return oscillators_of(material).oscillators.at(number.index).strength;
        case Part::damping:
            return oscillators_of(material).oscillators.at(number.index).damping_ev;
        case Part::resonance:
            break;
    }
    return oscillators_of(material).oscillators.at(number.index).resonance_ev;
}

Complex index_slope(const Material& material, const MaterialNumber& number, double wavelength_nm) {
    switch (number.part) {
        case Part::n:
            return 1;
        case Part::k:
            return {0, 1};
        case Part::coefficient: {
            const auto& index = std::get<RefractiveIndex>(material.model);
            return formula_slope(std::get<Formula>(index.n), number.index, wavelength_nm / 1000,
                                 index_at(material, wavelength_nm).real());
        }
        case Part::n_row:
            return share_of_row(std::get<Table>(std::get<RefractiveIndex>(material.model).n),
                                number.index, wavelength_nm);
        case Part::k_row:
            return {0, share_of_row(std::get<Table>(std::get<RefractiveIndex>(material.model).k),
                                    number.index, wavelength_nm)};
        default:
            return permittivity_slope(std::get<LorentzDrude>(material.model), number,
                                      wavelength_nm) /
                   (2.0 * index_at(material, wavelength_nm));
    }
}

}  // namespace irido
