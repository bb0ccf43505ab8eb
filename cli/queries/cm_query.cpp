#include "cli/queries/cm_query.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/options/command.hpp"
#include "core/color/fourier/film_color.hpp"
#include "core/error.hpp"
#include "core/film/film.hpp"
#include "core/stack/index_table.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

namespace {

constexpr double kMostOrders = 1e6, kMostRows = 1e7;

/// The letters of a comma-separated list, each one of `allowed`; `rule` is the error message.
std::vector<char> parse_letters(const std::string& text, std::string_view allowed,
                                std::string rule) {
    std::vector<char> letters;
    for (const std::string_view item : comma_separated(text)) {
        if (item.size() != 1 || allowed.find(item) == std::string_view::npos)
            throw UsageError(rule.append(" (got '").append(text).append("')"));
        letters.push_back(item.front());
    }
    return letters;
}

std::vector<double> parse_orders(const std::string& text) {
    std::vector<double> orders = parse_list("--orders", text, 0, kMostOrders);
    for (const double order : orders)
        if (order != std::floor(order))
            throw UsageError("--orders: must be whole numbers (got " + to_text(order) + ")");
    return orders;
}

/// The film's media at the requested wavelength.
Film film_of(const schemas::StackDocument& document, double at_nm) {
    const Stack& stack = document.stack;
    const std::string fault = stack.elements.empty() ? "no layer" : film_fault(stack);
    if (!fault.empty())
        throw schemas::InputError(document.file, "",
                                  "cm needs one coherent film of a real index (got " + fault + ")");
    const Layer layer = only_film(stack);
    try {
        const IndexTable table(stack, {at_nm});
        return {table.n(stack.incident, 0), table.n(layer.material, 0),
                table.index(stack.substrate, 0), layer.thickness_nm};
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
}

struct CmStack : PreparedStack {
    CmStack(schemas::StackDocument read, double at_nm)
        : PreparedStack(std::move(read)), film(film_of(document, at_nm)) {}

    Film film;
};

FilmSeries series_at(const schemas::StackDocument& document, const Film& film, double angle_deg,
                     char polarization) {
    const auto series = film_series(film, incident_angle(angle_deg),
                                    polarization == 's' ? Polarization::s : Polarization::p);
    if (series) return *series;
    throw schemas::InputError(
        document.file, "",
        "no Fourier series at " + to_text(angle_deg) + " degrees: past the film's critical angle" +
            (film.base.imag() < 0 ? ", or the base amplifies without bound" : ""));
}

}  // namespace

class CmResult : public QueryResult {
public:
    explicit CmResult(const CmQuery& query) : query_(query) {}

    std::size_t add(const PreparedStack& prepared, const Stack& stack,
                    const Incidence& incidence) override {
        Film film = static_cast<const CmStack&>(prepared).film;
        film.thickness_nm = only_film(stack).thickness_nm;
        std::vector<FilmSeries> series;
        for (const double angle_deg : incidence.angles_deg)
            for (const char p : query_.polarizations_)
                series.push_back(series_at(prepared.document, film, angle_deg, p));
        std::size_t rows = 0;
        for (std::size_t i = 0; i < series.size(); ++i) {
            const std::size_t polarizations = query_.polarizations_.size();
            rows += append(series[i], incidence.angles_deg[i / polarizations],
                           query_.polarizations_[i % polarizations]);
        }
        return rows;
    }

    tables::Records records() override {
        Rows rows = std::exchange(rows_, {});
        return {{{"angle_deg", std::move(rows.angle)},
                 {"polarization", std::move(rows.polarization)},
                 {"side", std::move(rows.side)},
                 {"order", std::move(rows.order)},
                 {"C", std::move(rows.C)},
                 {"opd_nm", std::move(rows.opd)},
                 {"phi_rad", std::move(rows.phi)}}};
    }

private:
    struct Rows {
        tables::Column::Numbers angle, order, C, opd, phi;
        tables::Column::Texts polarization, side;
    };

