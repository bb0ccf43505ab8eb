#pragma once

#include <string_view>

#include "core/material/graded.hpp"
#include "core/material/mixing_rule.hpp"

namespace irido::schemas {

/// A rule by the name that documents have for it ("maxwell-garnett"), and the name of a rule.
MixingRule mixing_rule(std::string_view name);
std::string_view name_of(MixingRule rule);

/// The same for profiles of graded layers ("inverse-n").
GradedProfile graded_profile(std::string_view name);
std::string_view name_of(GradedProfile profile);

}  // namespace irido::schemas
