#pragma once

#include <vector>

#include "core/coherent/coherent.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

/// One medium of an index table, as seen by one polarization.
///   table                 indices of the stack's materials
///   material, wavelength  positions in the table
///   incidence             direction of the light in the incident medium
///   polarization          s or p; matters in uniaxial media only
Medium medium_of(const IndexTable& table, std::size_t material, std::size_t wavelength,
                 IncidentAngle incidence, Polarization polarization);

/// Fills `media` with every medium of a table at one wavelength: one per material, then the
/// incident medium without absorption.
///   table         indices of the stack's materials
///   wavelength    position in the table
///   incidence     direction of the light in the incident medium
///   polarization  s or p; matters in uniaxial media only
///   media         output, whose memory is reused
void set_media(const IndexTable& table, std::size_t wavelength, IncidentAngle incidence,
               Polarization polarization, std::vector<Medium>& media);

}  // namespace irido
