#include "tables/pictures/drawing.hpp"

#include <array>
#include <cstdio>

namespace irido::tables {

std::string hex(const Ink& ink) {
    const auto byte = [](std::uint16_t component) { return (component + 128U) / 257U; };
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", byte(ink.r), byte(ink.g), byte(ink.b));
    return text.data();
}

Path box_path(const Box& box) {
    return {.lines = {{{box.left, box.top},
                       {box.right, box.top},
                       {box.right, box.bottom},
                       {box.left, box.bottom}}},
            .closed = true};
}

Path line_path(Point from, Point to, const Ink& ink, double width) {
    return {.lines = {{from, to}}, .stroke = ink, .width = width};
}

}  // namespace irido::tables
