#pragma once

#include "core/complex.hpp"

namespace irido {

inline constexpr Complex kI{0, 1};

}  // namespace irido
