#include "cli/queries/profile_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/options/command.hpp"
#include "cli/queries/stack_tables.hpp"
#include "core/coherent/media.hpp"
#include "core/spectrum/profile.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

namespace {

constexpr double kFarthest_nm = 1e10, kMostPoints = 1e6;

struct ProfileStack : PreparedStack {
    ProfileStack(schemas::StackDocument read, const std::vector<double>& wavelengths_nm)
        : PreparedStack(std::move(read)), table(index_table(document, wavelengths_nm)) {}

    IndexTable table;
};

void require_fields(const schemas::StackDocument& document, const StackPower& power) {
    if (!power.has_amplitudes())
        throw schemas::InputError(document.file, "",
                                  "a profile requires coherent layers without thickness_sigma_nm: "
                                  "incoherent or averaged stacks have no fields");
}

/// The columns after polarization.
std::vector<std::string> profile_names(bool summary) {
    if (summary) return {"medium", "absorbed", "penetration_nm", "largest_E2", "largest_at_nm"};
    return {"z_nm", "medium", "E2", "Ex2", "Ey2", "Ez2", "absorbed_per_nm", "flux"};
}

FieldPoint mean_of(const FieldPoint& s, const FieldPoint& p) {
    return {s.medium,
            (s.Ex2 + p.Ex2) / 2,
            (s.Ey2 + p.Ey2) / 2,
            (s.Ez2 + p.Ez2) / 2,
            (s.absorbed_per_nm + p.absorbed_per_nm) / 2,
            (s.flux + p.flux) / 2};
}

}  // namespace

class ProfileResult : public QueryResult {
public:
    explicit ProfileResult(const ProfileQuery& query)
        : query_(query), numbers_(profile_names(query.summary_).size()) {}

    std::size_t add(const PreparedStack& prepared, const Stack& stack,
                    const Incidence& incidence) override {
        const IndexTable& table = static_cast<const ProfileStack&>(prepared).table;
        const std::size_t before = angle_.size();
        try {
            for (const double angle_deg : incidence.angles_deg)
                for (const char letter : query_.polarizations_)
                    for (std::size_t w = 0; w < table.wavelength_nm().size(); ++w)
                        add_rows(stack, table, w, angle_deg, letter);
        } catch (const DomainError& error) {
            throw schemas::InputError(prepared.document.file, "", error.what());
        }
        return angle_.size() - before;
    }

    tables::Records records() override {
        tables::Records records{
            {{std::string(query_.wavelengths_.unit().column), std::exchange(wavelength_, {})},
             {"angle_deg", std::exchange(angle_, {})},
             {"polarization", std::exchange(polarization_, {})}}};
        const std::vector<std::string> names = profile_names(query_.summary_);
        for (std::size_t c = 0; c < names.size(); ++c)
            records.columns.push_back({names[c], std::exchange(numbers_[c], {})});
        return records;
    }

private:
    void add_rows(const Stack& stack, const IndexTable& table, std::size_t w, double angle_deg,
                  char letter) {
        const IncidentAngle at = incident_angle(angle_deg);
        std::vector<Medium> media;
        const auto profile = [&](Polarization polarization) {
            set_media(table, w, at, polarization, media);
            return FieldProfile(stack, media, table.k0()[w], at, polarization);
        };
        const FieldProfile first = profile(letter == 'p' ? Polarization::p : Polarization::s);
        std::optional<FieldProfile> second;
        if (letter == 'u') second.emplace(profile(Polarization::p));
        const auto lead = [&] {
            wavelength_.push_back(query_.wavelengths_.printed(table.wavelength_nm()[w]));
            angle_.push_back(angle_deg);
            polarization_.emplace_back(1, letter);
        };
        const FieldProfile* const other = second ? &*second : nullptr;
        if (query_.summary_) {
            for (std::size_t number = 1; number <= first.layers() + 1; ++number) {
                lead();
                const LayerProfile layer = first.layer(number, other);
                add_numbers(
                    {static_cast<double>(number), layer.absorbed,
                     layer.penetration_nm.value_or(std::numeric_limits<double>::quiet_NaN()),
                     layer.largest_E2, layer.largest_at_nm});
            }
            return;
        }
        for (const double z_nm : query_.depths_nm(first.faces_nm())) {
            lead();
            FieldPoint point = first.at(z_nm);
            if (other) point = mean_of(point, other->at(z_nm));
            add_numbers({z_nm, static_cast<double>(point.medium), point.intensity(), point.Ex2,
                         point.Ey2, point.Ez2, point.absorbed_per_nm, point.flux});
        }
    }

    void add_numbers(const std::vector<double>& row) {
        for (std::size_t c = 0; c < row.size(); ++c) numbers_[c].push_back(row[c] + 0.0);
    }

    const ProfileQuery& query_;
    tables::Column::Numbers wavelength_, angle_;
    tables::Column::Texts polarization_;
    std::vector<tables::Column::Numbers> numbers_;
};

