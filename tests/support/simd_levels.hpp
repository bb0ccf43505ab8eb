#pragma once

#include <string>
#include <vector>

#include "core/math/simd_level.hpp"

namespace irido {

/// "not run: avx2, avx512 (instructions that this machine lacks)" for the levels for which `has` is
/// false; "" if it has all.
std::string lacking_levels(bool (*has)(SimdLevel));

/// The levels that this machine supports, in the order of kSimdLevels. Unsupported ones are
/// reported as a warning, once per test case: a passing test has not covered them.
std::vector<SimdLevel> tested_levels();

/// tested_levels() without the plain kernel.
std::vector<SimdLevel> tested_vector_levels();

}  // namespace irido
