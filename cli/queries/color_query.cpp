#include "cli/queries/color_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/queries/color_cone.hpp"
#include "core/coherent/coherent.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/quadrature/optical_path.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/utf8.hpp"

namespace irido::cli {

namespace {

/// Size of the cache of all structures, in numbers: 256 MB.
constexpr std::size_t kKeptNumbers = 1U << 25;

/// x, y of a colour, or of the white if there is no light.
std::array<double, 2> chromaticity(const Triple& xyz, const Triple& white) {
    const Triple& shown = xyz[0] + xyz[1] + xyz[2] > 0 ? xyz : white;
    const double sum = shown[0] + shown[1] + shown[2];
    return {shown[0] / sum, shown[1] / sum};
}

struct ColorStack : PreparedStack {
    using PreparedStack::PreparedStack;

    std::vector<std::unique_ptr<ColorAlgorithm>> algorithms;  ///< one per illumination, or for a
                                                              ///< cone, per cone_requests()

    std::vector<const ColorAlgorithm*> of_illumination(std::size_t i, std::size_t count) const {
        std::vector<const ColorAlgorithm*> some;
        for (std::size_t a = 0; a < count; ++a) some.push_back(algorithms[i * count + a].get());
        return some;
    }
};

/// Columns to which rows are appended.
struct ColorRows {
    std::array<tables::Column::Numbers, 9> numbers;  ///< angle, X Y Z, x y, r g b
    tables::Column::CodedTexts side;
    tables::Column::Texts hexes;
    tables::Column::Flags gamut;
    tables::Column::Texts method;
    tables::Column::Numbers evaluations, error;
    std::vector<tables::Column::Numbers> columns;  ///< those of --columns
    tables::Column::CodedTexts illuminant;
    tables::Column::Numbers delta_e;

    void reserve(std::size_t rows) {
        for (tables::Column::Numbers& column : numbers) column.reserve(rows);
        hexes.reserve(rows);
        gamut.reserve(rows);
        side.codes.reserve(rows);
    }

    void add(const Illumination& illumination, const RgbSpace& space, double angle_deg,
             const Triple& xyz) {
        const auto [x, y] = chromaticity(xyz, illumination.white());
        const Triple rgb = illumination.transform(xyz);
        const std::array row{angle_deg, xyz[0], xyz[1], xyz[2], x, y, rgb[0], rgb[1], rgb[2]};
        for (std::size_t c = 0; c < row.size(); ++c) numbers[c].push_back(row[c]);
        hexes.push_back(hex(space, rgb));
        gamut.push_back(in_gamut(rgb));
    }
};

/// Whether a method's colours meet any tolerance requested.
bool is_untruncated(const ColorMethod& method) {
    return method.kind->use == MethodUse::exact && method.count == 0;
}

/// The incident medium's index at every nm that contributes.
IndexTable incident_table(const Stack& stack, WavelengthRange support) {
    Material medium = stack.materials[stack.incident];
    medium.outside = Outside::clamp;
    std::vector<double> wavelengths;
    for (double nm = support.first_nm; nm <= support.last_nm; ++nm) wavelengths.push_back(nm);
    return {Stack{{medium}, 0, {}, 0}, wavelengths};
}

}  // namespace

RgbTransform rgb_transform(const RgbSpace& space, const Triple& white, Adaptation adaptation) {
    try {
        return {space, white, adaptation};
    } catch (const DomainError& error) {
        throw UsageError("--illuminant: " + std::string(error.what()) + "; use --adaptation none");
    }
}

Illumination::Illumination(std::string named, Sensitivity sensitivity, const RgbSpace& space,
                           Adaptation adaptation)
    : name(std::move(named)),
      tables(std::move(sensitivity)),
      transform(rgb_transform(space, white(), adaptation)) {}

class ColorResult : public QueryResult {
public:
    explicit ColorResult(const ColorQuery& query) : query_(query) {}

    std::size_t add(const PreparedStack& prepared, const Stack& stack,
                    const Incidence& incidence) override {
        stacks_.push_back(query_.colors(prepared, stack, incidence.angles_deg));
        return incidence.angles_deg.size() * query_.rows_per_angle();
    }

