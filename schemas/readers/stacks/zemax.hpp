#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/stacks/stack_format.hpp"

namespace irido::schemas {

/// Reads a coating from Zemax OpticStudio's COATING.DAT: layers from the incident medium to the
/// substrate. The file contains neither; air and BK7 are assumed, with a note. k < 0 is loss there.
/// Thicknesses in waves need a primary wavelength; on a mirror the last layer is the substrate.
/// Tapers and loops are refused; TABLE, IDEAL, IDEAL2 and ENCRYPTED are skipped with a note.
StackFile read_zemax(std::string_view text, const std::string& file,
                     const StackReadOptions& options);

/// The stack as one coating with absolute thicknesses. An opaque substrate becomes the last layer,
/// as on mirrors.
WrittenStack write_zemax(const Stack& stack, const StackWriteOptions& options);

}  // namespace irido::schemas
