#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/stacks/stack_format.hpp"

namespace irido::schemas {

/// Reads a filter of an OpenFilters project. Its layers run outwards from the substrate, those of
/// the resulting document inwards from the front medium. Materials are files NAME.mat in the folder
/// given by the options, otherwise built-in materials of that name; void is vacuum. With
/// ConsiderBackside the substrate becomes an incoherent layer between front and back; without it,
/// it is the medium behind the front layers, and the back is omitted with a note. Graded layers and
/// mixtures are refused.
StackFile read_openfilters(std::string_view text, const std::string& file,
                           const StackReadOptions& options);

/// The stack as a project of one filter, with its materials as separate files. A single incoherent
/// layer becomes the substrate.
WrittenStack write_openfilters(const Stack& stack, const StackWriteOptions& options);

}  // namespace irido::schemas
