#pragma once

#include <span>
#include <string_view>

#include "core/math/random.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// One question to a coherent stack.
struct StackCase {
    Stack stack;
    double wavelength_nm = 550;
    double angle_deg = 0;
};

/// A part of what may be asked where a kernel could lose its digits, and a way to ask there.
struct Regime {
    std::string_view name;     ///< one word
    std::string_view summary;  ///< what its cases are, one line
    bool passive;              ///< nothing amplifies
    StackCase (*make)(Random& random);
};

/// All regimes in the order in which they are reported.
std::span<const Regime> regimes();

/// The regime of that name, nullptr if there is none.
const Regime* find_regime(std::string_view name);

}  // namespace irido
