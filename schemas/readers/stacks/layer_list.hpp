#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/stacks/stack_format.hpp"

namespace irido::schemas {

/// A list of layers from the incident side on, as tables are exchanged: a header, then a row per
/// layer. Columns: material (a name or an index, 1.9+1.5i), and thickness_nm, thickness_um or, in
/// quarter waves at the primary wavelength, qwot; perhaps layer (not used), thickness_sigma_nm and
/// coherent (true, false). A first and a last row without a thickness are the media around; where
/// they are missing, air and BK7 are assumed, with a note.
StackFile read_layer_list(std::string_view text, const std::string& file,
                          const StackReadOptions& options);

/// The list with columns layer, material, thickness_nm, and thickness_sigma_nm and coherent where a
/// layer needs them; media in the first and the last row. Groups are written out; of materials
/// that have no name to lead back to them there is the index at 550 nm.
WrittenStack write_layer_list(const Stack& stack, const StackWriteOptions& options);

}  // namespace irido::schemas
