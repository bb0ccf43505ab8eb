#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "core/periodic/bragg.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// A stack with one repeated group of two coherent, transparent layers, and any other layers around
/// it. Angles in degrees, omega = 2 pi / wavelength in 1/nm. Every function may throw DomainError.
class BraggMirror {
public:
    /// The materials need data from first_nm to last_nm, those of the group with k in [-0.1, 0.1];
    /// landmarks beyond the range of a material use the indices at its ends.
    BraggMirror(Stack stack, double first_nm, double last_nm);

    /// Largest k of the two layers, which the landmarks ignore.
    double left_out_k() const { return left_out_k_; }

    /// The group's period, repeated endlessly.
    PeriodAt period_at(double angle_deg, Polarization polarization) const;

    /// R of the whole stack.
    double reflectance(double angle_deg, Polarization polarization, double omega) const;

    static constexpr std::array kReflectances{0.95, 0.99, 0.999};
    using Periods = std::array<double, kReflectances.size()>;

    /// Smallest numbers of periods with which the whole stack reaches each of kReflectances; 0 if
    /// no number up to 1e9 does, or if R cannot be computed. For omega inside a gap; beyond 64
    /// periods R is assumed to increase with their number.
    Periods periods_needed(double angle_deg, Polarization polarization, double omega) const;

    /// Whether some wavelength lies inside the gap of this order at all angles and for both
    /// polarizations: tested at 361 angles from 0 to 90 degrees, provided the gap closes nowhere in
    /// between, at Brewster's angle or where the layers' phases are commensurate.
    bool is_omnidirectional(double order) const;

private:
    /// R as a function of the group's repeat count; 0 keeps the count as it is.
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
