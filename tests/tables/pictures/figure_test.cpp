#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tables/pictures/axis.hpp"
#include "tables/pictures/band_figure.hpp"
#include "tables/pictures/chromaticity_figure.hpp"
#include "tables/pictures/figure.hpp"
#include "tables/pictures/picture_format.hpp"

using namespace irido;
using namespace irido::tables;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

Figure curve(std::vector<Point> points) {
    Figure figure{.title = "curve"};
    Panel panel{.x = {.quantity = "x"}, .y = {.quantity = "y"}};
    panel.series.push_back({.name = "a", .points = std::move(points)});
    figure.panels.push_back(std::move(panel));
    return figure;
}

std::string svg_of(const Figure& figure) {
    return find_picture_format("svg")->write(drawn(figure));
}

/// The paths of all groups with a name.
std::vector<Path> paths_in(const Drawing& drawing, const std::string& name) {
    std::vector<Path> paths;
    for (const DrawnGroup& group : drawing.groups)
        if (group.name == name)
            for (const auto& item : group.items)
                if (const Path* path = std::get_if<Path>(&item)) paths.push_back(*path);
    return paths;
}

Box frame_of(const Drawing& drawing) {
    const Path frame = paths_in(drawing, "frame").at(0);
    return {frame.lines[0][0].x, frame.lines[0][0].y, frame.lines[0][2].x, frame.lines[0][2].y};
}

}  // namespace

TEST_CASE("labels of axes are short and round", "[pictures]") {
    CHECK(tick_text(0.30000000000000004, 0.1) == "0.3");
    CHECK(tick_text(-5, 1) == "\u22125");
    CHECK(tick_text(1e-17, 0.1) == "0");
    CHECK(tick_text(1, 0.2) == "1.0");
    CHECK(tick_text(2e6, 1e6) == "2\u00b710\u2076");
    CHECK(tick_text(1.5e-7, 0.5e-7) == "1.5\u00b710\u207b\u2077");
    CHECK(tick_text(1e7, 1e7) == "10\u2077");
    CHECK(tick_text(0.039946, 2e-6) == "0.039946");
    const FigureAxis share{.quantity = "R", .from_zero = true};
    CHECK(AxisPlaces(share, 0.2, 0.8, true, 0, 1).first() == 0);
    CHECK_THAT(AxisPlaces(share, 0.95, 0.99, true, 0, 1).first(), WithinAbs(0.95, 1e-12));
    CHECK(AxisPlaces(share, 0.04, 0.0400001, true, 0, 1).first() == 0);  // flat
    const FigureAxis plain{.quantity = "q"};
    const AxisPlaces places(plain, 0.1, 9.7, true, 0, 400);
    CHECK(places.first() == 0);
    CHECK(places.last() == 10);
    CHECK_THAT(places(5), WithinAbs(200, 1e-9));
    CHECK_THAT(places.value_at(100), WithinAbs(2.5, 1e-12));
    const FigureAxis powers{.quantity = "q", .logarithmic = true, .first = 1e-3, .last = 10};
    const AxisPlaces decades(powers, 0, 0, true, 400, 0);
    CHECK_THAT(decades(0.1), WithinAbs(200, 1e-9));
    const std::vector<Tick> ticks = decades.ticks(30);
    REQUIRE(ticks.size() == 5);
    CHECK(ticks[0].text == "10\u207b\u00b3");
}

TEST_CASE("a point of a curve is where its numbers are", "[pictures]") {
    const Drawing drawing = drawn(curve({{0, 0}, {5, 2}, {10, 4}}));
    const Box frame = frame_of(drawing);
    const Path line = paths_in(drawing, "series").at(0);
    REQUIRE(line.lines.at(0).size() == 3);
    CHECK_THAT(line.lines[0][1].x, WithinAbs((frame.left + frame.right) / 2, 1e-9));
    CHECK_THAT(line.lines[0][1].y, WithinAbs((frame.top + frame.bottom) / 2, 1e-9));
}

