#pragma once

#include <string>
#include <string_view>

namespace irido::tables {

/// SHA-256 as 64 hexadecimal digits.
std::string sha256_of(std::string_view bytes);

/// SHA-256 of a file's content, in constant memory. Throws OutputError if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace irido::tables
