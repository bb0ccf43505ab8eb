#include <cmath>
#include <limits>
#include <numbers>

#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/rough/filter.hpp"
#include "core/rough/ggx.hpp"
#include "tables/lut/kind_parts.hpp"

namespace irido::tables {

namespace {

LutPlan plan(const LutRequest& request) {
    LutPlan plan;
    plan.axes.push_back(alpha_axis(request));
    plan.axes.push_back(angles_axis(request, "theta-i", "theta_i_deg"));
    plan.axes.push_back(angles_axis(request, "theta-d", "theta_d_deg"));
    plan.channels = {"F"};
    plan.split_axis = 1;
    plan.evaluate = [simd = request.execution.simd](const std::vector<LutAxis>& axes) {
        const FilterAxis theta_d(axes[2].values, "theta_d_deg");
        std::vector<double> values(axes[0].count() * axes[1].count() * axes[2].count());
        auto row = std::span(values);
        for (const double alpha_value : axes[0].values) {
            const TransmissionFilter filter(alpha_value);
            for (const double theta_i : axes[1].values) {
                filter.row(theta_i, theta_d, row.first(theta_d.count()), simd);
                row = row.subspan(theta_d.count());
            }
        }
        return values;
    };
    // about the peak of a row, which has integral G1 and width alpha
    plan.measure = relative_to("relative to G1/alpha", [](double alpha, double theta_i_deg) {
        return smith_masking(alpha, cos_of_incidence(theta_i_deg)) / alpha;
    });
    return plan;
}

/// Integral over theta_d of the lines through a row, over every `step`-th sample; F goes to 0 at
/// 90 degrees.
double integral_of(const LutAxis& axis, std::span<const double> row, std::size_t step) {
    double sum = 0, before = axis.values[0], value = row[0];
    for (std::size_t i = step; i < row.size(); i += step) {
        sum += 0.5 * (axis.values[i] - before) * (row[i] + value);
        before = axis.values[i];
        value = row[i];
    }
    sum += 0.5 * (90 - before) * value;
    return sum * std::numbers::pi / 180;
}

/// A row that starts at 0 must integrate to G1, to within the change by leaving out every second
/// sample.
std::vector<std::string> problems(const Lut& lut) {
    std::vector<std::string> lines =
        out_of_range(lut, [](std::size_t) { return std::numeric_limits<double>::max(); });
    constexpr double kFarthestEnd = 85;
    constexpr std::size_t kFewest = 9, kMostLines = 5;
    const LutAxis& axis = lut.axes.back();
    if (!lines.empty() || lut.axes.size() != 3 || axis.count() < kFewest ||
        axis.values.front() != 0 || axis.values.back() < kFarthestEnd)
        return lines;
    const std::size_t rows = lut.axes[0].count() * lut.axes[1].count();
    for (std::size_t r = 0; r < rows && lines.size() < kMostLines; ++r) {
        const auto row = std::span(lut.values).subspan(r * axis.count(), axis.count());
        const double fine = integral_of(axis, row, 1), coarse = integral_of(axis, row, 2);
        const double alpha = lut.axes[0].values[r / lut.axes[1].count()];
        const double theta_i = lut.axes[1].values[r % lut.axes[1].count()];
        const double G1 = smith_masking(alpha, cos_of_incidence(theta_i));
        const double allowed =
            2 * std::abs(fine - coarse) + 1e-4 * G1 + rounding_of(lut.type) * fine;
        if (!(std::abs(fine - G1) <= allowed))
            lines.push_back("the integral of F over theta_d must be G1 = " + to_text(G1) +
                            " at alpha " + to_text(alpha) + ", theta_i_deg " + to_text(theta_i) +
                            " (got " + to_text(fine) + ")");
    }
    return lines;
}

}  // namespace

extern const LutKind lut_kind_falpha = {
    .name = "falpha",
    .summary = "Transmission filter of a rough layer, FPB24's F_alpha.",
    .axes = "alpha, theta_i_deg, theta_d_deg",
    .notes =
        "F is per radian of theta_d, from its closed form, relative error below 1e-14:\n"
        "    ft_cos(theta_i) = integral of T(theta_d) F(theta_i, theta_d) dtheta_d\n"
        "is the light that passes straight through a rough layer; it is G1(theta_i) where\n"
        "T = 1. Facets have the GGX distribution. The error is relative to G1/alpha, the\n"
        "scale of a row. FPB24: Fourneau, Pacanowski and Barla, CGF 43(2), 2024, eq. 29.",
    .examples = {"falpha -o falpha.npy", "falpha --alpha 0.05,0.1,0.2 --theta-i 0:85:5",
                 "falpha --alpha 0.2 --theta-i 20,60 --theta-d 15,45,75 --dtype f64"},
    .options = {alpha_option(),
                angles_option("theta-i", "angles of incidence, degrees, [0, 90] [0:89.75:0.25]"),
                angles_option("theta-d",
                              "angles to the facets' normals, degrees, [0, 90] "
                              "[0:89.75:0.25]")},
    .plan = plan,
    .problems = problems,
};

}  // namespace irido::tables
