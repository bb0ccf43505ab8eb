#include "tables/pictures/panel_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/keep_once.hpp"
#include "tables/pictures/glyphs.hpp"
#include "tables/pictures/inks.hpp"

namespace irido::tables {

namespace {

constexpr std::array kStyleInks{ink(0x0072b2), ink(0xd55e00), ink(0x009e73),
                                ink(0xcc79a7), ink(0x000000), ink(0xe69f00),
                                ink(0x56b4e9), ink(0x7f7f7f), ink(0x8c510a)};
constexpr Ink kGuide = ink(0x8a8a8a), kHighlight = ink(0xfbe08a), kWhite = ink(0xffffff);
constexpr double kCurveWidth = 1.6, kBarShare = 0.8;
/// Width along an axis within which only a curve's least and greatest values are drawn.
constexpr double kThinStep = 0.5;
constexpr std::size_t kMostCells = 2000;

const std::vector<double>& dash_of(std::size_t style) {
    static const std::array<std::vector<double>, 7> dashes{
        {{}, {7, 3}, {2, 2}, {9, 3, 2, 3}, {13, 4}, {4, 2}, {6, 2, 2, 2, 2, 2}}};
    return dashes[style % dashes.size()];
}

Ink ink_of(std::size_t style) {
    return kStyleInks[style % kStyleInks.size()];
}

/// Circle, square, triangle, diamond or cross around a point.
Path marker(std::size_t style, Point at, Ink color) {
    const auto around = [at](const std::vector<Point>& offsets) {
        std::vector<Point> line;
        for (const Point& offset : offsets) line.push_back({at.x + offset.x, at.y + offset.y});
        return line;
    };
    Path path{.closed = true, .fill = color, .stroke = kWhite, .width = 0.6};
    switch (style % 5) {
        case 0:
            path.lines.emplace_back();
            for (int k = 0; k < 16; ++k)
                path.lines[0].push_back({at.x + 3.4 * std::cos(k * std::numbers::pi / 8),
                                         at.y + 3.4 * std::sin(k * std::numbers::pi / 8)});
            break;
        case 1:
            path.lines = {around({{-3, -3}, {3, -3}, {3, 3}, {-3, 3}})};
            break;
        case 2:
            path.lines = {around({{0, -4}, {3.8, 2.6}, {-3.8, 2.6}})};
            break;
        case 3:
            path.lines = {around({{0, -4.4}, {4.4, 0}, {0, 4.4}, {-4.4, 0}})};
            break;
        default:
            path = {
                .lines = {around({{-3.2, -3.2}, {3.2, 3.2}}), around({{-3.2, 3.2}, {3.2, -3.2}})},
                .stroke = color,
                .width = 2};
    }
    return path;
}

// --- the range of the data --------------------------------------------------------------------

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool is_empty() const { return low > high; }
};

/// Edges of the cells around samples.
std::vector<double> edges_of(const std::vector<double>& samples) {
    const std::size_t n = samples.size();
    std::vector<double> edges(n + 1);
    for (std::size_t i = 1; i < n; ++i) edges[i] = (samples[i - 1] + samples[i]) / 2;
    const double room = n > 1 ? 0 : samples[0] == 0 ? 1 : std::abs(samples[0]) * 0.1;
    edges[0] = n > 1 ? samples[0] - (edges[1] - samples[0]) : samples[0] - room;
    edges[n] = n > 1 ? samples[n - 1] + (samples[n - 1] - edges[n - 1]) : samples[0] + room;
    return edges;
}

std::size_t count_of_bars(const Panel& panel) {
    return static_cast<std::size_t>(
        std::ranges::count(panel.series, Series::Form::bars, &Series::form));
}

/// The smallest distance between two bars of a series.
double bar_spacing(const Panel& panel) {
    double spacing = std::numeric_limits<double>::infinity();
    for (const Series& series : panel.series) {
        if (series.form != Series::Form::bars) continue;
        std::vector<double> x;
        for (const Point& point : series.points) x.push_back(point.x);
        std::ranges::sort(x);
        for (std::size_t i = 1; i < x.size(); ++i)
            if (x[i] > x[i - 1]) spacing = std::min(spacing, x[i] - x[i - 1]);
    }
    return std::isfinite(spacing) ? spacing : 1;
}

void add_ranges(const Panel& panel, Range& x, Range& y) {
    const double room = count_of_bars(panel) > 0 ? bar_spacing(panel) / 2 : 0;
    for (const Series& series : panel.series) {
        if (series.form == Series::Form::guide) continue;
        for (const Point& point : series.points) {
            x.add(point.x - room);
            x.add(point.x + room);
            y.add(point.y);
        }
        if (room > 0) y.add(0);
    }
    for (const Area& area : panel.areas) {
        for (const auto& [from, range] :
             {std::pair{&area.x, &x}, {&area.low, &y}, {&area.high, &y}})
            for (const double value : *from) range->add(value);
    }
    if (!panel.grid) return;
    for (const double edge : edges_of(panel.grid->x)) x.add(edge);
    for (const double edge : edges_of(panel.grid->y)) y.add(edge);
}

// --- what is in a panel -----------------------------------------------------------------------

void draw_lines(const PanelPlaces& places, std::vector<DrawnGroup>& to) {
    DrawnGroup group{.name = "grid"};
    const Box& box = places.box;
    for (const Tick& tick : places.x.ticks(52)) {
        const double x = places.x(tick.value);
        group.items.emplace_back(line_path({x, box.top}, {x, box.bottom}, kGridLine));
    }
    for (const Tick& tick : places.y.ticks(30)) {
        const double y = places.y(tick.value);
        group.items.emplace_back(line_path({box.left, y}, {box.right, y}, kGridLine));
    }
    to.push_back(std::move(group));
}

bool is_even(const std::vector<double>& samples) {
    const double step =
        (samples.back() - samples.front()) / static_cast<double>(samples.size() - 1);
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (std::abs(samples[i] - samples[i - 1] - step) > 1e-6 * std::abs(step)) return false;
    return true;
}

/// For each of the picture's cells along an axis, in coordinate order, the sample it shows: one
/// cell per sample if they are evenly spaced and few, otherwise the nearest.
std::vector<std::size_t> shown_samples(const std::vector<double>& samples, const AxisPlaces& axis,
                                       std::set<std::string>& notes) {
    std::vector<std::size_t> shown;
    const std::size_t n = samples.size();
    const bool is_backwards = (axis.last() < axis.first()) != (axis.to() < axis.from());
    if (n <= kMostCells && (n < 2 || is_even(samples))) {
        for (std::size_t i = 0; i < n; ++i) shown.push_back(is_backwards ? n - 1 - i : i);
        return shown;
    }
    if (n > kMostCells)
        notes.insert(std::to_string(n) + " samples along an axis: every " +
                     std::to_string((n + kMostCells - 1) / kMostCells) +
                     "th or so is drawn, the nearest to its place");
    const std::vector<double> edges = edges_of(samples);
    const double from = axis(edges.front()), to = axis(edges.back());
    const double low = std::min(from, to), length = std::abs(to - from);
    for (std::size_t i = 0; i < kMostCells; ++i) {
        const double value =
            axis.value_at(low + length * (static_cast<double>(i) + 0.5) / kMostCells);
        const auto after = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
        shown.push_back(static_cast<std::size_t>(after - edges.begin()) - 1);
    }
    return shown;
}

void draw_cells(const Panel& panel, const PanelPlaces& places, std::vector<DrawnGroup>& to,
                std::set<std::string>& notes) {
    const SampleGrid& grid = *panel.grid;
    const std::vector<std::size_t> columns = shown_samples(grid.x, places.x, notes),
                                   rows = shown_samples(grid.y, places.y, notes);
    const std::vector<double> x = edges_of(grid.x), y = edges_of(grid.y);
    const auto [left, right] = std::minmax({places.x(x.front()), places.x(x.back())});
    const auto [top, bottom] = std::minmax({places.y(y.front()), places.y(y.back())});
    Cells cells{{left, top, right, bottom}, columns.size(), rows.size(), {}};
    for (const std::size_t row : rows) {
        for (const std::size_t column : columns) {
            const std::size_t at = row * grid.x.size() + column;
            if (!places.bar) {
                cells.inks.push_back(grid.inks[at]);
                continue;
            }
            const double value = grid.values[at], first = places.bar->first();
            cells.inks.push_back(std::isfinite(value)
                                     ? value_ink((value - first) / (places.bar->last() - first))
                                     : kWhite);
        }
    }
    to.push_back({.name = "cells", .clip = places.box, .items = {std::move(cells)}});
}

void draw_area(const Area& area, const PanelPlaces& places, std::vector<DrawnGroup>& to,
               DrawnGroup& labels) {
    const Box& box = places.box;
    std::vector<Point> around;
    constexpr double label_height = 15, label_room = 12;
    double tallest = label_height;
    std::optional<Point> label_at;
    for (std::size_t i = 0; i < area.x.size(); ++i) {
        const double x = places.x(area.x[i]);
        around.push_back({x, places.y(area.low[i])});
        const auto [high, low] = std::minmax({places.y(area.low[i]), places.y(area.high[i])});
        const double top = std::max(high, box.top), bottom = std::min(low, box.bottom);
        if (x < box.left + label_room || x > box.right - label_room) continue;
        if (bottom - top <= tallest + 0.5) continue;
        tallest = bottom - top;
        label_at = {std::round(x), std::round((top + bottom) / 2) + 4};
    }
    for (std::size_t i = area.x.size(); i-- > 0;)
        around.push_back({places.x(area.x[i]), places.y(area.high[i])});
    if (area.label_in_middle) {
        const double begin = std::max(places.x(area.x.front()), box.left);
        const double end = std::min(places.x(area.x.back()), box.right);
        label_at.reset();
        if (end - begin > text_width(area.label, Text{}.size))
            label_at = {std::round((begin + end) / 2), box.bottom - label_room};
    }
    DrawnGroup group{.name = "area", .title = area.title, .clip = box};
    group.items.emplace_back(Path{.lines = {around},
                                  .closed = true,
                                  .fill = ink_of(area.style),
                                  .opacity = kAreaOpacity,
                                  .stroke = ink_of(area.style),
                                  .width = 1.2});
    to.push_back(std::move(group));
    if (label_at && !area.label.empty())
        labels.items.emplace_back(Text{.at = *label_at,
                                       .text = area.label,
                                       .anchor = Anchor::middle,
                                       .ink = kLetters,
                                       .halo = true});
}

/// A curve's points in the picture, cut where it wraps around.
std::vector<std::vector<Point>> placed_lines(const Series& series, const PanelPlaces& places,
                                             double period) {
    std::vector<std::vector<Point>> lines(1);
    for (std::size_t i = 0; i < series.points.size(); ++i) {
        const Point& point = series.points[i];
        if (period > 0 && i > 0 && std::abs(point.y - series.points[i - 1].y) > period / 2)
            lines.emplace_back();
        lines.back().push_back({places.x(point.x), places.y(point.y)});
    }
    return lines;
}

/// Of the points that share an x position, the first, the lowest, the highest and the last.
std::vector<Point> thinned(const std::vector<Point>& line) {
    std::vector<Point> out;
    for (std::size_t begin = 0; begin < line.size();) {
        const double place = std::floor(line[begin].x / kThinStep);
        std::size_t end = begin + 1, low = begin, high = begin;
        for (; end < line.size() && std::floor(line[end].x / kThinStep) == place; ++end) {
            if (line[end].y < line[low].y) low = end;
            if (line[end].y > line[high].y) high = end;
        }
        std::vector<std::size_t> kept{begin, low, high, end - 1};
        keep_once(kept);
        for (const std::size_t i : kept) out.push_back(line[i]);
        begin = end;
    }
    return out;
}

void draw_curve(const Series& series, const PanelPlaces& places, double period, DrawnGroup& group,
                std::set<std::string>& notes) {
    std::vector<std::vector<Point>> lines = placed_lines(series, places, period);
    const auto most = static_cast<std::size_t>(4 * places.box.width() / kThinStep);
    for (std::vector<Point>& line : lines) {
        if (line.size() <= most) continue;
        notes.insert(std::to_string(series.points.size()) +
                     " points a curve: drawn are the least and the greatest values of every half "
                     "unit of the picture");
        line = thinned(line);
    }
    std::erase_if(lines, [](const auto& line) { return line.size() < 2; });
    Path path{.lines = std::move(lines), .stroke = ink_of(series.style), .width = kCurveWidth};
    path.dash = dash_of(series.style);
    if (series.form == Series::Form::guide) {
        path.stroke = kGuide;
        path.width = 1;
    } else if (series.form == Series::Form::highlight) {
        path.stroke = kHighlight;
        path.width = 9;
        path.dash = {};
    }
    if (!path.lines.empty()) group.items.emplace_back(std::move(path));
}

void draw_markers(const Series& series, const PanelPlaces& places, DrawnGroup& group,
                  std::set<std::string>& notes) {
    std::set<std::pair<long, long>> taken;
    constexpr std::size_t most = 5000;
    for (std::size_t i = 0; i < series.points.size(); ++i) {
        const Point at{places.x(series.points[i].x), places.y(series.points[i].y)};
        if (series.points.size() > most &&
            !taken.emplace(std::lround(at.x), std::lround(at.y)).second)
            continue;
        Path path =
            marker(series.style, at, series.inks.empty() ? ink_of(series.style) : series.inks[i]);
        if (!series.inks.empty()) {
            path.stroke = kLetters;
            path.width = 0.8;
        }
        group.items.emplace_back(std::move(path));
    }
    if (series.points.size() > most)
        notes.insert(std::to_string(series.points.size()) +
                     " points: of those at the same place, to a unit of the picture, one is drawn");
}

void draw_bars(const Panel& panel, const PanelPlaces& places, std::size_t which,
               const Series& series, DrawnGroup& group) {
    const double spacing = bar_spacing(panel), count = static_cast<double>(count_of_bars(panel));
    const double width = kBarShare * spacing / count;
    for (const Point& point : series.points) {
        const double left = point.x - kBarShare * spacing / 2 + static_cast<double>(which) * width;
        const auto [top, bottom] = std::minmax({places.y(0), places.y(point.y)});
        Path bar = box_path({places.x(left), top, places.x(left + width), bottom});
        bar.fill = ink_of(series.style);
        group.items.emplace_back(std::move(bar));
    }
}

void draw_series(const Panel& panel, const PanelPlaces& places, std::vector<DrawnGroup>& to,
                 std::set<std::string>& notes) {
    using enum Series::Form;
    std::size_t bars_drawn = 0;
    for (const Series& series : panel.series) {
        DrawnGroup group{.name = series.form == guide       ? "guide"
                                 : series.form == highlight ? "highlight"
                                                            : "series",
                         .title = series.name,
                         .clip = places.box};
        if (series.form == Series::Form::bars) {
            draw_bars(panel, places, bars_drawn++, series, group);
        } else {
            if (series.form != points) draw_curve(series, places, panel.y.period, group, notes);
            // a curve of a single point is drawn as a point
            const bool is_alone = series.form == line && series.points.size() == 1;
            if (series.form == points || series.form == line_with_points || is_alone)
                draw_markers(series, places, group, notes);
        }
        to.push_back(std::move(group));
    }
}

/// A label next to `at`, offset in the direction of a unit vector, and its bounding box.
std::pair<Text, Box> label_beside(const std::string& text, Point at, Point direction) {
    constexpr double away = 8, above = 4, sideways = 0.4, ascent = 9, descent = 3;
    const double width = text_width(text, Text{}.size);
    Text label{.at = {at.x + away * direction.x, at.y + 4 + away * direction.y},
               .text = text,
               .ink = kLetters,
               .halo = true};
    double left = label.at.x;
    if (std::abs(direction.x) < sideways) {
        label.anchor = Anchor::middle;
        label.at.y += direction.y < 0 ? -above : above;
        left -= width / 2;
    } else if (direction.x < 0) {
        label.anchor = Anchor::end;
        left -= width;
    }
    return {label, {left, label.at.y - ascent, left + width, label.at.y + descent}};
}

/// Places each label where there is room: in its direction, or on another side.
void draw_labels(const Panel& panel, const PanelPlaces& places, DrawnGroup& to) {
    const Box& frame = places.box;
    std::vector<Box> taken;
    for (const Label& label : panel.labels) {
        const Point at{places.x(label.at.x), places.y(label.at.y)};
        Point way{1, 0};
        if (label.away_from) {
            const Point from{places.x(label.away_from->x), places.y(label.away_from->y)};
            const double length = std::max(1e-9, std::hypot(at.x - from.x, at.y - from.y));
            way = {(at.x - from.x) / length, (at.y - from.y) / length};
        }
        for (const Point side :
             {way, Point{-way.x, way.y}, Point{way.y, way.x}, Point{-way.x, -way.y}}) {
            auto [text, room] = label_beside(label.text, at, side);
            const bool is_free = std::ranges::none_of(taken, [&room = room](const Box& other) {
                return room.left < other.right && other.left < room.right &&
                       room.top < other.bottom && other.top < room.bottom;
            });
            if (!is_free || room.left < frame.left + 2 || room.right > frame.right - 2 ||
                room.top < frame.top + 1 || room.bottom > frame.bottom - 1)
                continue;
            taken.push_back(room);
            to.items.emplace_back(std::move(text));
            break;
        }
    }
}

}  // namespace

