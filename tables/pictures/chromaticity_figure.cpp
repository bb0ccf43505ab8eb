#include "tables/pictures/chromaticity_figure.hpp"

#include <algorithm>
#include <cmath>

namespace irido::tables {

namespace {

constexpr double kFirstLocus_nm = 390, kLastLocus_nm = 700;
constexpr std::size_t kMostStopLabels = 4, kMostDots = 25;

Point place_xy(const Triple& xyz) {
    const double sum = xyz[0] + xyz[1] + xyz[2];
    return {xyz[0] / sum, xyz[1] / sum};
}

/// CIE 1976 u', v'.
Point place_uv(const Triple& xyz) {
    const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
    return {4 * xyz[0] / sum, 9 * xyz[1] / sum};
}

using Place = Point (*)(const Triple&);

Triple seen(const Observer& eye, double wavelength_nm) {
    const auto row = static_cast<std::size_t>(wavelength_nm - kFirstRow_nm);
    return {eye.x[row], eye.y[row], eye.z[row]};
}

void add_diagram(Panel& panel, const Observer& eye, const Triple& white, Place place) {
    Series locus{.name = "spectral locus", .form = Series::Form::guide};
    for (double nm = kFirstLocus_nm; nm <= kLastLocus_nm; ++nm)
        locus.points.push_back(place(seen(eye, nm)));
    locus.points.push_back(locus.points.front());  // the line of purples
    panel.series.push_back(std::move(locus));
    Series triangle{.name = "sRGB", .style = 1, .form = Series::Form::guide};
    const auto& primaries = rgb_space("srgb").primaries;
    for (const std::size_t i : {0U, 1U, 2U, 0U}) {
        const Chromaticity& at = primaries[i];
        triangle.points.push_back(place({at.x, at.y, 1 - at.x - at.y}));
    }
    panel.series.push_back(std::move(triangle));
    panel.series.push_back({.name = "white point",
                            .style = 4,
                            .points = {place(white)},
                            .form = Series::Form::points});
    Series marks{.form = Series::Form::points};
    for (const double nm : {460.0, 480.0, 500.0, 520.0, 540.0, 560.0, 580.0, 600.0, 620.0}) {
        marks.points.push_back(place(seen(eye, nm)));
        marks.inks.push_back(ink(0xffffff));
        panel.labels.push_back(
            {marks.points.back(), std::to_string(static_cast<int>(nm)), place(white)});
    }
    panel.series.push_back(std::move(marks));
}

void add_path(Panel& panel, const ChromaticityPath& path, std::size_t style, Place place) {
    Series line{.name = path.name, .style = style};
    Series dots{.form = Series::Form::points};
    std::vector<const ChromaticityPath::Stop*> stops;
    for (const ChromaticityPath::Stop& stop : path.stops)
        if (stop.xyz[0] + stop.xyz[1] + stop.xyz[2] > 0) stops.push_back(&stop);
    if (stops.empty()) throw PictureError("black has no chromaticity to draw");
    const std::size_t n = stops.size(), last = n - 1;
    std::vector<Label> labels;
    for (std::size_t i = 0; i < n; ++i) {
        line.points.push_back(place(stops[i]->xyz));
        const auto in_turn = [&](std::size_t most) {  // one of `most` evenly chosen
            return n <= most || i == 0 || i * (most - 1) / last > (i - 1) * (most - 1) / last;
        };
        if (in_turn(kMostDots)) {
            dots.points.push_back(line.points.back());
            dots.inks.push_back(stops[i]->ink);
        }
        if (in_turn(kMostStopLabels)) labels.push_back({line.points.back(), stops[i]->label});
    }
    std::swap(labels[std::min<std::size_t>(1, last)], labels.back());  // both ends first
    panel.labels.insert(panel.labels.begin(), labels.begin(), labels.end());
    if (n > 1) panel.series.push_back(std::move(line));
    panel.series.push_back(std::move(dots));
}

}  // namespace

Figure chromaticity_figure(const std::string& title, const std::vector<ChromaticityPath>& paths,
                           const Observer& eye, const Triple& white) {
    Figure figure{.title = title};
    figure.columns = 2;
    figure.width = 1080;
    figure.equal_units = true;
    struct Diagram {
        const char* title;
        const char* x;
        const char* y;
        double right, top;
        Place place;
    };
    for (const Diagram& diagram :
         {Diagram{"CIE 1931", "x", "y", 0.8, 0.9, place_xy},
          Diagram{"CIE 1976", "u\u2032", "v\u2032", 0.65, 0.65, place_uv}}) {
        Panel panel{diagram.title,
                    {.quantity = diagram.x, .first = 0, .last = diagram.right},
                    {.quantity = diagram.y, .first = 0, .last = diagram.top}};
        add_diagram(panel, eye, white, diagram.place);
        std::size_t style = 0;
        for (const ChromaticityPath& path : paths) add_path(panel, path, style++, diagram.place);
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

}  // namespace irido::tables
