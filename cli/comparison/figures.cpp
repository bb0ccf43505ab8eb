#include "cli/comparison/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tables/pictures/rows_figure.hpp"

namespace irido::cli {

namespace {

using tables::column_numbers;
using tables::column_texts;

tables::FigureAxis delta_e_axis() {
    return {.quantity = "CIEDE2000", .from_zero = true};
}

/// Rows [engine][angle].
struct EngineGrid {
    explicit EngineGrid(const tables::Records& rows)
        : delta_e(column_numbers(rows, "delta_e_2000")) {
        for (const std::string& name : column_texts(rows, "engine"))
            if (names.empty() || names.back() != name) names.push_back(name);
        angles = column_numbers(rows, "angle_deg");
        angles.resize(angles.size() / names.size());
        for (std::size_t c = 0; c < 3; ++c) {
            rgb[c] = column_numbers(rows, std::string(1, "rgb"[c]));
            exact[c] = column_numbers(rows, std::string("true_") + "rgb"[c]);
        }
        order.resize(angles.size());
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::stable_sort(order, {}, [&](std::size_t a) { return angles[a]; });
        const auto same = [&](std::size_t a, std::size_t b) { return angles[a] == angles[b]; };
        order.erase(std::unique(order.begin(), order.end(), same), order.end());
    }

    static Triple at(const std::array<std::vector<double>, 3>& colors, std::size_t row) {
        return {colors[0][row], colors[1][row], colors[2][row]};
    }

    std::vector<std::string> names;
    std::vector<double> angles, delta_e;
    std::array<std::vector<double>, 3> rgb, exact;
    std::vector<std::size_t> order;  ///< sorts by ascending angle
};

tables::Figure strips(const EngineGrid& grid, tables::InkMixer& mixer) {
    const std::size_t engines = grid.names.size(), angles = grid.angles.size();
    tables::Panel colors{.x = tables::axis_of_column("angle_deg")};
    tables::SampleGrid cells;
    for (const std::size_t a : grid.order) cells.x.push_back(grid.angles[a]);
    for (std::size_t e = 0; e <= engines; ++e) {
        cells.y.push_back(static_cast<double>(e));
        colors.y.names.push_back(e == 0 ? "exact" : grid.names[e - 1]);
        for (const std::size_t a : grid.order)
            cells.inks.push_back(mixer(e == 0 ? EngineGrid::at(grid.exact, a)
                                              : EngineGrid::at(grid.rgb, (e - 1) * angles + a)));
    }
    colors.y.first = static_cast<double>(engines) + 0.5;  // the exact colour on top
    colors.y.last = -0.5;
    colors.grid = std::move(cells);
    tables::Panel differences{.x = colors.x, .y = delta_e_axis()};
    for (std::size_t e = 0; e < engines; ++e) {
        tables::Series series{.name = grid.names[e], .style = e};
        for (const std::size_t a : grid.order)
            series.points.push_back({grid.angles[a], grid.delta_e[e * angles + a]});
        differences.series.push_back(std::move(series));
    }
    return {.panels = {std::move(colors), std::move(differences)}, .shared_x = true};
}

tables::Figure patches(const EngineGrid& grid, tables::InkMixer& mixer) {
    tables::Panel colors, differences{.y = delta_e_axis()};
    colors.x.names = differences.x.names = grid.names;
    colors.y.names = {"engine", "exact"};
    tables::SampleGrid cells{.x = {}, .y = {0, 1}};
    tables::Series bars{.form = tables::Series::Form::bars};
    for (std::size_t e = 0; e < grid.names.size(); ++e) {
        cells.x.push_back(static_cast<double>(e));
        cells.inks.push_back(mixer(EngineGrid::at(grid.rgb, e)));
        bars.points.push_back({static_cast<double>(e), grid.delta_e[e]});
    }
    for (std::size_t e = 0; e < grid.names.size(); ++e)
        cells.inks.push_back(mixer(EngineGrid::at(grid.exact, e)));
    for (tables::Panel* const panel : {&colors, &differences}) {
        panel->x.first = -0.5;
        panel->x.last = static_cast<double>(grid.names.size()) - 0.5;
    }
    colors.y.first = 1.5;
    colors.y.last = -0.5;
    colors.grid = std::move(cells);
    differences.series.push_back(std::move(bars));
    constexpr double kWidth = 760, kNameWidth = 105;
    return {.panels = {std::move(colors), std::move(differences)},
            .width = std::max(kWidth, kNameWidth * static_cast<double>(grid.names.size())),
            .shared_x = true};
}

constexpr std::size_t kBins = 25;

}  // namespace

tables::Figure strip_figure(const tables::Records& rows, const std::string& title,
                            tables::GamutMapping gamut) {
    const EngineGrid grid(rows);
    tables::InkMixer mixer(gamut);
    tables::Figure figure = grid.order.size() > 1 ? strips(grid, mixer) : patches(grid, mixer);
    figure.title = title;
    figure.subtitle = "engines beside the exact colour";
    if (std::string note = mixer.note(); !note.empty()) figure.notes.push_back(std::move(note));
    return figure;
}

tables::Figure histogram_figure(const tables::Records& rows, const std::string& title) {
    const std::vector<double> delta_e = column_numbers(rows, "delta_e_2000");
    const std::vector<std::string> engine = column_texts(rows, "engine");
    double most = 0;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < delta_e.size(); ++i) {
        if (std::ranges::find(names, engine[i]) == names.end()) names.push_back(engine[i]);
        if (std::isfinite(delta_e[i])) most = std::max(most, delta_e[i]);
    }
    if (most == 0) throw tables::PictureError("no film has a difference to draw");
    const double width = std::max(0.2, std::ceil(most) / kBins);
    tables::Figure figure{.title = title, .shared_x = true, .shared_y = true};
    figure.columns = names.size() > 1 ? 2 : 1;
    for (const std::string& name : names) {
        std::vector<double> count(kBins);
        double films = 0;
        for (std::size_t i = 0; i < delta_e.size(); ++i) {
            if (engine[i] != name || !std::isfinite(delta_e[i])) continue;
            ++count[std::min(static_cast<std::size_t>(delta_e[i] / width), kBins - 1)];
            ++films;
        }
        tables::Panel panel{.title = name,
                            .x = delta_e_axis(),
                            .y = {.quantity = "films", .unit = "%", .from_zero = true}};
        panel.x.first = 0;
        panel.x.last = width * kBins;
        tables::Series bars{.form = tables::Series::Form::bars};
        for (std::size_t bin = 0; bin < kBins; ++bin)
            bars.points.push_back({(static_cast<double>(bin) + 0.5) * width,
                                   films > 0 ? 100 * count[bin] / films : 0});
        panel.series.push_back(std::move(bars));
        figure.panels.push_back(std::move(panel));
    }
    double tallest = 0;
    for (const tables::Panel& panel : figure.panels)
        for (const tables::Point& point : panel.series.front().points)
            tallest = std::max(tallest, point.y);
    constexpr double kStep = 10;
    for (tables::Panel& panel : figure.panels) {
        panel.y.first = 0;
        panel.y.last = kStep * std::ceil(tallest / kStep);
    }
    return figure;
}

}  // namespace irido::cli
