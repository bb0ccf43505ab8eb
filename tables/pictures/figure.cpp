#include "tables/pictures/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "schemas/readers/utf8.hpp"
#include "tables/pictures/glyphs.hpp"
#include "tables/pictures/inks.hpp"
#include "tables/pictures/panel_drawing.hpp"

namespace irido::tables {

namespace {

constexpr double kTitleSize = 16, kBody = 12, kSmall = 11;
constexpr double kSide = 14, kGap = 22, kTickGap = 6, kAxisTitle = 20, kTickHeight = 16;
constexpr double kBarGap = 14, kBarWidth = 14, kLegendRow = 20, kLegendSample = 40;
constexpr double kInnerGap = 6, kXSpace = 52, kYSpace = 30;
constexpr Ink kPale = ink(0x555555);

/// The text, or as much of both its ends as fits.
std::string fitted(const std::string& text, double size, double width) {
    if (text_width(text, size) <= width) return text;
    std::vector<std::size_t> starts;  // of characters
    for (std::size_t at = 0; at < text.size(); schemas::next_code_point(text, at))
        starts.push_back(at);
    for (std::size_t kept = starts.size() - 1; kept > 1; --kept) {
        const std::size_t front = (kept + 1) / 2, back = starts.size() - (kept - front);
        const std::string shorter =
            text.substr(0, starts[front]) + "\u2026" + text.substr(starts[back]);
        if (text_width(shorter, size) <= width) return shorter;
    }
    return "\u2026";
}

/// Lines of words that are no wider than `width`.
std::vector<std::string> wrapped(const std::string& text, double size, double width) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t blank = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, blank - at);
        if (!lines.empty() && text_width(lines.back() + " " + word, size) <= width)
            lines.back() += " " + word;
        else
            lines.push_back(fitted(word, size, width));
        at = blank + 1;
    }
    return lines;
}

struct LegendEntry {
    std::string name;
    std::vector<Path> sample;  ///< around 0, 0
};

std::vector<LegendEntry> legend_of(const Figure& figure) {
    std::vector<LegendEntry> entries;
    const auto add = [&](const std::string& name, std::vector<Path> sample) {
        if (!name.empty() && std::ranges::find(entries, name, &LegendEntry::name) == entries.end())
            entries.push_back({name, std::move(sample)});
    };
    for (const Panel& panel : figure.panels) {
        for (const Series& series : panel.series) add(series.name, legend_sample(series, {}));
        for (const Area& area : panel.areas)
            add(area.name, {legend_patch(area.style, kAreaOpacity, {})});
    }
    return entries;
}

double widest(const std::vector<Tick>& ticks) {
    double width = 0;
    for (const Tick& tick : ticks) width = std::max(width, text_width(tick.text, kBody));
    return width;
}

void check(const Figure& figure) {
    const auto require = [](bool is_good) {
        if (!is_good) throw PictureError("cannot draw values that are not finite");
    };
    if (figure.panels.empty()) throw PictureError("there is nothing to draw");
    for (const Panel& panel : figure.panels) {
        for (const Series& series : panel.series)
            for (const Point& point : series.points)
                require(std::isfinite(point.x) && std::isfinite(point.y));
        for (const Area& area : panel.areas)
            for (std::size_t i = 0; i < area.x.size(); ++i)
                require(std::isfinite(area.x[i]) && std::isfinite(area.low[i]) &&
                        std::isfinite(area.high[i]));
    }
}

/// Puts panels and texts in their places, from the top down.
class Arrangement {
public:
    explicit Arrangement(const Figure& figure) : figure_(figure) {
        drawing_.width = figure.width;
        drawing_.title = figure.title;
        drawing_.metadata = figure.metadata;
    }

    Drawing draw() {
        put_head();
        put_legend();
        put_panels();
        put_notes();
        drawing_.height = std::ceil(y_ + 12);
        return std::move(drawing_);
    }

private:
    void put_text(DrawnGroup& group, Text text) const { group.items.emplace_back(std::move(text)); }

    void put_head() {
        const double width = figure_.width - 2 * kSide;
        DrawnGroup head{.name = "head"};
        y_ = 14;
        const auto put = [&](const std::string& text, double size, Ink color) {
            if (text.empty()) return;
            y_ += size + 2;
            put_text(head, {.at = {kSide, y_},
                            .text = fitted(schemas::well_formed(text), size, width),
                            .size = size,
                            .ink = color});
        };
        put(figure_.title, kTitleSize, kLetters);
        y_ += 4;
        put(figure_.subtitle, kBody, kPale);
        y_ += 10;
        drawing_.groups.push_back(std::move(head));
    }

