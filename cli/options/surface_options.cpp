#include "cli/options/surface_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "core/nearest.hpp"
#include "core/rough/ggx.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/points_csv.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::cli {

namespace {

constexpr double kGrazing_deg = 90, kWholeTurn_deg = 360, kMostDirections = 1e7;

constexpr std::array<std::string_view, 4> kDirectionColumns{"light_theta_deg", "light_phi_deg",
                                                            "view_theta_deg", "view_phi_deg"};

double& member(Directions& directions, std::size_t column) {
    const std::array<double*, 4> members{&directions.light_theta_deg, &directions.light_phi_deg,
                                         &directions.view_theta_deg, &directions.view_phi_deg};
    return *members[column];
}

std::vector<Directions> directions_of_file(const std::string& path) {
    const std::string file = schemas::shown_path(path);
    const auto columns = schemas::read_points_csv(schemas::read_text(path), file);
    std::vector<Directions> directions;
    std::array<bool, 4> has{};
    for (const schemas::PointsColumn& column : columns) {
        const auto place = std::ranges::find(kDirectionColumns, column.path);
        if (place == kDirectionColumns.end())
            throw schemas::InputError(file, "",
                                      "unknown column " + column.path +
                                          did_you_mean(column.path, {kDirectionColumns.begin(),
                                                                     kDirectionColumns.end()}));
        const auto c = static_cast<std::size_t>(place - kDirectionColumns.begin());
        if (const std::string problem = column.problem_as_numbers(); !problem.empty())
            throw schemas::InputError(file, "", column.path + ": " + problem);
        has[c] = true;
        directions.resize(column.numbers.size());
        const bool is_theta = c % 2 == 0;
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const double lowest = is_theta ? 0 : -kWholeTurn_deg;
            const double highest = is_theta ? kGrazing_deg : kWholeTurn_deg;
            const double value = column.numbers[i];
            if (!(value >= lowest && value <= highest))
                require_in_range(file + ": row " + std::to_string(i + 1) + ": " + column.path,
                                 value, lowest, highest);
            member(directions[i], c) = value;
        }
    }
    for (std::size_t c = 0; c < has.size(); ++c)
        if (!has[c])
            throw schemas::InputError(file, "",
                                      "must have the column " + std::string(kDirectionColumns[c]));
    return directions;
}

}  // namespace

double Directions::azimuth_deg() const {
    const double turn = std::fmod(std::abs(view_phi_deg - light_phi_deg), kWholeTurn_deg);
    return std::min(turn, kWholeTurn_deg - turn);
}

void add_surface_options(CLI::App& command, SurfaceOptions& options) {
    command
        .add_option("SURFACE", options.source.stack,
                    "surface file (.json; see irido validate --schema surface), - for\n"
                    "standard input; or a stack, a file or an expression, with --alpha")
        ->required();
    command
        .add_option("--alpha", options.alpha,
                    "roughness of the facets of a stack, alpha of GGX, [1e-4, 1]")
        ->type_name("ALPHA");
    command
        .add_option("--set", options.source.set,
                    "override a value of the document by dotted path; repeatable:\n"
                    "--set layers.0.alpha=0.2 --set base.albedo=0.5")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
    command
        .add_option("--material", options.source.media,
                    "name a medium of a stack; repeatable: --material H=2.35")
        ->type_name("NAME=MATERIAL")
        ->allow_extra_args(false);
}

void add_table_paths_options(CLI::App& command, std::string& paths, std::string& transmission) {
    command
        .add_option("--paths", paths,
                    "single: light reflected once; all: as often as it may be, of one layer at\n"
                    "most [single]")
        ->type_name("PATHS");
    offer(command, "paths", "single all");
    command
        .add_option("--transmission", transmission, "single or multiple, as of irido brdf [single]")
        ->type_name("CROSSINGS");
    offer(command, "transmission", "single multiple");
}

schemas::SurfaceDocument read_noted_surface(const SurfaceOptions& options, bool quiet) {
    schemas::SurfaceRequest request{options.source, {}, options.takes_stacks};
    if (!options.alpha.empty())
        request.alpha = parse_one_number("--alpha", options.alpha, kSmoothest, kRoughest);
    schemas::SurfaceDocument document = schemas::read_surface(request);
    for (const std::string& text : document.notes) note(text, quiet);
    return document;
}

std::string title_of(const schemas::SurfaceDocument& document, const SurfaceOptions& options) {
    if (!document.name.empty()) return document.name;
    if (options.source.stack == "-") return "";
    const bool is_file = options.source.stack.find('|') == std::string::npos;
    return is_file ? std::filesystem::path(options.source.stack).filename().string()
                   : title_of(options.source);
}

void add_direction_options(CLI::App& command, DirectionOptions& options) {
    command
        .add_option("--light-theta", options.light_theta,
                    "polar angles of the light, degrees from the normal, [0, 90] [0]")
        ->type_name("LIST");
    command
        .add_option("--light-phi", options.light_phi,
                    "azimuths of the light, degrees, [-360, 360] [0]")
        ->type_name("LIST");
    command
        .add_option("--view-theta", options.view_theta,
                    "polar angles of the view, degrees from the normal, [0, 90] [0]")
        ->type_name("LIST");
    command
        .add_option("--view-phi", options.view_phi,
                    "azimuths of the view, degrees, [-360, 360]: 180 from the light's is the\n"
                    "mirror's side [180]")
        ->type_name("LIST");
    command
        .add_option("--directions", options.file,
                    "a CSV file of directions instead, with the columns light_theta_deg,\n"
                    "light_phi_deg,view_theta_deg,view_phi_deg")
        ->type_name("FILE");
}

std::vector<Directions> parse_directions(const DirectionOptions& options) {
    if (!options.file.empty()) return directions_of_file(options.file);
    const auto thetas = [](const char* name, const std::string& text) {
        return parse_list(name, text, 0, kGrazing_deg);
    };
    const auto phis = [](const char* name, const std::string& text) {
        return parse_list(name, text, -kWholeTurn_deg, kWholeTurn_deg);
    };
    const std::vector<double> light_theta = thetas("--light-theta", options.light_theta);
    const std::vector<double> light_phi = phis("--light-phi", options.light_phi);
    const std::vector<double> view_theta = thetas("--view-theta", options.view_theta);
    const std::vector<double> view_phi = phis("--view-phi", options.view_phi);
    double count = 1;
    for (const auto* list : {&light_theta, &light_phi, &view_theta, &view_phi})
        count *= static_cast<double>(list->size());
    if (count > kMostDirections)
        throw UsageError("directions: must be at most 1e7 combinations (got " + to_text(count) +
                         ")");
    std::vector<Directions> directions;
    directions.reserve(static_cast<std::size_t>(count));
    for (const double lt : light_theta)
        for (const double lp : light_phi)
            for (const double vt : view_theta)
                for (const double vp : view_phi) directions.push_back({lt, lp, vt, vp});
    return directions;
}

std::vector<double> parse_light_thetas(const DirectionOptions& options) {
    if (!options.file.empty())
        throw UsageError(
            "--directions: requires --quantity brdf; other quantities depend on --light-theta "
            "alone");
    return parse_list("--light-theta", options.light_theta, 0, kGrazing_deg);
}

}  // namespace irido::cli
