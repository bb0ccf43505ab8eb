#include "cli/comparison/films.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "core/nearest.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/points_csv.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::cli {

namespace {

constexpr std::array kChannels{"_r", "_g", "_b"};

/// Access to the columns of a table of films by name.
class FilmColumns {
public:
    FilmColumns(std::string file, std::vector<schemas::PointsColumn> columns)
        : file_(std::move(file)) {
        std::vector<std::string> known{"id",        "film_n", "film_d_nm",
                                       "angle_deg", "base_n", "base_k"};
        for (const char* const channel : kChannels)
            for (const char* const name : {"base_n", "base_k"})
                known.push_back(std::string(name) + channel);
        for (schemas::PointsColumn& column : columns) {
            if (std::ranges::find(known, column.path) == known.end())
                throw schemas::InputError(
                    file_, "",
                    "unknown column '" + column.path + "'" + did_you_mean(column.path, known));
            rows_ = std::max(column.numbers.size(), column.codes.size());
            const std::string name = column.path;
            columns_.emplace(name, std::move(column));
        }
        const bool has_gray = has("base_n") || has("base_k");
        const bool has_channels = std::ranges::any_of(kChannels, [&](const std::string& channel) {
            return has("base_n" + channel) || has("base_k" + channel);
        });
        if (has_gray && has_channels)
            throw schemas::InputError(
                file_, "", "base_n and base_k cannot be combined with base_n_r, base_k_r, ...");
    }

    std::size_t rows() const { return rows_; }
    bool has(const std::string& name) const { return columns_.contains(name); }

    std::string text(const std::string& name, std::size_t row) const {
        const schemas::PointsColumn& column = columns_.at(name);
        return column.texts.empty() ? to_text(column.numbers[row])
                                    : column.texts[column.codes[row]];
    }

    double number(const std::string& name, std::size_t row) const {
        const auto found = columns_.find(name);
        if (found == columns_.end())
            throw schemas::InputError(file_, "", "the column '" + name + "' is missing");
        if (const std::string problem = found->second.problem_as_numbers(); !problem.empty())
            throw schemas::InputError(file_, "", name + ": " + problem);
        return found->second.numbers[row];
    }

    /// n or k of the base's channels; `missing` if there is no such column.
    Triple channels(const std::string& name, std::size_t row, std::optional<double> missing) const {
        Triple values{};
        const bool is_split = std::ranges::any_of(
            kChannels, [&](const std::string& channel) { return has(name + channel); });
        for (std::size_t c = 0; c < values.size(); ++c) {
            if (!is_split && !has(name) && missing) {
                values[c] = *missing;
            } else {
                values[c] = number(is_split ? name + kChannels[c] : name, row);
            }
        }
        return values;
    }

private:
    std::string file_;
    std::map<std::string, schemas::PointsColumn> columns_;
    std::size_t rows_ = 0;
};

/// Columns of the statistics.
struct StatisticsRows {
    tables::Column::Texts engine, base, worst;
    tables::Column::Numbers count, mean, median, p95, max;

    void add(const std::string& name, std::string_view kind, std::span<const ComparedFilm> films,
             std::span<const std::optional<double>> differences, std::size_t of_base) {
        const DifferenceSummary summary = summary_of(differences);
        engine.push_back(name);
        base.emplace_back(kind);
        count.push_back(static_cast<double>(of_base));
        const bool is_empty = summary.count == 0;
        const auto value = [&](double number) {
            return is_empty ? std::numeric_limits<double>::quiet_NaN() : number;
        };
        mean.push_back(value(summary.mean));
        median.push_back(value(summary.median));
        p95.push_back(value(summary.p95));
        max.push_back(value(summary.max));
        worst.push_back(is_empty ? "" : films[summary.worst].id);
    }
};

}  // namespace

std::vector<ComparedFilm> read_films(const std::string& file) {
    const std::string shown = schemas::shown_path(file);
    const FilmColumns columns(shown, schemas::read_points_csv(schemas::read_text(file), shown));
    std::vector<ComparedFilm> films;
    for (std::size_t row = 0; row < columns.rows(); ++row) {
        if (!columns.has("id")) throw schemas::InputError(shown, "", "the column 'id' is missing");
        const std::string id = columns.text("id", row);
        EngineFilm film;
        film.film_n = columns.number("film_n", row);
        film.thickness_nm = columns.number("film_d_nm", row);
        film.base_n = columns.channels("base_n", row, {});
        film.base_k = columns.channels("base_k", row, 0);
        const double angle_deg = columns.number("angle_deg", row);
        try {
            films.push_back(compared_film(id, angle_deg, film));
        } catch (const DomainError& error) {
            throw schemas::InputError(shown, "", "film " + id + ": " + error.what());
        }
    }
    return films;
}

