#include "cli/queries/spectrum_query.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/options/command.hpp"
#include "cli/queries/stack_tables.hpp"
#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/material/index_series.hpp"
#include "core/spectrum/stack_power.hpp"
#include "core/stack/index_table.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/index_rows.hpp"

namespace irido::cli {

namespace {

struct SpectrumStack : PreparedStack {
    SpectrumStack(schemas::StackDocument read, const std::vector<double>& wavelengths_nm)
        : PreparedStack(std::move(read)), table(index_table(document, wavelengths_nm)) {}

    IndexTable table;
};

std::string count_of(std::size_t part, std::size_t all, const std::string& what) {
    return std::to_string(part) + " of " + std::to_string(all) + " " + what;
}

/// Why a request is left to the plain kernel; see --stats.
std::string why_plain(const StackPower& stack, SimdLevel simd) {
    if (simd == SimdLevel::plain) return "IRIDO_SIMD=plain";
    if (!stack.chain()) return "thickness distributions";
    return "groups of many layers in groups, or phases beyond 1e12";
}

std::vector<std::string> lines_of(const Work& work, const Needs& needs, std::size_t angles,
                                  const std::string& plain_reason) {
    std::vector<std::string> lines;
    const std::string points = std::to_string(work.points) + " points (wavelength, angle), ";
    if (work.kernel == SimdLevel::plain) {
        lines.push_back(points + "one at a time (" + plain_reason + ")");
    } else {
        lines.push_back(points + "vectorized (" + std::string(name_of(work.kernel)) + "), " +
                        std::to_string(work.layers) + " layers");
    }
    const auto skipped = [&](const std::string& what) { lines.push_back("skipped: " + what); };
    if (work.normal_angles > 0 && needs.s && needs.p)
        skipped("p at " + count_of(work.normal_angles, angles, "angles (s serves both at 0 deg)"));
    if (!needs.s || !needs.p) skipped(std::string(needs.s ? "p" : "s") + " (not requested)");
    if (work.kernel == SimdLevel::plain) return lines;
    if (work.one_film) skipped("recursion over layers (one film: Airy's sum)");
    if (work.mirror)
        skipped("layer matrices (closed form for a mirror embedded in one of its own materials)");
    if (work.transparent_layers > 0)
        skipped("complex arithmetic in " +
                count_of(work.transparent_layers, work.layers, "layers (transparent)"));
    if (work.distinct_layers < work.layers)
        skipped("matrices of " + count_of(work.layers - work.distinct_layers, work.layers,
                                          "layers (equal to others)"));
    if (work.powers > 0)
        skipped("repetitions of " + schemas::plural(work.powers, "group") +
                " (matrix powers in closed form)");
    if (work.constant_media > 0)
        lines.push_back("reused across wavelengths: angle terms of " +
                        count_of(work.constant_media, work.media, "media (no dispersion)"));
    if (!work.absorbs) skipped("absorption (no layer absorbs)");
    if (work.passes > 1)
        lines.push_back(std::to_string(work.passes) +
                        " passes through coherent blocks between incoherent layers");
    return lines;
}

/// Most numbers computed and written at a time, and rows of several angles: as many as stay in the
/// cache, so that every block is computed in the memory of the one before.
constexpr std::size_t kBlockNumbers = 1U << 20U, kBlockRows = 1U << 13U;
/// Size of the cache of index tables, in numbers: 64 MB.
constexpr std::size_t kKeptIndices = 1U << 23U;

template <class Value>
std::vector<Value> part_of(const std::vector<Value>& all, std::size_t begin, std::size_t count) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(begin);
    return {first, first + static_cast<std::ptrdiff_t>(std::min(count, all.size() - begin))};
}

/// Wavelengths that, added to any part of a request, make an IndexTable choose the same arithmetic
/// as for the whole request: those where a material first absorbs, amplifies or changes its index,
/// those of the largest index, and the shortest.
class Witnesses {
public:
    void see(const IndexTable& table) {
        const std::vector<double>& wavelengths = table.wavelength_nm();
        if (of_.empty()) {
            for (std::size_t m = 0; m < table.materials(); ++m)
                of_.push_back({.first = table.index(m, 0)});
        }
        for (std::size_t m = 0; m < table.materials(); ++m) {
            Material& seen = of_[m];
            for (std::size_t w = 0; w < wavelengths.size(); ++w) {
                const Complex index = table.index(m, w);
                const double size = std::abs(index.real()) + std::abs(index.imag());
                if (index != seen.first) keep(seen.changes, wavelengths[w]);
                if (index.imag() != 0) keep(seen.absorbs, wavelengths[w]);
                if (index.imag() < 0) keep(seen.amplifies, wavelengths[w]);
                if (size <= seen.size) continue;
                seen.size = size;
                seen.largest = wavelengths[w];
            }
        }
        const double shortest = std::ranges::min(wavelengths);
        if (!shortest_ || shortest < *shortest_) shortest_ = shortest;
    }

