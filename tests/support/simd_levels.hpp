#pragma once

#include <string>
#include <vector>

#include "core/math/simd_level.hpp"

namespace irido {

/// "not run: avx2, avx512 (instructions that this machine lacks)" of the levels for which `has` is
/// false; "" if it has all.
std::string lacking_levels(bool (*has)(SimdLevel));

/// The levels that this machine runs, in the order of kSimdLevels. What it lacks stands in the
/// output as a warning, once a test case: a test that passes there has not looked at them.
std::vector<SimdLevel> tested_levels();

/// The same without the plain kernel.
std::vector<SimdLevel> tested_vector_levels();

}  // namespace irido