TEST_CASE("what cannot be drawn is said in one line", "[pictures][refused]") {
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(drawn(Figure{}), PictureError);
    CHECK_THROWS_AS(drawn(curve({})), PictureError);
    CHECK_THROWS_AS(drawn(curve({{0, std::nan("")}})), PictureError);
    CHECK_THROWS_AS(drawn(curve({{infinity, 1}})), PictureError);
    CHECK_THROWS_AS(drawn(curve({{0, 1e300}, {1, -1e300}})), PictureError);
    CHECK_THROWS_AS(drawn(curve({{1, 1}, {1 + 1e-15, 2}})), PictureError);
    Figure logarithmic = curve({{0, 0}, {1, 1}});
    logarithmic.panels[0].y.logarithmic = true;
    CHECK_THROWS_AS(drawn(logarithmic), PictureError);
}

TEST_CASE("one point, and values that do not vary, are drawn", "[pictures]") {
    for (const double y : {0.0, 1.0, -3.0, 1e-300, 1e200}) {
        const std::string one = svg_of(curve({{550, y}})), level = svg_of(curve({{0, y}, {9, y}}));
        CHECK_THAT(one + level, !Contains("nan") && !Contains("inf"));
    }
    CHECK(paths_in(drawn(curve({{550, 1}})), "series").size() == 1);  // a marker
}

