#pragma once

#include <string>

#include "tables/records.hpp"

namespace irido {

/// NumPy's array format 1.0: a one-dimensional structured array, one field a column, little-endian;
/// numbers are <f8, texts <U of the longest one, flags |b1.
/// Source: NumPy documentation, numpy.lib.format.
std::string write_npy(const Records& records);

/// Magic, version and header of an array: `type` and `shape` in Python's spelling, "'<f4'" and
/// "(3, 4)". The array's bytes follow.
std::string npy_header(const std::string& type, const std::string& shape);

}  // namespace irido
