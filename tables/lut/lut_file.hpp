#pragma once

#include <string>
#include <vector>

#include "tables/lut/lut_format.hpp"

namespace irido::tables {

/// The format whose name is the file's extension. Throws LutError, which lists the formats.
const LutFormat& lut_format_of(const std::string& file);

/// Reads a table from a file and its companion. facts["checksum"] is the one stored in the file.
/// Throws LutError "FILE: reason", or InputError if the file cannot be read.
Lut read_lut(const std::string& file);

/// Writes a table's files, the companion first, each whole or not at all. Throws LutError for
/// tables that the format cannot represent, or OutputError.
/// lut     the table
/// file    path of the main file; a companion adds .json
/// format  the file format
/// layout  options of ktx2; must be empty for other formats
void write_lut(const Lut& lut, const std::string& file, const LutFormat& format,
               const LutLayout& layout);

/// The problems of a table read from a file, one line each: values that are not finite, or a
/// checksum (facts["checksum"]) that does not match.
std::vector<std::string> lut_problems(const Lut& lut);

}  // namespace irido::tables
