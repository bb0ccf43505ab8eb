#pragma once

#include <span>
#include <vector>

#include "core/interference/stack_power.hpp"

namespace irido {

/// Complex index of every material of a stack at every wavelength, computed once for all angles.
class IndexTable {
public:
    /// Throws DomainError as index_at does, and if the incident medium absorbs: |k| above 1e-5 (a
    /// smaller k is left out).
    IndexTable(const Stack& stack, std::vector<double> wavelength_nm);

    const std::vector<double>& wavelength_nm() const { return wavelength_nm_; }
    /// All materials at one wavelength.
    std::span<const Complex> at(std::size_t wavelength) const {
        return {index_.data() + wavelength * materials_, materials_};
    }
    double incident_index(std::size_t wavelength) const { return at(wavelength)[incident_].real(); }

private:
    std::vector<double> wavelength_nm_;
    std::size_t materials_, incident_;
    std::vector<Complex> index_;
};

/// Responses in the two polarizations; one that was not asked for stays empty.
struct Polarized {
    Response s, p;
    /// The mean of the two powers.
    Power unpolarized() const {
        const Power &a = s.power, &b = p.power;
        return {(a.R + b.R) / 2, (a.T + b.T) / 2, (a.A + b.A) / 2};
    }
};

/// Which polarizations a request needs.
struct Needs {
    bool s = true, p = true;
};

/// The batch form of the kernel: powers at every wavelength of the table for one angle.
///   cos_theta  of the angle of incidence, [0, 1]; at 1 both polarizations are one computation
///   out        one entry per wavelength
void power_spectrum(const StackPower& stack, const IndexTable& table, double cos_theta, Needs needs,
                    std::span<Polarized> out);

}  // namespace irido
