#include "schemas/text_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "schemas/input_error.hpp"

namespace irido {
namespace {

[[noreturn]] void refuse(const std::string& path, int reason) {
    throw InputError(shown_path(path), "",
                     "cannot be read: " + std::generic_category().message(reason));
}

}  // namespace

std::string shown_path(const std::string& path) {
    return path == "-" ? "<stdin>" : path;
}

std::string read_text(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(
        path == "-" ? nullptr : std::fopen(path.c_str(), "rb"),
        [](std::FILE* file) { return std::fclose(file); });
    std::FILE* const file = path == "-" ? stdin : opened.get();
    if (file == nullptr) refuse(path, errno);
    std::string text;
    std::array<char, 65536> block{};
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file)) {
        text.append(block.data(), count);
    }
    if (std::ferror(file) != 0) refuse(path, errno);
    return text;
}

std::string line_and_column(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte);
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const auto column = std::count_if(before.begin() + static_cast<std::ptrdiff_t>(line_start),
                                      before.end(), [](char c) { return (c & 0xC0) != 0x80; }) +
                        1;
    return std::to_string(line) + ":" + std::to_string(column);
}

}  // namespace irido