    void put_legend() {
        const std::vector<LegendEntry> entries = legend_of(figure_);
        if (entries.empty()) return;
        DrawnGroup legend{.name = "legend"};
        const double right = figure_.width - kSide;
        double x = kSide;
        y_ += 6;
        for (const LegendEntry& entry : entries) {
            const std::string name = fitted(schemas::well_formed(entry.name), kBody,
                                            figure_.width - 2 * kSide - kLegendSample);
            const double width = kLegendSample + text_width(name, kBody) + 18;
            if (x > kSide && x + width - 18 > right) {
                x = kSide;
                y_ += kLegendRow;
            }
            for (Path path : entry.sample) {
                for (auto& line : path.lines)
                    for (Point& point : line) point = {point.x + x + 15, point.y + y_};
                legend.items.emplace_back(std::move(path));
            }
            put_text(legend,
                     {.at = {x + kLegendSample - 4, y_ + 4}, .text = name, .ink = kLetters});
            x += width;
        }
        y_ += kLegendRow - 4;
        drawing_.groups.push_back(std::move(legend));
    }

    bool has_y_labels(std::size_t column) const { return !figure_.shared_y || column == 0; }
    /// Of a panel that has none below, if they are shared.
    bool has_x_labels(std::size_t row, std::size_t column) const {
        return !figure_.shared_x || (row + 1) * columns_ + column >= figure_.panels.size();
    }
    static double hues(const FigureAxis& axis) { return axis.hues ? kHueStrip : 0; }

    /// Room for labels left and right of the panels of a column, of panels so high.
    void measure_columns(double height) {
        left_.assign(columns_, 0);
        right_.assign(columns_, 0);
        for (std::size_t i = 0; i < figure_.panels.size(); ++i) {
            const Panel& panel = figure_.panels[i];
            const PanelPlaces places = panel_places(panel, {0, 0, 400, height});
            const std::size_t column = i % columns_;
            double& left = left_[column];
            if (has_y_labels(column)) {
                const double title = panel.y.quantity.empty() ? 0 : kAxisTitle;
                left = std::max(left,
                                widest(places.y.ticks(kYSpace)) + kTickGap + title + hues(panel.y));
            }
            if (places.bar)
                right_[column] =
                    std::max(right_[column], kBarGap + kBarWidth + kTickGap + kAxisTitle +
                                                 widest(places.bar->ticks(kYSpace)));
        }
    }

    double default_height() const {
        if (figure_.panel_height > 0) return figure_.panel_height;
        return rows_ == 1 ? 330 : rows_ == 2 ? 210 : 160;
    }

    /// Height of panels so wide whose axes have the same scale.
    double equal_height(double width) const {
        const PanelPlaces places = panel_places(figure_.panels[0], {0, 0, width, width});
        return width * std::abs((places.y.last() - places.y.first()) /
                                (places.x.last() - places.x.first()));
    }

    void put_panels() {
        columns_ = std::min(figure_.columns, figure_.panels.size());
        rows_ = (figure_.panels.size() + columns_ - 1) / columns_;
        double height = default_height();
        measure_columns(height);
        double room = figure_.width - 2 * kSide - 6;
        const double gap = figure_.joined ? 0 : kGap;
        for (std::size_t c = 0; c < columns_; ++c) room -= left_[c] + right_[c] + (c > 0 ? gap : 0);
        const double width = std::floor(room / static_cast<double>(columns_));
        if (figure_.equal_units) height = std::round(equal_height(width));
        for (std::size_t row = 0; row < rows_; ++row) {
            const bool has_titles = std::ranges::any_of(
                figure_.panels, [](const Panel& panel) { return !panel.title.empty(); });
            const double top = std::round(y_ + (has_titles ? 24 : 8));
            double x = kSide, below = 0;
            for (std::size_t c = 0; c < columns_ && row * columns_ + c < figure_.panels.size();
                 ++c) {
                x += left_[c];
                const double left = std::round(x);
                const Panel& panel = figure_.panels[row * columns_ + c];
                below = std::max(below,
                                 put_panel(panel, {left, top, left + width, top + height}, row, c));
                x += width + right_[c] + gap;
            }
            const bool is_inner = figure_.shared_x && row + 1 < rows_;
            y_ = top + height + (is_inner ? kInnerGap : below);
        }
    }

    /// Returns the height of what stands below the panel.
    double put_panel(const Panel& panel, const Box& box, std::size_t row, std::size_t column) {
        const PanelPlaces places = panel_places(panel, box);
        DrawnGroup axes{.name = "axes"};
        if (!panel.title.empty())
            put_text(axes,
                     {.at = {figure_.joined ? (box.left + box.right) / 2 : box.left, box.top - 8},
                      .text = fitted(schemas::well_formed(panel.title), kBody, box.width()),
                      .anchor = figure_.joined ? Anchor::middle : Anchor::start,
                      .ink = kLetters});
        double below = kInnerGap;
        if (has_x_labels(row, column)) below = put_x_labels(panel, places, axes);
        if (has_y_labels(column)) put_y_labels(panel, places, axes, left_[column]);
        if (places.bar) put_bar(panel, places, axes);
        draw_panel(panel, places, drawing_.groups, notes_);
        drawing_.groups.push_back(std::move(axes));
        return below;
    }

