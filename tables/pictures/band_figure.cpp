#include "tables/pictures/band_figure.hpp"

#include "tables/pictures/axis.hpp"
#include "tables/pictures/rows_figure.hpp"

namespace irido::tables {

namespace {

Panel side_panel(const BandDiagram& diagram, bool is_s) {
    constexpr double quarter = 45;
    const double largest = diagram.angles_deg.back();
    FigureAxis angle = axis_of_column("angle_deg"), wavelength = axis_of_column("wavelength_nm");
    angle.first = is_s ? largest : 0;
    angle.last = is_s ? 0 : largest;
    angle.step = largest > quarter ? 15 : 0;
    wavelength.first = diagram.first_nm;
    wavelength.last = diagram.last_nm;
    Panel panel{is_s ? "s polarization" : "p polarization", angle, wavelength};
    for (const BandDiagram::Gap& gap : diagram.gaps) {
        const std::string order = tick_text(gap.order, 1);
        Area area{.name = is_s ? "band gaps, s" : "band gaps, p",
                  .style = is_s ? 0U : 1U,
                  .title = std::string(is_s ? "s" : "p") + ", gap of order " + order,
                  .label = order,
                  .x = diagram.angles_deg};
        for (const BandDiagram::Edges& edges : is_s ? gap.s : gap.p) {
            area.low.push_back(edges.short_nm);
            area.high.push_back(edges.long_nm);
        }
        panel.areas.push_back(std::move(area));
    }
    return panel;
}

}  // namespace

Figure band_figure(const BandDiagram& diagram) {
    Figure figure{.title = diagram.title,
                  .subtitle = "photonic band gaps, labelled by order",
                  .panels = {side_panel(diagram, true), side_panel(diagram, false)}};
    figure.columns = 2;
    figure.panel_height = 420;
    figure.shared_y = figure.joined = true;
    return figure;
}

}  // namespace irido::tables