TEST_CASE("a million points are drawn as their least and greatest values", "[pictures]") {
    std::vector<Point> points;
    constexpr std::size_t count = 1'000'000, spike = 654'321;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back({static_cast<double>(i), std::sin(static_cast<double>(i))});
    points[spike].y = 5;
    const Drawing drawing = drawn(curve(std::move(points)));
    const Path line = paths_in(drawing, "series").at(0);
    CHECK(line.lines[0].size() < 10'000);
    CHECK(line.lines[0].size() > 2'000);
    const auto highest = std::ranges::min_element(line.lines[0], {}, &Point::y);
    const Box frame = frame_of(drawing);
    CHECK_THAT(highest->x, WithinAbs(frame.left + frame.width() * spike / (count - 1.0), 1e-6));
    CHECK_THAT(find_picture_format("svg")->write(drawing), Contains("1000000 points a curve"));
}

TEST_CASE("a curve of angles is cut where it wraps", "[pictures]") {
    Figure figure = curve({{0, 170}, {1, 179}, {2, -179}, {3, -170}});
    CHECK(paths_in(drawn(figure), "series").at(0).lines.size() == 1);
    figure.panels[0].y.period = 360;
    CHECK(paths_in(drawn(figure), "series").at(0).lines.size() == 2);
}

TEST_CASE("lines differ in dashes, not in colour alone", "[pictures]") {
    Figure figure{.title = "many"};
    Panel panel{.x = {.quantity = "x"}, .y = {.quantity = "y"}};
    for (std::size_t i = 0; i < 7; ++i)
        panel.series.push_back(
            {.name = std::to_string(i), .style = i, .points = {{0, double(i)}, {1, double(i)}}});
    figure.panels.push_back(std::move(panel));
    const std::vector<Path> lines = paths_in(drawn(figure), "series");
    for (std::size_t i = 0; i < lines.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            CHECK(lines[i].dash != lines[k].dash);
            CHECK(lines[i].stroke != lines[k].stroke);
        }
}

TEST_CASE("the legend stands above the panels", "[pictures]") {
    Figure figure = curve({{0, 0}, {1, 1}});
    for (std::size_t i = 1; i < 30; ++i)
        figure.panels[0].series.push_back(
            {.name = "curve number " + std::to_string(i), .style = i, .points = {{0, 0}, {1, 1}}});
    const Drawing drawing = drawn(figure);
    for (const DrawnGroup& group : drawing.groups)
        if (group.name == "legend")
            for (const auto& item : group.items)
                if (const Text* text = std::get_if<Text>(&item))
                    CHECK(text->at.y < frame_of(drawing).top - 5);
}

TEST_CASE("a map's cell has the colour of its value", "[pictures]") {
    Figure figure{.title = "map"};
    Panel panel{.x = {.quantity = "x"}, .y = {.quantity = "y"}};
    panel.grid = SampleGrid{{0, 1, 2}, {0, 1}, {}, {0, 1, 2, 3, 4, std::nan("")}};
    panel.bar = {.quantity = "v", .first = 0, .last = 4};
    figure.panels.push_back(panel);
    const Drawing drawing = drawn(figure);
    std::vector<Cells> maps;
    for (const DrawnGroup& group : drawing.groups)
        if (group.name == "cells") maps.push_back(std::get<Cells>(group.items.at(0)));
    REQUIRE(maps.size() == 1);
    const Cells& cells = maps[0];
    REQUIRE(cells.inks.size() == 6);  // the row with the greatest y is on top
    CHECK(cells.inks[2] == ink(0xffffff));
    CHECK(cells.inks[3] != cells.inks[1]);
    figure.panels[0].grid->x = {0, 1, 5};  // uneven: looked up one by one
    const Drawing uneven = drawn(figure);
    for (const DrawnGroup& group : uneven.groups)
        if (group.name == "cells") {
            const Cells& wide = std::get<Cells>(group.items.at(0));
            CHECK(wide.columns == 2000);
            CHECK(wide.inks[2000] == cells.inks[3]);
            CHECK(wide.inks[2000 + 1999] == cells.inks[5]);
        }
}

TEST_CASE("the band diagram has s and p side by side", "[pictures]") {
    BandDiagram diagram{"mirror", 400, 800, {0, 45, 85}, {}};
    BandDiagram::Gap gap{2, {{500, 600}, {480, 580}, {450, 550}}, {}};
    gap.p = gap.s;
    diagram.gaps.push_back(gap);
    const Drawing drawing = drawn(band_figure(diagram));
    const std::vector<Path> areas = paths_in(drawing, "area"), frames = paths_in(drawing, "frame");
    REQUIRE(areas.size() == 2);
    REQUIRE(frames.size() == 2);
    CHECK(frames[0].lines[0][1].x == frames[1].lines[0][0].x);  // they touch
    const double middle = frames[1].lines[0][0].x;
    for (std::size_t i = 0; i < areas[0].lines[0].size(); ++i)
        CHECK_THAT(areas[0].lines[0][i].x + areas[1].lines[0][i].x, WithinAbs(2 * middle, 1e-9));
    diagram.gaps.clear();
    CHECK_NOTHROW(svg_of(band_figure(diagram)));
}

TEST_CASE("chromaticities lie where the CIE puts them", "[pictures]") {
    const Triple white = rgb_space("srgb").white;
    const ChromaticityPath path{"", {{white, ink(0xffffff), "0"}, {{1, 1, 1}, ink(0xffffff), "1"}}};
    const Figure figure = chromaticity_figure("white", {path}, observer(2), white);
    REQUIRE(figure.panels.size() == 2);
    const auto place = [&](std::size_t panel) { return figure.panels[panel].series.back().points; };
    CHECK_THAT(place(0)[0].x, WithinAbs(0.3127, 1e-4));
    CHECK_THAT(place(0)[0].y, WithinAbs(0.3290, 1e-4));
    CHECK_THAT(place(1)[0].x, WithinAbs(0.1978, 1e-4));  // D65: u' and v'
    CHECK_THAT(place(1)[0].y, WithinAbs(0.4683, 1e-4));
    CHECK_THAT(place(1)[1].x, WithinAbs(4.0 / 19, 1e-12));
    CHECK_THROWS_AS(chromaticity_figure("", {{"", {{{0, 0, 0}, ink(0), "0"}}}}, observer(2), white),
                    PictureError);
    const Drawing drawing = drawn(figure);
    const Box frame = frame_of(drawing);
    CHECK_THAT(frame.height() / frame.width(), WithinAbs(0.9 / 0.8, 0.01));
}