PanelPlaces panel_places(const Panel& panel, const Box& box) {
    Range x, y;
    add_ranges(panel, x, y);
    const auto is_given = [](const FigureAxis& axis) { return axis.first && axis.last; };
    if ((x.is_empty() && !is_given(panel.x)) || (y.is_empty() && !is_given(panel.y)))
        throw PictureError("there is nothing to draw");
    const bool has_grid = panel.grid.has_value();
    PanelPlaces places{box,
                       {panel.x, x.low, x.high, false, box.left, box.right},
                       {panel.y, y.low, y.high, !has_grid, box.bottom, box.top},
                       {}};
    if (!has_grid || panel.grid->values.empty()) return places;
    Range values;
    for (const double value : panel.grid->values)
        if (std::isfinite(value)) values.add(value);
    if (values.is_empty()) throw PictureError("there is nothing to draw");
    places.bar.emplace(panel.bar, values.low, values.high, true, box.bottom, box.top);
    return places;
}

void draw_panel(const Panel& panel, const PanelPlaces& places, std::vector<DrawnGroup>& to,
                std::set<std::string>& notes) {
    if (panel.grid)
        draw_cells(panel, places, to, notes);
    else
        draw_lines(places, to);
    DrawnGroup labels{.name = "labels"};
    for (const Area& area : panel.areas) draw_area(area, places, to, labels);
    draw_series(panel, places, to, notes);
    Path frame = box_path(places.box);
    frame.stroke = kFrame;
    to.push_back({.name = "frame", .items = {std::move(frame)}});
    draw_labels(panel, places, labels);
    if (!labels.items.empty()) to.push_back(std::move(labels));
}

