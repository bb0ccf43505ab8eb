#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tables/lut/lut.hpp"

namespace irido::tables {

/// The samples of an axis as its metadata defines them: equally_spaced() if it is linear.
std::vector<double> samples_of(const LutAxis& axis);

/// Count of numbers in all levels, including channels.
std::size_t values_of(const Lut& lut);

/// Throws LutError for shapes that formats cannot write and read back: a wrong number of axes;
/// names that are empty, repeated or not plain words; samples that are not strictly monotonic; mip
/// levels with axes that are not linear; more than 2^40 values.
void check_shape(const Lut& lut);

/// Calls check_shape(), and checks that the number of values is right and all are finite in the
/// table's type. Throws LutError with the location of the first bad value: "R at cos_theta = 0.5,
/// nm = 300".
void check_values(const Lut& lut);

/// Channel and location of a value: "R at cos_theta = 0.5, nm = 300".
std::string place_of(const Lut& lut, std::size_t index);

/// Appends a number in file format: little-endian, rounded to nearest even.
void append_bytes(std::string& out, double value, LutType type);

/// The number stored in the bytes_of(type) bytes starting at `bytes`.
double number_at(const char* bytes, LutType type);

/// All values in sequence, in the format of append_bytes().
std::string value_bytes(const Lut& lut);

/// The values in the bytes of value_bytes().
std::vector<double> values_from_bytes(std::string_view bytes, LutType type);

}  // namespace irido::tables