ProfileQuery::ProfileQuery(const ProfileOptions& typed, const QueryRun& run)
    : angles_deg_(parse_list("--angles", typed.angles, 0, kLargestAngle_deg)),
      polarizations_(parse_polarizations(typed.polarization)),
      wavelengths_(typed.wavelengths, typed.unit, "550"),
      summary_(typed.summary),
      faces_(typed.faces && !typed.summary),
      note_(run.note) {
    if (!typed.points.empty() && !typed.z.empty())
        throw UsageError("--points and --z are mutually exclusive");
    if (summary_ && !(typed.points.empty() && typed.z.empty()))
        throw UsageError("--summary: cannot be combined with --points and --z");
    if (!typed.z.empty()) z_nm_ = parse_list("--z", typed.z, -kFarthest_nm, kFarthest_nm);
    const std::string points = typed.points.empty() ? "200" : typed.points;
    points_ = static_cast<std::size_t>(parse_whole_number("--points", points, 2, kMostPoints));
}

std::vector<double> ProfileQuery::depths_nm(const std::vector<double>& faces_nm) const {
    std::vector<double> depths = z_nm_;
    if (depths.empty()) {
        const double beyond = std::ranges::max(wavelengths_.nm()) / 2;
        const double first = -beyond, last = faces_nm.back() + beyond;
        depths.resize(points_);
        for (std::size_t i = 0; i < points_; ++i)
            depths[i] =
                first + (last - first) * static_cast<double>(i) / static_cast<double>(points_ - 1);
        depths.back() = last;
    }
    if (!faces_) return depths;
    const auto [first, last] = std::ranges::minmax(depths);
    for (const double face : faces_nm) {
        if (!(face > first && face < last)) continue;
        depths.push_back(std::nextafter(face, -std::numeric_limits<double>::infinity()));
        depths.push_back(face);
    }
    return depths;
}

std::size_t ProfileQuery::rows_per_angle() const {
    if (summary_ || faces_) return 0;
    const std::size_t points = z_nm_.empty() ? points_ : z_nm_.size();
    return polarizations_.size() * wavelengths_.nm().size() * points;
}

tables::RecordLayout ProfileQuery::layout(const schemas::StackDocument&) const {
    tables::RecordLayout layout{{std::string(wavelengths_.unit().column)},
                                {"angle_deg"},
                                {"polarization", tables::RecordField::Type::text, 1}};
    for (std::string& name : profile_names(summary_)) layout.push_back({std::move(name)});
    return layout;
}

tables::RowPlot ProfileQuery::plot(const tables::Records&, tables::GamutMapping) const {
    tables::RowPlot plot;
    for (const std::string& name :
         {std::string(summary_ ? "medium" : "z_nm"), std::string(wavelengths_.unit().column),
          std::string("angle_deg"), std::string("polarization")})
        plot.keys.push_back({name, tables::axis_of_column(name)});
    if (summary_) {
        for (const char* name : {"absorbed", "largest_E2"})
            plot.values.push_back({name, tables::axis_of_column(name)});
        return plot;
    }
    for (const char* name : {"E2", "absorbed_per_nm", "flux"})
        plot.values.push_back({name, tables::axis_of_column(name)});
    return plot;
}

std::unique_ptr<const PreparedStack> ProfileQuery::prepare(schemas::StackDocument document) const {
    require_fields(document, stack_power(document, document.stack));
    try {
        auto prepared = std::make_unique<ProfileStack>(std::move(document), wavelengths_.nm());
        note_incident(prepared->document, prepared->table, note_);
        return prepared;
    } catch (const schemas::InputError& error) {
        throw wavelengths_.with_unit(error);
    }
}

std::unique_ptr<QueryResult> ProfileQuery::new_result() const {
    return std::make_unique<ProfileResult>(*this);
}

double ProfileQuery::cost_us(const PreparedStack&, const Stack& stack, double,
                             std::optional<double>) const {
    constexpr double kRow = 1, kLayer = 0.3;
    return kRow * static_cast<double>(rows_per_angle()) +
           kLayer * static_cast<double>(count_layers(stack.elements));
}

std::unique_ptr<QueryOptions> ProfileOptions::add(CLI::App& command) {
    auto options = std::make_unique<ProfileOptions>();
    command
        .add_option("-w,--wavelengths", options->wavelengths,
                    "vacuum wavelengths, nm or as --unit says, [1, 1e7] nm [550]")
        ->type_name("LIST");
    add_unit_option(command, options->unit);
    command
        .add_option("-a,--angles", options->angles,
                    "angles of incidence in the incident medium, degrees, [0, 90) [0]")
        ->type_name("LIST");
    add_polarizations_option(command, options->polarization);
    command
        .add_option("--points", options->points,
                    "number of equally spaced depths, from half of the longest wavelength\n"
                    "before the first face to half of it behind the last [200]")
        ->type_name("N");
    command
        .add_option("--z", options->z,
                    "depths instead, nm: 0 is the first face, a negative depth lies before\n"
                    "it; a depth on a face belongs to the medium below it")
        ->type_name("LIST");
    command.add_flag("--summary", options->summary,
                     "one row for each layer and the substrate: absorbed power, the depth\n"
                     "over which the intensity of a wave falls to 1/e, the largest |E|^2 and\n"
                     "its depth");
    return options;
}

std::unique_ptr<const Query> ProfileOptions::parse(const QueryRun& run) const {
    return std::make_unique<ProfileQuery>(*this, run);
}

nlohmann::json ProfileOptions::typed() const {
    return {{"wavelengths", wavelengths},
            {"angles", angles},
            {"polarization", polarization},
            {"unit", unit},
            {"points", points},
            {"z", z},
            {"summary", summary}};
}

}  // namespace irido::cli