std::vector<Path> legend_sample(const Series& series, Point at) {
    using enum Series::Form;
    if (series.form == bars) return {legend_patch(series.style, 1, at)};
    std::vector<Path> paths;
    if (series.form != points) {
        Path line =
            line_path({at.x - 14, at.y}, {at.x + 14, at.y}, ink_of(series.style), kCurveWidth);
        line.dash = dash_of(series.style);
        if (series.form == guide) line.stroke = kGuide;
        if (series.form == highlight)
            line = line_path({at.x - 12, at.y}, {at.x + 12, at.y}, kHighlight, 9);
        paths.push_back(std::move(line));
    }
    if (series.form == points || series.form == line_with_points)
        paths.push_back(marker(series.style, at, ink_of(series.style)));
    return paths;
}

Path legend_patch(std::size_t style, double opacity, Point at) {
    Path patch = box_path({at.x - 9, at.y - 6, at.x + 9, at.y + 6});
    patch.fill = ink_of(style);
    patch.opacity = opacity;
    if (opacity < 1) patch.stroke = ink_of(style);
    return patch;
}

std::optional<Cells> hue_strip(const AxisPlaces& axis, const Box& box, bool is_x) {
    constexpr std::size_t count = 200;
    const double low = std::max(std::min(axis.first(), axis.last()), kFirstVisible_nm);
    const double high = std::min(std::max(axis.first(), axis.last()), kLastVisible_nm);
    if (!(low < high)) return {};
    const auto [from, to] = std::minmax({axis(low), axis(high)});
    Cells cells;
    for (std::size_t i = 0; i < count; ++i)
        cells.inks.push_back(wavelength_ink(
            std::clamp(axis.value_at(from + (to - from) * (static_cast<double>(i) + 0.5) / count),
                       kFirstVisible_nm, kLastVisible_nm)));
    constexpr double gap = 2;
    cells.columns = is_x ? count : 1;
    cells.rows = is_x ? 1 : count;
    cells.box = is_x ? Box{from, box.bottom + gap, to, box.bottom + kHueStrip}
                     : Box{box.left - kHueStrip, from, box.left - gap, to};
    return cells;
}

}  // namespace irido::tables
