#include "cli/queries/comparison_query.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/options/color_options.hpp"
#include "core/coherent/coherent.hpp"
#include "core/incoherent/chain.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

struct ComparedStack : PreparedStack {
    using PreparedStack::PreparedStack;

    std::unique_ptr<const StackComparison> comparison;
};

/// The film passed to engines, for a note.
std::string given_text(const GivenFilm& given) {
    const EngineFilm& film = given.film;
    std::string text = "engines are given a film of index " +
                       channels_text({film.film_n, film.film_n, film.film_n}) +
                       " (550 nm) over a base of n " + channels_text(film.base_n);
    if (film.is_conductor()) {
        const bool is_gray = film.base_n[0] == film.base_n[1] && film.base_n[1] == film.base_n[2];
        text += ", k " + channels_text(film.base_k) +
                (is_gray ? "" : " at " + channels_text(kBaseWavelengths_nm) + " nm") + ", F0 " +
                channels_text(film.base_f0) + ", F82 tint " + channels_text(film.base_f82_tint);
    } else {
        text += " (550 nm), F0 " + channels_text(film.base_f0);
    }
    constexpr double kAir = 5e-4;
    if (std::abs(given.thickness_scale - 1) > kAir)
        text += "; in air: indices divided and the thickness multiplied by " +
                to_text(given.thickness_scale);
    return text;
}

}  // namespace

void require_exact(const std::string& name, double error) {
    constexpr double kVisible = 1e-5;
    if (error > kVisible)
        throw ToleranceError(name + ": the exact colour cannot be had: its error is " +
                             to_text(error) + " in X, Y, Z");
}

EngineRows::EngineRows(const Triple& white)
    : exact_rgb_(rgb_space("srgb"), white, Adaptation::bradford) {}

void EngineRows::add(const std::string& engine, double angle_deg, const EngineColor& color) {
    const RgbSpace& srgb = rgb_space("srgb");
    engine_.push_back(engine);
    angle_.push_back(angle_deg);
    hex_.push_back(color.rgb ? hex(srgb, *color.rgb) : "");
    std::optional<Triple> exact;
    if (color.exact_xyz) exact = exact_rgb_(*color.exact_xyz);
    exact_hex_.push_back(exact ? hex(srgb, *exact) : "");
    for (std::size_t c = 0; c < 3; ++c) {
        rgb_[c].push_back(color.rgb ? (*color.rgb)[c] : kMissing);
        exact_[c].push_back(exact ? (*exact)[c] : kMissing);
    }
    delta_e_.push_back(color.delta_e.value_or(kMissing));
}

std::vector<tables::Column> EngineRows::take() {
    std::vector<tables::Column> columns;
    const auto add = [&](const char* name, auto& values) {
        columns.push_back({name, std::exchange(values, {})});
    };
    add("engine", engine_);
    add("angle_deg", angle_);
    add("r", rgb_[0]);
    add("g", rgb_[1]);
    add("b", rgb_[2]);
    add("hex", hex_);
    add("true_r", exact_[0]);
    add("true_g", exact_[1]);
    add("true_b", exact_[2]);
    add("true_hex", exact_hex_);
    add("delta_e_2000", delta_e_);
    return columns;
}

tables::RecordLayout EngineRows::layout(std::size_t longest) {
    using enum tables::RecordField::Type;
    constexpr std::size_t hex_width = 7;
    return {{"engine", text, longest},
            {"angle_deg"},
            {"r"},
            {"g"},
            {"b"},
            {"hex", text, hex_width},
            {"true_r"},
            {"true_g"},
            {"true_b"},
            {"true_hex", text, hex_width},
            {"delta_e_2000"}};
}

class ComparisonResult : public QueryResult {
public:
    explicit ComparisonResult(const ComparisonQuery& query)
        : query_(query), rows_(query.tables_.sensitivity().white()) {}

