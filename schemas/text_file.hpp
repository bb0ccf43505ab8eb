#pragma once

#include <string>

namespace irido {

/// The bytes of a file, "-" being standard input. Throws InputError with the system's reason.
std::string read_text(const std::string& path);

/// What messages call a path: itself, or "<stdin>" for "-".
std::string shown_path(const std::string& path);

}  // namespace irido
