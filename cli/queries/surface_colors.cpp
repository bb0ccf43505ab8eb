#include "cli/queries/surface_colors.hpp"

#include <array>

#include "core/error.hpp"

namespace irido::cli {

SurfaceRows rows_of(NumberColumns columns, std::size_t keys) {
    SurfaceRows rows;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const tables::FigureAxis axis = tables::axis_of_column(columns[c].first);
        if (c < keys)
            rows.plot.keys.push_back({columns[c].first, axis});
        else
            rows.plot.values.push_back({columns[c].first, axis});
        rows.records.columns.push_back({columns[c].first, std::move(columns[c].second)});
    }
    return rows;
}

NumberColumns direction_columns(const std::vector<Directions>& directions, std::size_t times) {
    NumberColumns columns{{"light_theta_deg", {}},
                          {"light_phi_deg", {}},
                          {"view_theta_deg", {}},
                          {"view_phi_deg", {}}};
    for (const Directions& one : directions) {
        const std::array<double, 4> row{one.light_theta_deg, one.light_phi_deg, one.view_theta_deg,
                                        one.view_phi_deg};
        for (std::size_t c = 0; c < row.size(); ++c)
            columns[c].second.insert(columns[c].second.end(), times, row[c]);
    }
    return columns;
}

void require_few_rows(double rows) {
    constexpr double kMostSurfaceRows = 1e8;
    if (rows > kMostSurfaceRows)
        throw UsageError("rows: must be at most 1e8 (got " + to_text(rows) + ")");
}

ColorColumns::ColorColumns(const ColorOptions& typed)
    : space_(parse_space(typed.space)),
      illumination_(typed.illuminant,
                    Sensitivity(parse_observer(typed.observer), parse_illuminant(typed.illuminant)),
                    space_, parse_adaptation(typed.adaptation)),
      drawn_(rgb_space("srgb"), illumination_.white(), Adaptation::bradford) {}

SurfaceRows ColorColumns::rows(NumberColumns keys, const std::vector<Triple>& colors) const {
    const std::size_t key_count = keys.size();
    std::array<tables::Column::Numbers, 6> numbers;
    tables::Column::Texts hexes;
    tables::RowPlot plot;
    tables::InkMixer mixer(tables::GamutMapping{});
    for (const Triple& xyz : colors) {
        const Triple rgb = illumination_.transform(xyz);
        for (std::size_t c = 0; c < 3; ++c) {
            numbers[c].push_back(xyz[c] + 0.0);
            numbers[3 + c].push_back(rgb[c] + 0.0);
        }
        hexes.push_back(hex(space_, rgb));
        plot.inks.push_back(mixer(drawn_(xyz)));
    }
    constexpr std::array names{"X", "Y", "Z", "r", "g", "b"};
    for (std::size_t c = 0; c < names.size(); ++c)
        keys.emplace_back(names[c], std::move(numbers[c]));
    SurfaceRows rows = rows_of(std::move(keys), key_count);
    rows.records.columns.push_back({"hex", std::move(hexes)});
    rows.plot.values.clear();
    rows.plot.inks = std::move(plot.inks);
    if (std::string share = mixer.note(); !share.empty())
        rows.plot.notes.push_back(std::move(share));
    return rows;
}

}  // namespace irido::cli
