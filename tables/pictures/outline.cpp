#include "tables/pictures/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tables/pictures/glyphs.hpp"

namespace irido::tables {

namespace {

constexpr int kCurvePieces = 6, kCornerPieces = 12;
constexpr double kSharpCorner = 0.97;  ///< cosine of a visible bend

Point between(Point a, Point b, double part) {
    return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}

double distance(Point a, Point b) {
    return std::hypot(b.x - a.x, b.y - a.y);
}

/// Splits a line into its dashes, each a separate line.
std::vector<std::vector<Point>> dashes_of(const std::vector<Point>& line,
                                          const std::vector<double>& dash) {
    std::vector<std::vector<Point>> dashes;
    std::size_t kind = 0;
    double left = dash.front();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const double length = distance(line[i], line[i + 1]);
        if (i == 0) dashes.push_back({line[0]});
        for (double at = 0; length > 0;) {
            const double step = std::min(left, length - at);
            at += step;
            left -= step;
            const Point end = between(line[i], line[i + 1], at / length);
            if (kind % 2 == 0) dashes.back().push_back(end);
            if (left > 0) break;
            kind = (kind + 1) % dash.size();
            left = dash[kind];
            if (kind % 2 == 0) dashes.push_back({end});
        }
    }
    return dashes;
}

void add_line(const std::vector<Point>& line, double half,
              std::vector<std::vector<Point>>& outlines) {
    Point before{};
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Point a = line[i], b = line[i + 1];
        const double length = distance(a, b);
        if (length == 0) continue;
        const Point along{(b.x - a.x) / length, (b.y - a.y) / length};
        const Point aside{-along.y * half, along.x * half};
        outlines.push_back({{a.x + aside.x, a.y + aside.y},
                            {a.x - aside.x, a.y - aside.y},
                            {b.x - aside.x, b.y - aside.y},
                            {b.x + aside.x, b.y + aside.y}});
        if (i > 0 && along.x * before.x + along.y * before.y < kSharpCorner) {
            std::vector<Point> corner;
            for (int k = 0; k < kCornerPieces; ++k) {
                const double turn = 2 * std::numbers::pi * k / kCornerPieces;
                corner.push_back({a.x + half * std::cos(turn), a.y + half * std::sin(turn)});
            }
            outlines.push_back(std::move(corner));
        }
        before = along;
    }
}

}  // namespace

std::vector<std::vector<Point>> text_outline(const Text& text) {
    const double scale = text.size / kGlyphUnits;
    double pen = 0;
    if (text.anchor != Anchor::start)
        pen = -text_width(text.text, text.size) * (text.anchor == Anchor::end ? 1 : 0.5);
    std::vector<std::vector<Point>> lines;
    for (const char32_t character : characters_of(text.text)) {
        const Glyph& glyph = glyph_of(character);
        const auto placed = [&](Point point) {
            const Point flat{pen + point.x * scale, -point.y * scale};
            if (text.upright) return Point{text.at.x + flat.y, text.at.y - flat.x};
            return Point{text.at.x + flat.x, text.at.y + flat.y};
        };
        for (const GlyphContour& contour : glyph.contours) {
            std::vector<Point> line{placed(contour.first)};
            Point last = contour.first;
            for (const auto& [control, end, straight] : contour.curves) {
                for (int k = 1; !straight && k < kCurvePieces; ++k) {
                    const double t = static_cast<double>(k) / kCurvePieces;
                    line.push_back(
                        placed(between(between(last, control, t), between(control, end, t), t)));
                }
                line.push_back(placed(end));
                last = end;
            }
            lines.push_back(std::move(line));
        }
        pen += glyph.advance * scale;
    }
    return lines;
}

std::vector<std::vector<Point>> stroke_outline(const Path& path) {
    std::vector<std::vector<Point>> outlines;
    for (std::vector<Point> line : path.lines) {
        if (path.closed) {
            line.push_back(line[0]);
            if (line.size() > 2 && path.dash.empty()) line.push_back(line[1]);  // the last corner
        }
        if (path.dash.empty()) {
            add_line(line, path.width / 2, outlines);
            continue;
        }
        for (const std::vector<Point>& dash : dashes_of(line, path.dash))
            add_line(dash, path.width / 2, outlines);
    }
    return outlines;
}

}  // namespace irido::tables