    tables::Records records() override { return query_.records(std::exchange(stacks_, {})); }

private:
    const ColorQuery& query_;
    std::vector<StackColors> stacks_;
};

ColorQuery::ColorQuery(const ColorQueryOptions& typed, const QueryRun& run)
    : angles_deg_(parse_list("--angles", typed.angles, 0, kLargestAngle_deg)),
      illuminant_(parse_illuminant(typed.color.illuminant)),
      method_(parse_method(typed.color)),
      held_to_tolerance_(!typed.color.tolerance.empty()),
      tolerance_(parse_tolerance(typed.color.tolerance)),
      space_(&parse_space(typed.color.space)),
      stats_(typed.stats),
      strict_(typed.color.strict),
      run_(run) {
    const Adaptation adaptation = parse_adaptation(typed.color.adaptation);
    request_.sides = parse_sides(typed.color.sides);
    cone_ = parse_cone(typed.cone, angles_deg_);
    if (!cone_.is_none() && method_.kind->use != MethodUse::exact)
        throw UsageError("--cone and --f-number require an exact --method");
    request_.light = parse_light(typed.color.polarization);
    request_.tolerance = tolerance_;
    request_.colors = static_cast<std::size_t>(
        std::min(1e15, run.stacks * static_cast<double>(angles_deg_.size())));
    request_.varied = run.varied;
    request_.kept_numbers =
        std::min(request_.kept_numbers, kKeptNumbers / std::max<std::size_t>(1, run.structures));
    request_.simd = run.execution.simd;
    const Observer& eye = parse_observer(typed.color.observer);
    const std::string first = schemas::well_formed(typed.color.illuminant);  // may be a file name
    illuminations_.push_back(
        std::make_unique<Illumination>(first, Sensitivity(eye, illuminant_), *space_, adaptation));
    if (typed.compare)
        for (const std::string_view name : illuminant_names())
            if (name != first)
                illuminations_.push_back(std::make_unique<Illumination>(
                    std::string(name), Sensitivity(eye, illuminant(name)), *space_, adaptation));
    prepare_columns(typed);
}

/// Exact methods compute X, Y, Z to the accuracy that Lab and the differences need.
void ColorQuery::prepare_columns(const ColorQueryOptions& typed) {
    const bool has_target = !typed.target.empty();
    if (has_target && typed.compare)
        throw UsageError("--target: cannot be combined with --compare-illuminants");
    columns_ = parse_color_columns(typed.columns, has_target);
    if (columns_.empty()) return;
    std::optional<ColorTarget> target;
    if (has_target) target.emplace(typed.target, *space_);
    for (const auto& illumination : illuminations_) {
        const Triple& white = illumination->white();
        try {
            lab(white, white);
        } catch (const DomainError& error) {
            throw UsageError("--columns: " + std::string(error.what()) + " under " +
                             illumination->name);
        }
        ColorView view{parse_observer(typed.color.observer),
                       typed.color.observer == "2" ? 2 : 10,
                       white,
                       illumination->name == "D65",
                       {}};
        if (target) view.target = target->lab(illumination->transform, white);
        views_.push_back(view);
        if (is_untruncated(method_))
            request_.tolerance = std::clamp(xyz_tolerance(white, kColorColumnError),
                                            kSmallestTolerance, request_.tolerance);
        const auto named = [&](ColorColumn column) {
            return std::ranges::find(columns_, column) != columns_.end();
        };
        if (!view.has_whiteness &&
            (named(ColorColumn::whiteness_cie) || named(ColorColumn::tint_cie)))
            run_.note(
                "--columns: whiteness_cie and tint_cie are defined for D65; they have no "
                "value under " +
                illumination->name);
    }
}

tables::RecordLayout ColorQuery::layout(const schemas::StackDocument&) const {
    using enum tables::RecordField::Type;
    constexpr std::size_t hex_width = 7, longest_method = 24;
    tables::RecordLayout layout{{"angle_deg"}, {"side", text, 1}};
    for (const char* name : {"X", "Y", "Z", "x", "y", "r", "g", "b"}) layout.push_back({name});
    layout.push_back({"hex", text, hex_width});
    layout.push_back({"in_gamut", flag});
    for (const ColorColumn column : columns_) layout.push_back({name_of(column)});
    if (stats_) {
        layout.push_back({"method", text, longest_method});
        layout.push_back({"evaluations"});
        layout.push_back({"error_estimate"});
    }
    if (illuminations_.size() == 1) return layout;
    std::size_t longest = 1;
    for (const auto& illumination : illuminations_)
        longest = std::max(longest, illumination->name.size());
    layout.push_back({"illuminant", text, longest});
    layout.push_back({"delta_e_2000"});
    return layout;
}

tables::RowPlot ColorQuery::plot(const tables::Records& rows, tables::GamutMapping gamut) const {
    tables::RowPlot plot;
    for (const char* name : {"angle_deg", "side", "illuminant"})
        if (std::ranges::find(rows.columns, name, &tables::Column::name) != rows.columns.end())
            plot.keys.push_back({name, tables::axis_of_column(name)});
    std::map<std::string, RgbTransform> transforms;
    for (const auto& illumination : illuminations_)
        transforms.emplace(
            illumination->name,
            RgbTransform(rgb_space("srgb"), illumination->white(), Adaptation::bradford));
    std::array<std::vector<double>, 3> xyz;
    for (std::size_t i = 0; i < 3; ++i)
        xyz[i] = tables::column_numbers(rows, std::string(1, "XYZ"[i]));
    const std::vector<std::string> under =
        illuminations_.size() == 1 ? std::vector(rows.rows(), illuminations_.front()->name)
                                   : tables::column_texts(rows, "illuminant");
    tables::InkMixer mixer(gamut);
    for (std::size_t row = 0; row < rows.rows(); ++row)
        plot.inks.push_back(
            mixer(transforms.at(under[row])({xyz[0][row], xyz[1][row], xyz[2][row]})));
    if (std::string share = mixer.note(); !share.empty()) plot.notes.push_back(std::move(share));
    return plot;
}

nlohmann::json ColorQuery::data() const {
    return {illuminant_.wavelength_nm, illuminant_.value};
}

std::unique_ptr<const PreparedStack> ColorQuery::prepare(schemas::StackDocument document) const {
    report_held_ranges(document, illuminations_.front()->tables.sensitivity(), strict_, run_.note);
    const std::string file = document.file;
    try {
        const WavelengthRange support = illuminations_.front()->tables.sensitivity().support();
        note_incident(document, incident_table(document.stack, support), run_.note);
        auto prepared = std::make_unique<ColorStack>(std::move(document));
        for (const auto& illumination : illuminations_) {
            if (!cone_.is_none()) {
                for (const ColorRequest& request : cone_requests(request_))
                    prepared->algorithms.push_back(color_algorithm(
                        illumination->tables, prepared->document.stack, method_, request));
                continue;
            }
            prepared->algorithms.push_back(
                color_algorithm(illumination->tables, prepared->document.stack, method_, request_));
        }
        return prepared;
    } catch (const DomainError& error) {
        throw schemas::InputError(file, "", error.what());
    }
}

std::unique_ptr<QueryResult> ColorQuery::new_result() const {
    return std::make_unique<ColorResult>(*this);
}

double ColorQuery::cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                           std::optional<double>) const {
    constexpr double kColor = 1, kLayer = 0.012, kPathWavelength_nm = 500, kConeAngles = 48;
    const Sensitivity& sensitivity = illuminations_.front()->tables.sensitivity();
    const Stack& model = prepared.document.stack;
    const IndexTable indices(held_stack(model, sensitivity), {kPathWavelength_nm});
    const std::size_t pieces = smooth_pieces(model, sensitivity.support()).size() - 1;
    return static_cast<double>(illuminations_.size()) * (cone_.is_none() ? 1 : kConeAngles) *
           (kColor + kLayer * quadrature_work(stack, indices, pieces, incident_angle(angle_deg)));
}

