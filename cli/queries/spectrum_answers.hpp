#pragma once

#include <span>
#include <vector>

#include "core/spectrum/cone.hpp"
#include "core/spectrum/delay.hpp"
#include "core/spectrum/ellipsometry.hpp"
#include "core/spectrum/spectrum.hpp"

namespace irido::cli {

/// Quantities required for the rows of a spectrum.
struct SpectrumNeeds {
    Needs power;
    bool ellipsometry = false;
    bool delays = false, derivatives = false;  ///< phases alone need no derivatives
};

/// Quantities of a stack, [angle][wavelength]; empty unless needed.
struct SpectrumAnswers {
    Spectra spectra;
    std::vector<Ellipsometry> ellipsometry;
    std::vector<Delays> delays_s, delays_p;
};

/// Evaluates one stack at all wavelengths of a table and all angles, into memory that is reused.
/// Throws DomainError and ToleranceError.
///   stack       the stack
///   power       its power
///   table       the indices of its materials
///   angles_deg  degrees, [0, 90]
///   cone        about each angle, or none; only R, T, A and A_layers may then be needed
///   needs       the quantities required
///   execution   threads and SIMD level
///   out         receives the quantities
void answer(const Stack& stack, const StackPower& power, const IndexTable& table,
            std::span<const double> angles_deg, const ConeSize& cone, const SpectrumNeeds& needs,
            const Execution& execution, SpectrumAnswers& out);

std::vector<IncidentAngle> incident_angles_of(std::span<const double> angles_deg);

}  // namespace irido::cli
