// SVG 1.1: text stays text, and the parts of a picture are labelled (class, title). Cells are
// embedded PNG files.

#include <algorithm>
#include <array>
#include <cmath>

#include "schemas/readers/utf8.hpp"
#include "tables/pictures/glyphs.hpp"
#include "tables/pictures/picture_format.hpp"
#include "tables/pictures/png_file.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

namespace {

std::string number(double value) {
    std::string text;
    append_number(text, std::round(value * 100) / 100 + 0.0);
    return text;
}

std::string attribute(const char* name, double value) {
    return std::string(" ") + name + "=\"" + number(value) + "\"";
}

/// Text escaped for use between tags or in quotes.
std::string escaped_xml(const std::string& text) {
    std::string out;
    for (const char c : schemas::well_formed(text)) {
        if (c == '&') {
            out += "&amp;";
        } else if (c == '<') {
            out += "&lt;";
        } else if (c == '>') {  // "]]>" is not allowed in XML text
            out += "&gt;";
        } else if (c == '"') {
            out += "&quot;";
        } else {
            out += c;
        }
    }
    return out;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t block = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < 3; ++k)
            block = block << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= count ? digits[block >> (18 - 6 * k) & 63U] : '=';
    }
    return out;
}

bool is_box(const Path& path) {
    if (!path.closed || path.lines.size() != 1 || path.lines[0].size() != 4) return false;
    const std::vector<Point>& p = path.lines[0];
    return p[0].y == p[1].y && p[1].x == p[2].x && p[2].y == p[3].y && p[3].x == p[0].x &&
           p[0].x <= p[1].x && p[1].y <= p[2].y;
}

std::string shape_of(const Path& path) {
    if (is_box(path)) {
        const Point a = path.lines[0][0], b = path.lines[0][2];
        return "<rect" + attribute("x", a.x) + attribute("y", a.y) + attribute("width", b.x - a.x) +
               attribute("height", b.y - a.y);
    }
    std::string out = "<path d=\"";
    for (const std::vector<Point>& line : path.lines) {
        const char* before = "M";
        for (const Point& point : line) {
            out += before + number(point.x) + " " + number(point.y);
            before = "L";
        }
        if (path.closed) out += "Z";
    }
    return out + "\"";
}

std::string style_of(const Path& path) {
    std::string out = " fill=\"" + (path.fill ? hex(*path.fill) : "none") + "\"";
    if (path.fill && path.opacity != 1) out += attribute("fill-opacity", path.opacity);
    if (!path.stroke) return out;
    out += " stroke=\"" + hex(*path.stroke) + "\"";
    if (path.width != 1) out += attribute("stroke-width", path.width);
    if (path.dash.empty()) return out;
    out += " stroke-dasharray=\"";
    for (std::size_t i = 0; i < path.dash.size(); ++i)
        out += (i > 0 ? " " : "") + number(path.dash[i]);
    return out + "\"";
}

std::string element(const Path& path) {
    const bool is_crisp = is_box(path) && !path.stroke;
    return shape_of(path) + style_of(path) + (is_crisp ? " shape-rendering=\"crispEdges\"" : "") +
           "/>\n";
}

std::string element(const Text& text) {
    constexpr std::array anchors{"start", "middle", "end"};
    std::string out = "<text" + attribute("x", text.at.x) + attribute("y", text.at.y);
    if (text.anchor != Anchor::start)
        out +=
            std::string(" text-anchor=\"") + anchors[static_cast<std::size_t>(text.anchor)] + "\"";
    if (text.size != Text{}.size) out += attribute("font-size", text.size);
    if (text.ink != Ink{}) out += " fill=\"" + hex(text.ink) + "\"";
    if (text.upright)
        out += " transform=\"rotate(-90 " + number(text.at.x) + " " + number(text.at.y) + ")\"";
    if (text.halo) out += " paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3\"";
    return out + ">" + escaped_xml(text.text) + "</text>\n";
}

/// Cells as rectangles, which an editor can take apart; each extends under the next, so that no
/// seam shows.
std::string rectangles(const Cells& cells) {
    const Box& box = cells.box;
    const double width = box.width() / static_cast<double>(cells.columns),
                 height = box.height() / static_cast<double>(cells.rows);
    std::string out = "<g shape-rendering=\"crispEdges\">\n";
    for (std::size_t i = 0; i < cells.inks.size(); ++i) {
        const std::size_t row = i / cells.columns, column = i % cells.columns;
        const double left = box.left + width * static_cast<double>(column),
                     top = box.top + height * static_cast<double>(row);
        out += "<rect" + attribute("x", left) + attribute("y", top) +
               attribute("width", std::min(2 * width, box.right - left)) +
               attribute("height", std::min(2 * height, box.bottom - top)) + " fill=\"" +
               hex(cells.inks[i]) + "\"/>\n";
    }
    return out + "</g>\n";
}

std::string element(const Cells& cells) {
    constexpr std::size_t few = 500;
    if (cells.inks.size() <= few) return rectangles(cells);
    const std::string png = png_file({cells.columns, cells.rows, cells.inks}, 8);
    return "<image" + attribute("x", cells.box.left) + attribute("y", cells.box.top) +
           attribute("width", cells.box.width()) + attribute("height", cells.box.height()) +
           " preserveAspectRatio=\"none\" image-rendering=\"pixelated\" "
           "href=\"data:image/png;base64," +
           base64(png) + "\"/>\n";
}

std::string group_text(const DrawnGroup& group, std::size_t index) {
    const std::string id = "clip" + std::to_string(index);
    std::string out;
    if (group.clip)
        out += "<clipPath id=\"" + id + "\">" + shape_of(box_path(*group.clip)) + "/></clipPath>\n";
    out += "<g class=\"" + escaped_xml(group.name) + "\"" +
           (group.clip ? " clip-path=\"url(#" + id + ")\"" : "") + ">\n";
    if (!group.title.empty()) out += "<title>" + escaped_xml(group.title) + "</title>\n";
    for (const auto& item : group.items)
        out += std::visit([](const auto& one) { return element(one); }, item);
    return out + "</g>\n";
}

std::string write(const Drawing& drawing) {
    const std::string width = number(drawing.width), height = number(drawing.height);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width +
                      "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
                      "\" role=\"img\" font-family=\"'" + kTypeface +
                      "', Verdana, sans-serif\" font-size=\"" + number(Text{}.size) +
                      "\">\n<title>" + escaped_xml(drawing.title) + "</title>\n";
    if (!drawing.metadata.empty())
        out += "<metadata>" + escaped_xml(drawing.metadata) + "</metadata>\n";
    out += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    for (std::size_t i = 0; i < drawing.groups.size(); ++i) out += group_text(drawing.groups[i], i);
    return out + "</svg>\n";
}

}  // namespace

extern const PictureFormat picture_format_svg{
    .name = "svg",
    .summary = "vector picture for pages and editors",
    .is_binary = false,
    .write = write,
};

}  // namespace irido::tables