double ColorQuery::try_share(const schemas::StackDocument& document, const Incidence& incidence,
                             double share) const {
    constexpr double kUsualWavelengths = 1000;  // per colour; --stats prints the number
    const ColorTables& tables = illuminations_.front()->tables;
    const auto illuminations = static_cast<double>(illuminations_.size());
    const StackPower power(document.stack);
    if (power.spread_layers() == 0 && share < 1)
        return std::numeric_limits<double>::infinity();  // a part costs as much as the whole
    if (share >= 1) {
        const auto algorithm = color_algorithm(tables, document.stack, method_, request_);
        stack_color(*algorithm, document.stack, sides().size(), incidence.angles_deg, 1);
        return 1 / illuminations;
    }
    std::vector<IncidentAngle> angles;
    for (const double angle_deg : incidence.angles_deg) angles.push_back(incident_angle(angle_deg));
    const double count = std::max(1.0, std::round(share * kUsualWavelengths));
    const WavelengthRange all = tables.sensitivity().support();
    std::vector<double> wavelengths_nm;
    for (double i = 0; i < count; ++i)
        wavelengths_nm.push_back(all.first_nm + (i + 0.5) / count * (all.last_nm - all.first_nm));
    const IndexTable indices(held_stack(document.stack, tables.sensitivity()), wavelengths_nm);
    spectra(power, indices, angles, needs_of(request_), {1, request_.simd});
    return count / kUsualWavelengths / illuminations;
}

