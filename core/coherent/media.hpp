#pragma once

#include <vector>

#include "core/coherent/coherent.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

/// One medium of a table as a polarization sees it.
Medium medium_of(const IndexTable& table, std::size_t material, std::size_t wavelength,
                 IncidentAngle incidence, Polarization polarization);

/// All media of a table at one of its wavelengths, one per material, and last the incident one
/// without absorption; memory is used again. Those of s and p differ in uniaxial media only.
void set_media(const IndexTable& table, std::size_t wavelength, IncidentAngle incidence,
               Polarization polarization, std::vector<Medium>& media);

}  // namespace irido
