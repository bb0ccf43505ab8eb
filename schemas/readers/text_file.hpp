#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace irido::schemas {

/// What a text may be read from. A document that the user names may come from a pipe, a file that
/// a document names must not: a pipe might make its reader wait for ever.
enum class TextSource { anything, regular_file };

/// The bytes of an input, "-" being standard input. A regular file becomes one of the inputs, see
/// is_input(). Throws InputError with the system's reason, or if it is longer than 64 MiB from a
/// pipe or a device and 1 GiB from a file. Safe from many threads.
std::string read_text(const std::string& path, TextSource source = TextSource::anything);

/// The bytes of a regular file that irido has written, of any length; it does not become an input:
/// it may be written again. Throws InputError.
std::string read_own_file(const std::string& path);

/// Makes a file that read_own_file() reads one of the inputs, if it is there.
void mark_as_input(const std::string& path);

/// Whether the file at this path, by whatever name or link, is one of the inputs.
bool is_input(const std::string& path);

/// What messages call a path: itself, or "<stdin>" for "-".
std::string shown_path(const std::string& path);

/// "LINE:COLUMN" of a byte of a text, both counted from 1 in characters.
std::string line_and_column(std::string_view text, std::size_t byte);

}  // namespace irido::schemas
