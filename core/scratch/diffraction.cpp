#include "core/scratch/diffraction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/gauss.hpp"

namespace irido {

namespace {

double slit_sinc(double x) {
    return sinc_of(x, std::sin(x));
}

double wavenumber_of(double wavelength_um) {
    constexpr double kShortest_um = 1e-3, kLongest_um = 1e4;
    require_in_range("wavelength_um", wavelength_um, kShortest_um, kLongest_um);
    return 1 / wavelength_um;
}

}  // namespace

ScratchPair pair_of(const VisibleScratch& scratch, DepthPhase phase, const UnitVector& light,
                    const UnitVector& view) {
    const auto [tx, ty] = scratch.tangent();
    const double x = light[0] + view[0], y = light[1] + view[1];
    const double rise = phase == DepthPhase::vertical ? 2 : light[2] + view[2];
    return {x * tx + y * ty, y * tx - x * ty, scratch.scratch().depth_um * rise};
}

double sinc_of(double x, double sine) {
    return std::abs(x) < 1e-4 ? 1 - x * x / 6 : sine / x;
}

double groove_power(double path_um, double wavenumber_per_um) {
    const double sine = std::sin(kPi * path_um * wavenumber_per_um);
    return 4 * sine * sine;
}

double slit_power(double width_um, double xi2, double wavenumber_per_um) {
    const double sinc = slit_sinc(kPi * width_um * xi2 * wavenumber_per_um);
    return sinc * sinc;
}

double scratch_brdf(const VisibleScratch& scratch, const ScratchPair& pair, double wavelength_um) {
    const double nu = wavenumber_of(wavelength_um);
    const double y = kTwoPi * scratch.coherence_radius_um() * pair.xi1 * nu;
    return scratch_brdf_of_lobe(scratch, pair, wavelength_um, scratch.power(y));
}

double scratch_brdf_of_lobe(const VisibleScratch& scratch, const ScratchPair& pair,
                            double wavelength_um, double power) {
    const double nu = wavenumber_of(wavelength_um), width = scratch.scratch().width_um;
    return 2 * width * width * nu * nu * slit_power(width, pair.xi2, nu) *
           groove_power(pair.path_um, nu) * power;
}

Complex scratch_amplitude(const VisibleScratch& scratch, const ScratchPair& pair,
                          double wavelength_um) {
    const double nu = wavenumber_of(wavelength_um), width = scratch.scratch().width_um;
    const double y = kTwoPi * scratch.coherence_radius_um() * pair.xi1 * nu;
    // 1 - exp(2 i a) = -2 i sin(a) exp(i a)
    const double a = kPi * pair.path_um * nu;
    const Complex groove = 2 * std::sin(a) * std::polar(1.0, a - kPi / 2);
    return std::numbers::sqrt2 * width * nu * slit_sinc(kPi * width * pair.xi2 * nu) * groove *
           scratch.amplitude(y, kTwoPi * nu, pair.xi2);
}

double coherent_brdf(std::span<const VisibleScratch> scratches, DepthPhase phase,
                     const UnitVector& light, const UnitVector& view, double wavelength_um) {
    Complex sum = 0;
    for (const VisibleScratch& scratch : scratches)
        sum += scratch_amplitude(scratch, pair_of(scratch, phase, light, view), wavelength_um);
    return std::norm(sum);
}

/// Of an ellipse: Gauss in the squared radius, equal angles. Of a Gaussian: the same on rings up to
/// 8 deviations.
std::vector<FootprintPoint> footprint_points(const Footprint& footprint,
                                             double coherence_radius_um) {
    require_valid(footprint);
    const bool is_gaussian = footprint.kind == Footprint::Kind::gaussian;
    const double reach = is_gaussian ? 8 : 1;
    const double extent = reach * std::max(footprint.a1_um, footprint.a2_um) / coherence_radius_um;
    const int rings =
        std::clamp(static_cast<int>(std::ceil(extent)), 1, 64) * (is_gaussian ? 2 : 1);
    const int angles = 32 + 16 * std::clamp(static_cast<int>(std::ceil(extent)), 1, 64);
    const double c = cos_deg(footprint.angle_deg), s = sin_deg(footprint.angle_deg);
    std::vector<FootprintPoint> points;
    double sum = 0;
    for (int ring = 0; ring < rings; ++ring)
        for (const GaussNode& node : gauss_legendre<16>()) {
            const double radius = (ring + (1 + node.x) / 2) / rings * reach;
            const double weight =
                node.weight * radius * (is_gaussian ? std::exp(-radius * radius / 2) : 1.0);
            for (int i = 0; i < angles; ++i) {
                const double turn = kTwoPi * (i + 0.5) / angles;
                const double along = footprint.a1_um * radius * std::cos(turn),
                             across = footprint.a2_um * radius * std::sin(turn);
                points.push_back({{footprint.center.x_um + along * c - across * s,
                                   footprint.center.y_um + along * s + across * c},
                                  weight});
                sum += weight;
            }
        }
    for (FootprintPoint& point : points) point.weight /= sum;
    return points;
}

}  // namespace irido
