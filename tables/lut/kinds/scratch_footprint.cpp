#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/scratch/footprint.hpp"
#include "tables/lut/kind_parts.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

namespace {

/// G(s, h) (1 + h) at offset = s/(h + 3), size = h/(h + 1).
double scaled_mean(double offset, double size) {
    constexpr double kBeyond = 3;
    if (size == 1) return 2 / std::sqrt(kPi) * std::sqrt((1 - offset) * (1 + offset));
    const double h = size / (1 - size);
    return ellipse_mean(offset * (h + kBeyond), h) * (1 + h);
}

LutPlan plan(const LutRequest& request) {
    constexpr std::size_t kCount = 128;
    LutPlan result;
    result.axes = {listed_axis(request, "offset", {"offset", "", equally_spaced(0, 1, kCount)}),
                   listed_axis(request, "extent", {"extent", "", equally_spaced(0, 1, kCount)})};
    result.channels = {"G"};
    result.evaluate = [](const std::vector<LutAxis>& axes) {
        std::vector<double> values;
        for (const double offset : axes[0].values)
            for (const double extent : axes[1].values)
                values.push_back(scaled_mean(offset, extent));
        return values;
    };
    result.measure = {"absolute, of G",
                      [](const std::vector<LutAxis>& axes, std::span<const double> exact,
                         std::span<const double> approximate) {
                          const std::vector<double>& extents = axes[1].values;
                          std::vector<double> differences;
                          for (std::size_t i = 0; i < exact.size(); ++i)
                              differences.push_back(std::abs(exact[i] - approximate[i]) *
                                                    (1 - extents[i % extents.size()]));
                          return differences;
                      }};
    return result;
}

std::vector<std::string> problems(const Lut& lut) {
    const double rounding = rounding_of(lut.type);
    return out_of_range(lut, [rounding](std::size_t) { return 1.63 + rounding; });
}

}  // namespace

extern const LutKind lut_kind_scratch_footprint = {
    .name = "scratch-footprint",
    .summary = "Share of scratches in the footprint of a pixel: smooth at every size.",
    .axes = "offset, extent",
    .notes =
        "G (1 + h/sigma) with G the mean of exp(-s^2/sigma^2) over an ellipse, s the distance\n"
        "from the scratch, sigma the coherence radius, h the ellipse's half extent across the\n"
        "scratch, s_b the distance of its centre: offset = |s_b|/(h + 3 sigma), extent =\n"
        "h/(h + sigma). A scratch of width W covers W G/(sqrt(pi) sigma) of the footprint. The\n"
        "error is that of G.",
    .examples = {"scratch-footprint -o footprint.ktx2",
                 "scratch-footprint --tolerance 1e-3 -o g.exr"},
    .options = {{.name = "offset",
                 .type = LutOption::Type::list,
                 .help = "|s_b|/(h + 3 sigma), [0, 1] [0:1/128]",
                 .lowest = 0,
                 .highest = 1},
                {.name = "extent",
                 .type = LutOption::Type::list,
                 .help = "h/(h + sigma), [0, 1] [0:1/128]",
                 .lowest = 0,
                 .highest = 1}},
    .plan = plan,
    .problems = problems,
};

}  // namespace irido::tables
