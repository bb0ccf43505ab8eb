#include "tables/pictures/svg.hpp"

#include <cmath>

#include "schemas/readers/utf8.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

std::string svg_number(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

std::string svg_coordinate(double value) {
    return svg_number(std::round(value * 100) / 100);
}

std::string svg_escaped(const std::string& text) {
    std::string out;
    for (const char c : schemas::well_formed(text)) {
        if (c == '&') {
            out += "&amp;";
        } else if (c == '<') {
            out += "&lt;";
        } else if (c == '>') {  // "]]>" is no text of XML
            out += "&gt;";
        } else if (c == '"') {
            out += "&quot;";
        } else {
            out += c;
        }
    }
    return out;
}

std::string svg_text(double x, double y, const std::string& anchor, const std::string& text) {
    return "<text x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" text-anchor=\"" + anchor +
           "\">" + svg_escaped(text) + "</text>\n";
}

std::string svg_line(double x1, double y1, double x2, double y2, const std::string& color) {
    return "<path d=\"M" + svg_coordinate(x1) + " " + svg_coordinate(y1) + "L" +
           svg_coordinate(x2) + " " + svg_coordinate(y2) + "\" stroke=\"" + color + "\"/>\n";
}

}  // namespace irido::tables
