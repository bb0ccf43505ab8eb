#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace irido {

/// The bytes of a file, "-" being standard input. Throws InputError with the system's reason.
std::string read_text(const std::string& path);

/// What messages call a path: itself, or "<stdin>" for "-".
std::string shown_path(const std::string& path);

/// "LINE:COLUMN" of a byte of a text, both counted from 1 in characters.
std::string line_and_column(std::string_view text, std::size_t byte);

}  // namespace irido
