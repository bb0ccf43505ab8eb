#include "tables/pictures/rows_figure.hpp"

#include <catch2/catch.hpp>

#include "tables/records/packed_rows.hpp"
#include "tables/resume/collected_rows.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::tables;
using Catch::Matchers::Contains;

namespace {

/// Rows for every combination of `x`, `y` numbers and `t` texts, with values v and zero.
Records grid(std::size_t x, std::size_t y, std::size_t t) {
    Column::Numbers xs, ys, values;
    Column::Texts ts;
    for (std::size_t k = 0; k < t; ++k)
        for (std::size_t j = 0; j < y; ++j)
            for (std::size_t i = 0; i < x; ++i) {
                xs.push_back(static_cast<double>(i));
                ys.push_back(10 * static_cast<double>(j));
                ts.push_back("text " + std::to_string(k));
                values.push_back(static_cast<double>(i + j + k) + 1);
            }
    Column::Numbers zero(values.size());
    return {{{"x", xs}, {"y", ys}, {"t", ts}, {"v", values}, {"zero", zero}}};
}

RowPlot plot() {
    RowPlot result{.title = "rows"};
    for (const char* name : {"x", "y", "t"}) result.keys.push_back({name, axis_of_column(name)});
    for (const char* name : {"v", "zero"}) result.values.push_back({name, axis_of_column(name)});
    return result;
}

}  // namespace

TEST_CASE("one number that varies makes curves, two make maps", "[pictures]") {
    const Figure curves = figure_of(grid(20, 1, 2), plot());
    REQUIRE(curves.panels.size() == 1);
    CHECK(curves.panels[0].series.size() == 2);
    CHECK(curves.panels[0].series[0].name == "text 0");
    CHECK(curves.panels[0].series[0].points.size() == 20);
    CHECK(curves.subtitle == "y 0");
    REQUIRE(curves.notes.size() == 1);
    CHECK(curves.notes[0] == "zero is 0 throughout");
    CHECK(figure_of(grid(20, 3, 1), plot()).panels[0].series.size() == 3);
    CHECK(figure_of(grid(3, 20, 1), plot()).panels[0].x.quantity == "y");
    const Figure maps = figure_of(grid(20, 30, 2), plot());
    REQUIRE(maps.panels.size() == 2);
    REQUIRE(maps.panels[1].grid);
    CHECK(maps.panels[1].title == "text 1");
    CHECK(maps.panels[1].x.quantity == "x");
    CHECK(maps.panels[1].grid->values[20 * 29 + 19] == 19 + 29 + 1 + 1);
}

TEST_CASE("a colour for every row makes strips and maps", "[pictures]") {
    RowPlot colors = plot();
    colors.values.clear();
    colors.inks.assign(40, ink(0x123456));
    const Figure strips = figure_of(grid(20, 1, 2), colors);
    REQUIRE(strips.panels.size() == 1);
    CHECK(strips.panels[0].y.names == std::vector<std::string>{"text 0", "text 1"});
    CHECK(strips.panels[0].grid->inks.size() == 40);
    colors.inks.assign(24, ink(0x123456));
    CHECK(figure_of(grid(6, 4, 1), colors).panels[0].grid->y.size() == 4);
    colors.inks.assign(1, ink(0x123456));
    CHECK_NOTHROW(drawn(figure_of(grid(1, 1, 1), colors)));
}

TEST_CASE("one row is a point; no row and too much are refused", "[pictures][refused]") {
    CHECK(figure_of(grid(1, 1, 1), plot()).panels[0].series[0].points.size() == 1);
    CHECK_THROWS_WITH(figure_of(grid(0, 0, 0), plot()), Contains("no rows"));
    CHECK_THROWS_WITH(figure_of(grid(5, 1, 30), plot()), Contains("too much varies"));
    CHECK_THROWS_WITH(figure_of(grid(12, 12, 13), plot()), Contains("too much varies"));
    Records zeros = grid(5, 1, 1);
    RowPlot only_zero = plot();
    only_zero.values.erase(only_zero.values.begin());
    CHECK(figure_of(zeros, only_zero).panels.size() == 1);  // 0 throughout, but the only column
}

TEST_CASE("columns have their units", "[pictures]") {
    CHECK(axis_of_column("wavelength_nm").title() == "vacuum wavelength, nm");
    CHECK(axis_of_column("wavelength_nm").hues);
    CHECK(axis_of_column("layers.0.thickness_nm").title() == "thickness of layer 1, nm");
    CHECK(axis_of_column("A_3").title() == "A of layer 3");
    CHECK(axis_of_column("layers.1.layers.0.thickness_nm").title() == "thickness of layer 2.1, nm");
    CHECK(axis_of_column("layers.1.repeat").title() == "periods of layer 2");
    CHECK(axis_of_column("layers.0.thickness_sigma_nm").title() ==
          "thickness sigma of layer 1, nm");
    CHECK(axis_of_column("layers.0").title() == "layers.0");
    CHECK(axis_of_column("layers.99999999999999999999.n").title() ==
          "layers.99999999999999999999.n");
    CHECK(axis_of_column("substrate.n").title() == "substrate.n");
}

TEST_CASE("collected rows are those that were appended", "[pictures]") {
    const Records rows = grid(3, 2, 2);
    RecordLayout layout = layout_of(rows);
    Records got;
    const auto stream = collected_rows(layout, [&](Records taken) { got = std::move(taken); });
    stream->append(packed_format().rows(layout, rows), 1, rows.rows());
    stream->append(packed_format().rows(layout, rows), 1, rows.rows());
    stream->finish();
    REQUIRE(got.rows() == 2 * rows.rows());
    const RecordFormat& csv = *find_record_format("csv");
    Records twice = rows;
    twice.append(rows);
    CHECK(written(csv, got) == written(csv, twice));
}
