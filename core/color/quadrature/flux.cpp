#include "core/color/quadrature/flux.hpp"

#include <algorithm>
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
    const auto is_zero = [](double scale) { return scale == 0; };
    if (!std::ranges::all_of(spectrum.log_scale, is_zero)) return false;
    double least = size_at(0);
    for (std::size_t j = 1; j < spectrum.log_scale.size(); ++j) least = std::min(least, size_at(j));
    std::size_t clearest = 0;
    while (size_at(clearest) > least) ++clearest;
    flux = T_at(clearest) * size_at(clearest);
    if (!(flux > 0)) return false;
    for (std::size_t j = 0; j < spectrum.log_scale.size(); j += kFluxStep)
        if (!(std::abs(T_at(j) * size_at(j) - flux) <= kRoundingOfFlux * size_at(j))) return false;
    return true;
}

void fill_samples(std::span<const Side> sides, const Spectrum& first, const Spectrum* second,
                  Samples& samples) {
    const std::size_t points = samples.points();
    std::size_t row = 0;
    for (const Side side : sides) {
        const auto values = side == Side::reflected ? &Spectrum::R : &Spectrum::T;
        const double* a = (first.*values).data();
        double* to = samples.row(row++);
        std::copy_n(a, points, to);
        if (!second) continue;
        const double* b = (second->*values).data();
        for (std::size_t j = 0; j < points; ++j) to[j] = (a[j] + b[j]) / 2;
    }
    for (const Spectrum* spectrum : {&first, second}) {
        if (!spectrum) break;
        for (const auto values :
             {&Spectrum::denominator_re, &Spectrum::denominator_im, &Spectrum::log_scale})
            std::copy_n((spectrum->*values).data(), points, samples.row(row++));
    }
}

}  // namespace irido