    std::size_t add(const PreparedStack& prepared, const Stack& stack,
                    const Incidence& incidence) override {
        const std::vector<EngineColor> colors = [&] {
            try {
                return ComparisonQuery::comparison_of(prepared)(stack, incidence.angles_deg);
            } catch (const DomainError& error) {
                throw schemas::InputError(prepared.document.file, "", error.what());
            }
        }();
        const std::size_t angles = incidence.angles_deg.size();
        double error = 0;
        for (std::size_t i = 0; i < colors.size(); ++i) {
            rows_.add(query_.engines_[i / angles].name, incidence.angles_deg[i % angles],
                      colors[i]);
            error = std::max(error, colors[i].exact_error);
        }
        require_exact(prepared.document.file, error);
        return colors.size();
    }

    tables::Records records() override { return {rows_.take()}; }

private:
    const ComparisonQuery& query_;
    EngineRows rows_;
};

ComparisonQuery::ComparisonQuery(const ComparisonQueryOptions& typed, const QueryRun& run)
    : angles_deg_(
          parse_list("--angles", typed.angles.empty() ? "0" : typed.angles, 0, kLargestAngle_deg)),
      engines_(parse_engines(typed.comparison.engines)),
      tables_(parse_sensitivity(typed.comparison)),
      difference_(parse_difference(typed.comparison, tables_.sensitivity().white())),
      strict_(typed.comparison.strict),
      note_(run.note) {
    request_.tolerance = kComparisonTolerance;
    request_.colors = static_cast<std::size_t>(
        std::min(1e15, run.stacks * static_cast<double>(angles_deg_.size())));
    request_.varied = run.varied;
    request_.simd = run.execution.simd;
}

const StackComparison& ComparisonQuery::comparison_of(const PreparedStack& prepared) {
    return *static_cast<const ComparedStack&>(prepared).comparison;
}

tables::RecordLayout ComparisonQuery::layout(const schemas::StackDocument&) const {
    std::size_t longest = 1;
    for (const ComparedEngine& engine : engines_) longest = std::max(longest, engine.name.size());
    return EngineRows::layout(longest);
}

tables::RowPlot ComparisonQuery::plot(const tables::Records&, tables::GamutMapping) const {
    tables::RowPlot plot;
    for (const char* name : {"angle_deg", "engine"})
        plot.keys.push_back({name, tables::axis_of_column(name)});
    plot.values.push_back({"delta_e_2000", {.quantity = "CIEDE2000", .from_zero = true}});
    return plot;
}

std::unique_ptr<const PreparedStack> ComparisonQuery::prepare(
    schemas::StackDocument document) const {
    report_held_ranges(document, tables_.sensitivity(), strict_, note_);
    const std::string file = document.file;
    try {
        auto prepared = std::make_unique<ComparedStack>(std::move(document));
        prepared->comparison = std::make_unique<StackComparison>(
            tables_, engines_, difference_, prepared->document.stack, request_);
        const GivenFilm& given = prepared->comparison->given();
        if (std::ranges::none_of(engines_, &ComparedEngine::takes_film)) return prepared;
        if (!given.dropped.empty()) {
            const std::string what = "engines cannot take " + joined(given.dropped, ", ");
            if (strict_) throw schemas::InputError(file, "", what);
            note_(file + ": " + what);
        }
        note_(file + ": " + given_text(given));
        return prepared;
    } catch (const DomainError& error) {
        throw schemas::InputError(file, "", error.what());
    }
}

std::unique_ptr<QueryResult> ComparisonQuery::new_result() const {
    return std::make_unique<ComparisonResult>(*this);
}

double ComparisonQuery::cost_us(const PreparedStack&, const Stack& stack, double,
                                std::optional<double>) const {
    constexpr double kEngine = 1, kLayer = 1;
    return kEngine * static_cast<double>(engines_.size()) +
           kLayer * static_cast<double>(count_layers(stack.elements));
}

std::unique_ptr<const Query> ComparisonQueryOptions::parse(const QueryRun& run) const {
    return std::make_unique<ComparisonQuery>(*this, run);
}

nlohmann::json ComparisonQueryOptions::typed() const {
    return {{"angles", angles},
            {"engines", comparison.engines},
            {"illuminant", comparison.color.illuminant},
            {"observer", comparison.color.observer},
            {"white", comparison.white},
            {"as_cie_rgb", comparison.as_cie_rgb}};
}

}  // namespace irido::cli
