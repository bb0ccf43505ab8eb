#include "core/math/adaptive_integral.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/gauss.hpp"

namespace irido {

namespace {

constexpr std::size_t kPanelPoints = 16;

struct IntegrationPanel {
    double begin, end;
    std::vector<double> integrals;

    double middle() const { return begin + (end - begin) / 2; }
};

/// Computes the integrals of panels.
void evaluate(std::span<IntegrationPanel> panels, std::size_t components,
              const ManyValues& values_at) {
    const auto& rule = gauss_legendre<kPanelPoints>();
    std::vector<double> points;
    for (const IntegrationPanel& panel : panels)
        for (const GaussNode& node : rule)
            points.push_back(panel.middle() + (panel.end - panel.begin) / 2 * node.x);
    std::vector<double> values(points.size() * components);
    values_at(points, values);
    const double* value = values.data();
    for (IntegrationPanel& panel : panels) {
        panel.integrals.assign(components, 0);
        for (const GaussNode& node : rule) {
            const double weight = node.weight * (panel.end - panel.begin) / 2;
            for (double& integral : panel.integrals) integral += weight * *value++;
        }
    }
}

/// Whether the halves of a panel agree with the whole.
bool agree(const IntegrationPanel& whole, const IntegrationPanel& first,
           const IntegrationPanel& second, double tolerance) {
    for (std::size_t i = 0; i < whole.integrals.size(); ++i) {
        const double halves = first.integrals[i] + second.integrals[i];
        constexpr double kRounding = 1e-15;
        const double allowed = std::max(tolerance, kRounding * std::abs(halves));
        if (!(std::abs(halves - whole.integrals[i]) <= allowed)) return false;
    }
    return true;
}

}  // namespace

std::optional<std::vector<double>> integrals(std::span<const double> ends, std::size_t components,
                                             double tolerance, const ManyValues& values_at) {
    std::vector<IntegrationPanel> panels;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        if (ends[i] < ends[i + 1]) panels.push_back({ends[i], ends[i + 1], {}});
    std::vector<double> sums(components, 0);
    const double length = ends.back() - ends.front();
    evaluate(panels, components, values_at);
    for (std::size_t all = panels.size(); !panels.empty(); all += panels.size()) {
        if (all > kMostPanels) return std::nullopt;
        std::vector<IntegrationPanel> halves;
        for (const IntegrationPanel& panel : panels) {
            halves.push_back({panel.begin, panel.middle(), {}});
            halves.push_back({panel.middle(), panel.end, {}});
        }
        evaluate(halves, components, values_at);
        std::vector<IntegrationPanel> rest;
        for (std::size_t i = 0; i < panels.size(); ++i) {
            IntegrationPanel &first = halves[2 * i], &second = halves[2 * i + 1];
            const double share = (panels[i].end - panels[i].begin) / length;
            if (agree(panels[i], first, second, tolerance * share)) {
                for (std::size_t c = 0; c < components; ++c)
                    sums[c] += first.integrals[c] + second.integrals[c];
            } else {
                rest.push_back(std::move(first));
                rest.push_back(std::move(second));
            }
        }
        panels = std::move(rest);
    }
    return sums;
}

}  // namespace irido
