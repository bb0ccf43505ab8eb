#pragma once

#include <cstddef>
#include <string>

namespace irido::tables {

/// Magic, version (1.0, or 2.0 for a longer header than that can have) and header of a NumPy array:
/// `type` and `shape` in Python's spelling, "'<f4'" and "(3, 4)"; with room for `spare` more
/// characters. The array's bytes follow. Source: NumPy documentation, numpy.lib.format.
std::string npy_header(const std::string& type, const std::string& shape, std::size_t spare = 0);

}  // namespace irido::tables
