#include "core/interference/spectrum.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace irido {

namespace {

/// Absorption of an incident medium that passes as none: catalogue glasses have k of 1e-8.
constexpr double kNegligibleAbsorption = 1e-5;

}  // namespace

IndexTable::IndexTable(const Stack& stack, std::vector<double> wavelength_nm)
    : wavelength_nm_(std::move(wavelength_nm)),
      materials_(stack.materials.size()),
      incident_(stack.incident) {
    index_.reserve(wavelength_nm_.size() * materials_);
    for (const double wavelength : wavelength_nm_) {
        for (const Material& material : stack.materials)
            index_.push_back(index_at(material, wavelength));
        const Complex incident = at(index_.size() / materials_ - 1)[incident_];
        if (incident.real() > 0 && std::abs(incident.imag()) <= kNegligibleAbsorption) continue;
        throw DomainError(
            "the incident medium must be transparent (got n = " + to_text(incident.real()) +
            ", k = " + to_text(incident.imag()) + " at " + to_text(wavelength) + " nm)");
    }
}

void power_spectrum(const StackPower& stack, const IndexTable& table, double cos_theta, Needs needs,
                    std::span<Polarized> out) {
    const std::size_t materials = table.at(0).size();
    std::vector<Medium> media(materials + 1);
    for (std::size_t w = 0; w < out.size(); ++w) {
        const double n0 = table.incident_index(w);
        const double k0 = 2 * std::numbers::pi / table.wavelength_nm()[w];
        for (std::size_t m = 0; m < materials; ++m)
            media[m] = medium(table.at(w)[m], n0, cos_theta);
        media.back() = medium(n0, n0, cos_theta);
        if (needs.s || cos_theta == 1) out[w].s = stack(media, k0, Polarization::s);
        if (cos_theta == 1) {
            out[w].p = out[w].s;
        } else if (needs.p) {
            out[w].p = stack(media, k0, Polarization::p);
        }
    }
}

}  // namespace irido
