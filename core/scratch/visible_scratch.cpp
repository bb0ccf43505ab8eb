#include "core/scratch/visible_scratch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/faddeeva.hpp"

namespace irido {

namespace {

/// Ends further off than this, in units of sigma, leave nothing that a double has: exp(-9^2/2).
constexpr double kFarEnd = 9;

/// exp(-y^2/2) erf((x + i y)/sqrt2) of a finite or infinite x.
Complex gaussian_error(double x, double y) {
    const double sign = x < 0 ? -1 : 1, distance = std::abs(x), turned = sign * y;
    const double whole = std::exp(-y * y / 2);
    if (std::isinf(x)) return sign * whole;
    const Complex z = Complex(-turned, distance) / std::numbers::sqrt2;
    return sign * (whole - std::polar(std::exp(-distance * distance / 2), -distance * turned) *
                               faddeeva(z));
}

double normal_between(double start, double end) {
    return (std::erf(end) - std::erf(start)) / 2;
}

}  // namespace

Complex gaussian_segment(double start, double end, double y) {
    return gaussian_error(end, y) - gaussian_error(start, y);
}

VisibleScratch::VisibleScratch(const Scratch& scratch, const ScratchOptics& optics, SurfacePoint at)
    : scratch_(scratch),
      sigma_(optics.coherence_radius_um),
      tangent_{cos_deg(scratch.angle_deg), sin_deg(scratch.angle_deg)} {
    require_valid(scratch);
    require_valid(optics);
    const double dx = scratch.point.x_um - at.x_um, dy = scratch.point.y_um - at.y_um;
    middle_ = dx * tangent_[0] + dy * tangent_[1];
    offset_ = dy * tangent_[0] - dx * tangent_[1];
    const double s = offset_ / sigma_;
    weight_ = std::exp(-s * s);
    const double start = (middle_ + scratch.start_um) / sigma_,
                 end = (middle_ + scratch.end_um) / sigma_;
    if (start > -kFarEnd || end < kFarEnd) places_.push_back({start, end, weight_});
    set_share();
}

VisibleScratch::VisibleScratch(const Scratch& scratch, const ScratchOptics& optics,
                               const Footprint& footprint)
    : scratch_(scratch),
      sigma_(optics.coherence_radius_um),
      tangent_{cos_deg(scratch.angle_deg), sin_deg(scratch.angle_deg)} {
    require_valid(scratch);
    require_valid(optics);
    require_valid(footprint);
    const FootprintFrame frame = frame_of(footprint, scratch);
    constexpr double kGaussianReach = 8;
    const bool is_gaussian = footprint.kind == Footprint::Kind::gaussian;
    offset_ = frame.offset_um;
    middle_ = frame.middle_um;
    reach_ = frame.along_um * (is_gaussian ? kGaussianReach : 1);
    weight_ = is_gaussian ? gaussian_mean(offset_ / sigma_, frame.across_um / sigma_)
                          : ellipse_mean(offset_ / sigma_, frame.across_um / sigma_);
    const double start = (middle_ + reach_ + scratch.start_um) / sigma_,
                 end = (middle_ - reach_ + scratch.end_um) / sigma_;
    if (start > -kFarEnd || end < kFarEnd) add_places(frame, footprint.kind);
    set_share();
}

/// The mean over the footprint, first across the scratch, where it is closed, then along it: of an
/// ellipse by Chebyshev's rule of the second kind, of a Gaussian by a trapezoidal rule. Both have
/// as many points as leave 1e-13 of a mean over Gaussians exp(-v^2).
void VisibleScratch::add_places(const FootprintFrame& frame, Footprint::Kind kind) {
    constexpr double kLeast = 16, kPerSigma = 8, kLeastOfGaussian = 24, kOfGaussian = 32,
                     kMost = 4096;
    const double extent = std::max(frame.along_um, frame.across_um) / sigma_;
    const bool is_gaussian = kind == Footprint::Kind::gaussian;
    const int count = static_cast<int>(
        std::min(kMost, is_gaussian ? std::max(kLeastOfGaussian, std::ceil(kOfGaussian * extent))
                                    : kLeast + kPerSigma * std::ceil(extent)));
    double sum = 0;
    for (int i = 1; i <= count; ++i) {
        const double place = static_cast<double>(i) / (count + 1);
        const double u = is_gaussian ? 2 * place - 1 : std::cos(kPi * place);
        const double shift = u * reach_;  // of the seeing point along the axis
        const double s = (offset_ - frame.slope * shift) / sigma_;
        double weight = 0;
        if (is_gaussian) {
            const double deviations = shift / frame.along_um;
            weight =
                std::exp(-deviations * deviations / 2) * gaussian_mean(s, frame.half_um / sigma_);
        } else {
            const double sine = std::sin(kPi * place), half = frame.half_um / sigma_ * sine;
            // (1/2 half) int exp(-(s + v)^2) dv over [-half, half], times sin^2
            const double mean =
                half < 1e-3 ? std::exp(-s * s) * (1 + half * half * (2 * s * s - 1) / 3)
                            : std::sqrt(kPi) * normal_between(s - half, s + half) / (2 * half);
            weight = sine * sine * mean;
        }
        sum += is_gaussian ? std::exp(-std::pow(shift / frame.along_um, 2) / 2) : 0;
        places_.push_back({(middle_ - shift + scratch_.start_um) / sigma_,
                           (middle_ - shift + scratch_.end_um) / sigma_, weight});
    }
    const double scale = is_gaussian ? 1 / sum : 2.0 / (count + 1);
    for (Place& place : places_) place.weight *= scale;
}

void VisibleScratch::set_share() {
    share_ = weight_;
    if (has_ends()) {
        share_ = 0;
        for (const Place& place : places_)
            share_ += place.weight * normal_between(place.start, place.end);
    }
    share_ *= scratch_.width_um / (std::sqrt(kPi) * sigma_);
}

double VisibleScratch::power(double y) const {
    if (!has_ends()) return weight_ * std::exp(-y * y);
    double sum = 0;
    for (const Place& place : places_)
        sum += place.weight * std::norm(gaussian_segment(place.start, place.end, y));
    return sum / 4;
}

Complex VisibleScratch::amplitude(double y, double k_um, double xi2) const {
    const double s = offset_ / sigma_;
    const Complex along =
        has_ends() ? gaussian_segment(places_.front().start, places_.front().end, y) / 2.0
                   : Complex(std::exp(-y * y / 2));
    return std::polar(std::exp(-s * s / 2), -k_um * offset_ * xi2) * along;
}

bool VisibleScratch::ends_within(double radii) const {
    return middle_ + reach_ + scratch_.start_um > -radii * sigma_ ||
           middle_ - reach_ + scratch_.end_um < radii * sigma_;
}

}  // namespace irido
