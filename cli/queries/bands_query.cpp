#include "cli/queries/bands_query.hpp"

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "cli/options/command.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

namespace {

std::vector<Polarization> band_polarizations(const std::string& text) {
    std::vector<Polarization> polarizations;
    for (const std::string_view item : comma_separated(text)) {
        if (item != "s" && item != "p")
            throw UsageError("--polarization: must be s, p or s,p (got '" + text + "')");
        polarizations.push_back(item == "s" ? Polarization::s : Polarization::p);
    }
    return polarizations;
}

/// Parses a non-empty range of wavelengths into its ends.
std::pair<double, double> parse_wavelengths(const std::string& text) {
    const auto range =
        parse_range("--range", text, kAllWavelengths.first_nm, kAllWavelengths.last_nm);
    if (range.first == range.second)
        throw UsageError("--range: LO must be below HI (got '" + text + "')");
    return range;
}

std::string letter(Polarization polarization) {
    return polarization == Polarization::s ? "s" : "p";
}

std::string name_of(LandmarkKind kind) {
    switch (kind) {
        case LandmarkKind::mode:
            return "mode";
        case LandmarkKind::edge:
            return "edge";
        case LandmarkKind::airy:
            return "airy";
        case LandmarkKind::zero:
            return "zero";
    }
    return "";
}

}  // namespace

/// Collects rows; a stack that fails contributes none.
template <class Rows>
class BandsResult : public QueryResult {
public:
    explicit BandsResult(const BandsQuery& query) : query_(query) {}

    std::size_t add(const PreparedStack& prepared, const Stack& stack,
                    const Incidence& incidence) override {
        const BraggMirror mirror = query_.mirror(prepared.document, stack);
        Rows rows;
        try {
            append(mirror, incidence, rows);
        } catch (const DomainError& error) {
            throw schemas::InputError(prepared.document.file, "", error.what());
        }
        const std::size_t count = rows.angle.size();
        all_.append(to_records(std::move(rows)));
        return count;
    }

    tables::Records records() override {
        if (all_.columns.empty()) return to_records({});
        return std::exchange(all_, {});
    }

protected:
    virtual void append(const BraggMirror& mirror, const Incidence& incidence,
                        Rows& rows) const = 0;
    virtual tables::Records to_records(Rows rows) const = 0;

    const BandsQuery& query_;

private:
    tables::Records all_;
};

struct LandmarkRows {
    tables::Column::Numbers angle, order, omega, wavelength;
    tables::Column::Texts polarization, kind;
};

class LandmarkResult : public BandsResult<LandmarkRows> {
public:
    using BandsResult::BandsResult;

private:
    void append(const BraggMirror& mirror, const Incidence& incidence,
                LandmarkRows& rows) const override {
        for (const double angle_deg : incidence.angles_deg) {
            for (const Polarization p : query_.polarizations_) {
                for (const Landmark& mark :
                     landmarks(mirror.period_at(angle_deg, p), query_.omega())) {
                    const double wavelength_nm = kTwoPi / mark.omega_per_nm;
                    if (wavelength_nm < query_.first_nm() || wavelength_nm > query_.last_nm())
                        continue;
                    rows.angle.push_back(angle_deg);
                    rows.polarization.push_back(letter(p));
                    rows.kind.push_back(name_of(mark.kind));
                    rows.order.push_back(mark.order);
                    rows.omega.push_back(mark.omega_per_nm);
                    rows.wavelength.push_back(wavelength_nm);
                }
            }
        }
    }

    tables::Records to_records(LandmarkRows rows) const override {
        return {{{"angle_deg", std::move(rows.angle)},
                 {"polarization", std::move(rows.polarization)},
                 {"kind", std::move(rows.kind)},
                 {"order", std::move(rows.order)},
                 {"omega_per_nm", std::move(rows.omega)},
                 {"wavelength_nm", std::move(rows.wavelength)}}};
    }
};

struct GapRows {
    tables::Column::Numbers angle, order, shorter, longer, width, R, centre;
    std::array<tables::Column::Numbers, BraggMirror::kReflectances.size()> periods;
    tables::Column::Texts polarization;
    tables::Column::Flags omnidirectional;
};

class GapResult : public BandsResult<GapRows> {
public:
    using BandsResult::BandsResult;

private:
    void append(const BraggMirror& mirror, const Incidence& incidence,
                GapRows& rows) const override {
        std::map<double, bool> known;
        for (const double angle_deg : incidence.angles_deg) {
            for (const Polarization p : query_.polarizations_) {
                for (const BandGap& gap :
                     band_gaps(mirror.period_at(angle_deg, p), query_.omega())) {
                    const double short_nm = kTwoPi / gap.high_per_nm;
                    const double long_nm = kTwoPi / gap.low_per_nm;
                    if (long_nm < query_.first_nm() || short_nm > query_.last_nm()) continue;
                    if (!known.contains(gap.order))
                        known[gap.order] = mirror.is_omnidirectional(gap.order);
                    rows.angle.push_back(angle_deg);
                    rows.polarization.push_back(letter(p));
                    rows.order.push_back(gap.order);
                    rows.shorter.push_back(short_nm);
                    rows.longer.push_back(long_nm);
                    rows.width.push_back(long_nm - short_nm);
                    rows.omnidirectional.push_back(known[gap.order]);
                    append_middle(mirror, angle_deg, p, gap, rows);
                }
            }
        }
    }