    std::vector<double> wavelengths_nm(double first) const {
        std::vector<double> all{first, *shortest_};
        for (const Material& seen : of_)
            for (const auto& one : {seen.changes, seen.absorbs, seen.amplifies, seen.largest})
                if (one) all.push_back(*one);
        return all;
    }

private:
    struct Material {
        Complex first;
        std::optional<double> changes = {}, absorbs = {}, amplifies = {};
        double size = 0;
        std::optional<double> largest = {};
    };

    static void keep(std::optional<double>& place, double wavelength_nm) {
        if (!place) place = wavelength_nm;
    }

    std::vector<Material> of_;
    std::optional<double> shortest_;
};

/// Truncates every column to its first `rows` rows.
void cut(tables::Records& records, std::size_t rows) {
    for (tables::Column& column : records.columns)
        std::visit(
            [&](auto& values) {
                if constexpr (requires { values.codes; })
                    values.codes.resize(rows);
                else
                    values.resize(rows);
            },
            column.values);
}

std::vector<std::string> letters_of(const std::string& polarizations) {
    std::vector<std::string> result;
    for (const char letter : polarizations) result.emplace_back(1, letter);
    return result;
}

}  // namespace

class SpectrumResult : public QueryResult {
public:
    explicit SpectrumResult(const SpectrumQuery& query)
        : SpectrumResult(query, query.polarizations_) {}
    SpectrumResult(const SpectrumQuery& query, std::string polarizations)
        : query_(query),
          polarizations_(std::move(polarizations)),
          has_ellipsometry_(polarizations_.front() == query.polarizations_.front()) {}

    std::size_t add(const PreparedStack& prepared, const Stack& stack,
                    const Incidence& incidence) override {
        const StackPower power = stack_power(prepared.document, stack);
        const SpectrumNeeds needs = spectrum_needs(polarizations_, query_.columns_, power);
        const bool is_other = incidence.wavelength_nm.has_value();
        const IndexTable& table =
            is_other ? other_.emplace(index_table(prepared.document, {*incidence.wavelength_nm}))
                     : static_cast<const SpectrumStack&>(prepared).table;
        try {
            answer(stack, power, table, incidence.angles_deg, query_.cone_, needs,
                   query_.execution_, answers_);
        } catch (const DomainError& error) {
            throw schemas::InputError(prepared.document.file, "", error.what());
        }
        const std::size_t layers = needs.power.layers ? power.layer_count() : 0;
        if (numbers_.empty()) begin(layers);
        if (layers != layers_)
            throw UsageError(
                "--columns: A_layers requires the same number of layers in every stack");
        return append(incidence, table.wavelength_nm());
    }

    tables::Records records() override {
        tables::Records records{{{std::string(query_.typed_.unit().column), std::move(wavelength_)},
                                 {"angle_deg", std::move(angle_)},
                                 {"polarization", std::move(polarization_)}}};
        for (std::size_t c = 0; c < names_.size(); ++c)
            records.columns.push_back({names_[c], std::move(numbers_[c])});
        numbers_.clear();
        return records;
    }

private:
    void begin(std::size_t layers) {
        layers_ = layers;
        names_ = spectrum_number_names(query_.columns_, layers);
        numbers_.assign(names_.size(), {});
        wavelength_ = {};
        angle_ = {};
        polarization_ = {letters_of(polarizations_), {}};
        shared_wavelengths_ = false;
    }

