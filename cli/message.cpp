#include "cli/message.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <iostream>

namespace irido::cli {

namespace {

constexpr std::size_t kLongest = 400, kHead = 250;

bool continues(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// The code point at the start of a text and its length in bytes, 0 if there is none.
struct CodePoint {
    std::uint32_t value = 0;
    std::size_t bytes = 0;
};

CodePoint first_of(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    const std::size_t bytes = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    if ((lead >= 0x80 && lead < 0xC2) || lead > 0xF4 || text.size() < bytes) return {};
    std::uint32_t value = bytes == 1 ? lead : lead & (0xFFU >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if (!continues(text[i])) return {};
        value = value << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
    }
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = value >= 0xD800 && value < 0xE000;
    if (value < least[bytes] || value > 0x10FFFF || is_surrogate) return {};
    return {value, bytes};
}

/// Whether a character is a control, a line separator or a direction mark.
bool is_hidden(std::uint32_t c) {
    const auto in = [c](std::uint32_t first, std::uint32_t last) {
        return c >= first && c <= last;
    };
    return c < 0x20 || in(0x7F, 0x9F) || in(0x200E, 0x200F) || in(0x2028, 0x202E) ||
           in(0x2066, 0x2069) || c == 0xFEFF;
}

std::string hexadecimal(const char* format, std::uint32_t value) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string line;
    while (!text.empty()) {
        const CodePoint point = first_of(text);
        const std::size_t bytes = point.bytes == 0 ? 1 : point.bytes;
        if (text[0] == '\n') {
            line += "\\n";
        } else if (text[0] == '\t') {
            line += "\\t";
        } else if (point.bytes == 0 || point.value < 0x80) {
            const bool is_shown = point.bytes > 0 && !is_hidden(point.value);
            line += is_shown ? std::string(1, text[0])
                             : hexadecimal("\\x%02X", static_cast<unsigned char>(text[0]));
        } else if (is_hidden(point.value)) {
            line += hexadecimal("\\u%04X", point.value);
        } else {
            line += text.substr(0, bytes);
        }
        text.remove_prefix(bytes);
    }
    return line;
}

std::string message_line(std::string_view text) {
    constexpr std::string_view ellipsis = " ... ";
    std::string line = escaped(text);
    if (line.size() <= kLongest) return line;
    std::size_t head = kHead, tail = line.size() - (kLongest - kHead - ellipsis.size());
    while (continues(line[head])) --head;
    while (continues(line[tail])) ++tail;
    return line.substr(0, head).append(ellipsis).append(line, tail);
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
    std::string text;
    for (const std::string& word : words) {
        if (!text.empty()) text += separator;
        text += word;
    }
    return text;
}

void print_error(std::string_view text) {
    std::cerr << "irido: error: " + message_line(text) + '\n';
}

void note(const std::string& text, bool quiet) {
    if (!quiet) std::cerr << "irido: note: " + message_line(text) + '\n';
}

void Notes::operator()(const std::string& text) {
    const std::scoped_lock guard(lock_);
    if (said_.size() >= kMost || !said_.insert(text).second) return;
    note(said_.size() < kMost ? text : "further notes suppressed", quiet_);
}

}  // namespace irido::cli
