#pragma once

#include <cstdint>

#include "core/material/material.hpp"

namespace irido::schemas {

/// Hash that is equal for materials for which same_physics() is true.
std::uint64_t hash_of(const Material& material);

/// Whether two materials differ at most in their names.
bool same_physics(const Material& a, const Material& b);

}  // namespace irido::schemas
