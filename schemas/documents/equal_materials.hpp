#pragma once

#include <cstdint>

#include "core/material/material.hpp"

namespace irido::schemas {

/// The same for materials of same_physics().
std::uint64_t hash_of(const Material& material);

/// Whether two materials are one but for their names.
bool same_physics(const Material& a, const Material& b);

}  // namespace irido::schemas
