#include "core/scratch/energy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/complex.hpp"
#include "core/error.hpp"

namespace irido {

ScratchBalance scratch_balance(std::span<const GrooveShare> grooves, double wavenumber_per_um,
                               bool overlap, ScratchEnergy rule) {
    double all = 0, power = 0;  // sum rho, sum rho |d|^2
    Complex amplitude = 0;      // sum rho d
    for (const auto& [share, path_um] : grooves) {
        require_in_range("share", share, 0, 1e12);
        // 1 - exp(2 i a) = -2 i sin(a) exp(i a)
        const double a = std::numbers::pi * path_um * wavenumber_per_um;
        all += share;
        power += share * 4 * std::sin(a) * std::sin(a);
        amplitude += share * (2 * std::sin(a)) * std::polar(1.0, a - std::numbers::pi / 2);
    }
    if (rule == ScratchEnergy::none || all == 0) return {};
    if (rule == ScratchEnergy::blend) return {std::max(0.0, 1 - 2 * all), 1};
    const double covered = overlap ? -std::expm1(-all) : std::min(all, 1.0);
    const double part = covered / all;
    const double lost = power > 0 ? part * std::norm(amplitude) / power : covered;
    return {std::norm(1.0 - part * amplitude), part * (1 - lost)};
}

}  // namespace irido