tables::Records film_rows(const Triple& white, std::span<const ComparedEngine> engines,
                          std::span<const ComparedFilm> films,
                          std::span<const EngineColor> colors) {
    EngineRows rows(white);
    tables::Column::Texts ids;
    for (std::size_t f = 0; f < films.size(); ++f) {
        for (std::size_t e = 0; e < engines.size(); ++e) {
            ids.push_back(films[f].id);
            rows.add(engines[e].name, films[f].angle_deg, colors[f * engines.size() + e]);
        }
    }
    tables::Records records{{{"id", std::move(ids)}}};
    for (tables::Column& column : rows.take()) records.columns.push_back(std::move(column));
    return records;
}

tables::Records film_statistics(std::span<const ComparedEngine> engines,
                                std::span<const ComparedFilm> films,
                                std::span<const EngineColor> colors) {
    StatisticsRows rows;
    std::vector<std::optional<double>> differences(films.size());
    for (std::size_t e = 0; e < engines.size(); ++e) {
        const auto add = [&](std::string_view name, const std::optional<BaseKind>& kind) {
            std::size_t count = 0;
            for (std::size_t f = 0; f < films.size(); ++f) {
                const bool counts = !kind || films[f].base() == *kind;
                count += counts ? 1 : 0;
                differences[f] = counts ? colors[f * engines.size() + e].delta_e : std::nullopt;
            }
            if (count > 0 || !kind) rows.add(engines[e].name, name, films, differences, count);
        };
        for (const std::string_view name : base_kind_names()) add(name, base_kind(name));
        add("all", {});
    }
    return {{{"engine", rows.engine},
             {"base", rows.base},
             {"count", rows.count},
             {"mean", rows.mean},
             {"median", rows.median},
             {"p95", rows.p95},
             {"max", rows.max},
             {"worst", rows.worst}}};
}

tables::Records engine_list() {
    tables::Column::Texts name, title, version, date, source, inputs, space, white, limits;
    const auto add = [&](const Engine& engine) {
        name.emplace_back(engine.name);
        title.emplace_back(engine.title);
        version.emplace_back(engine.version);
        date.emplace_back(engine.date);
        source.emplace_back(engine.source);
        inputs.emplace_back(engine.inputs);
        space.emplace_back(engine.space);
        white.emplace_back(engine.white);
        limits.emplace_back(engine.limits);
    };
    for (const Engine* const engine : engines()) add(*engine);
    constexpr std::string_view spectral = "linear sRGB under the illuminant";
    add({.name = "gaussian",
         .title = "Belcour and Barla's series with their Gaussians",
         .version = "supplemental code",
         .date = "2017",
         .source = "ACM TOG 36(4), eqs. 3 to 10",
         .inputs = "film index at 550 nm, thickness in nm, n and k of the base at 550 nm",
         .space = spectral,
         .white = "D65",
         .limits = "one film of real index; three orders; one index for all wavelengths",
         .reflectance = nullptr});
    add({.name = "smits",
         .title = "Two beams, integrated over wavelengths",
         .version = "Newton's Colors",
         .date = "1992",
         .source = "B. E. Smits and G. W. Meyer, Photorealism in Computer Graphics",
         .inputs = "film index at 550 nm, thickness in nm, spectrum of the base's index",
         .space = spectral,
         .white = "D65",
         .limits = "one film; one reflection inside it; results above 1 occur",
         .reflectance = nullptr});
    add({.name = "naive",
         .title = "Reflectances at 650, 510 and 475 nm as r, g, b",
         .version = "Thin Film Interference for Computer Graphics",
         .date = "2013",
         .source = "Bacterius",
         .inputs = "the whole stack",
         .space = spectral,
         .white = "D65",
         .limits = "three wavelengths",
         .reflectance = nullptr});
    add({.name = "equal/N",
         .title = "N equally spaced wavelengths",
         .version = "trapezoid rule over 360 to 830 nm",
         .date = "",
         .source = "spectral renderers",
         .inputs = "the whole stack",
         .space = spectral,
         .white = "D65",
         .limits = "N wavelengths",
         .reflectance = nullptr});
    return {{{"engine", name},
             {"title", title},
             {"version", version},
             {"date", date},
             {"source", source},
             {"inputs", inputs},
             {"space", space},
             {"white", white},
             {"limits", limits}}};
}

}  // namespace irido::cli