    static void append_middle(const BraggMirror& mirror, double angle_deg, Polarization p,
                              const BandGap& gap, GapRows& rows) {
        const double middle = gap.centre_per_nm();
        rows.R.push_back(mirror.reflectance(angle_deg, p, middle));
        rows.centre.push_back(kTwoPi / middle);
        BraggMirror::Periods needed{};
        if (gap.is_open()) needed = mirror.periods_needed(angle_deg, p, middle);
        for (std::size_t i = 0; i < needed.size(); ++i) rows.periods[i].push_back(needed[i]);
    }

    tables::Records to_records(GapRows rows) const override {
        return {{{"angle_deg", std::move(rows.angle)},
                 {"polarization", std::move(rows.polarization)},
                 {"order", std::move(rows.order)},
                 {"short_nm", std::move(rows.shorter)},
                 {"long_nm", std::move(rows.longer)},
                 {"width_nm", std::move(rows.width)},
                 {"R_mid", std::move(rows.R)},
                 {"centre_nm", std::move(rows.centre)},
                 {"N_95", std::move(rows.periods[0])},
                 {"N_99", std::move(rows.periods[1])},
                 {"N_999", std::move(rows.periods[2])},
                 {"omnidirectional", std::move(rows.omnidirectional)}}};
    }
};

BandsQuery::BandsQuery(const BandsOptions& typed, const QueryRun& run)
    : angles_deg_(parse_list("--angles", typed.angles, 0, kLargestAngle_deg)),
      polarizations_(band_polarizations(typed.polarization)),
      gaps_(typed.gaps),
      run_(run) {
    std::tie(first_nm_, last_nm_) = parse_wavelengths(typed.range);
}

OmegaRange BandsQuery::omega() const {
    return {kTwoPi / last_nm_ * (1 - 1e-15), kTwoPi / first_nm_ * (1 + 1e-15)};
}

BraggMirror BandsQuery::mirror(const schemas::StackDocument& document, const Stack& stack) const {
    try {
        return {stack, first_nm_, last_nm_};
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
}

tables::RecordLayout BandsQuery::layout(const schemas::StackDocument&) const {
    using enum tables::RecordField::Type;
    constexpr std::size_t longest_kind = 4;
    if (!gaps_)
        return {{"angle_deg"}, {"polarization", text, 1}, {"kind", text, longest_kind},
                {"order"},     {"omega_per_nm"},          {"wavelength_nm"}};
    return {{"angle_deg"}, {"polarization", text, 1},
            {"order"},     {"short_nm"},
            {"long_nm"},   {"width_nm"},
            {"R_mid"},     {"centre_nm"},
            {"N_95"},      {"N_99"},
            {"N_999"},     {"omnidirectional", flag}};
}

tables::RowPlot BandsQuery::plot(const tables::Records&, tables::GamutMapping) const {
    tables::RowPlot plot;
    plot.form = tables::Series::Form::points;
    plot.keys.push_back({"angle_deg", tables::axis_of_column("angle_deg")});
    plot.keys.push_back({"polarization", tables::axis_of_column("polarization"), true});
    if (!gaps_) plot.keys.push_back({"kind", tables::axis_of_column("kind")});
    if (!gaps_) {
        plot.values.push_back({"wavelength_nm", tables::axis_of_column("wavelength_nm")});
        return plot;
    }
    for (const char* name : {"short_nm", "long_nm"})
        plot.values.push_back({name, tables::axis_of_column(name), "band-gap edges"});
    return plot;
}

std::unique_ptr<const PreparedStack> BandsQuery::prepare(schemas::StackDocument document) const {
    const double k = mirror(document, document.stack).left_out_k();
    if (k > 0)
        run_.note("landmarks and gaps ignore the absorption of the two layers (k up to " +
                  to_text(k) + ")");
    return std::make_unique<PreparedStack>(std::move(document));
}

std::unique_ptr<QueryResult> BandsQuery::new_result() const {
    if (gaps_) return std::make_unique<GapResult>(*this);
    return std::make_unique<LandmarkResult>(*this);
}

double BandsQuery::cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                           std::optional<double>) const {
    constexpr double kStack = 3, kMode = 4, kGap = 30;
    const PeriodAt period = mirror(prepared.document, stack).period_at(angle_deg, Polarization::s);
    const OmegaRange range = omega();
    const BraggPeriod middle = period((range.low_per_nm + range.high_per_nm) / 2);
    const double modes =
        (middle.path1_nm + middle.path2_nm) * (range.high_per_nm - range.low_per_nm) / kTwoPi;
    return kStack +
           (1 + 2 * modes) * (gaps_ ? kGap : kMode) * static_cast<double>(polarizations_.size());
}

std::unique_ptr<QueryOptions> BandsOptions::add(CLI::App& command) {
    auto options = std::make_unique<BandsOptions>();
    add_angles_option(command, options->angles);
    add_s_and_p_option(command, options->polarization);
    command
        .add_option("--range", options->range,
                    "range of vacuum wavelengths, nm, in [1, 1e7] [360:830]")
        ->type_name("LO:HI");
    command.add_flag("--gaps", options->gaps,
                     "list gaps instead: edges, width, R of the whole stack at mid-gap (in\n"
                     "1/wavelength), the numbers of periods N_95, N_99, N_999 that reach\n"
                     "an R of 0.95, 0.99, 0.999 there (0: none up to 1e9), and whether\n"
                     "some wavelength lies in the gap at all angles in s and p");
    return options;
}

std::unique_ptr<const Query> BandsOptions::parse(const QueryRun& run) const {
    return std::make_unique<BandsQuery>(*this, run);
}

nlohmann::json BandsOptions::typed() const {
    return {{"angles", angles}, {"polarization", polarization}, {"range", range}, {"gaps", gaps}};
}

}  // namespace irido::cli
