#include "schemas/documents/material_words.hpp"

#include <algorithm>
#include <array>

namespace irido::schemas {

namespace {

/// In the order of MixingRule, as stack.schema.json lists them.
constexpr std::array<std::string_view, 5> kMixingRules{"bruggeman", "maxwell-garnett",
                                                       "lorentz-lorenz", "linear", "series"};

/// In the order of GradedProfile.
constexpr std::array<std::string_view, 4> kGradedProfiles{"n", "eps", "exp", "inverse-n"};

}  // namespace

MixingRule mixing_rule(std::string_view name) {
    return static_cast<MixingRule>(std::ranges::find(kMixingRules, name) - kMixingRules.begin());
}

std::string_view name_of(MixingRule rule) {
    return kMixingRules[static_cast<std::size_t>(rule)];
}

GradedProfile graded_profile(std::string_view name) {
    return static_cast<GradedProfile>(std::ranges::find(kGradedProfiles, name) -
                                      kGradedProfiles.begin());
}

std::string_view name_of(GradedProfile profile) {
    return kGradedProfiles[static_cast<std::size_t>(profile)];
}

}  // namespace irido::schemas