    std::size_t append(const Incidence& incidence, const std::vector<double>& wavelengths_nm) {
        const SpectrumShape shape{incidence.angles_deg.size(), polarizations_,
                                  wavelengths_nm.size(), has_ellipsometry_};
        append_spectrum_numbers(shape, query_.columns_, layers_, answers_, numbers_);
        if (incidence.wavelength_nm || !shared_wavelengths_) {
            first_wavelength_ = static_cast<std::uint32_t>(wavelength_.values.size());
            for (const double nm : wavelengths_nm)
                wavelength_.values.push_back(query_.typed_.printed(nm));
            shared_wavelengths_ = !incidence.wavelength_nm;
        }
        for (const double angle_deg : incidence.angles_deg) {
            const auto angle = static_cast<std::uint32_t>(angle_.values.size());
            angle_.values.push_back(angle_deg);
            for (std::uint32_t p = 0; p < shape.polarizations.size(); ++p) {
                for (std::uint32_t w = 0; w < shape.wavelengths; ++w) {
                    wavelength_.codes.push_back(first_wavelength_ + w);
                    polarization_.codes.push_back(p);
                    angle_.codes.push_back(angle);
                }
            }
        }
        return shape.rows();
    }

    const SpectrumQuery& query_;
    std::string polarizations_;
    bool has_ellipsometry_;
    SpectrumAnswers answers_;
    std::optional<IndexTable> other_;
    std::size_t layers_ = 0;
    std::vector<std::string> names_;
    std::vector<tables::Column::Numbers> numbers_;
    tables::Column::CodedNumbers wavelength_, angle_;
    tables::Column::CodedTexts polarization_;
    bool shared_wavelengths_ = false;  ///< the last values are for the query's wavelengths
    std::uint32_t first_wavelength_ = 0;
};

/// Rows of averages: one per angle and polarization.
class AverageResult : public QueryResult {
public:
    explicit AverageResult(const SpectrumQuery& query) : query_(query) {}

    std::size_t add(const PreparedStack& prepared, const Stack& stack,
                    const Incidence& incidence) override {
        const WavelengthRange range{query_.wavelengths_nm_.front(), query_.wavelengths_nm_.back()};
        SpectrumAnswers answers;
        try {
            answers.spectra = average_power(prepared.document, stack, range, *query_.average_,
                                            incidence.angles_deg, query_.cone_, query_.execution_);
        } catch (const DomainError& error) {
            throw schemas::InputError(prepared.document.file, "", error.what());
        }
        const SpectrumShape shape{incidence.angles_deg.size(), query_.polarizations_, 1};
        append_spectrum_numbers(shape, {}, 0, answers, numbers_);
        for (const double angle_deg : incidence.angles_deg)
            for (const char letter : query_.polarizations_) {
                angle_.push_back(angle_deg);
                polarization_.emplace_back(1, letter);
                weight_.push_back(query_.average_->name);
            }
        return shape.rows();
    }

    tables::Records records() override {
        tables::Records records{{{"angle_deg", std::exchange(angle_, {})},
                                 {"polarization", std::exchange(polarization_, {})},
                                 {"weight", std::exchange(weight_, {})}}};
        for (std::size_t c = 0; c < numbers_.size(); ++c)
            records.columns.push_back({std::string(1, "RTA"[c]), std::exchange(numbers_[c], {})});
        return records;
    }

private:
    const SpectrumQuery& query_;
    tables::Column::Numbers angle_;
    tables::Column::Texts polarization_, weight_;
    std::vector<tables::Column::Numbers> numbers_ = std::vector<tables::Column::Numbers>(3);
};

namespace {

void require_power_columns(const std::string& option, const std::vector<SpectrumColumn>& columns,
                           bool takes_layers) {
    for (const SpectrumColumn column : columns)
        if (!takes_layers || column != SpectrumColumn::A_layers)
            throw UsageError(option + ": cannot be combined with --columns" +
                             (takes_layers ? " other than A_layers" : ""));
}

std::vector<double> both_ends(const std::vector<double>& wavelengths_nm) {
    const auto [first, last] = std::ranges::minmax(wavelengths_nm);
    if (first == last)
        throw UsageError("--average: --wavelengths must be a range, such as 400:700:1 (got " +
                         to_text(first) + " nm alone)");
    return {first, last};
}

}  // namespace

