#pragma once

#include <string>
#include <vector>

#include "tables/lut/lut_format.hpp"

namespace irido::tables {

/// The format whose name is the file's extension. Throws LutError that lists the formats.
const LutFormat& lut_format_of(const std::string& file);

/// The table in a file, with its companion if it has one. facts["checksum"] is what the file says.
/// Throws LutError "FILE: reason", or InputError if the file cannot be read.
Lut read_lut(const std::string& file);

/// Writes a table's files, the companion first, each whole or not at all; all bytes are made before
/// the first is written. Throws LutError for what the format cannot hold, or OutputError.
void write_lut(const Lut& lut, const std::string& file, const LutFormat& format,
               const LutLayout& layout);

/// What is wrong with a table that was read, one line each: values that are not finite, a checksum
/// (facts["checksum"]) that is not that of the values.
std::vector<std::string> lut_problems(const Lut& lut);

}  // namespace irido::tables
