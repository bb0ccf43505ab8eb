#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/spectrum/stack_power.hpp"
#include "core/stack/index_table.hpp"
#include "schemas/documents/stack_document.hpp"

namespace irido::cli {

/// Parses "s,p,u" into letters, in that order. Throws UsageError.
std::string parse_polarizations(std::string_view text);

/// The indices of a document's materials. Throws InputError with the JSON pointer of the first
/// material that has no index at one of the wavelengths.
IndexTable index_table(const schemas::StackDocument& document,
                       const std::vector<double>& wavelengths_nm);

/// The power of a stack of the document. Throws InputError.
StackPower stack_power(const schemas::StackDocument& document, const Stack& stack);

}  // namespace irido::cli
