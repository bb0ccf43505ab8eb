#pragma once

#include <memory>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

/// Product quadrature of any stack, materials holding their end values outside their range: every
/// piece of the spectrum between two kinks of the materials is a panel, and panels whose fringes
/// or resonances are not resolved are halved. `error` is an honest estimate; it exceeds the
/// tolerance where the effort ran out: request.evaluations, or earlier for stacks of many layers,
/// after about a second of work. A colour does not depend on the other angles of a call.
/// Where request.varied leaves layers that many colours have in common, and the vector kernel takes
/// the stack, these are stored for the angles asked for last, as request.kept_numbers has room:
/// quickest where one angle's colours follow each other. Stacks that differ in other layers are
/// then refused by DomainError. Throws DomainError as StackPower and IndexTable do.
std::unique_ptr<ColorAlgorithm> quadrature_color(const ColorTables& tables, const Stack& stack,
                                                 const ColorRequest& request);

/// Layers that quadrature_color() computes for a colour, more or less: points times layers. A
/// function of its arguments that needs no table and is the same on every machine.
///   indices  of the stack's materials at one wavelength
///   pieces   smooth_pieces() of the stack, less one
double quadrature_work(const Stack& stack, const IndexTable& indices, std::size_t pieces,
                       IncidentAngle incidence);

}  // namespace irido
