#pragma once

#include <memory>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

/// Product quadrature of any stack, with materials clamped outside their range: each piece of the
/// spectrum between two kinks of the materials is a panel, and panels with unresolved fringes or
/// resonances are bisected. `error` is a reliable estimate. It exceeds the tolerance if the effort
/// is exhausted: after request.evaluations, or earlier for stacks of many layers, after some
/// seconds of work. A colour does not depend on the other angles of a call. If request.varied
/// leaves layers that many colours share, and the vector kernel supports the stack, their results
/// are cached for the angles used last, within request.kept_numbers: fastest if the colours of one
/// angle follow each other. Stacks that differ in other layers are then rejected with DomainError.
/// Throws DomainError as StackPower and IndexTable do.
std::unique_ptr<ColorAlgorithm> quadrature_color(const ColorTables& tables, const Stack& stack,
                                                 const ColorRequest& request);

}  // namespace irido
