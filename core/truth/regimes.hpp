#pragma once

#include <span>
#include <string_view>

#include "core/math/random.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// One test case for the coherent kernels.
struct StackCase {
    Stack stack;
    double wavelength_nm = 550;
    double angle_deg = 0;
};

/// A numerically difficult region of the input space, and a sampler for it.
struct Regime {
    std::string_view name;     ///< one word
    std::string_view summary;  ///< description of its cases, one line
    bool passive;              ///< no gain media
    StackCase (*make)(Random& random);
};

/// All regimes, in reporting order.
std::span<const Regime> regimes();

/// The regime of that name, or nullptr.
const Regime* find_regime(std::string_view name);

}  // namespace irido
