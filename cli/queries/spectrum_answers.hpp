#pragma once

#include <span>
#include <vector>

#include "core/spectrum/cone.hpp"
#include "core/spectrum/delay.hpp"
#include "core/spectrum/ellipsometry.hpp"
#include "core/spectrum/spectrum.hpp"

namespace irido::cli {

/// What rows of a spectrum require.
struct SpectrumNeeds {
    Needs power;
    bool ellipsometry = false;
    bool delays = false, derivatives = false;  ///< phases alone need no derivatives of materials
};

/// Quantities of a stack, [angle][wavelength]; empty where not needed.
struct SpectrumAnswers {
    Spectra spectra;
    std::vector<Ellipsometry> ellipsometry;
    std::vector<Delays> delays_s, delays_p;
};

/// Answers about one stack at all wavelengths of a table and all angles, into memory that is used
/// again. Throws DomainError and ToleranceError.
///   stack       of the power;  table  of its materials
///   angles_deg  [0, 90]
///   cone        about each angle, or none; then only R, T, A and A_layers are needed
void answer(const Stack& stack, const StackPower& power, const IndexTable& table,
            std::span<const double> angles_deg, const ConeSize& cone, const SpectrumNeeds& needs,
            const Execution& execution, SpectrumAnswers& out);

std::vector<IncidentAngle> incident_angles_of(std::span<const double> angles_deg);

}  // namespace irido::cli
