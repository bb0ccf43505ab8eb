#pragma once

#include <string_view>

#include "core/material/graded.hpp"
#include "core/material/mixing_rule.hpp"

namespace irido::schemas {

/// Mixing rules and their names in documents ("maxwell-garnett").
MixingRule mixing_rule(std::string_view name);
std::string_view name_of(MixingRule rule);

/// Profiles of graded layers and their names in documents ("inverse-n").
GradedProfile graded_profile(std::string_view name);
std::string_view name_of(GradedProfile profile);

}  // namespace irido::schemas
