#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "core/scratch/footprint.hpp"
#include "core/scratch/scratch.hpp"

namespace irido {

/// A scratch as a point of the surface, or a footprint on average, sees it: how far off it is and
/// where it ends.
class VisibleScratch {
public:
    /// Throws DomainError for members outside their ranges.
    VisibleScratch(const Scratch& scratch, const ScratchOptics& optics, SurfacePoint at);
    VisibleScratch(const Scratch& scratch, const ScratchOptics& optics, const Footprint& footprint);

    const Scratch& scratch() const { return scratch_; }
    double coherence_radius_um() const { return sigma_; }
    std::array<double, 2> tangent() const { return tangent_; }
    std::array<double, 2> bitangent() const { return {-tangent_[1], tangent_[0]}; }
    double offset_um() const { return offset_; }  ///< s_b, of the footprint's centre
    bool has_ends() const { return !places_.empty(); }

    /// The ends as seen from a place along the axis, in units of sigma; weights sum to weight().
    struct Place {
        double start, end, weight;
    };
    /// All places of a footprint, or the only one; none of a scratch without ends that count.
    std::span<const Place> places() const { return places_; }

    /// Mean of |eta|^2/(2 pi sigma^2) at y = sigma k xi_1: exp(-s_b^2/sigma^2 - y^2) of an infinite
    /// scratch at a point, with (E(end) - E(start))^2/4 in the place of exp(-y^2) of a finite one.
    double power(double y) const;
    /// power() of an infinite scratch without exp(-y^2): exp(-s_b^2/sigma^2) or its mean.
    double weight() const { return weight_; }
    /// rho, its share of the coherence area, or the mean: W/(sqrt(pi) sigma) times the mean of
    /// exp(-s_b^2/sigma^2) and of the part of the axis's weight between the ends.
    double share() const { return share_; }
    /// eta/sqrt(2 pi sigma^2) at a point (not a footprint): exp(-s_b^2/(2 sigma^2) - i k s_b xi_2)
    /// times exp(-y^2/2), or (E(end) - E(start))/2. `k_um` is 2 pi/wavelength.
    Complex amplitude(double y, double k_um, double xi2) const;
    /// Whether an end lies nearer than so many sigma to what is seen.
    bool ends_within(double radii) const;
    /// Nearer than 3, where formulas of infinite scratches are off.
    bool ends_nearby() const { return ends_within(3); }

private:
    void add_places(const FootprintFrame& frame, Footprint::Kind kind);
    void set_share();

    Scratch scratch_;
    double sigma_;
    std::array<double, 2> tangent_;
    double offset_ = 0, reach_ = 0, middle_ = 0, weight_ = 0, share_ = 0;
    std::vector<Place> places_;
};

/// E(end) - E(start) with
///     E(x) = sqrt(2/pi) int_0^x exp(-t^2/2 - i y t) dt = exp(-y^2/2) erf((x + i y)/sqrt2),
/// which tends to 2 exp(-y^2/2) as the ends go to -+infinity; never overflows, absolute error below
/// 1e-14.
Complex gaussian_segment(double start, double end, double y);

}  // namespace irido