SpectrumQuery::SpectrumQuery(const SpectrumOptions& typed, const QueryRun& run)
    : varies_wavelength_(run.varies_wavelength),
      typed_(varies_wavelength_
                 ? TypedWavelengths()
                 : TypedWavelengths(typed.wavelengths, typed.unit, kUsualWavelengths_nm)),
      wavelengths_nm_(typed_.nm()),
      angles_deg_(parse_list("--angles", typed.angles, 0, kLargestAngle_deg)),
      polarizations_(parse_polarizations(typed.polarization)),
      columns_(parse_spectrum_columns(typed.columns)),
      cone_(parse_cone(typed.cone, angles_deg_)),
      execution_(run.execution),
      note_(run.note) {
    if (varies_wavelength_ && (typed.unit != "nm" || !typed.average.empty()))
        throw UsageError(std::string(typed.unit != "nm" ? "--unit" : "--average") +
                         ": cannot be combined with a varied wavelength_nm");
    if (!cone_.is_none())
        require_power_columns(cone_.f_number != 0 ? "--f-number" : "--cone", columns_, true);
    if (typed.average.empty()) return;
    average_ = parse_average(typed.average);
    require_power_columns("--average", columns_, false);
    wavelengths_nm_ = both_ends(wavelengths_nm_);
}

nlohmann::json SpectrumQuery::data() const {
    if (!average_) return nullptr;
    nlohmann::json rows = nlohmann::json::array();
    for (const Table& factor : average_->factors)
        rows.push_back({factor.wavelength_nm, factor.value});
    return rows;
}

tables::RecordLayout SpectrumQuery::layout(const schemas::StackDocument& document) const {
    const StackPower power = stack_power(document, document.stack);
    const bool by_layer = spectrum_needs(polarizations_, columns_, power).power.layers;
    using enum tables::RecordField::Type;
    tables::RecordLayout layout;
    if (!average_) layout.push_back({std::string(typed_.unit().column)});
    layout.push_back({"angle_deg"});
    layout.push_back({"polarization", text, 1});
    if (average_) layout.push_back({"weight", text, average_->name.size()});
    for (std::string& name : spectrum_number_names(columns_, by_layer ? power.layer_count() : 0))
        layout.push_back({std::move(name)});
    return layout;
}

tables::RowPlot SpectrumQuery::plot(const tables::Records& rows, tables::GamutMapping) const {
    tables::RowPlot plot;
    std::vector<std::string> keys{"angle_deg", "polarization"};
    keys.insert(keys.begin(), std::string(average_ ? "weight" : typed_.unit().column));
    for (const std::string& name : keys) plot.keys.push_back({name, tables::axis_of_column(name)});
    std::size_t layers = 0;
    for (const tables::Column& column : rows.columns)
        if (column.name == "A_" + std::to_string(layers + 1)) ++layers;
    for (std::string& name : spectrum_number_names(columns_, layers)) {
        tables::FigureAxis axis = tables::axis_of_column(name);
        if (name == "C") axis.quantity = name;  // of ellipsometry, not the Fourier coefficient
        plot.values.push_back({name, axis, name.starts_with("A_") ? "absorbed in layers" : ""});
    }
    return plot;
}

std::unique_ptr<const PreparedStack> SpectrumQuery::prepare(schemas::StackDocument document) const {
    spectrum_needs(polarizations_, columns_, stack_power(document, document.stack));
    try {
        auto prepared = std::make_unique<SpectrumStack>(std::move(document), wavelengths_nm_);
        note_stack(prepared->document, prepared->table);
        return prepared;
    } catch (const schemas::InputError& error) {
        throw typed_.with_unit(error);
    }
}

void SpectrumQuery::note_stack(const schemas::StackDocument& document,
                               const IndexTable& table) const {
    note_incident(document, table, note_);
    const StackPower power = stack_power(document, document.stack);
    if (!spectrum_needs(polarizations_, columns_, power).derivatives) return;
    std::string names, last;
    for (const Material& material : document.stack.materials) {
        if (!has_rows(material)) continue;
        const std::string name = material.name.empty() ? "a table" : material.name;
        if (name == last) continue;  // parts of a graded layer
        names += (names.empty() ? "" : ", ") + name;
        last = name;
    }
    if (!names.empty())
        note_(document.file + ": gd, gdd and tod take tabulated indices (" + names +
              ") as straight lines between their rows, and so jump at the rows");
}

std::unique_ptr<QueryResult> SpectrumQuery::new_result() const {
    if (average_) return std::make_unique<AverageResult>(*this);
    return std::make_unique<SpectrumResult>(*this);
}

