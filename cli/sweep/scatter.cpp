#include "cli/sweep/scatter.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "cli/options/list.hpp"
#include "cli/options/words.hpp"
#include "core/stack/stack.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/varied_stack.hpp"
#include "schemas/readers/number.hpp"

namespace irido::cli {

namespace {

using nlohmann::json;

constexpr double kMostSamples = 1e9, kLargestSeed = 9007199254740992, kLargestValue = 1e300;
constexpr std::uint64_t kDefaultSamples = 1000, kDefaultSeed = 1;
constexpr std::size_t kMostScattered = 10'000;

constexpr std::array<std::string_view, 4> kLinks{"none", "repeat", "material", "all"};

/// A standard deviation as given on the command line.
struct Sigma {
    double size = 0;
    bool is_relative = false;

    double of(double nominal) const { return is_relative ? size * std::abs(nominal) : size; }
};

/// PATH=SIGMA.
struct ScatteredPath {
    std::string pattern;
    Sigma sigma;
};

ScatteredPath parse_scattered(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError("--scatter: must be PATH=SIGMA, as in layers.*.thickness_nm=2% (got '" +
                         text + "')");
    ScatteredPath result{text.substr(0, equals), {}};
    std::string_view size = schemas::trimmed(std::string_view(text).substr(equals + 1));
    if (size.ends_with('%')) {
        result.sigma.is_relative = true;
        size.remove_suffix(1);
    } else if (size.ends_with("nm") && result.pattern.ends_with("_nm")) {
        size.remove_suffix(2);
    }
    const std::optional<double> number = schemas::parse_number(schemas::trimmed(size));
    if (!number || *number < 0 || *number > kLargestValue)
        throw UsageError("--scatter " + result.pattern +
                         ": SIGMA must be a number from 0 on, in the unit of the value or in "
                         "percent of it, as 2% (got '" +
                         text.substr(equals + 1) + "')");
    result.sigma.size = result.sigma.is_relative ? *number / 100 : *number;
    return result;
}

using SigmaOfPath = std::map<std::string, Sigma>;

std::string joined_path(const std::string& path, const std::string& step) {
    return path.empty() ? step : path + "." + step;
}

/// The values of a document that match a pattern, with their paths.
class Matches {
public:
    Matches(const ScatteredPath& scattered, SigmaOfPath& found)
        : scattered_(scattered), found_(found) {}

    void find(const json& document) { match(document, "", scattered_.pattern, ""); }
    std::size_t count() const { return count_; }

private:
    void match(const json& value, const std::string& path, std::string_view rest,
               std::string_view parent) {
        if (rest.empty()) return take(value, path);
        const std::size_t dot = std::min(rest.find('.'), rest.size());
        const std::string_view step = rest.substr(0, dot);
        const std::string_view behind = rest.substr(std::min(dot + 1, rest.size()));
        if (step == "*") {
            if (value.is_array()) match_all(value, path, rest, behind, parent);
        } else if (value.is_array()) {
            std::size_t index = 0;
            const auto [stop, error] =
                std::from_chars(step.data(), step.data() + step.size(), index);
            if (error == std::errc() && stop == step.data() + step.size() && index < value.size())
                match(value[index], joined_path(path, std::to_string(index)), behind, step);
        } else if (value.is_object() && value.contains(step)) {
            match(value[std::string(step)], joined_path(path, std::string(step)), behind, step);
        }
    }

    /// Every element; for layers, also those of groups.
    void match_all(const json& array, const std::string& path, std::string_view rest,
                   std::string_view behind, std::string_view parent) {
        for (std::size_t i = 0; i < array.size(); ++i) {
            const std::string place = joined_path(path, std::to_string(i));
            match(array[i], place, behind, "*");
            if (parent == "layers" && array[i].is_object() && array[i].contains("layers") &&
                array[i]["layers"].is_array())
                match_all(array[i]["layers"], place + ".layers", rest, behind, parent);
        }
    }

    void take(const json& value, const std::string& path) {
        if (!value.is_number()) {
            if (scattered_.pattern.find('*') != std::string::npos) return;
            throw UsageError("--scatter " + path + ": must name a number");
        }
        ++count_;
        found_[path] = scattered_.sigma;
    }

    const ScatteredPath& scattered_;
    SigmaOfPath& found_;
    std::size_t count_ = 0;
};

/// A scattered value in the document being swept.
struct WrittenValue {
    std::string path;
    std::string original;  ///< its path before groups were expanded
};

/// Expands the groups of layers that have independent errors.
class WrittenOut {
public:
    WrittenOut(const SigmaOfPath& sigmas, bool repetitions_differ)
        : sigmas_(sigmas), repetitions_differ_(repetitions_differ) {}

    std::vector<std::string> groups;  ///< paths of expanded groups

