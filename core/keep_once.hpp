#pragma once

#include <algorithm>
#include <vector>

namespace irido {

/// Sorts values, ascending, and keeps each of them once.
template <class Value>
void keep_once(std::vector<Value>& values) {
    if (!std::ranges::is_sorted(values)) std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace irido
