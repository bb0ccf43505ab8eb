#pragma once

#include <string>
#include <string_view>

namespace irido {

/// SHA-256 as 64 hexadecimal digits.
std::string sha256_of(std::string_view bytes);

}  // namespace irido
