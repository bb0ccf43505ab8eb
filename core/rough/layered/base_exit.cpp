#include "core/rough/layered/base_exit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"

namespace irido {

namespace {

/// Barycentric weights of the nodes of a Gauss rule: (-1)^j sqrt((1 - x^2) w). Source: H. Wang and
/// S. Xiang, Math. Comp. 81, 861 (2012).
template <int count>
const std::array<double, count>& barycentric() {
    static const std::array<double, count> all = [] {
        std::array<double, count> weights;
        for (std::size_t j = 0; j < count; ++j) {
            const GaussNode& node = gauss_legendre<count>()[j];
            weights[j] = (j % 2 == 0 ? 1 : -1) * std::sqrt((1 - node.x * node.x) * node.weight);
        }
        return weights;
    }();
    return all;
}

}  // namespace

double coating_return(const Coating& coating) {
    const double top = coating.top_deg(), left = 90 - top;
    // theta = top -+ v^2, as R0 has a square root at the critical angle
    const std::array<double, 9> ends{0, 0.1, 0.3, 1, 2, 3, 5, 7, std::sqrt(90.0)};
    double sum = 0;
    const auto add = [&](double sign, double farthest) {
        const double last = std::sqrt(farthest);
        for_each_node(ends, 0, last, [&](double v, double weight) {
            const double theta = std::clamp(top + sign * v * v, 0.0, 90.0);
            sum += kDegree * 2 * v * weight * coating.outward(theta).R * sin_deg(2 * theta);
        });
    };
    add(-1, top);
    if (left > 0) add(1, left);
    return sum;
}

std::vector<double> exit_from_below(const Coating& coating, double alpha, const AngleSeries& series,
                                    const std::function<double(double theta_deg)>& masking) {
    // theta = top - v^2
    const double top = coating.top_deg();
    const std::array<Feature, 1> grazing{Feature{0, std::sqrt(std::max(alpha, 1e-4) / kDegree)}};
    const std::vector<double> ends = graded_panels(0, std::sqrt(top), grazing);
    std::vector<double> sums(series.functions()), values(series.functions());
    for (const AngleSeries::Panel& panel : series.panels()) {
        if (panel.begin_deg() >= top) break;
        const double from = std::sqrt(std::max(0.0, top - panel.end_deg()));
        for_each_node(ends, from, std::sqrt(top - panel.begin_deg()), [&](double v, double weight) {
            const double theta = std::clamp(top - v * v, 0.0, 90.0);
            series.values(theta, values);
            const double scale = kDegree * 2 * v * weight * sin_deg(2 * theta) *
                                 coating.outward(theta).T * masking(theta);
            for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += scale * values[c];
        });
    }
    return sums;
}

void reflected_share(const LobeNodes& nodes,
                     const std::function<void(double cos_o, std::span<double> values)>& exit,
                     std::span<const std::shared_ptr<const AngleSeries>> series,
                     std::size_t function, std::span<double> out) {
    constexpr int kNodes = 16;
    const std::array<double, kNodes>& weights = barycentric<kNodes>();
    const auto& rule = gauss_legendre<kNodes>();
    std::vector<double> values(series.size());
    std::vector<double> kernel(kNodes * series.size());  // [node][component]
    nodes.over_panels([&](double begin, double end, const auto& theta_of, const auto& slope_of,
                          const auto& variable_of) {
        std::ranges::fill(kernel, 0);
        for (std::size_t j = 0; j < kNodes; ++j) {
            const double x = 0.5 * ((begin + end) + (end - begin) * rule[j].x);
            nodes.over_psi(theta_of(x), [&](double cos_o, double weight) {
                exit(cos_o, values);
                for (std::size_t c = 0; c < values.size(); ++c)
                    kernel[j * values.size() + c] += weight * slope_of(x) * values[c];
            });
        }
        // R has its own panels, on which the kernel is interpolated
        const double first = theta_of(begin), last = theta_of(end);
        for (std::size_t c = 0; c < series.size(); ++c)
            for (const AngleSeries::Panel& panel : series[c]->panels()) {
                if (panel.end_deg() <= first || panel.begin_deg() >= last) continue;
                const double from =
                    std::max(begin, variable_of(std::max(first, panel.begin_deg())));
                const double to = std::min(end, variable_of(std::min(last, panel.end_deg())));
                if (!(from < to)) continue;
                for (const GaussNode& node : rule) {
                    const double x = 0.5 * ((from + to) + (to - from) * node.x);
                    const double at = (2 * x - begin - end) / (end - begin);
                    double over = 0, under = 0;
                    for (std::size_t j = 0; j < kNodes; ++j) {
                        const double distance = at - rule[j].x;
                        const double share = weights[j] / (distance == 0 ? 1e-300 : distance);
                        over += share * kernel[j * series.size() + c];
                        under += share;
                    }
                    out[c] += 0.5 * (to - from) * node.weight * kDegree * (over / under) *
                              series[c]->value(function, theta_of(x));
                }
            }
    });
}

}  // namespace irido
