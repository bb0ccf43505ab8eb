#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tables/pictures/glyphs.hpp"
#include "tables/pictures/outline.hpp"
#include "tables/pictures/picture_format.hpp"
#include "tables/pictures/raster.hpp"

using namespace irido::tables;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

Drawing drawing_of(std::variant<Path, Text, Cells> item) {
    Drawing drawing{20, 10, "test", "", 8, {}};
    drawing.groups.push_back({.name = "all", .items = {std::move(item)}});
    return drawing;
}

Path filled(std::vector<Point> line) {
    return {.lines = {std::move(line)}, .closed = true, .fill = ink(0x000000)};
}

/// Fraction of a pixel covered by black.
double cover_at(const Pixels& pixels, std::size_t x, std::size_t y) {
    return 1 - pixels.inks[y * pixels.width + x].r / 65535.0;
}

double area_of(const Pixels& pixels) {
    double area = 0;
    for (const Ink& one : pixels.inks) area += 1 - one.r / 65535.0;
    return area;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
        number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
    return number;
}

/// The chunk names of a PNG file.
std::vector<std::string> chunks_of(const std::string& png) {
    std::vector<std::string> names;
    for (std::size_t at = 8; at < png.size(); at += 12 + number_at(png, at))
        names.push_back(png.substr(at + 4, 4));
    return names;
}

Drawing sample() {
    Drawing drawing{200, 100, "a <b> & \"c\"", "{\"a\":\"]]>\"}", 8, {}};
    Path line = line_path({0, 0}, {200, 100}, ink(0x0072b2), 3);
    line.dash = {5, 2};
    drawing.groups.push_back(
        {.name = "one",
         .title = "x < y",
         .clip = Box{10, 10, 190, 90},
         .items = {line, Text{{100, 50}, "\u03bb \u2212 \u2070 \u4e2d ]]>", Anchor::middle, 14},
                   Cells{{20, 20, 40, 40}, 2, 1, {ink(0xff0000), ink(0x00ff00)}}}});
    return drawing;
}

}  // namespace

TEST_CASE("pixels have the share of their area that is covered", "[pictures]") {
    const auto square = rasterized(drawing_of(filled({{2, 2}, {5.25, 2}, {5.25, 6}, {2, 6}})), 1);
    CHECK(square.width == 20);
    CHECK(square.height == 10);
    CHECK(cover_at(square, 3, 3) == 1);
    CHECK(cover_at(square, 1, 3) == 0);
    CHECK_THAT(cover_at(square, 5, 3), WithinAbs(0.25, 1e-4));  // 16 bits
    CHECK_THAT(area_of(square), WithinAbs(3.25 * 4, 1e-3));
    const auto triangle = rasterized(drawing_of(filled({{1, 1}, {17, 1}, {1, 9}})), 1);
    CHECK_THAT(area_of(triangle), WithinAbs(64, 0.05));
    CHECK_THAT(area_of(rasterized(drawing_of(filled({{1, 1}, {17, 1}, {1, 9}})), 2)),
               WithinAbs(256, 0.1));
}

TEST_CASE("what overlaps itself is covered once, a hole is not", "[pictures]") {
    Path twice = filled({{2, 2}, {8, 2}, {8, 8}, {2, 8}});
    twice.lines.push_back({{4, 2}, {10, 2}, {10, 8}, {4, 8}});
    CHECK_THAT(area_of(rasterized(drawing_of(twice), 1)), WithinAbs(48, 1e-2));
    Path ring = filled({{2, 2}, {8, 2}, {8, 8}, {2, 8}});
    ring.lines.push_back({{4, 4}, {4, 6}, {6, 6}, {6, 4}});
    CHECK_THAT(area_of(rasterized(drawing_of(ring), 1)), WithinAbs(32, 1e-2));
}

TEST_CASE("a line is as wide as it says, and dashes leave their part out", "[pictures]") {
    Path line = line_path({2, 5}, {18, 5}, ink(0x000000), 2);
    CHECK_THAT(area_of(rasterized(drawing_of(line), 1)), WithinAbs(32, 1e-2));
    line.dash = {3, 1};
    CHECK_THAT(area_of(rasterized(drawing_of(line), 1)), WithinAbs(24, 1e-2));
    // two bars of 36 and 20 minus their overlap, and the corner's quarter of a twelve-sided polygon
    const Path corner{.lines = {{{3, 3}, {12, 3}, {12, 8}}}, .stroke = ink(0x000000), .width = 4};
    CHECK_THAT(area_of(rasterized(drawing_of(corner), 1)), WithinAbs(36 + 20 - 4 + 3, 0.05));
    Path steep = line_path({2, 1}, {5, 5}, ink(0x000000), 1);
    CHECK_THAT(area_of(rasterized(drawing_of(steep), 4)), WithinAbs(5 * 16, 0.5));
}

TEST_CASE("cells fill their box without a seam and take no others' pixels", "[pictures]") {
    const Cells cells{{2, 2, 10, 6}, 4, 2, std::vector<Ink>(8, ink(0x102030))};
    const Pixels pixels = rasterized(drawing_of(cells), 1);
    CHECK(std::ranges::count(pixels.inks, ink(0x102030)) == 32);
    Drawing clipped = drawing_of(cells);
    clipped.groups[0].clip = Box{4, 0, 8, 10};
    CHECK(std::ranges::count(rasterized(clipped, 1).inks, ink(0x102030)) == 16);
}

