#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tables/lut/lut.hpp"

namespace irido::tables {

/// The samples of an axis as its metadata gives them: equally_spaced() if it is linear.
std::vector<double> samples_of(const LutAxis& axis);

/// Numbers of all levels, channels counted.
std::size_t values_of(const Lut& lut);

/// Throws LutError for shapes that formats cannot write and read back: a wrong number of axes;
/// names that are empty, repeated or no plain words; samples that are not strictly monotonic; mip
/// levels of axes that are not linear; more than 2^40 values.
void check_shape(const Lut& lut);

/// check_shape(), and checks that the number of values is right and all are finite in the table's
/// type. Throws LutError with the place of the first bad value: "R at cos_theta = 0.5, nm = 300".
void check_values(const Lut& lut);

/// Channel and place of a value: "R at cos_theta = 0.5, nm = 300".
std::string place_of(const Lut& lut, std::size_t index);

/// One number as it stands in a file, little-endian, rounded to nearest even.
void append_bytes(std::string& out, double value, LutType type);

/// The number in the bytes_of(type) bytes from `bytes` on.
double number_at(const char* bytes, LutType type);

/// All values, one after the other, as append_bytes() has them.
std::string value_bytes(const Lut& lut);

/// The values in the bytes of value_bytes().
std::vector<double> values_from_bytes(std::string_view bytes, LutType type);

}  // namespace irido::tables
