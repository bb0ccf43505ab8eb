#pragma once

#include <algorithm>

#include "core/material/material.hpp"

namespace irido {

/// Linear interpolation between rows, clamped beyond the ends.
inline double linear_value(const Table& table, double wavelength_nm) {
    const auto& x = table.wavelength_nm;
    const auto& y = table.value;
    const double at = std::clamp(wavelength_nm, x.front(), x.back());
    const auto above = std::upper_bound(x.begin(), x.end(), at);
    if (above == x.end()) return y.back();
    const auto i = static_cast<std::size_t>(above - x.begin());
    return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
}

}  // namespace irido
