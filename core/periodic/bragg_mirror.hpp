#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "core/periodic/bragg.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// A stack that has one repeated group of two coherent, transparent layers, and any others around
/// it. Angles in degrees, omega = 2 pi / wavelength in 1/nm. All throw DomainError.
class BraggMirror {
public:
    /// Materials must be known from first_nm to last_nm, the group's with k in [-0.1, 0.1];
    /// landmarks beyond have the indices of the ends of what is known.
    BraggMirror(Stack stack, double first_nm, double last_nm);

    /// Largest k of the two layers, which their landmarks leave out.
    double left_out_k() const { return left_out_k_; }

    /// The group without end.
    PeriodAt period_at(double angle_deg, Polarization polarization) const;

    /// R of the whole stack.
    double reflectance(double angle_deg, Polarization polarization, double omega) const;

    static constexpr std::array kReflectances{0.95, 0.99, 0.999};
    using Periods = std::array<double, kReflectances.size()>;

    /// Smallest numbers of periods for which the whole stack reflects kReflectances, 0 where none
    /// up to 1e9 does, or none that can be computed. Inside a gap; beyond 64 periods R is taken to
    /// grow with their number.
    Periods periods_needed(double angle_deg, Polarization polarization, double omega) const;

    /// Whether some wavelength lies inside the gap of this order at every angle in both
    /// polarizations: at each of 361 angles from 0 to 90 degrees, if the gap does not close on the
    /// way, at Brewster's angle or where the layers' shares of the path are commensurate.
    bool is_omnidirectional(double order) const;

private:
    /// R with the group as many times as asked; 0: as it is.
    std::function<double(std::uint64_t repeat)> reflectances(double angle_deg,
                                                             Polarization polarization,
                                                             double omega) const;
    double index(std::size_t material, double omega) const;
    BraggPeriod period(double angle_deg, Polarization polarization, double omega) const;
    void find_pair();
    void check_indices(double first_nm, double last_nm);

    Stack stack_;
    std::size_t place_ = 0;  ///< of the group among the stack's elements
    std::array<Layer, 2> pair_;
    double left_out_k_ = 0;
};

}  // namespace irido
