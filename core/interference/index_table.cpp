#include "core/interference/index_table.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

namespace {

/// Absorption of an incident medium that passes as none: catalogue glasses have k of 1e-8.
constexpr double kNegligibleAbsorption = 1e-5;

}  // namespace

IndexTable::IndexTable(const Stack& stack, std::vector<double> wavelength_nm)
    : wavelength_nm_(std::move(wavelength_nm)),
      materials_(stack.materials.size()),
      incident_(stack.incident),
      n_(wavelength_nm_.size() * materials_ + kMostLanes, 1),
      k_(n_.size(), 0),
      k0_(wavelength_nm_.size() + kMostLanes, 1),
      constant_(materials_, true),
      absorbs_(materials_, false),
      amplifies_(materials_, false) {
    const std::size_t count = wavelength_nm_.size();
    for (std::size_t w = 0; w < count; ++w) {
        const double wavelength = wavelength_nm_[w];
        for (std::size_t m = 0; m < materials_; ++m) {
            const Complex index = index_at(stack.materials[m], wavelength);
            n_[m * count + w] = index.real();
            k_[m * count + w] = index.imag();
            if (index != this->index(m, 0)) constant_[m] = false;
            if (index.imag() != 0) absorbs_[m] = true;
            if (index.imag() < 0) amplifies_[m] = true;
        }
        k0_[w] = 2 * std::numbers::pi / wavelength;
        const Complex incident = index(incident_, w);
        if (incident.real() > 0 && std::abs(incident.imag()) <= kNegligibleAbsorption) continue;
        throw DomainError(
            "the incident medium must be transparent (got n = " + to_text(incident.real()) +
            ", k = " + to_text(incident.imag()) + " at " + to_text(wavelength) + " nm)");
    }
}

}  // namespace irido
