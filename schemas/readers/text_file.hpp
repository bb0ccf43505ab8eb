#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace irido::schemas {

/// Allowed kinds of input. A document named by the user may come from a pipe; a file named in a
/// document may not, as a pipe might block its reader for ever.
enum class TextSource { anything, regular_file };

/// The bytes of an input; "-" is standard input. A regular file is registered as an input, see
/// is_input(). Throws InputError with the system's reason, or if the input exceeds 64 MiB (pipes
/// and devices) or 1 GiB (files). Thread-safe.
std::string read_bytes(const std::string& path, TextSource source = TextSource::anything);

/// Throws InputError for text in UTF-16.
void require_no_utf16(std::string_view text, const std::string& file);

/// read_bytes() of a text, for which require_no_utf16() holds.
std::string read_text(const std::string& path, TextSource source = TextSource::anything);

/// The bytes of a regular file that irido has written, of any length. It is not registered as an
/// input, so it may be overwritten. Throws InputError.
std::string read_own_file(const std::string& path);

/// Makes a file that read_own_file() reads one of the inputs, if it is there.
void mark_as_input(const std::string& path);

/// Whether the file at this path, by whatever name or link, is one of the inputs.
bool is_input(const std::string& path);

/// A path as shown in messages: itself, or "<stdin>" for "-".
std::string shown_path(const std::string& path);

/// "LINE:COLUMN" of a byte offset in a text, both counted from 1 in characters.
std::string line_and_column(std::string_view text, std::size_t byte);

}  // namespace irido::schemas
