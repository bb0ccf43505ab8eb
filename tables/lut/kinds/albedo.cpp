#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/rough/albedo.hpp"
#include "core/rough/ggx.hpp"
#include "tables/lut/color_values.hpp"
#include "tables/lut/kind_parts.hpp"

namespace irido::tables {

namespace {

constexpr double kWorstError = 1e-4;  ///< of X, Y, Z

/// The state of the table's function.
struct Source {
    ColorTables tables;
    ColorValues values;
    RoughAlbedo albedo;

    explicit Source(const LutRequest& request)
        : tables(*request.sensitivity),
          values(request),
          albedo(tables, request.document.stack, request.color, request.execution.threads) {}
};

void require_albedo(const LutRequest& request) {
    if (!request.vary.empty())
        throw DomainError("albedo has no varied value (got '" + request.vary.front().path + "')");
    for (const Side side : request.color.sides)
        if (side != Side::reflected) throw DomainError("side must be R for albedo (got T)");
}

LutPlan::Evaluate function_of(const LutRequest& request) {
    const auto source = std::make_shared<const Source>(request);
    return [source](const std::vector<LutAxis>& axes) {
        const std::size_t alphas = axes[1].count();
        std::vector<double> values(axes[0].count() * alphas * 3);
        for (std::size_t a = 0; a < alphas; ++a) {
            const std::vector<RoughAlbedo::Value> column =
                source->albedo(axes[1].values[a], axes[0].values);
            for (std::size_t i = 0; i < column.size(); ++i) {
                if (!(column[i].error <= kWorstError))
                    throw DomainError("the albedo at cos_theta " + to_text(axes[0].values[i]) +
                                      " has error " + to_text(column[i].error) +
                                      ", tables require " + to_text(kWorstError));
                const Triple rgb = source->values(column[i].xyz);
                for (std::size_t c = 0; c < 3; ++c) values[(i * alphas + a) * 3 + c] = rgb[c];
            }
        }
        return values;
    };
}

LutPlan plan(const LutRequest& request) {
    require_albedo(request);
    constexpr std::size_t kCount = 32;
    LutPlan plan;
    plan.axes.push_back(
        listed_axis(request, "cos-theta", {"cos_theta", "", equally_spaced(0, 1, kCount)}));
    plan.axes.push_back(listed_axis(request, "alpha", {"alpha", "", equally_spaced(0, 1, kCount)}));
    for (const double value : plan.axes[0].axis.values) require_in_range("cos_theta", value, 0, 1);
    for (const double value : plan.axes[1].axis.values)
        if (value != 0) require_in_range("alpha", value, kSmoothest, kRoughest);
    plan.channels = color_channels(request);
    plan.evaluate = function_of(request);
    plan.roughly = [request](double error) { return function_of(rougher(request, error)); };
    plan.measure = color_measure(request);
    plan.facts = color_facts(request);
    return plan;
}

/// The luminance must be in [0, 1], but for adaptation and rounding.
std::vector<std::string> problems(const Lut& lut) {
    constexpr double kSlack = 0.02;
    constexpr std::size_t kMostLines = 5;
    std::vector<std::string> lines;
    if (lut.channels.size() != 3) return {"albedo must have three channels"};
    Triple luminance{0, 1, 0};
    if (lut.channels.front() == "R") {
        const auto space = lut.facts.find("color_space");
        const bool is_named = space != lut.facts.end() && space->is_string();
        luminance = xyz_from_rgb(rgb_space(is_named ? space->get<std::string>() : "srgb"))[1];
    }
    const double most = lut.facts.at("request").contains("amplifies") ? HUGE_VAL : 1 + kSlack;
    for (std::size_t i = 0; 3 * i + 2 < lut.values.size() && lines.size() < kMostLines; ++i) {
        double Y = 0;
        for (std::size_t c = 0; c < 3; ++c) Y += luminance[c] * lut.values[3 * i + c];
        if (!(Y >= -kSlack && Y <= most && std::isfinite(Y)))
            lines.push_back("the luminance must be in [0, 1] at " + place_in(lut, i) + " (got " +
                            to_text(Y) + ")");
    }
    return lines;
}

}  // namespace

extern const LutKind lut_kind_albedo = {
    .name = "albedo",
    .summary = "Directional albedo, as a colour, of a rough surface whose facets are the stack.",
    .axes = "cos_theta, alpha",
    .notes =
        "Fraction of light that leaves in any direction after one reflection:\n"
        "    E(theta_i) = integral of D G2 R / (4 cos_i cos_o) cos_o over all directions o\n"
        "with GGX's D, Smith's height-correlated G2 and the stack's reflectance R at the\n"
        "half angle. alpha 0 is the smooth stack's colour. --tolerance is in CIEDE2000.",
    .examples = {"albedo \"1 | 1.33@400 | 1.5+3i\" -o albedo.ktx2",
                 "albedo mirror.json --alpha 0.05,0.1,0.4 --space xyz"},
    .stack = true,
    .light = true,
    .color = true,
    .options = {{.name = "cos-theta",
                 .help = "cosines of the angle of incidence, [0, 1] [0:1/32]",
                 .lowest = 0,
                 .highest = 1},
                {.name = "alpha",
                 .help = "roughness, 0 or [1e-4, 1] [0:1/32]",
                 .lowest = 0,
                 .highest = kRoughest}},
    .plan = plan,
    .problems = problems,
};

}  // namespace irido::tables