    std::size_t append(const FilmSeries& series, double angle_deg, char polarization) {
        for (const char s : query_.sides_) {
            for (const double m : query_.orders_) {
                rows_.angle.push_back(angle_deg);
                rows_.polarization.emplace_back(1, polarization);
                rows_.side.emplace_back(1, s);
                rows_.order.push_back(m);
                rows_.C.push_back(series.coefficient(s == 'T', m));
                rows_.opd.push_back(series.opd_nm);
                rows_.phi.push_back(series.phase_rad());
            }
        }
        return query_.sides_.size() * query_.orders_.size();
    }

    const CmQuery& query_;
    Rows rows_;
};

CmQuery::CmQuery(const CmOptions& typed)
    : angles_deg_(parse_list("--angles", typed.angles, 0, kLargestAngle_deg)),
      polarizations_(
          parse_letters(typed.polarization, "sp", "--polarization: must be s, p or s,p")),
      sides_(parse_letters(typed.sides, "RT", "--side: must be R, T or R,T")),
      orders_(parse_orders(typed.orders)),
      at_nm_(
          parse_one_number("--at", typed.at, kAllWavelengths.first_nm, kAllWavelengths.last_nm)) {
    const double rows =
        static_cast<double>(angles_deg_.size()) * static_cast<double>(rows_per_angle());
    if (rows > kMostRows)
        throw UsageError("--orders: the result must have at most " + to_text(kMostRows) +
                         " rows (got " + to_text(rows) + ")");
}

tables::RecordLayout CmQuery::layout(const schemas::StackDocument&) const {
    using enum tables::RecordField::Type;
    return {
        {"angle_deg"}, {"polarization", text, 1}, {"side", text, 1}, {"order"}, {"C"}, {"opd_nm"},
        {"phi_rad"}};
}

tables::RowPlot CmQuery::plot(const tables::Records&, tables::GamutMapping) const {
    tables::RowPlot plot;
    constexpr std::size_t kMostBars = 8;  // of each order, side by side
    const bool has_bars = angles_deg_.size() <= kMostBars;
    plot.form = has_bars ? tables::Series::Form::bars : tables::Series::Form::line;
    for (const char* name : {"order", "angle_deg", "polarization", "side"})
        plot.keys.push_back({name, tables::axis_of_column(name),
                             !has_bars && std::string_view(name) == "polarization"});
    plot.values.push_back({"C", tables::axis_of_column("C")});
    return plot;
}

std::unique_ptr<const PreparedStack> CmQuery::prepare(schemas::StackDocument document) const {
    return std::make_unique<CmStack>(std::move(document), at_nm_);
}

std::unique_ptr<QueryResult> CmQuery::new_result() const {
    return std::make_unique<CmResult>(*this);
}

double CmQuery::cost_us(const PreparedStack&, const Stack&, double, std::optional<double>) const {
    constexpr double kAngle = 0.5, kRow = 0.5;
    return kAngle + kRow * static_cast<double>(rows_per_angle());
}

std::unique_ptr<QueryOptions> CmOptions::add(CLI::App& command) {
    auto options = std::make_unique<CmOptions>();
    add_angles_option(command, options->angles);
    add_s_and_p_option(command, options->polarization);
    command.add_option("--side", options->sides, "R (reflected), T (transmitted) or R,T [R]")
        ->type_name("SIDES");
    offer(command, "side", "R T", OfferedWords::Use::several);
    command.add_option("--orders", options->orders, "orders m, whole numbers in [0, 1e6] [0:5:1]")
        ->type_name("LIST");
    command.add_option("--at", options->at, "vacuum wavelength of the indices, nm, [1, 1e7] [550]")
        ->type_name("NM");
    return options;
}

std::unique_ptr<const Query> CmOptions::parse(const QueryRun&) const {
    return std::make_unique<CmQuery>(*this);
}

nlohmann::json CmOptions::typed() const {
    return {{"angles", angles},
            {"polarization", polarization},
            {"orders", orders},
            {"side", sides},
            {"at", at}};
}

}  // namespace irido::cli