TEST_CASE("text has the typeface's measures, whatever its characters are", "[pictures]") {
    CHECK_THAT(text_width("A", 2048), WithinAbs(1401, 1e-9));
    CHECK_THAT(text_width("AA", 12), WithinAbs(2 * 1401 * 12 / 2048.0, 1e-9));
    CHECK(text_width("\u4e2d", 12) == text_width("\ufffd", 12));
    CHECK(text_width("", 12) == 0);
    const auto inside = [](Text text) {
        Box box{1e9, 1e9, -1e9, -1e9};
        for (const auto& line : text_outline(text))
            for (const Point& point : line) {
                box.left = std::min(box.left, point.x);
                box.right = std::max(box.right, point.x);
                box.top = std::min(box.top, point.y);
                box.bottom = std::max(box.bottom, point.y);
            }
        return box;
    };
    Text text{{100, 50}, "HIH", Anchor::middle, 20, {}, false, false};
    const Box flat = inside(text);
    CHECK_THAT(flat.left + flat.right, WithinAbs(200, 1e-9));
    CHECK_THAT(flat.bottom, WithinAbs(50, 1e-9));
    CHECK_THAT(flat.height(), WithinAbs(20 * 1493 / 2048.0, 1e-9));
    text.upright = true;
    const Box turned = inside(text);
    CHECK_THAT(turned.top + turned.bottom, WithinAbs(100, 1e-9));
    CHECK_THAT(turned.right, WithinAbs(100, 1e-9));
}

TEST_CASE("formats of pictures are those of their files, and write the same bytes again",
          "[pictures]") {
    std::vector<std::string> names;
    for (const PictureFormat* format : picture_formats()) {
        names.emplace_back(format->name);
        CHECK(find_picture_format(format->name) == format);
        CHECK(format->write(sample()) == format->write(sample()));
    }
    CHECK(names == std::vector<std::string>{"pdf", "png", "svg"});
    CHECK(find_picture_format("gif") == nullptr);
}

TEST_CASE("PNG says that it is sRGB, and has 8 or 16 bits", "[pictures]") {
    const PictureFormat& png = *find_picture_format("png");
    Drawing drawing = sample();
    for (const unsigned bits : {8U, 16U}) {
        drawing.bits = bits;
        const std::string file = png.write(drawing);
        CHECK(file.substr(0, 8) == "\x89PNG\r\n\x1a\n");
        CHECK(number_at(file, 16) == 400);
        CHECK(number_at(file, 20) == 200);
        CHECK(static_cast<unsigned>(file[24]) == bits);
        const std::vector<std::string> chunks = chunks_of(file);
        for (const char* name : {"IHDR", "sRGB", "gAMA", "cHRM", "pHYs", "iTXt", "IDAT", "IEND"})
            CHECK(std::ranges::count(chunks, name) > 0);
        CHECK(std::ranges::count(chunks, "tIME") == 0);
    }
    drawing.metadata.clear();
    CHECK(std::ranges::count(chunks_of(png.write(drawing)), "iTXt") == 0);
}

TEST_CASE("SVG keeps text as text and well formed", "[pictures]") {
    const std::string svg = find_picture_format("svg")->write(sample());
    CHECK_THAT(svg, Contains("<title>a &lt;b&gt; &amp; &quot;c&quot;</title>"));
    CHECK_THAT(svg, Contains("<title>x &lt; y</title>"));
    CHECK_THAT(svg, Contains(">\u03bb \u2212 \u2070 \u4e2d ]]&gt;</text>"));
    CHECK_THAT(svg, Contains("stroke-dasharray=\"5 2\""));
    CHECK_THAT(svg, Contains("fill=\"#ff0000\"") && Contains("fill=\"#00ff00\""));
    CHECK_THAT(svg, !Contains("data:image"));  // a few cells stay shapes
    Drawing many = drawing_of(Cells{{0, 0, 20, 10}, 40, 40, std::vector<Ink>(1600)});
    CHECK_THAT(find_picture_format("svg")->write(many),
               Contains("href=\"data:image/png;base64,iVBORw0KGgo"));
}

TEST_CASE("PDF's table leads to its objects", "[pictures]") {
    const std::string pdf = find_picture_format("pdf")->write(sample());
    CHECK(pdf.starts_with("%PDF-1.4\n"));
    CHECK(pdf.ends_with("%%EOF\n"));
    const std::size_t start = pdf.rfind("startxref\n") + 10;
    const std::size_t table = std::stoul(pdf.substr(start));
    CHECK(pdf.substr(table, 7) == "xref\n0 ");
    const std::size_t count = std::stoul(pdf.substr(table + 7));
    CHECK(count > 8);
    const std::size_t lines = pdf.find('\n', table + 7) + 1;
    for (std::size_t object = 1; object < count; ++object) {
        const std::size_t place = std::stoul(pdf.substr(lines + 20 * object, 10));
        const std::string head = std::to_string(object) + " 0 obj\n";
        CHECK(pdf.substr(place, head.size()) == head);
    }
    CHECK_THAT(pdf, Contains("/ToUnicode") && !Contains("CreationDate"));
}
