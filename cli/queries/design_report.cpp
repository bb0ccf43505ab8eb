#include "cli/queries/design_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "core/design/problem_values.hpp"
#include "core/error.hpp"
#include "schemas/documents/json_document.hpp"
#include "tables/pictures/rows_figure.hpp"

namespace irido::cli {

namespace {

using Quantity = DesignQuantity;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<std::string_view, 16> kQuantityNames{
    "R",           "T",           "A",       "psi_deg",           "delta_deg", "delta_nebraska_deg",
    "phase_r_deg", "phase_t_deg", "gd_r_fs", "gd_t_fs",           "gdd_r_fs2", "gdd_t_fs2",
    "tod_r_fs3",   "tod_t_fs3",   "lab",     "total_thickness_nm"};

constexpr std::array<const char*, 3> kLabNames{"L", "a", "b"};

std::string letter_of(Light light) {
    return light == Light::s ? "s" : light == Light::p ? "p" : "u";
}

/// Columns to which rows are appended.
class ReportRows {
public:
    void add(std::size_t target, std::string quantity, double angle_deg, std::string polarization,
             double wavelength_nm, std::array<double, 4> numbers, std::string met) {
        target_.push_back(static_cast<double>(target));
        quantity_.push_back(std::move(quantity));
        angle_.push_back(angle_deg);
        polarization_.push_back(std::move(polarization));
        wavelength_.push_back(wavelength_nm);
        for (std::size_t i = 0; i < numbers.size(); ++i) numbers_[i].push_back(numbers[i]);
        met_.push_back(std::move(met));
    }

    tables::Records records() {
        return {{{"target", std::move(target_)},
                 {"quantity", std::move(quantity_)},
                 {"angle_deg", std::move(angle_)},
                 {"polarization", std::move(polarization_)},
                 {"wavelength_nm", std::move(wavelength_)},
                 {"value", std::move(numbers_[0])},
                 {"target_value", std::move(numbers_[1])},
                 {"difference", std::move(numbers_[2])},
                 {"weight", std::move(numbers_[3])},
                 {"met", std::move(met_)}}};
    }

private:
    tables::Column::Numbers target_, angle_, wavelength_;
    std::array<tables::Column::Numbers, 4> numbers_;
    tables::Column::Texts quantity_, polarization_, met_;
};

double allowed(const schemas::DesignTask& task, const DesignTarget& target, std::size_t entry) {
    if (task.has_sigma) return target.sigma[entry];
    return target.quantity <= Quantity::A ? kMetFraction : kMetOther;
}

const tables::Column::Numbers& number_column(const tables::Records& records,
                                             std::string_view name) {
    return std::get<tables::Column::Numbers>(
        std::ranges::find(records.columns, name, &tables::Column::name)->values);
}
const tables::Column::Texts& text_column(const tables::Records& records, std::string_view name) {
    return std::get<tables::Column::Texts>(
        std::ranges::find(records.columns, name, &tables::Column::name)->values);
}

}  // namespace

std::string_view name_of(DesignQuantity quantity) {
    return kQuantityNames.at(static_cast<std::size_t>(quantity));
}

tables::Records target_report(const schemas::DesignTask& task, const DesignRows& rows) {
    ReportRows report;
    std::size_t row = 0;
    for (std::size_t t = 0; t < task.problem.targets.size(); ++t) {
        const DesignTarget& target = task.problem.targets[t];
        const std::size_t number = task.target_numbers[t];
        const bool is_color = target.quantity == Quantity::lab;
        const bool is_one = is_of_both(target.quantity);
        const std::size_t lights = is_one ? 1 : target.polarizations.size();
        const bool is_total = target.quantity == Quantity::total_thickness_nm;
        const std::size_t count = is_color || is_total ? 1 : target.wavelength_nm.size();
        for (std::size_t e = 0; e < entry_count(target); ++e) {
            const double angle = target.angle_deg[e / count / lights];
            const std::string letter =
                is_one || is_total ? "" : letter_of(target.polarizations[e / count % lights]);
            if (!is_color) {
                const double value = rows.value[row], difference = rows.residual[row];
                const bool met = target.side == TargetSide::equal
                                     ? std::abs(difference) <= allowed(task, target, e)
                                     : difference == 0;
                report.add(number, std::string(name_of(target.quantity)), angle, letter,
                           is_total ? kNoNumber : target.wavelength_nm[e % count],
                           {value, target.target[e], difference, target.weight[e]},
                           met ? "yes" : "no");
                ++row;
                continue;
            }
            double square = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const double value = rows.value[row + c];
                square += rows.residual[row + c] * rows.residual[row + c];
                report.add(number, kLabNames[c], angle, letter, kNoNumber,
                           {value, target.lab[e][c], value - target.lab[e][c], target.weight[e]},
                           "");
            }
            const double delta_e = std::sqrt(square);
            report.add(
                number,
                task.problem.merit == MeritKind::delta_e_2000 ? "delta_e_2000" : "delta_e_76",
                angle, letter, kNoNumber, {delta_e, 0, delta_e, target.weight[e]},
                delta_e <= allowed(task, target, e) ? "yes" : "no");
            row += 3;
        }
    }
    return report.records();
}