StackColors ColorQuery::colors(const PreparedStack& prepared, const Stack& stack,
                               std::span<const double> angles_deg) const {
    const auto& ready = static_cast<const ColorStack&>(prepared);
    const auto& algorithms = ready.algorithms;
    const unsigned threads = run_.execution.threads;
    StackColors result{{angles_deg.begin(), angles_deg.end()}, {}};
    bool approximate = method_.count > 0;
    try {
        for (std::size_t i = 0; i < illuminations_.size(); ++i) {
            if (!cone_.is_none()) {
                result.colors.push_back(
                    cone_colors(ready.of_illumination(i, algorithms.size() / illuminations_.size()),
                                stack, request_, angles_deg, cone_, threads));
                continue;
            }
            result.colors.push_back(
                stack_color(*algorithms[i], stack, sides().size(), angles_deg, threads));
            if (run_.is_silent && !stats_ && !held_to_tolerance_) continue;
            approximate |= measure_errors(illuminations_[i]->tables, stack, request_, angles_deg,
                                          threads, result.colors.back());
        }
    } catch (const DomainError& error) {
        throw schemas::InputError(prepared.document.file, "", error.what());
    }
    check_errors(prepared.document, result, approximate);
    check_columns(prepared.document, result);
    return result;
}

/// Approximate methods have no tolerance unless one is given: a note reports errors above the
/// default tolerance.
void ColorQuery::check_errors(const schemas::StackDocument& document, const StackColors& colors,
                              bool approximate) const {
    for (const std::vector<StackColor>& lit : colors.colors) {
        const auto worst = std::ranges::max_element(lit, {}, &StackColor::error);
        if (worst->error <= tolerance_) continue;
        if (!held_to_tolerance_ && (approximate || !std::isfinite(worst->error))) {
            if (run_.is_silent) continue;
            std::array<char, 32> text{};
            std::snprintf(text.data(), text.size(), "%.2g", worst->error);
            run_.note(document.file + ": " + name_of(method_) + ": error up to " + text.data() +
                      " in X, Y, Z for this stack");
            continue;
        }
        const auto i = static_cast<std::size_t>(worst - lit.begin());
        const Triple& xyz = worst->xyz;
        throw ToleranceError(
            document.file + ": the tolerance " + to_text(tolerance_) + " cannot be met; at " +
            to_text(colors.angles_deg[i / sides().size()]) + " degrees, side " +
            std::string(letter(sides()[i % sides().size()])) +
            ", the best value is X, Y, Z = " + to_text(xyz[0]) + ", " + to_text(xyz[1]) + ", " +
            to_text(xyz[2]) + " with an error of " + to_text(worst->error));
    }
}

/// Colours that miss the tolerance needed for the darkest ones may still be accurate enough.
void ColorQuery::check_columns(const schemas::StackDocument& document,
                               const StackColors& colors) const {
    if (!is_untruncated(method_)) return;
    for (std::size_t l = 0; l < views_.size(); ++l)
        for (std::size_t i = 0; i < colors.colors[l].size(); ++i) {
            const StackColor& color = colors.colors[l][i];
            const double error = lab_error(color.xyz, views_[l].white, color.error);
            if (error > kColorColumnError)
                throw ToleranceError(document.file + ": --columns: L, a, b cannot be found to " +
                                     to_text(kColorColumnError) + " at " +
                                     to_text(colors.angles_deg[i / sides().size()]) +
                                     " degrees, side " +
                                     std::string(letter(sides()[i % sides().size()])));
        }
}