    /// layers    of the document or of a group
    /// original  their path
    /// path      path of the array that they become part of
    /// shift     index of the first one there
    json layers(const json& layers, const std::string& original, const std::string& path,
                std::size_t shift) {
        json result = json::array();
        for (std::size_t i = 0; i < layers.size(); ++i)
            result.push_back(element(layers[i], original + "." + std::to_string(i),
                                     path + "." + std::to_string(shift + i)));
        return result;
    }

    const std::vector<WrittenValue>& values() const { return values_; }

private:
    json element(const json& object, const std::string& original, const std::string& path) {
        if (!object.is_object()) return object;
        for (auto at = sigmas_.lower_bound(original + ".");
             at != sigmas_.end() && at->first.starts_with(original + "."); ++at)
            if (!at->first.starts_with(original + ".layers."))
                add(path + at->first.substr(original.size()), at->first);
        if (!object.contains("layers") || !object["layers"].is_array()) return object;
        json group = object;
        const json& inner = object["layers"];
        const std::uint64_t times = repetitions(object, original);
        if (times > 1) {
            if (std::ranges::find(groups, original) == groups.end()) groups.push_back(original);
            group["repeat"] = 1;
        }
        json written = json::array();
        for (std::uint64_t repetition = 0; repetition < times; ++repetition)
            for (json& layer :
                 layers(inner, original + ".layers", path + ".layers", written.size()))
                written.push_back(std::move(layer));
        group["layers"] = std::move(written);
        return group;
    }

    /// How many times a group is written: once unless its repetitions differ.
    std::uint64_t repetitions(const json& group, const std::string& original) const {
        const auto scattered = sigmas_.lower_bound(original + ".layers.");
        const bool has_scattered =
            scattered != sigmas_.end() && scattered->first.starts_with(original + ".layers.");
        const auto repeat = group.find("repeat");
        if (!repetitions_differ_ || !has_scattered || repeat == group.end() || !repeat->is_number())
            return 1;
        const double times = repeat->get<double>();
        if (!(times >= 1 && times <= static_cast<double>(kMostRepeats))) return 1;  // told later
        if (times > static_cast<double>(kMostScattered)) throw_too_many();
        return static_cast<std::uint64_t>(times);
    }

    void add(std::string path, std::string original) {
        if (values_.size() >= kMostScattered) throw_too_many();
        values_.push_back({std::move(path), std::move(original)});
    }

    [[noreturn]] static void throw_too_many() {
        throw UsageError("--scatter: more than " + std::to_string(kMostScattered) +
                         " layers have errors of their own; --link repeat or --link material "
                         "gives the repetitions of a group the same ones");
    }

