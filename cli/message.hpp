#pragma once

#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace irido::cli {

/// `text` on one line that is safe for terminals: control characters, characters that reverse the
/// text direction and invalid UTF-8 become
/// , \x1B, \u202E.
std::string escaped(std::string_view text);

/// `text` as a one-line message: escaped, and shortened in the middle to 400 bytes.
std::string message_line(std::string_view text);

/// Joins words: "a, b, c".
std::string joined(const std::vector<std::string>& words, std::string_view separator);

/// Prints "irido: error: TEXT" on standard error.
void print_error(std::string_view text);

/// Prints "irido: note: TEXT" on standard error, unless quiet.
void note(const std::string& text, bool quiet);

/// Prints each note once, and at most 100 notes. Thread-safe.
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
