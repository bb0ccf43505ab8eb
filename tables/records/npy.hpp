#pragma once

#include <cstddef>
#include <string>

namespace irido::tables {

/// Magic string, version (1.0, or 2.0 for headers too long for it) and header of a NumPy array:
/// `type` and `shape` in Python notation, "'<f4'" and "(3, 4)"; with room for `spare` more
/// characters. The array's bytes follow. Source: NumPy documentation, numpy.lib.format.
std::string npy_header(const std::string& type, const std::string& shape, std::size_t spare = 0);

}  // namespace irido::tables
