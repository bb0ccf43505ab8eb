#include "cli/queries/query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/options/long_work.hpp"
#include "cli/options/wavelength_unit.hpp"
#include "cli/queries/bands_query.hpp"
#include "cli/queries/cm_query.hpp"
#include "cli/queries/color_query.hpp"
#include "cli/queries/spectrum_query.hpp"

namespace irido::cli {

namespace {

/// Seconds to write one row as text.
constexpr double kWriting_s = 1e-6;

}  // namespace

nlohmann::json Query::data() const {
    return nullptr;
}

double Query::try_share(const schemas::StackDocument& document, const Incidence& incidence,
                        double) const {
    const std::unique_ptr<const PreparedStack> prepared = prepare(document);
    new_result()->add(*prepared, document.stack, incidence);
    return 1;
}

void note_incident(const schemas::StackDocument& document, const IndexTable& table,
                   const std::function<void(const std::string&)>& say) {
    const std::size_t incident = document.stack.incident;
    if (is_constant(document.stack.materials[incident])) return;  // reported when read
    double largest = 0;
    for (std::size_t w = 0; w < table.wavelength_nm().size(); ++w)
        largest = std::max(largest, std::abs(table.k(incident, w)));
    if (largest > 0)
        say(document.file + ": " + document.material_pointers[incident] + ": " +
            schemas::incident_note(largest));
}

tables::Records records_of(const Query& query, const PreparedStack& prepared) {
    const std::unique_ptr<QueryResult> result = query.new_result();
    result->add(prepared, prepared.document.stack, {query.angles_deg()});
    return result->records();
}

tables::Figure figure_of_rows(const Query& query, const tables::Records& rows,
                              const std::vector<std::string>& varied, const std::string& title,
                              tables::GamutMapping gamut,
                              const std::function<void(const std::string&)>& say) {
    tables::RowPlot plot = query.plot(rows, gamut);
    plot.title = title;
    auto place = plot.keys.begin();
    if (is_wavelength_column(place->column)) ++place;  // always along x
    for (const std::string& path : varied)
        place = plot.keys.insert(place, {path, tables::axis_of_column(path)}) + 1;
    for (const std::string& text : plot.notes) say(text);
    return tables::figure_of(rows, plot);
}

double seconds_of_rows(const Query& query, const schemas::StackDocument& document,
                       unsigned threads) {
    const std::span<const double> all = query.angles_deg();
    const auto seconds_of = [&](double angles) {
        const auto count = static_cast<std::size_t>(std::max(1.0, std::round(angles)));
        std::vector<double> some;
        for (std::size_t i = 0; i < count; ++i)
            some.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
        double share = 1;
        const double seconds = processor_seconds(
            [&] { share = query.try_share(document, {some}, std::min(1.0, angles)); });
        return seconds * angles / (share * static_cast<double>(count)) / threads_used(threads);
    };
    const auto rows = static_cast<double>(query.rows_per_angle() * all.size());
    return kWriting_s * rows +
           tried_seconds(static_cast<double>(all.size()), kFirstShare, seconds_of);
}

std::span<const QueryKind> query_kinds() {
    static constexpr std::array kinds{
        QueryKind{"spectrum", SpectrumOptions::add},
        QueryKind{"color", ColorQueryOptions::add},
        QueryKind{"bands", BandsOptions::add},
        QueryKind{"cm", CmOptions::add},
    };
    return kinds;
}

std::vector<std::string_view> query_names() {
    std::vector<std::string_view> names;
    for (const QueryKind& kind : query_kinds()) names.push_back(kind.name);
    return names;
}

}  // namespace irido::cli
