#include "tables/lut/lut_figure.hpp"

#include <algorithm>

#include "core/colorimetry/space.hpp"
#include "tables/lut/lut_metadata.hpp"

namespace irido::tables {

namespace {

/// Linear sRGB of a table's three channels.
class TableColors {
public:
    explicit TableColors(const Lut& lut)
        : space_(rgb_space(lut.facts.at("color_space").get<std::string>())),
          to_xyz_(xyz_from_rgb(space_)),
          transform_(
              rgb_space("srgb"), white_of(lut),
              lut.facts.at("request").value("adaptation", "bradford") == "none" && !is_xyz(lut)
                  ? Adaptation::none
                  : Adaptation::bradford) {}

    static bool is_xyz(const Lut& lut) { return lut.channels.front() == "X"; }

    Triple operator()(const double* value) const {
        Triple xyz{};
        for (std::size_t i = 0; i < 3; ++i)
            xyz[i] = to_xyz_[i][0] * value[0] + to_xyz_[i][1] * value[1] + to_xyz_[i][2] * value[2];
        return transform_(xyz);
    }

private:
    Triple white_of(const Lut& lut) const {
        if (!is_xyz(lut)) return space_.white;
        const auto& white = lut.facts.at("request").at("white_xyz");
        return {white[0], white[1], white[2]};
    }

    const RgbSpace& space_;
    ColorMatrix to_xyz_;
    RgbTransform transform_;
};

Triple scaled(Triple color, double gain) {
    for (double& part : color) part *= gain;
    return color;
}

bool has_colors(const Lut& lut) {
    const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"};
    return lut.channels == rgb ||
           (lut.channels == xyz &&
            (lut.kind == "color" || lut.kind == "albedo" || lut.kind == "brdf"));
}

}  // namespace

Figure lut_figure(const Lut& lut, const std::string& title, GamutMapping gamut, double gain) {
    RowPlot plot{.title = title};
    Records records;
    const std::size_t channels = lut.channels.size(), rows = lut.values.size() / channels;
    std::size_t stride = rows;
    for (const LutAxis& axis : lut.axes) {
        stride /= axis.count();
        Column::CodedNumbers places{axis.values, std::vector<std::uint32_t>(rows)};
        for (std::size_t row = 0; row < rows; ++row)
            places.codes[row] = static_cast<std::uint32_t>(row / stride % axis.count());
        records.columns.push_back({axis.name, std::move(places)});
        FigureAxis of_name = axis_of_column(axis.name);
        plot.keys.insert(plot.keys.begin(), {axis.name, std::move(of_name)});
    }
    if (has_colors(lut)) {
        const TableColors colors(lut);
        InkMixer mixer(gamut);
        for (std::size_t row = 0; row < rows; ++row)
            plot.inks.push_back(mixer(scaled(colors(&lut.values[row * channels]), gain)));
        if (const std::string note = mixer.note(); !note.empty()) plot.notes.push_back(note);
    } else {
        for (std::size_t c = 0; c < channels; ++c) {
            Column::Numbers numbers(rows);
            for (std::size_t row = 0; row < rows; ++row)
                numbers[row] = lut.values[row * channels + c];
            records.columns.push_back({lut.channels[c], std::move(numbers)});
            plot.values.push_back({lut.channels[c], axis_of_column(lut.channels[c])});
        }
    }
    Figure figure = figure_of(records, plot);
    figure.metadata = metadata_text(metadata_of(lut));
    return figure;
}

}  // namespace irido::tables