double SpectrumQuery::cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                              std::optional<double> wavelength_nm) const {
    constexpr double kStack = 2, kRow = 0.2, kOperation = 3e-5, kPlainPoint = 2;
    constexpr double kDelay = 4, kConePoints = 48, kAveragePoints = 10000;
    const StackPower power = stack_power(prepared.document, stack);
    const SpectrumNeeds needs = spectrum_needs(polarizations_, columns_, power);
    const IncidentAngle at = incident_angle(angle_deg);
    std::optional<IndexTable> other;
    const IndexTable& table = wavelength_nm
                                  ? other.emplace(index_table(prepared.document, {*wavelength_nm}))
                                  : static_cast<const SpectrumStack&>(prepared).table;
    const Work work = work_of(power, table, {&at, 1}, needs.power, execution_);
    const bool is_plain = work.kernel == SimdLevel::plain;
    double point = is_plain ? kPlainPoint : kOperation * work.operations_per_point;
    if (needs.delays) point += kDelay * static_cast<double>(power.chain()->blocks[0].down.size());
    if (!cone_.is_none()) point *= kConePoints;
    if (average_) point *= kAveragePoints;
    return kStack + kRow * static_cast<double>(rows_per_angle()) +
           point * static_cast<double>(work.points);
}

std::uint64_t SpectrumQuery::rows() const {
    return std::uint64_t{rows_per_angle()} * angles_deg_.size();
}

double SpectrumQuery::try_share(const schemas::StackDocument& document, const Incidence& incidence,
                                double share) const {
    const std::size_t all = wavelengths_nm_.size();
    if (incidence.wavelength_nm || all == 0 || average_)
        return Query::try_share(document, incidence, share);
    const auto wanted = static_cast<std::size_t>(std::round(share * static_cast<double>(all)));
    const std::size_t count = std::clamp<std::size_t>(wanted, 1, std::min(all, kBlockNumbers));
    std::vector<double> some;
    for (std::size_t i = 0; i < count; ++i)
        some.push_back(wavelengths_nm_[(2 * i + 1) * all / (2 * count)]);
    const SpectrumStack prepared(document, some);
    new_result()->add(prepared, document.stack, incidence);
    return static_cast<double>(count) / static_cast<double>(all);
}

void SpectrumQuery::each_block(const schemas::StackDocument& document,
                               const std::function<void(const tables::Records&)>& take) const {
    constexpr std::size_t kOfCone = 64;  // a cone has many points
    const std::size_t numbers = cone_.is_none() ? kBlockNumbers : kBlockNumbers / kOfCone;
    const std::size_t most = std::max<std::size_t>(1, numbers / layout(document).size());
    if (!average_ && rows_per_angle() > most) return each_part_of_angle(document, most, take);
    const std::size_t angles = angles_deg_.size();
    const std::size_t count =
        std::max<std::size_t>(1, std::min(most, kBlockRows) / rows_per_angle());
    const auto prepared = prepare(document);
    const auto result = new_result();
    for (std::size_t a = 0; a < angles; a += count) {
        const std::vector<double> some = part_of(angles_deg_, a, count);
        result->add(*prepared, document.stack, {some});
        take(result->records());
    }
}

void SpectrumQuery::each_part_of_angle(
    const schemas::StackDocument& document, std::size_t most,
    const std::function<void(const tables::Records&)>& take) const {
    const std::size_t all = wavelengths_nm_.size();
    Witnesses witnesses;
    for (std::size_t w = 0; w < all; w += most) {
        const IndexTable table = index_table(document, part_of(wavelengths_nm_, w, most));
        if (w == 0) note_stack(document, table);
        witnesses.see(table);
    }
    const std::vector<double> others = witnesses.wavelengths_nm(wavelengths_nm_.front());
    // shared by all angles and polarizations, and kept if it fits
    std::vector<std::unique_ptr<const SpectrumStack>> kept((all + most - 1) / most);
    const bool has_room = all * (2 * document.stack.materials.size() + 2) <= kKeptIndices;
    std::unique_ptr<const SpectrumStack> passing;
    const auto prepared = [&](std::size_t w) -> const SpectrumStack& {
        auto& part = has_room ? kept[w / most] : passing;
        if (has_room && part) return *part;
        std::vector<double> some = part_of(wavelengths_nm_, w, most);
        some.insert(some.end(), others.begin(), others.end());
        part = std::make_unique<const SpectrumStack>(document, some);
        return *part;
    };
    std::vector<SpectrumResult> results;
    for (const char polarization : polarizations_)
        results.emplace_back(*this, std::string{polarization});
    for (const double angle_deg : angles_deg_)
        for (SpectrumResult& of_polarization : results)
            for (std::size_t w = 0; w < all; w += most) {
                of_polarization.add(prepared(w), document.stack, {{&angle_deg, 1}});
                tables::Records rows = of_polarization.records();
                cut(rows, std::min(most, all - w));
                take(rows);
            }
}