MetTargets met_targets(const tables::Records& report) {
    MetTargets result;
    for (const std::string& met : text_column(report, "met")) {
        if (met.empty()) continue;
        ++result.all;
        if (met == "yes") ++result.met;
    }
    return result;
}

std::vector<std::string> summary_lines(const tables::Records& report) {
    constexpr std::size_t kMostLines = 4;
    const MetTargets count = met_targets(report);
    std::vector<std::string> lines{std::to_string(count.met) + " of " + std::to_string(count.all) +
                                   " values are met"};
    const auto& quantity = text_column(report, "quantity");
    const auto& met = text_column(report, "met");
    const auto& value = number_column(report, "value");
    const auto& angle = number_column(report, "angle_deg");
    const auto rounded = [](double number, double scale) {
        return to_text(std::round(number * scale) / scale);
    };
    for (std::size_t r = 3; r < report.rows() && lines.size() < kMostLines; ++r) {
        if (!quantity[r].starts_with("delta_e") || met[r] != "no") continue;
        std::string nearest;
        for (std::size_t c = r - 3; c < r; ++c)
            nearest += (nearest.empty() ? "" : ", ") + rounded(value[c], 100);
        lines.push_back("the colour at " + to_text(angle[r]) +
                        " degrees was not reached: the nearest found is Lab " + nearest + ", " +
                        quantity[r] + " = " + rounded(value[r], 1000));
    }
    return lines;
}

std::string designed_text(const schemas::DesignTask& task, const std::vector<double>& values,
                          nlohmann::json design, const std::string& path) {
    nlohmann::json document = schemas::designed_stack(task, values);
    document["design"] = std::move(design);
    schemas::move_files(document, task.source.folder,
                        std::filesystem::path(path).parent_path().string());
    schemas::shorten_numbers(document);
    return document.dump(2) + "\n";
}

tables::Figure target_figure(const schemas::DesignTask& task, const tables::Records& report,
                             bool residuals) {
    tables::Figure figure{.title = task.name.empty() ? task.file : task.name};
    const auto& quantity = text_column(report, "quantity");
    const auto& letters = text_column(report, "polarization");
    const auto& angle = number_column(report, "angle_deg");
    const auto& wavelength = number_column(report, "wavelength_nm");
    const auto& value = number_column(report, residuals ? "difference" : "value");
    const auto& wanted = number_column(report, "target_value");
    std::map<std::string, std::size_t> panels;
    std::vector<std::map<std::string, std::size_t>> curves;
    for (std::size_t r = 0; r < report.rows(); ++r) {
        if (quantity[r].starts_with("delta_e") || quantity[r] == "total_thickness_nm") continue;
        const bool is_color = std::isnan(wavelength[r]);
        const auto [panel, is_new] = panels.try_emplace(quantity[r], figure.panels.size());
        if (is_new) {
            figure.panels.push_back({});
            curves.emplace_back();
            figure.panels.back().x =
                tables::axis_of_column(is_color ? "angle_deg" : "wavelength_nm");
            figure.panels.back().y = is_color ? tables::FigureAxis{.quantity = quantity[r] + "*"}
                                              : tables::axis_of_column(quantity[r]);
            if (residuals) figure.panels.back().y.quantity += ", value - target";
        }
        tables::Panel& to = figure.panels[panel->second];
        const std::string letter = letters[r] == "u" ? "" : letters[r];  // unpolarized
        const std::string name =
            is_color && letter.empty() ? "stack"
            : is_color                 ? letter
                       : (letter.empty() ? "" : letter + ", ") + to_text(angle[r]) + "\u00b0";
        const auto [curve, is_new_curve] =
            curves[panel->second].try_emplace(name, curves[panel->second].size());
        if (is_new_curve) {
            to.series.push_back({.name = name,
                                 .style = curve->second,
                                 .points = {},
                                 .form = is_color ? tables::Series::Form::line_with_points
                                                  : tables::Series::Form::line});
            to.series.push_back(
                {.name = residuals ? "" : "target",
                 .style = curve->second,
                 .points = {},
                 .form = residuals ? tables::Series::Form::guide : tables::Series::Form::points});
        }
        const double x = is_color ? angle[r] : wavelength[r];
        to.series[2 * curve->second].points.push_back({x, value[r]});
        to.series[2 * curve->second + 1].points.push_back({x, residuals ? 0 : wanted[r]});
    }
    for (tables::Panel& panel : figure.panels)
        for (tables::Series& series : panel.series)
            std::ranges::stable_sort(series.points, {}, &tables::Point::x);
    return figure;
}

}  // namespace irido::cli
