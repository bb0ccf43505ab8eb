#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace irido {

/// Output that could not be written; the text names the file and the system's reason.
struct OutputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Nobody reads standard output any more.
struct BrokenPipe {};

/// Writes a file whole or not at all: a temporary name in the same folder, then a rename; an
/// existing file keeps its permissions. Devices and pipes are written to directly. Throws
/// OutputError.
void write_file(const std::string& path, std::string_view bytes);

/// Writes to standard output. Throws OutputError, or BrokenPipe.
void write_stdout(std::string_view bytes);

/// Removes the temporary file of a write_file() that is under way. For signal handlers.
void remove_unfinished_file() noexcept;

}  // namespace irido
