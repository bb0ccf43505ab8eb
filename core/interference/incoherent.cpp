#include "core/interference/incoherent.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/interference/slab_response.hpp"

namespace irido {

Attenuation attenuation(const Medium& m, double k0_d) {
    const double exponent = -2 * k0_d * onward_kz(m).imag();
    return {std::exp(exponent), -std::expm1(exponent), -std::expm1(2 * exponent)};
}

LightInGap light_in_gap(const BlockPower& block, const Attenuation& gap, const Power& below) {
    if (block.down.T == 0) return {0, 0, 0};
    // 1 - R kept^2 R', formed from what is left of 1
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
