#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/stacks/stack_format.hpp"

namespace irido::schemas {

/// A filter of an OpenFilters project. Its layers run from the substrate outwards, those of this
/// document from the front medium on. Materials are files NAME.mat of the folder of the options,
/// else built-in materials of that name; void is vacuum. With ConsiderBackside the substrate is an
/// incoherent layer between front and back, else the medium behind the front layers, and the back
/// is left out with a note. Graded layers and mixtures are refused.
StackFile read_openfilters(std::string_view text, const std::string& file,
                           const StackReadOptions& options);

/// The stack as a project of one filter, with its materials as files beside it. One incoherent
/// layer becomes the substrate.
WrittenStack write_openfilters(const Stack& stack, const StackWriteOptions& options);

}  // namespace irido::schemas
