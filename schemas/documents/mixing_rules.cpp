#include "schemas/documents/mixing_rules.hpp"

#include <algorithm>
#include <array>

namespace irido::schemas {

namespace {

/// In the order of MixingRule, as stack.schema.json lists them.
constexpr std::array<std::string_view, 5> kMixingRules{"bruggeman", "maxwell-garnett",
                                                       "lorentz-lorenz", "linear", "series"};

}  // namespace

MixingRule mixing_rule(std::string_view name) {
    return static_cast<MixingRule>(std::ranges::find(kMixingRules, name) - kMixingRules.begin());
}

std::string_view name_of(MixingRule rule) {
    return kMixingRules[static_cast<std::size_t>(rule)];
}

}  // namespace irido::schemas
