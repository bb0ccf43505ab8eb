#include "cli/options/scratch_options.hpp"

#include <array>

#include "core/error.hpp"

namespace irido::cli {

namespace {

constexpr std::array<std::string_view, 2> kFootprintShapes{"ellipse", "gaussian"};
constexpr std::array<std::string_view, 3> kScratchEnergies{"balanced", "blend", "none"};
constexpr int kMostLightPoints = 64;
constexpr std::string_view kGauss = "gauss/";

/// Parses "v1,v2,..." into `count` numbers.
std::vector<double> parse_parts(const char* option, const std::string& text, std::size_t count,
                                const std::string& form) {
    const std::vector<std::string_view> parts = comma_separated(text);
    if (parts.size() != count)
        throw UsageError(std::string(option) + ": must be " + form + " (got '" + text + "')");
    std::vector<double> numbers;
    for (const std::string_view part : parts)
        numbers.push_back(parse_one_number(option, std::string(part), -Scratch::kLongest_um,
                                           Scratch::kLongest_um));
    return numbers;
}

}  // namespace

std::string ScratchOptions::typed() const {
    if (!at.empty()) return "--at";
    if (!footprint.empty()) return "--footprint";
    if (!footprint_shape.empty()) return "--footprint-shape";
    if (!area_light.empty()) return "--area-light";
    if (!light_integral.empty()) return "--light-integral";
    if (!energy.empty()) return "--energy";
    return coherent ? "--coherent" : ensemble ? "--ensemble" : "";
}

void add_scratch_options(CLI::App& command, ScratchOptions& options) {
    command.add_option("--at", options.at, "scratches: where the surface is seen, um [0,0]")
        ->type_name("X,Y");
    command
        .add_option("--footprint", options.footprint,
                    "scratches: the mean over an ellipse around --at instead of a point:\n"
                    "semi-axes in um, the first one's angle from x in degrees")
        ->type_name("A1,A2,ANGLE");
    command
        .add_option("--footprint-shape", options.footprint_shape,
                    "ellipse, evenly weighted, or gaussian, whose deviations are A1 and A2\n"
                    "[ellipse]")
        ->type_name("SHAPE");
    offer(command, "footprint-shape", "ellipse gaussian");
    command.add_flag("--coherent", options.coherent,
                     "scratches: waves of all scratches add, not their powers");
    command.add_flag("--ensemble", options.ensemble,
                     "scratches: the mean over all places of the fields, as endless scratches");
    command
        .add_option("--area-light", options.area_light,
                    "scratches: a light instead of --light-theta, --light-phi: a file or JSON,\n"
                    "{\"center_mm\": [x, y, z], \"radius_mm\": r} or {\"vertices_mm\": [...]},\n"
                    "relative to the shaded point, z the normal, or an array of them; rows are\n"
                    "outgoing radiance over the light's")
        ->type_name("LIGHT");
    command
        .add_option("--light-integral", options.light_integral,
                    "exact: along the scratch to 1e-8; gauss/N: N points in [1, 64], weighted\n"
                    "by the lobe; band: only directions that a scratch reflects as a mirror\n"
                    "[exact]")
        ->type_name("METHOD");
    offer(command, "light-integral", "exact band gauss/4 gauss/8");
    command
        .add_option("--energy", options.energy,
                    "scratches and their base: balanced: all light is kept; blend: as VWH18\n"
                    "has it, off by up to half; none: neither knows of the other [balanced]")
        ->type_name("RULE");
    offer(command, "energy", "balanced blend none");
}

SurfacePoint parse_at(const ScratchOptions& options) {
    if (options.at.empty()) return {};
    const std::vector<double> place = parse_parts("--at", options.at, 2, "X,Y in um");
    return {place[0], place[1]};
}

std::optional<Footprint> parse_footprint(const ScratchOptions& options) {
    Footprint footprint;
    if (!options.footprint_shape.empty()) {
        if (options.footprint.empty()) throw UsageError("--footprint-shape: requires --footprint");
        if (options.footprint_shape == kFootprintShapes[1])
            footprint.kind = Footprint::Kind::gaussian;
        else if (options.footprint_shape != kFootprintShapes[0])
            throw UsageError("--footprint-shape: " +
                             not_one_of(kFootprintShapes, options.footprint_shape));
    }
    if (options.footprint.empty()) return std::nullopt;
    const std::vector<double> numbers =
        parse_parts("--footprint", options.footprint, 3, "A1,A2,ANGLE in um and degrees");
    footprint.center = parse_at(options);
    footprint.a1_um = numbers[0];
    footprint.a2_um = numbers[1];
    footprint.angle_deg = numbers[2];
    try {
        require_valid(footprint);
    } catch (const DomainError& error) {
        throw UsageError(std::string("--footprint: ") + error.what());
    }
    return footprint;
}

ScratchSum parse_scratch_sum(const ScratchOptions& options) {
    if (options.coherent && options.ensemble)
        throw UsageError("--coherent: cannot be combined with --ensemble");
    ScratchSum sum;
    if (options.coherent) sum.kind = ScratchSum::Kind::coherent;
    if (options.ensemble) sum.kind = ScratchSum::Kind::ensemble;
    if (options.energy == kScratchEnergies[1])
        sum.energy = ScratchEnergy::blend;
    else if (options.energy == kScratchEnergies[2])
        sum.energy = ScratchEnergy::none;
    else if (!options.energy.empty() && options.energy != kScratchEnergies[0])
        throw UsageError("--energy: " + not_one_of(kScratchEnergies, options.energy));
    return sum;
}

LightIntegral parse_light_integral(const ScratchOptions& options) {
    const std::string& text = options.light_integral;
    if (!text.empty() && options.area_light.empty())
        throw UsageError("--light-integral: requires --area-light");
    if (text.empty() || text == "exact") return {};
    if (text == "band") return {LightIntegral::Kind::band};
    if (text.starts_with(kGauss))
        return {LightIntegral::Kind::points,
                static_cast<int>(parse_whole_number("--light-integral", text.substr(kGauss.size()),
                                                    1, kMostLightPoints))};
    constexpr std::array<std::string_view, 3> names{"exact", "gauss/N", "band"};
    throw UsageError("--light-integral: " + not_one_of(names, text));
}

}  // namespace irido::cli
