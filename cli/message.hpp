#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irido::cli {

/// `text` on one line that a terminal shows as it is: control characters, those that reverse the
/// direction of a text and bytes that are not UTF-8 become \n, \x1B, \u202E.
std::string escaped(std::string_view text);

/// `text` as the line of a message: escaped, and shortened in the middle to 400 bytes.
std::string message_line(std::string_view text);

/// "a, b, c".
std::string joined(const std::vector<std::string>& words, std::string_view separator);

/// "irido: error: TEXT" on standard error.
void print_error(std::string_view text);

/// "irido: note: TEXT" on standard error, unless quiet.
void note(const std::string& text, bool quiet);

}  // namespace irido::cli
