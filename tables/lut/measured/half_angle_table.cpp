#include "tables/lut/measured/half_angle_table.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/rough/walk/layered_nodes.hpp"

namespace irido::tables {

namespace {

constexpr double kMeasuredEnd_deg = 85;
constexpr std::size_t kPhiSamples = 32, kHalfSamples = 128, kDifferenceSamples = 64;

AxisPlan angle_axis(std::string name, const std::vector<double>& typed, std::size_t count,
                    double half_at_deg) {
    AxisPlan plan{{std::move(name), "deg", typed}};
    if (typed.empty()) {
        plan.axis.values = {0, 90};
        plan.axis.half_at = half_at_deg;
        plan.axis.values = plan.axis.spaced(count);
    }
    for (std::size_t k = 0; k < typed.size(); ++k) {
        require_in_range(plan.axis.name, typed[k], 0, 90);
        if (k > 0 && !(typed[k] > typed[k - 1])) throw DomainError(plan.axis.name + " must ascend");
    }
    plan.fixed = !typed.empty() && !plan.axis.is_linear();
    return plan;
}

/// Every sample of the axes with its directions, the last axis fastest.
template <class Visit>
void for_each_sample(const std::vector<LutAxis>& axes, const Visit& visit) {
    std::size_t place = 0;
    for (const double phi_d : axes[0].values)
        for (const double theta_h : axes[1].values)
            for (const double theta_d : axes[2].values)
                visit(place++, directions_of({theta_h, theta_d, phi_d}));
}

}  // namespace

double half_angle_scale_deg(double alpha) {
    return 25 * std::sqrt(alpha / kDegree);
}

LutPlan half_angle_plan(HalfAngleTable typed) {
    const auto table = std::make_shared<const HalfAngleTable>(std::move(typed));
    LutPlan plan;
    plan.axes = {angle_axis("phi_d_deg", table->phi_d_deg, kPhiSamples, 0),
                 angle_axis("theta_h_deg", table->theta_h_deg, kHalfSamples,
                            half_angle_scale_deg(table->alpha)),
                 angle_axis("theta_d_deg", table->theta_d_deg, kDifferenceSamples, 0)};
    plan.channels = table->is_xyz ? std::vector<std::string>{"X", "Y", "Z"}
                                  : std::vector<std::string>{"R", "G", "B"};
    plan.split_axis = 1;
    plan.evaluate = [table](const std::vector<LutAxis>& axes) {
        std::vector<double> values;
        for_each_sample(axes, [&](std::size_t, const HalfAnglePair& one) {
            const Triple value = table->transform(table->xyz(one));
            values.insert(values.end(), value.begin(), value.end());
        });
        return values;
    };
    plan.measure = {
        "delta_e_2000", [table](const std::vector<LutAxis>& axes, std::span<const double> exact,
                                std::span<const double> approximate) {
            std::vector<double> result(exact.size() / 3);
            for_each_sample(axes, [&](std::size_t k, const HalfAnglePair& one) {
                if (std::max(one.pair.theta_i_deg, one.pair.theta_o_deg) > kMeasuredEnd_deg) return;
                const auto xyz_at = [&](std::span<const double> values) {
                    return table->transform.xyz_of(
                        {values[3 * k], values[3 * k + 1], values[3 * k + 2]});
                };
                result[k] = scatter_difference(xyz_at(exact), xyz_at(approximate), table->white);
            });
            return result;
        }};
    return plan;
}

}  // namespace irido::tables
