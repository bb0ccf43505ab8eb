#pragma once

#include <string_view>

#include "core/material/mixing_rule.hpp"

namespace irido::schemas {

/// A rule by the name that documents have for it ("maxwell-garnett"), and the name of a rule.
MixingRule mixing_rule(std::string_view name);
std::string_view name_of(MixingRule rule);

}  // namespace irido::schemas