    const SigmaOfPath& sigmas_;
    bool repetitions_differ_;
    std::vector<WrittenValue> values_;
};

/// FNV-1a, 64 bits.
std::uint64_t stream_of(std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return hash;
}

/// The value at a path that exists.
const json& value_at(const json& document, std::string_view path) {
    const json* place = &document;
    while (!path.empty()) {
        const std::size_t dot = std::min(path.find('.'), path.size());
        const std::string step(path.substr(0, dot));
        place = place->is_array() ? &(*place)[std::stoul(step)] : &(*place)[step];
        path.remove_prefix(std::min(dot + 1, path.size()));
    }
    return *place;
}

/// The stream of deviates of a value; only thicknesses can be linked.
std::uint64_t stream_of(const WrittenValue& value, const json& document, std::string_view link) {
    if (!schemas::VariedStack::is_thickness(value.path) || link == "none" || link == "repeat")
        return stream_of(value.path);
    if (link == "all") return stream_of("all layers");
    const json& layer = value_at(document, value.path.substr(0, value.path.rfind('.')));
    return stream_of("material " + layer.value("material", json()).dump());
}

std::string parsed_link(const ScatterOptions& options) {
    const std::string link = options.link.empty() ? "none" : options.link;
    if (std::ranges::find(kLinks, link) == kLinks.end())
        throw UsageError("--link: " + not_one_of(kLinks, link));
    return link;
}

std::uint64_t whole_or(std::string_view option, const std::string& text, double lowest,
                       double highest, std::uint64_t otherwise) {
    return text.empty() ? otherwise : parse_whole_number(option, text, lowest, highest);
}

void require_scatter(const ScatterOptions& options) {
    const std::array<std::pair<bool, const char*>, 5> typed{
        {{!options.samples.empty(), "--samples"},
         {!options.seed.empty(), "--seed"},
         {!options.link.empty(), "--link"},
         {options.summary, "--summary"},
         {!options.limits.empty(), "--limit"}}};
    for (const auto& [is_typed, name] : typed)
        if (is_typed) throw UsageError(std::string(name) + ": requires --scatter PATH=SIGMA");
}

/// Refuses varied paths into groups whose layers are renumbered.
void require_outside(const std::vector<std::string>& vary, const std::vector<std::string>& groups) {
    for (const std::string& text : vary) {
        const std::string path = text.substr(0, text.find('='));
        for (const std::string& group : groups)
            if (schemas::is_part_of(path, group))
                throw UsageError("--vary: " + path + " is inside " + group +
                                 ", whose repetitions have errors of their own; --link repeat or "
                                 "--link material keeps the group");
    }
}

SigmaOfPath sigmas_of(const ScatterOptions& options, const json& document) {
    SigmaOfPath sigmas;
    for (const std::string& text : options.paths) {
        const ScatteredPath scattered = parse_scattered(text);
        if (scattered.pattern == kSweptAngle || scattered.pattern == kSweptWavelength)
            throw UsageError("--scatter: " + scattered.pattern + " cannot be scattered");
        Matches matches(scattered, sigmas);
        matches.find(document);
        if (matches.count() == 0)
            throw UsageError("--scatter: " + scattered.pattern +
                             " names no number of the stack, as layers.*.thickness_nm does");
    }
    return sigmas;
}

}  // namespace

std::vector<SweptColumn> scattered_columns(const ScatterOptions& options,
                                           const std::vector<std::string>& vary,
                                           schemas::StackSource& source) {
    if (options.paths.empty()) {
        require_scatter(options);
        return {};
    }
    const std::string link = parsed_link(options);
    ScatteredValue drawn;
    drawn.samples = whole_or("--samples", options.samples, 1, kMostSamples, kDefaultSamples);
    drawn.seed = whole_or("--seed", options.seed, 0, kLargestSeed, kDefaultSeed);
    const SigmaOfPath sigmas = sigmas_of(options, source.document);
    WrittenOut written(sigmas, link == "none");
    std::vector<WrittenValue> values;
    if (source.document.contains("layers") && source.document["layers"].is_array()) {
        source.document["layers"] =
            written.layers(source.document["layers"], "layers", "layers", 0);
        values = written.values();
    }
    for (const auto& [path, sigma] : sigmas)
        if (!path.starts_with("layers.")) values.push_back({path, path});
    require_outside(vary, written.groups);
    SweptColumn sample;
    sample.path = kSweptSample;
    sample.scattered = drawn;
    sample.is_sample = true;
    std::vector<SweptColumn> columns{sample};
    for (const WrittenValue& value : values) {
        SweptColumn column;
        column.path = value.path;
        const bool is_thickness = schemas::VariedStack::is_thickness(value.path);
        column.scattered = drawn;
        column.scattered->lowest = is_thickness ? 0 : -kLargestValue;
        column.scattered->highest = is_thickness ? kLargestThickness_nm : kLargestValue;
        column.scattered->nominal = value_at(source.document, value.path).get<double>();
        column.scattered->sigma = sigmas.at(value.original).of(column.scattered->nominal);
        column.scattered->stream = stream_of(value, source.document, link);
        columns.push_back(std::move(column));
    }
    return columns;
}

void add_scatter_options(CLI::App& command, ScatterOptions& options) {
    command
        .add_option("--scatter", options.paths,
                    "Gaussian errors of a value of the stack, by dotted path: the standard\n"
                    "deviation in percent (layers.*.thickness_nm=2%) or in the value's unit\n"
                    "(layers.0.thickness_nm=1.5); layers.* is every layer, each repetition\n"
                    "of a group with errors of its own. Repeatable; for a path that is named\n"
                    "again, the last one counts. Thicknesses below 0 are set to 0")
        ->type_name("PATH=SIGMA")
        ->allow_extra_args(false);
    command
        .add_option("--samples", options.samples, "number of stacks to draw, in [1, 1e9] [1000]")
        ->type_name("N");
    command
        .add_option("--seed", options.seed,
                    "seed of the draws, whole, in [0, 2^53] [1]; a draw depends on seed,\n"
                    "sample and path alone")
        ->type_name("N");
    command
        .add_option("--link", options.link,
                    "thicknesses with the same errors, in units of their standard\n"
                    "deviation: none, repeat (the repetitions of a group), material (all\n"
                    "layers of a material) or all [none]")
        ->type_name("WORD");
    offer(command, "link", [] { return kLinks; });
    command.add_flag("--summary", options.summary,
                     "instead of rows print quantity, mean, standard deviation and the\n"
                     "percentiles 5, 50, 95 of every column that is a number");
    command
        .add_option("--limit", options.limits,
                    "with --summary, the yield: the share of samples in which every row\n"
                    "has COLUMN<=VALUE (or >=, <, >). Repeatable; the row named yield is\n"
                    "the share that keeps all limits")
        ->type_name("LIMIT")
        ->allow_extra_args(false);
}

}  // namespace irido::cli