    double put_x_labels(const Panel& panel, const PanelPlaces& places, DrawnGroup& axes) const {
        const Box& box = places.box;
        double y = box.bottom + hues(panel.x);
        if (panel.x.hues)
            if (auto strip = hue_strip(places.x, box, true)) axes.items.emplace_back(*strip);
        y += kTickHeight;
        std::vector<Tick> ticks = places.x.ticks(kXSpace);
        std::ranges::sort(ticks, {}, [&](const Tick& tick) { return places.x(tick.value); });
        double reached = -1e9;  // labels that would touch are left out
        const bool is_second = figure_.joined && box.left > kSide + left_[0] + 1;
        for (const Tick& tick : ticks) {
            const double x = places.x(tick.value), half = text_width(tick.text, kBody) / 2;
            if (x - half < reached + 4 || (is_second && x < box.left + 1)) continue;
            reached = x + half;
            put_text(axes,
                     {.at = {x, y}, .text = tick.text, .anchor = Anchor::middle, .ink = kLetters});
        }
        if (is_second) return y - box.bottom + kAxisTitle + 4;
        const double middle = figure_.joined
                                  ? box.left + box.width() * static_cast<double>(columns_) / 2
                                  : (box.left + box.right) / 2;
        y += kAxisTitle;
        put_text(axes, {.at = {middle, y},
                        .text = fitted(panel.x.title(), kBody, figure_.width - 2 * kSide),
                        .anchor = Anchor::middle,
                        .ink = kLetters});
        return y - box.bottom + 4;
    }

    void put_y_labels(const Panel& panel, const PanelPlaces& places, DrawnGroup& axes,
                      double left) const {
        const Box& box = places.box;
        if (panel.y.hues)
            if (auto strip = hue_strip(places.y, box, false)) axes.items.emplace_back(*strip);
        const double x = box.left - kTickGap - hues(panel.y);
        for (const Tick& tick : places.y.ticks(kYSpace))
            put_text(axes, {.at = {x, places.y(tick.value) + 4},
                            .text = tick.text,
                            .anchor = Anchor::end,
                            .ink = kLetters});
        if (panel.y.quantity.empty()) return;
        put_text(axes, {.at = {box.left - left + 10, (box.top + box.bottom) / 2},
                        .text = fitted(panel.y.title(), kBody, box.height() + 40),
                        .anchor = Anchor::middle,
                        .ink = kLetters,
                        .upright = true});
    }

    static void put_bar(const Panel& panel, const PanelPlaces& places, DrawnGroup& axes) {
        constexpr std::size_t steps = 256;
        const Box& box = places.box;
        const Box bar{box.right + kBarGap, box.top, box.right + kBarGap + kBarWidth, box.bottom};
        Cells cells{bar, 1, steps, {}};
        for (std::size_t i = 0; i < steps; ++i)
            cells.inks.push_back(value_ink(1 - (static_cast<double>(i) + 0.5) / steps));
        axes.items.emplace_back(std::move(cells));
        Path frame = box_path(bar);
        frame.stroke = kFrame;
        axes.items.emplace_back(std::move(frame));
        const std::vector<Tick> ticks = places.bar->ticks(kYSpace);
        for (const Tick& tick : ticks)
            axes.items.emplace_back(
                Text{.at = {bar.right + kTickGap, (*places.bar)(tick.value) + 4},
                     .text = tick.text,
                     .ink = kLetters});
        axes.items.emplace_back(
            Text{.at = {bar.right + kTickGap + widest(ticks) + 16, (box.top + box.bottom) / 2},
                 .text = fitted(panel.bar.title(), kBody, box.height() + 40),
                 .anchor = Anchor::middle,
                 .ink = kLetters,
                 .upright = true});
    }

    void put_notes() {
        DrawnGroup group{.name = "notes"};
        std::vector<std::string> notes = figure_.notes;
        notes.insert(notes.end(), notes_.begin(), notes_.end());
        for (const std::string& note : notes)
            for (const std::string& line :
                 wrapped(schemas::well_formed(note), kSmall, figure_.width - 2 * kSide)) {
                y_ += kSmall + 5;
                put_text(group, {.at = {kSide, y_}, .text = line, .size = kSmall, .ink = kPale});
            }
        if (!group.items.empty()) drawing_.groups.push_back(std::move(group));
    }

    const Figure& figure_;
    Drawing drawing_;
    std::set<std::string> notes_;
    std::size_t columns_ = 1, rows_ = 1;
    std::vector<double> left_, right_;
    double y_ = 0;
};

}  // namespace

Drawing drawn(const Figure& figure) {
    check(figure);
    return Arrangement(figure).draw();
}

}  // namespace irido::tables
