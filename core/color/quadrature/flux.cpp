#include "core/color/quadrature/flux.hpp"

#include <cmath>
#include <cstddef>

namespace irido {

namespace {

/// What R or T may be off from flux / |D|^2 where it is that.
constexpr double kRoundingOfFlux = 1e-10;
constexpr std::size_t kFluxStep = 5;  ///< between points where that is checked

}  // namespace

bool has_flux(const Spectrum& spectrum, double& flux) {
    const auto size_at = [&](std::size_t j) {
        return spectrum.denominator_re[j] * spectrum.denominator_re[j] +
               spectrum.denominator_im[j] * spectrum.denominator_im[j];
    };
    const auto T_at = [&](std::size_t j) {
        return spectrum.T.empty() ? 1 - spectrum.R[j] : spectrum.T[j];
    };
    std::size_t clearest = 0;
    for (std::size_t j = 0; j < spectrum.log_scale.size(); ++j) {
        if (spectrum.log_scale[j] != 0) return false;
        if (size_at(j) < size_at(clearest)) clearest = j;
    }
    flux = T_at(clearest) * size_at(clearest);
    if (!(flux > 0)) return false;
    for (std::size_t j = 0; j < spectrum.log_scale.size(); j += kFluxStep)
        if (!(std::abs(T_at(j) - flux / size_at(j)) <= kRoundingOfFlux)) return false;
    return true;
}

}  // namespace irido
