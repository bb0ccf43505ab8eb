#include "cli/commands/table_check.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "cli/comparison/films.hpp"
#include "cli/options/surface_options.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/measured_table.hpp"
#include "schemas/readers/points_csv.hpp"
#include "schemas/readers/spectrum_csv.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::cli {

namespace {

constexpr std::array<std::string_view, 3> kFilmColumns{"film_n", "film_d_nm", "base_n"};
constexpr std::array<std::string_view, 2> kDirectionColumns{"light_theta_deg", "view_theta_deg"};
constexpr std::array<std::string_view, 4> kStackPaths{"layers.", "incident", "substrate",
                                                      "materials."};
constexpr std::array<std::string_view, 6> kSpectrumWords{"power",    "intensity", "irradiance",
                                                         "radiance", "emission",  "weight"};

/// The names in the first line that is not blank.
std::vector<std::string> heading_of(const std::string& text) {
    for (const schemas::TextLine& line : schemas::lines_of(text))
        if (line.text.find_first_not_of(" \t") != std::string_view::npos)
            return schemas::column_names(line.text, ',');
    return {};
}

template <class Names, class Is>
bool has_any(const std::vector<std::string>& heading, const Names& names, const Is& is) {
    return std::ranges::any_of(heading, [&](const std::string& column) {
        return std::ranges::any_of(names, [&](std::string_view name) { return is(column, name); });
    });
}

}  // namespace

bool check_other_table(const std::string& text, const std::string& path) {
    const std::vector<std::string> heading = heading_of(text);
    const std::string file = schemas::shown_path(path);
    const auto equal = [](std::string_view column, std::string_view name) {
        return column == name;
    };
    const auto begins = [](std::string_view column, std::string_view name) {
        return column.starts_with(name);
    };
    const auto contains = [](std::string_view column, std::string_view name) {
        return schemas::plain_words(column).find(name) != std::string::npos;
    };
    if (has_any(heading, kFilmColumns, equal)) {
        read_films(path);
    } else if (has_any(heading, kDirectionColumns, equal)) {
        parse_directions({.file = path});
    } else if (has_any(heading, kStackPaths, begins)) {
        schemas::read_points_csv(text, file);
    } else if (const auto columns = schemas::measured_columns(text); !columns.empty()) {
        for (const schemas::MeasuredColumn& one : columns)
            schemas::read_measured_table(text, file, one.quantity, one.column);
    } else if (has_any(heading, kSpectrumWords, contains)) {
        schemas::read_spectrum_csv(text, file);
    } else {
        return false;
    }
    return true;
}

}  // namespace irido::cli
