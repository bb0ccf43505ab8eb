#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/stacks/stack_format.hpp"

namespace irido::schemas {

/// Reads a list of layers, starting on the incident side: a header, then one row per layer.
/// Columns: material (a name or an index, 1.9+1.5i), and thickness_nm, thickness_um or, in quarter
/// waves at the primary wavelength, qwot; optionally layer (ignored), thickness_sigma_nm and
/// coherent (true, false). A first and a last row without a thickness are the outer media; if they
/// are missing, air and BK7 are assumed, with a note.
StackFile read_layer_list(std::string_view text, const std::string& file,
                          const StackReadOptions& options);

/// Writes a list with columns layer, material, thickness_nm, and, if any layer needs them,
/// thickness_sigma_nm and coherent; the outer media are the first and last row. Groups are
/// expanded; materials that cannot be read back by name are written as their index at 550 nm.
WrittenStack write_layer_list(const Stack& stack, const StackWriteOptions& options);

}  // namespace irido::schemas
