#pragma once

#include <vector>

#include "core/coherent/coherent.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

/// All media of a table at one of its wavelengths, one per material, and last the incident one
/// without absorption; memory is used again.
void set_media(const IndexTable& table, std::size_t wavelength, IncidentAngle incidence,
               std::vector<Medium>& media);

}  // namespace irido
