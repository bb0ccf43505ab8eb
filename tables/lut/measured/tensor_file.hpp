#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace irido::tables {

/// A named array of a tensor file, row-major.
struct TensorField {
    std::string name;
    std::vector<std::uint64_t> shape;
    std::vector<float> numbers;       ///< data of a field of 32-bit floats
    std::vector<std::uint8_t> bytes;  ///< data of a field of bytes, if there are no numbers
};

/// The container format of the RGL material database, read by Mitsuba's and pbrt's measured
/// materials: "tensor_file" and a zero byte, version 1.0, a 32-bit count of fields; for each field
/// the length of its name (16 bits), the name, the number of dimensions (16 bits), the type (8
/// bits: 1 bytes, 10 floats), the offset of its data (64 bits) and its dimensions (64 bits each);
/// then the data, aligned to 8 bytes, all little-endian.
/// Source: J. Dupuy and W. Jakob, An Adaptive Parameterization for Efficient Material Acquisition
/// and Rendering, ACM TOG 37(6), 2018, and the reader that comes with its data.
std::string tensor_file(const std::vector<TensorField>& fields);

}  // namespace irido::tables
