#include "core/scratch/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/degrees.hpp"
#include "core/math/gauss.hpp"

namespace irido {

namespace {

constexpr double kLargestFootprint_um = 1e6, kSmallestFootprint_um = 1e-6;

double footprint_gauss(double s) {
    return std::exp(-s * s);
}

/// (2/pi) int sin^2 t exp(-(s + h cos t)^2) dt where the exponential counts, by Gauss rules.
double wide_mean(double s, double h) {
    constexpr double kReach = 6.8;  // exp(-6.8^2) = 8e-21
    constexpr int kPanels = 8;
    const double first = std::acos(std::clamp((kReach - s) / h, -1.0, 1.0));
    const double last = std::acos(std::clamp((-kReach - s) / h, -1.0, 1.0));
    const double half = (last - first) / (2 * kPanels);
    double sum = 0;
    for (int panel = 0; panel < kPanels; ++panel) {
        double part = 0;
        for (const GaussNode& node : gauss_legendre<16>()) {
            const double t = first + half * (2 * panel + 1 + node.x), sine = std::sin(t);
            part += node.weight * sine * sine * footprint_gauss(s + h * std::cos(t));
        }
        sum += half * part;
    }
    return 2 / kPi * sum;
}

}  // namespace

void require_valid(const Footprint& footprint) {
    for (const double place : {footprint.center.x_um, footprint.center.y_um})
        require_in_range("center_um", place, -Scratch::kLongest_um, Scratch::kLongest_um);
    require_in_range("a1_um", footprint.a1_um, kSmallestFootprint_um, kLargestFootprint_um);
    require_in_range("a2_um", footprint.a2_um, kSmallestFootprint_um, kLargestFootprint_um);
    require_in_range("angle_deg", footprint.angle_deg, -360, 360);
}

FootprintFrame frame_of(const Footprint& footprint, const Scratch& scratch) {
    const double turn_deg = footprint.angle_deg - scratch.angle_deg;
    const double c = cos_deg(turn_deg), s = sin_deg(turn_deg);
    const double tx = cos_deg(scratch.angle_deg), ty = sin_deg(scratch.angle_deg);
    const double dx = scratch.point.x_um - footprint.center.x_um,
                 dy = scratch.point.y_um - footprint.center.y_um;
    const double a1 = footprint.a1_um, a2 = footprint.a2_um;
    FootprintFrame frame;
    frame.along_um = std::hypot(a1 * c, a2 * s);
    frame.across_um = std::hypot(a1 * s, a2 * c);
    frame.middle_um = dx * tx + dy * ty;
    frame.offset_um = dy * tx - dx * ty;
    frame.slope = (a1 - a2) * (a1 + a2) * c * s / (frame.along_um * frame.along_um);
    frame.half_um = a1 * a2 / frame.along_um;
    return frame;
}

double ellipse_mean_by_points(double offset, double half_extent, int points) {
    double sum = 0;
    for (int i = 1; i <= points; ++i) {
        const double t = kPi * i / (points + 1), sine = std::sin(t);
        sum += sine * sine * footprint_gauss(offset + half_extent * std::cos(t));
    }
    return 2.0 / (points + 1) * sum;
}

double ellipse_mean(double offset, double half_extent) {
    constexpr double kFarthest = 1e12, kNarrow = 8;
    require_in_range("offset", offset, -kFarthest, kFarthest);
    require_in_range("half_extent", half_extent, 0, kFarthest);
    const double s = std::abs(offset), h = half_extent;
    if (h > kNarrow) return wide_mean(s, h);
    return ellipse_mean_by_points(s, h, 16 + static_cast<int>(std::ceil(7 * h)));
}

double gaussian_mean(double offset, double deviation) {
    const double spread = 1 + 2 * deviation * deviation;
    return std::exp(-offset * offset / spread) / std::sqrt(spread);
}

double chord_um(const FootprintFrame& frame) {
    const double place = frame.offset_um / frame.across_um;
    if (std::abs(place) >= 1) return 0;
    // a1 a2 = half_um along_um
    return 2 * frame.half_um * frame.along_um / frame.across_um *
           std::sqrt((1 - place) * (1 + place));
}

double published_eta2_um2(FootprintFormula formula, const Footprint& footprint,
                          const Scratch& scratch, double coherence_radius_um) {
    const FootprintFrame frame = frame_of(footprint, scratch);
    const double sigma = coherence_radius_um, area = kPi * footprint.a1_um * footprint.a2_um;
    const double by_length =
        2 * sigma * sigma / area * sigma * std::sqrt(kPi * kPi * kPi) * chord_um(frame);
    if (formula == FootprintFormula::length) return by_length;
    const double share = std::min(area / (2 * kPi * sigma * sigma), 1.0);
    const double small = 2 * sigma * sigma * footprint_gauss(frame.offset_um / sigma) *
                         (formula == FootprintFormula::blend ? kPi : 1);
    return share * by_length + (1 - share) * small;
}

double published_density(const Footprint& footprint, const Scratch& scratch) {
    return 2 * scratch.width_um * chord_um(frame_of(footprint, scratch)) /
           (kPi * footprint.a1_um * footprint.a2_um);
}

}  // namespace irido