std::vector<std::string> SpectrumQuery::stats(const PreparedStack& prepared) const {
    const StackPower power = stack_power(prepared.document, prepared.document.stack);
    const Needs needs = spectrum_needs(polarizations_, columns_, power).power;
    const Work work = work_of(power, static_cast<const SpectrumStack&>(prepared).table,
                              incident_angles_of(angles_deg_), needs, execution_);
    return lines_of(work, needs, angles_deg_.size(), why_plain(power, execution_.simd));
}

std::unique_ptr<QueryOptions> SpectrumOptions::add(CLI::App& command) {
    auto options = std::make_unique<SpectrumOptions>();
    command
        .add_option("-w,--wavelengths", options->wavelengths,
                    "vacuum wavelengths, nm or as --unit says, [1, 1e7] nm [380:780:1 nm]")
        ->type_name("LIST");
    add_unit_option(command, options->unit);
    add_angles_option(command, options->angles);
    add_polarizations_option(command, options->polarization);
    command
        .add_option("--columns", options->columns,
                    "additional columns, in the order given:\n"
                    "r_re r_im t_re t_im  amplitudes of the tangential electric\n"
                    "    field, time factor exp(-i w t), so that r_p = r_s at 0 deg\n"
                    "psi_deg delta_deg  ellipsometric angles, r_p/r_s = tan(psi)\n"
                    "    exp(i delta); delta = 0 at 0 deg\n"
                    "delta_nebraska_deg  what instruments print, in [0, 360):\n"
                    "    180 - delta, so that 57.692 is 122.308\n"
                    "N C S depolarization  cos 2psi, sin 2psi cos Delta, sin 2psi\n"
                    "    sin Delta of that Delta; 1 - N^2 - C^2 - S^2\n"
                    "phase_r_deg phase_t_deg  arg r at the first face, arg t from the\n"
                    "    first face to the last; gd_r_fs gd_t_fs gdd_r_fs2 gdd_t_fs2\n"
                    "    tod_r_fs3 tod_t_fs3  derivatives with respect to the angular\n"
                    "    frequency at a fixed angle; no value where r is 0\n"
                    "A_layers  A_1 A_2 ..., absorptance of each layer, at most 1000\n"
                    "    (np.load needs max_header_size=100000 for more than 500)\n"
                    "psi_deg, delta_nebraska_deg, N, C, S and depolarization take any -p\n"
                    "and incoherent layers; they and delta_deg are in the rows of the\n"
                    "first polarization only. All others but A_layers require -p s, p\n"
                    "or s,p and coherent layers")
        ->type_name("NAMES");
    add_cone_options(command, options->cone);
    command
        .add_option("--average", options->average,
                    "instead of rows for wavelengths, R, T and A averaged over the range of\n"
                    "--wavelengths, to 1e-9: flat, photopic (D65 times the 2 degree\n"
                    "luminosity) or a file of rows nm,weight")
        ->type_name("WEIGHT");
    offer(command, "average", "flat photopic", OfferedWords::Use::one_or_file);
    offer(command, "columns", spectrum_column_names, OfferedWords::Use::several);
    return options;
}

std::unique_ptr<const Query> SpectrumOptions::parse(const QueryRun& run) const {
    return std::make_unique<SpectrumQuery>(*this, run);
}

nlohmann::json SpectrumOptions::typed() const {
    return {{"wavelengths", wavelengths},
            {"angles", angles},
            {"polarization", polarization},
            {"columns", columns},
            {"unit", unit},
            {"average", average},
            {"cone", cone.half_angle},
            {"f_number", cone.f_number}};
}

}  // namespace irido::cli
