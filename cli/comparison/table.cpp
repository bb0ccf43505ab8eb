#include "cli/comparison/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/options/color_options.hpp"
#include "core/color/color_tables.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/comparison/film_set.hpp"
#include "core/engines/series.hpp"
#include "core/math/parallel.hpp"
#include "core/math/random.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/lut/lut_file.hpp"

namespace irido::cli {

namespace {

constexpr double kTableTolerance = 1e-7;

/// Value of a table between its samples, linear along every axis.
Triple interpolated(const tables::Lut& lut, const std::vector<double>& point) {
    std::vector<std::size_t> cell(point.size());
    std::vector<double> part(point.size());
    for (std::size_t a = 0; a < point.size(); ++a) {
        const tables::LutAxis& axis = lut.axes[a];
        cell[a] = axis.cell_of(point[a]);
        if (axis.count() > 1)
            part[a] = (point[a] - axis.values[cell[a]]) /
                      (axis.values[cell[a] + 1] - axis.values[cell[a]]);
    }
    Triple sum{};
    for (std::size_t corner = 0; corner < std::size_t{1} << point.size(); ++corner) {
        std::size_t place = 0;
        double weight = 1;
        for (std::size_t a = 0; a < point.size(); ++a) {
            const bool upper = (corner >> a & 1U) != 0;
            weight *= upper ? part[a] : 1 - part[a];
            const std::size_t last = lut.axes[a].count() - 1;
            place = place * lut.axes[a].count() + std::min(cell[a] + (upper ? 1U : 0U), last);
        }
        if (weight == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * lut.values[3 * place + c];
    }
    return sum;
}

/// How a table's values become Lab, and exact colours its values.
class TableColors {
public:
    explicit TableColors(const tables::Lut& lut)
        : request_(lut.facts.at("request")),
          space_(rgb_space(lut.facts.at("color_space").get<std::string>())),
          tables_(Sensitivity(parse_observer(text("observer_deg")),
                              parse_illuminant(text("illuminant")))),
          transform_(space_, white(), parse_adaptation(text("adaptation"))),
          lab_white_(text("adaptation") == "none" ? white() : space_.white) {
        exactly_.tolerance = kTableTolerance;
        exactly_.sides = parse_sides(text("side"));
        exactly_.light = parse_light(text("polarization"));
    }

    Triple exact(const Stack& stack, double angle_deg, SimdLevel simd) const {
        ColorRequest request = exactly_;
        request.simd = simd;
        StackColor color;
        (*color_algorithm(tables_, stack, {}, request))(stack, {&angle_deg, 1}, {&color, 1});
        return transform_(color.xyz);
    }
    double difference(const Triple& a, const Triple& b) const {
        const ColorMatrix rows = xyz_from_rgb(space_);
        return ciede2000(lab(product(rows, a), lab_white_), lab(product(rows, b), lab_white_));
    }
    std::string hex_of(const Triple& rgb) const { return hex(space_, rgb); }

private:
    std::string text(const char* key) const { return request_.at(key).get<std::string>(); }
    const Triple& white() const { return tables_.sensitivity().white(); }

    nlohmann::json request_;
    const RgbSpace& space_;
    ColorTables tables_;
    RgbTransform transform_;
    Triple lab_white_;
    ColorRequest exactly_;
};

tables::Lut read_color_table(const std::string& file) {
    tables::Lut lut = tables::read_lut(file);
    for (const char* const suffix : {"", ".json"}) schemas::mark_as_input(file + suffix);
    if (lut.kind != "color")
        throw UsageError("--lut: " + file + ": must be a table of kind color (got " + lut.kind +
                         ")");
    if (lut.mips || lut.channels.size() != 3)
        throw UsageError("--lut: " + file + ": mip levels are not compared");
    return lut;
}

bool is_angle(const std::string& axis) {
    return axis == "cos_theta" || axis == "theta_deg";
}

double angle_of(const std::string& axis, double value) {
    return axis == "theta_deg" ? value : 90 - std::asin(value) * 180 / std::numbers::pi;
}

}  // namespace

tables::Records table_rows(const TableComparison& typed) {
    const tables::Lut lut = read_color_table(typed.file);
    schemas::StackSource source;
    if (typed.stack.stack.empty()) {
        source.document = lut.facts.at("stack");
        source.file = typed.file;
    } else {
        source = schemas::load_stack(typed.stack);
    }
    const TableColors colors(lut);
    Random random(typed.seed);
    const std::size_t axes = lut.axes.size();
    std::vector<std::vector<double>> points(typed.points, std::vector<double>(axes));
    for (std::vector<double>& point : points)
        for (std::size_t a = 0; a < axes; ++a) {
            const std::vector<double>& samples = lut.axes[a].values;
            point[a] =
                samples.size() == 1 ? samples[0] : random.uniform(samples.front(), samples.back());
        }
    std::vector<Triple> read(points.size()), exact(points.size());
    std::vector<std::optional<double>> differences(points.size());
    parallel_for(points.size(), typed.threads, [&](std::size_t i) {
        nlohmann::json document = source.document;
        double angle_deg = 0;
        for (std::size_t a = 0; a < axes; ++a) {
            const std::string& name = lut.axes[a].name;
            if (is_angle(name))
                angle_deg = angle_of(name, points[i][a]);
            else
                schemas::set_value(document, name, points[i][a]);
        }
        schemas::MaterialFiles files;
        const Stack stack = schemas::read_source(source, document, files).stack;
        try {
            exact[i] = colors.exact(stack, angle_deg, typed.simd);
        } catch (const DomainError& error) {
            throw schemas::InputError(source.file, "", error.what());
        }
        read[i] = interpolated(lut, points[i]);
        differences[i] = colors.difference(read[i], exact[i]);
    });

    if (typed.rows) {
        tables::Records records;
        for (std::size_t a = 0; a < axes; ++a) {
            tables::Column::Numbers values;
            for (const std::vector<double>& point : points) values.push_back(point[a]);
            records.columns.push_back({lut.axes[a].name, std::move(values)});
        }
        const auto add = [&](const std::string& prefix, const std::vector<Triple>& rgb) {
            tables::Column::Texts hexes;
            for (std::size_t c = 0; c < 3; ++c) {
                tables::Column::Numbers values;
                for (const Triple& color : rgb) values.push_back(color[c]);
                records.columns.push_back({prefix + "rgb"[c], std::move(values)});
            }
            for (const Triple& color : rgb) hexes.push_back(colors.hex_of(color));
            records.columns.push_back({prefix + "hex", std::move(hexes)});
        };
        add("", read);
        add("true_", exact);
        tables::Column::Numbers delta_e;
        for (const std::optional<double>& difference : differences) delta_e.push_back(*difference);
        records.columns.push_back({"delta_e_2000", std::move(delta_e)});
        return records;
    }
    const DifferenceSummary summary = summary_of(differences);
    std::string worst;
    for (std::size_t a = 0; a < axes; ++a)
        worst += (worst.empty() ? "" : "; ") + lut.axes[a].name + "=" +
                 to_text(points[summary.worst][a]);
    using Numbers = tables::Column::Numbers;
    return {{{"count", Numbers{static_cast<double>(summary.count)}},
             {"mean", Numbers{summary.mean}},
             {"median", Numbers{summary.median}},
             {"p95", Numbers{summary.p95}},
             {"max", Numbers{summary.max}},
             {"worst", tables::Column::Texts{worst}}}};
}

}  // namespace irido::cli
