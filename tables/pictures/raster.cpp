#include "tables/pictures/raster.hpp"

#include <algorithm>
#include <cmath>

#include "tables/pictures/outline.hpp"

namespace irido::tables {

namespace {

constexpr int kSteps = 16;  ///< scan lines per row of pixels
constexpr double kHaloWidth = 3;
constexpr Ink kPaper = ink(0xffffff);

struct Edge {
    double top, bottom, x, slope;  ///< x at the top, slope of x over y
    int winding;
};

struct Crossing {
    double x;
    int winding;
};

/// The canvas: pixels, and the functions that draw on them.
class Canvas {
public:
    Canvas(const Drawing& drawing, double scale) : scale_(scale) {
        const auto size = [&](double units) {
            return static_cast<std::size_t>(std::lround(units * scale));
        };
        pixels_ = {size(drawing.width), size(drawing.height), {}};
        pixels_.inks.assign(pixels_.width * pixels_.height, kPaper);
    }

    Pixels take() { return std::move(pixels_); }

    void clip(const std::optional<Box>& box) {
        const double wide = static_cast<double>(pixels_.width),
                     high = static_cast<double>(pixels_.height);
        clip_ = {0, 0, wide, high};
        if (!box) return;
        clip_.left = std::clamp(std::round(box->left * scale_), 0.0, wide);
        clip_.right = std::clamp(std::round(box->right * scale_), 0.0, wide);
        clip_.top = std::clamp(std::round(box->top * scale_), 0.0, high);
        clip_.bottom = std::clamp(std::round(box->bottom * scale_), 0.0, high);
    }

    void draw(const Path& path) {
        if (path.fill) fill(path.lines, *path.fill, path.opacity);
        if (path.stroke) fill(stroke_outline(path), *path.stroke, 1);
    }

    void draw(const Text& text) {
        const std::vector<std::vector<Point>> outline = text_outline(text);
        if (text.halo)
            fill(stroke_outline({.lines = outline, .closed = true, .width = kHaloWidth}), kPaper,
                 1);
        fill(outline, text.ink, 1);
    }

    void draw(const Cells& cells) {
        const auto range = [&](double low, double high, double first, double last) {
            return std::pair{static_cast<std::size_t>(std::max(std::round(low * scale_), first)),
                             static_cast<std::size_t>(std::min(std::round(high * scale_), last))};
        };
        const auto [left, right] = range(cells.box.left, cells.box.right, clip_.left, clip_.right);
        const auto [top, bottom] = range(cells.box.top, cells.box.bottom, clip_.top, clip_.bottom);
        const auto place = [&](std::size_t at, double first, double length, std::size_t count) {
            const double part = ((static_cast<double>(at) + 0.5) / scale_ - first) / length;
            const double cell = std::floor(part * static_cast<double>(count));
            return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
        };
        for (std::size_t y = top; y < bottom; ++y) {
            const std::size_t row = place(y, cells.box.top, cells.box.height(), cells.rows);
            for (std::size_t x = left; x < right; ++x)
                pixels_.inks[y * pixels_.width + x] =
                    cells.inks[row * cells.columns +
                               place(x, cells.box.left, cells.box.width(), cells.columns)];
        }
    }

private:
    std::vector<Edge> edges_of(const std::vector<std::vector<Point>>& lines) const {
        std::vector<Edge> edges;
        for (const std::vector<Point>& line : lines) {
            for (std::size_t i = 0; i < line.size(); ++i) {
                Point a = line[i], b = line[(i + 1) % line.size()];
                if (a.y == b.y) continue;
                const int winding = a.y < b.y ? 1 : -1;
                if (winding < 0) std::swap(a, b);
                const double slope = (b.x - a.x) / (b.y - a.y);
                edges.push_back({a.y * scale_, b.y * scale_, a.x * scale_, slope, winding});
            }
        }
        std::ranges::sort(edges, {}, &Edge::top);
        return edges;
    }

    void fill(const std::vector<std::vector<Point>>& lines, const Ink& ink, double opacity) {
        const std::vector<Edge> edges = edges_of(lines);
        if (edges.empty()) return;
        double last = edges.front().bottom;
        for (const Edge& edge : edges) last = std::max(last, edge.bottom);
        const double first_row = std::max(clip_.top, std::floor(edges.front().top));
        const double end_row = std::min(clip_.bottom, std::ceil(last));
        cover_.assign(pixels_.width + 1, 0);
        std::vector<const Edge*> active;
        std::size_t next = 0;
        for (double row = first_row; row < end_row; ++row) {
            while (next < edges.size() && edges[next].top < row + 1)
                active.push_back(&edges[next++]);
            std::erase_if(active, [row](const Edge* edge) { return edge->bottom <= row; });
            cover_row(active, row);
            blend_row(static_cast<std::size_t>(row), ink, opacity);
        }
    }

    void cover_row(const std::vector<const Edge*>& active, double row) {
        for (int step = 0; step < kSteps; ++step) {
            const double y = row + (step + 0.5) / kSteps;
            crossings_.clear();
            for (const Edge* edge : active)
                if (edge->top <= y && y < edge->bottom)
                    crossings_.push_back({edge->x + (y - edge->top) * edge->slope, edge->winding});
            std::ranges::sort(crossings_, {}, &Crossing::x);
            int winding = 0;
            for (std::size_t i = 0; i + 1 < crossings_.size(); ++i) {
                winding += crossings_[i].winding;
                if (winding != 0) cover_span(crossings_[i].x, crossings_[i + 1].x);
            }
        }
    }

    void cover_span(double from, double to) {
        from = std::max(from, clip_.left);
        to = std::min(to, clip_.right);
        if (from >= to) return;
        const auto first = static_cast<std::size_t>(from), last = static_cast<std::size_t>(to);
        if (first == last) {
            cover_[first] += to - from;
            return;
        }
        cover_[first] += static_cast<double>(first + 1) - from;
        for (std::size_t x = first + 1; x < last; ++x) cover_[x] += 1;
        cover_[last] += to - static_cast<double>(last);
    }

    void blend_row(std::size_t row, const Ink& ink, double opacity) {
        for (std::size_t x = static_cast<std::size_t>(clip_.left); x < pixels_.width; ++x) {
            if (cover_[x] == 0) continue;
            const double part = std::min(cover_[x] / kSteps, 1.0) * opacity;
            cover_[x] = 0;
            Ink& pixel = pixels_.inks[row * pixels_.width + x];
            const auto mixed = [part](std::uint16_t below, std::uint16_t above) {
                return static_cast<std::uint16_t>(std::lround(below + part * (above - below)));
            };
            pixel = {mixed(pixel.r, ink.r), mixed(pixel.g, ink.g), mixed(pixel.b, ink.b)};
        }
        cover_[pixels_.width] = 0;
    }

    double scale_;
    Pixels pixels_;
    Box clip_;
    std::vector<double> cover_;
    std::vector<Crossing> crossings_;
};

}  // namespace

Pixels rasterized(const Drawing& drawing, double scale) {
    Canvas canvas(drawing, scale);
    for (const DrawnGroup& group : drawing.groups) {
        canvas.clip(group.clip);
        for (const auto& item : group.items)
            std::visit([&](const auto& one) { canvas.draw(one); }, item);
    }
    return canvas.take();
}

}  // namespace irido::tables
