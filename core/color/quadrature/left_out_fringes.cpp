#include "core/color/quadrature/left_out_fringes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/color/quadrature/optical_path.hpp"

namespace irido {

namespace {

/// Points on either side that see a function turn as quickly as it does anywhere, and the radians
/// of phase between these from which on the function is constant over a fringe.
constexpr std::size_t kNeighbours = 4;
constexpr double kManyTurns = 100;

/// Wavelengths that differ by roundings are one.
constexpr double kSame = 1e-11;

/// Part of a wavelength within which the slope of a table jumps.
constexpr double kKinkStep = 1e-7;

/// Of bounds that look at a few points.
constexpr double kSafety = 2;

}  // namespace

void LeftOutFringes::add(double wavelength_nm, const FringeMean& mean) {
    points_.push_back({wavelength_nm, std::abs(mean.form.turn[0]), mean.swing_R, mean.swing_T, 0});
}

double LeftOutFringes::path_nm(const Point& from, const Point& to) {
    const double waves = (to.turned - from.turned) / (2 * std::numbers::pi);
    return waves > 0 ? waves / (1 / from.wavelength_nm - 1 / to.wavelength_nm) : 0;
}

double LeftOutFringes::error(Side side, const ColorTables& tables, bool only_edges) {
    std::ranges::sort(points_, {}, &Point::wavelength_nm);
    const auto same = [](const Point& a, const Point& b) {
        return b.wavelength_nm - a.wavelength_nm < kSame * a.wavelength_nm;
    };
    points_.erase(std::unique(points_.begin(), points_.end(), same), points_.end());
    for (std::size_t i = 1; i < points_.size(); ++i)
        points_[i].turned =
            points_[i - 1].turned + std::abs(points_[i].phase - points_[i - 1].phase);
    const std::size_t last = points_.size() - 1;
    double slow = 0, fast = 0;
    for (std::size_t i = 0; i <= last; ++i) {
        const Point& point = points_[i];
        const Point& before = points_[i - std::min<std::size_t>(i, 1)];
        const Point& after = points_[std::min(i + 1, last)];
        const double swing = side == Side::reflected ? point.swing_R : point.swing_T;
        const double turn = points_[std::min(i + kNeighbours, last)].turned -
                            points_[i - std::min(i, kNeighbours)].turned;
        if (!std::isfinite(swing + turn)) return std::numeric_limits<double>::infinity();
        if (only_edges || turn >= kManyTurns) {
            // one of the two may lead into a gap, or from K < pi to K > pi
            const double longer_nm = std::max(path_nm(before, point), path_nm(point, after));
            fast = std::max(fast, swing * tables.decay()(longer_nm));
        } else {
            slow += swing * (after.wavelength_nm - before.wavelength_nm) / 2 *
                    std::ranges::max(tables.sensitivity().at(point.wavelength_nm));
        }
    }
    return kSafety * fast + slow;
}

double LeftOutFringes::at_kinks(Side side, const ColorTables& tables,
                                std::span<const Kink> kinks) const {
    constexpr double kDeviations = 3;
    double squares = 0;
    for (const Kink& kink : kinks) {
        const auto above =
            std::ranges::upper_bound(points_, kink.wavelength_nm, {}, &Point::wavelength_nm);
        const std::ptrdiff_t at = std::clamp<std::ptrdiff_t>(
            above - points_.begin(), 1, static_cast<std::ptrdiff_t>(points_.size()) - 1);
        const Point& before = points_[static_cast<std::size_t>(at) - 1];
        const Point& after = points_[static_cast<std::size_t>(at)];
        const double swing = side == Side::reflected ? std::max(before.swing_R, after.swing_R)
                                                     : std::max(before.swing_T, after.swing_T);
        const double path = path_nm(before, after);
        if (swing == 0) continue;
        const double part = swing * kink.wavelength_nm * kink.wavelength_nm *
                            std::ranges::max(tables.sensitivity().at(kink.wavelength_nm)) *
                            kink.path_jump_nm / (2 * std::numbers::pi * path * path);
        squares += part * part;
    }
    return kDeviations * std::sqrt(squares);
}

void kinks_of(const Element& element, const Stack& held, WavelengthRange support,
              std::vector<LeftOutFringes::Kink>& kinks) {
    std::vector<double> length_nm(held.materials.size());
    add_lengths(element, 1, length_nm);
    for (std::size_t m = 0; m < length_nm.size(); ++m) {
        if (length_nm[m] == 0) continue;
        const Material& material = held.materials[m];
        for (const double nm : table_rows(material, support)) {
            const double step = kKinkStep * nm;
            const double jump = index_at(material, nm + step).real() +
                                index_at(material, nm - step).real() -
                                2 * index_at(material, nm).real();
            kinks.push_back({nm, 2 * length_nm[m] * nm * std::abs(jump) / step});
        }
    }
}

}  // namespace irido