tables::Records ColorQuery::records(const std::vector<StackColors>& stacks) const {
    ColorRows rows;
    for (const Side side : sides()) rows.side.values.emplace_back(letter(side));
    for (const auto& illumination : illuminations_)
        rows.illuminant.values.push_back(illumination->name);
    std::size_t count = 0;
    for (const StackColors& stack : stacks) count += stack.angles_deg.size() * rows_per_angle();
    rows.reserve(count);
    rows.columns.resize(columns_.size());
    for (const StackColors& stack : stacks) {
        for (std::uint32_t l = 0; l < illuminations_.size(); ++l) {
            const Illumination& illumination = *illuminations_[l];
            for (std::size_t i = 0; i < stack.colors[l].size(); ++i) {
                const StackColor& color = stack.colors[l][i];
                rows.add(illumination, *space_, stack.angles_deg[i / sides().size()], color.xyz);
                rows.side.codes.push_back(static_cast<std::uint32_t>(i % sides().size()));
                for (std::size_t c = 0; c < columns_.size(); ++c)
                    rows.columns[c].push_back(
                        color_column_value(columns_[c], color.xyz, views_[l]));
                if (stats_) {
                    rows.method.push_back(method_.count == 0 ? std::string(color.method)
                                                             : name_of(method_));
                    rows.evaluations.push_back(static_cast<double>(color.evaluations));
                    rows.error.push_back(color.error);
                }
                if (illuminations_.size() == 1) continue;
                rows.illuminant.codes.push_back(l);
                rows.delta_e.push_back(
                    ciede2000(lab(color.xyz, illumination.white()),
                              lab(stack.colors[0][i].xyz, illuminations_[0]->white())));
            }
        }
    }
    tables::Records records{
        {{"angle_deg", std::move(rows.numbers[0])}, {"side", std::move(rows.side)}}};
    constexpr std::array names{"X", "Y", "Z", "x", "y", "r", "g", "b"};
    for (std::size_t c = 0; c < names.size(); ++c)
        records.columns.push_back({names[c], std::move(rows.numbers[c + 1])});
    records.columns.push_back({"hex", std::move(rows.hexes)});
    records.columns.push_back({"in_gamut", std::move(rows.gamut)});
    for (std::size_t c = 0; c < columns_.size(); ++c)
        records.columns.push_back({name_of(columns_[c]), std::move(rows.columns[c])});
    if (stats_) {
        records.columns.push_back({"method", std::move(rows.method)});
        records.columns.push_back({"evaluations", std::move(rows.evaluations)});
        records.columns.push_back({"error_estimate", std::move(rows.error)});
    }
    if (illuminations_.size() == 1) return records;
    records.columns.push_back({"illuminant", std::move(rows.illuminant)});
    records.columns.push_back({"delta_e_2000", std::move(rows.delta_e)});
    return records;
}

std::unique_ptr<QueryOptions> ColorQueryOptions::add(CLI::App& command) {
    auto options = std::make_unique<ColorQueryOptions>();
    add_angles_option(command, options->angles);
    add_color_options(command, options->color);
    add_cone_options(command, options->cone);
    command
        .add_option("--columns", options->columns,
                    "additional columns, in the order given, to 1e-4 whatever --tolerance:\n"
                    "L a b C_ab h_ab_deg  CIELAB under the illuminant's white, chroma, hue\n"
                    "u v C_uv h_uv_deg  u*, v* of CIELUV, chroma, hue\n"
                    "dominant_nm excitation_purity  dominant wavelength, or minus the\n"
                    "    complementary one; no value for the white itself\n"
                    "whiteness_cie tint_cie  under D65 only\n"
                    "delta_e_76 delta_e_2000 delta_e_cmc_2_1 delta_e_cmc_1_1  from\n"
                    "    --target, which is the standard of CMC(l:c)")
        ->type_name("NAMES");
    offer(command, "columns", color_column_names, OfferedWords::Use::several);
    command
        .add_option("--target", options->target,
                    "a colour to compare with: #rrggbb in the encoding of --space, or\n"
                    "CIELAB L,a,b; adds the four delta_e unless --columns names some")
        ->type_name("COLOR");
    command.add_flag("--compare-illuminants", options->compare,
                     "also compute every other named illuminant; adds columns\n"
                     "illuminant,delta_e_2000 (CIEDE2000 to the first one)");
    command.add_flag("--stats", options->stats,
                     "add columns method,evaluations,error_estimate; the error of\n"
                     "approximate methods is measured against quadrature");
    add_strict_option(command, options->color.strict);
    return options;
}

std::unique_ptr<const Query> ColorQueryOptions::parse(const QueryRun& run) const {
    return std::make_unique<ColorQuery>(*this, run);
}

nlohmann::json ColorQueryOptions::typed() const {
    return {{"angles", angles},
            {"side", color.sides},
            {"polarization", color.polarization},
            {"illuminant", color.illuminant},
            {"observer", color.observer},
            {"space", color.space},
            {"adaptation", color.adaptation},
            {"method", color.method},
            {"subdivide", color.subdivide},
            {"harmonics", color.harmonics},
            {"base_color", color.base_color},
            {"tolerance", color.tolerance},
            {"cone", cone.half_angle},
            {"f_number", cone.f_number},
            {"columns", columns},
            {"target", target},
            {"compare", compare},
            {"stats", stats},
            {"strict", color.strict}};
}

}  // namespace irido::cli
