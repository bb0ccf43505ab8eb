#pragma once

#include <array>
#include <vector>

#include "core/scratch/visible_scratch.hpp"

namespace irido {

/// power() of a scratch for many y: the closed form of an infinite one; of one with ends, as exact
/// and, whatever its footprint, without a Faddeeva function a place. With B the weight of all
/// places along the axis, each exp(-v^2), and N its integral,
///     power(y) = (1/pi) int_0^L cos(y d) exp(-d^2/4) [N(end - d/2) - N(start + d/2)] dd,
/// which from kFar on is its asymptotic series at d = 0 and d = L, and below it polynomials in y.
/// Errors below 1e-12, and from kFar on below 1e-11 of 1/(pi y^2). Refers to the scratch.
class LobeTable {
public:
    /// Ends further off than this, in coherence radii, change integrals over y by 1e-8 at most; by
    /// default they are left out.
    static constexpr double kFarthestEnd = 6;

    /// first, last  the range of |y|; beyond it power() itself is asked
    LobeTable(const VisibleScratch& scratch, double first, double last,
              double farthest_end = kFarthestEnd);

    bool has_ends() const { return has_ends_; }
    double operator()(double y) const;

private:
    static constexpr double kFar = 12;
    static constexpr std::size_t kNodes = 24;  ///< of a panel
    static constexpr std::size_t kTerms = 20;  ///< of a Taylor series
    using Taylor = std::array<double, kTerms + 1>;

    void add_series();
    void add_panels();
    double near(double size) const;
    double far(double size) const;

    const VisibleScratch& scratch_;
    bool has_ends_;
    double first_, last_;
    std::vector<std::array<double, kNodes>> panels_;  ///< of equal length, from first_ on
    double panel_ = 1;
    Taylor at_zero_{}, at_length_{};   ///< k-th derivatives of the integrand there, over pi
    double length_ = kInfiniteLength;  ///< of the scratch, in coherence radii
    static constexpr double kInfiniteLength = 1e300;
};

}  // namespace irido
