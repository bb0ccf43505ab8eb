#pragma once

#include <mutex>
#include <set>
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

/// Prints each note once, and at most 100. Safe from many threads.
class Notes {
public:
    explicit Notes(bool quiet) : quiet_(quiet) {}

    void operator()(const std::string& text);

private:
    static constexpr std::size_t kMost = 100;

    bool quiet_;
    std::mutex lock_;
    std::set<std::string> said_;
};

}  // namespace irido::cli
