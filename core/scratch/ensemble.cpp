#include "core/scratch/ensemble.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/scratch/diffraction.hpp"

namespace irido {

namespace {

/// Mean of exp(-(y sin a)^2) over angles a in radians between two ends, by Gauss rules where it
/// counts: near multiples of pi.
double mean_of_lobe(double y, double from, double to) {
    constexpr double kReach = 6.5;
    const double width = y > kReach ? std::asin(kReach / y) : kPi / 2;
    double sum = 0;
    for (int turn = -3; turn <= 3; ++turn) {
        const double a = std::max(from, turn * kPi - width), b = std::min(to, turn * kPi + width);
        if (!(a < b)) continue;
        constexpr int kPanels = 8;
        const double half = (b - a) / (2 * kPanels);
        for (int panel = 0; panel < kPanels; ++panel)
            for (const GaussNode& node : gauss_legendre<16>()) {
                const double s = y * std::sin(a + half * (2 * panel + 1 + node.x));
                sum += half * node.weight * std::exp(-s * s);
            }
    }
    return sum / (to - from);
}

}  // namespace

double ensemble_brdf(const ScratchEnsemble& ensemble, const ScratchOptics& optics,
                     const UnitVector& light, const UnitVector& view, double wavelength_um) {
    constexpr double kNoSpread_deg = 1e-9;
    require_valid(optics);
    require_in_range("wavelength_um", wavelength_um, 1e-3, 1e4);
    require_in_range("share", ensemble.share, 0, 1);
    require_in_range("width_um", ensemble.width_um, std::numeric_limits<double>::min(), kWidest_um);
    require_in_range("depth_um", ensemble.depth_um, 0, kDeepest_um);
    require_in_range("angle_low_deg", ensemble.angle_low_deg, -360, 360);
    require_in_range("angle_high_deg", ensemble.angle_high_deg,
                     ensemble.angle_low_deg + kNoSpread_deg, ensemble.angle_low_deg + 360);
    const double x = light[0] + view[0], y = light[1] + view[1], size = std::hypot(x, y);
    const double nu = 1 / wavelength_um, sigma = optics.coherence_radius_um;
    const double rise = optics.depth_phase == DepthPhase::vertical ? 2 : light[2] + view[2];
    // a scratch along a reflects by its angle to the line across xi
    const double across = std::atan2(y, x) + kPi / 2;
    const double lobe =
        mean_of_lobe(kTwoPi * sigma * nu * size, ensemble.angle_low_deg * kDegree - across,
                     ensemble.angle_high_deg * kDegree - across);
    return 2 * std::sqrt(kPi) * ensemble.share * sigma * ensemble.width_um * nu * nu *
           slit_power(ensemble.width_um, size, nu) * groove_power(ensemble.depth_um * rise, nu) *
           lobe;
}

}  // namespace irido
