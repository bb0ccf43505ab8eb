#include "core/incoherent/incoherent.hpp"

#include <cmath>

#include "core/error.hpp"

namespace irido {

bool travels(const Medium& m) {
    return m.q2.real() > 0;
}

Wave wave_in_gap(const Medium& m, double k0_d, Polarization polarization) {
    const Wave own = onward_wave(m, polarization);
    if (!is_lossy(m)) return own;
    const Complex y = own.c / own.b;
    const double most = y.real() * std::abs(std::sinh(k0_d * onward_kz(m).imag()));
    if (std::abs(y.imag()) <= most) return own;
    return {1, {y.real(), std::copysign(most, y.imag())}, y.real()};
}

bool has_own_wave(const Medium& m, double k0_d) {
    // Y is kz for s; its phase is smaller for p
    const Complex kz = onward_kz(m);
    return std::abs(kz.imag()) <= kz.real() * std::abs(std::sinh(k0_d * kz.imag()));
}

Attenuation attenuation(const Medium& m, double k0_d) {
    const double exponent = -2 * k0_d * onward_kz(m).imag();
    return {std::exp(exponent), -std::expm1(exponent), -std::expm1(2 * exponent)};
}

LightInGap light_in_gap(const BlockPower& block, const Attenuation& gap, const Power& below) {
    if (block.down.T == 0) return {0, 0, 0};
    // 1 - R kept^2 R', written as a sum of losses to avoid cancellation
    const Power& up = block.up;
    const double lost =
        up.T + up.A + up.R * (gap.lost_twice + gap.kept * gap.kept * (below.T + below.A));
    const double entering = block.down.T / lost;
    if (!(lost > 0) || !std::isfinite(entering * gap.kept))
        throw DomainError("the stack amplifies without bound at this wavelength and angle");
    const double arriving = entering * gap.kept;
    return {entering, arriving, arriving * below.R * gap.kept};
}

Power over_gap(const BlockPower& block, const Attenuation& gap, const Power& below) {
    const LightInGap light = light_in_gap(block, gap, below);
    return {block.down.R + light.returned * block.up.T, light.arriving * below.T,
            block.down.A + light.returned * block.up.A + light.arriving * below.A +
                gap.lost * (light.entering + light.arriving * below.R)};
}

}  // namespace irido
