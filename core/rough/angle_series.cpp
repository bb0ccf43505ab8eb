#include "core/rough/angle_series.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/constants.hpp"
#include "core/math/transform.hpp"

namespace irido {

namespace {

constexpr unsigned kFirstLevel = 3, kLastLevel = 30;

/// Nodes of a panel, from its end to its beginning.
std::array<double, AngleSeries::kPanelDegree + 1> nodes_of(const AngleSeries::Panel& panel) {
    const double begin = panel.begin_deg(), end = panel.end_deg();
    std::array<double, AngleSeries::kPanelDegree + 1> nodes;
    for (std::size_t j = 0; j <= AngleSeries::kPanelDegree; ++j) {
        const double turn = kPi * static_cast<double>(j) / AngleSeries::kPanelDegree;
        nodes[j] = 0.5 * (begin + end) + 0.5 * (end - begin) * std::cos(turn);
    }
    nodes.front() = end;
    nodes.back() = begin;
    return nodes;
}

double last_of(const AngleSeries::Coefficients& series) {
    return std::abs(series[AngleSeries::kPanelDegree - 2]) +
           std::abs(series[AngleSeries::kPanelDegree - 1]) +
           std::abs(series[AngleSeries::kPanelDegree]);
}

double sum_of_products(const AngleSeries::Coefficients& a, const AngleSeries::Coefficients& b) {
    // four partial sums, to hide latency
    std::array<double, 4> sums{a[AngleSeries::kPanelDegree] * b[AngleSeries::kPanelDegree], 0, 0,
                               0};
    for (std::size_t k = 0; k < AngleSeries::kPanelDegree; k += 4)
        for (std::size_t j = 0; j < 4; ++j) sums[j] += a[k + j] * b[k + j];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Adds weight T_k(x), k = 0 .. 16.
void add_polynomials(double x, double weight, AngleSeries::Coefficients& to) {
    double before = weight, now = weight * x;
    to[0] += before;
    for (std::size_t k = 1; k <= AngleSeries::kPanelDegree; ++k) {
        to[k] += now;
        before = std::exchange(now, 2 * x * now - before);
    }
}

}  // namespace

double AngleSeries::Panel::begin_deg() const {
    return std::ldexp(90 * static_cast<double>(index), -static_cast<int>(level));
}

double AngleSeries::Panel::end_deg() const {
    return std::ldexp(90 * static_cast<double>(index + 1), -static_cast<int>(level));
}

AngleSeries::AngleSeries(
    std::size_t functions, double tolerance,
    const std::function<std::vector<double>(std::span<const double>)>& evaluate)
    : AngleSeries(functions, tolerance, kFirstLevel, kLastLevel, evaluate) {}

AngleSeries::AngleSeries(
    std::size_t functions, unsigned level,
    const std::function<std::vector<double>(std::span<const double>)>& evaluate)
    : AngleSeries(functions, 0, level, level, evaluate) {}

AngleSeries::AngleSeries(
    std::size_t functions, double tolerance, unsigned first, unsigned last,
    const std::function<std::vector<double>(std::span<const double>)>& evaluate)
    : functions_(functions) {
    std::vector<std::pair<Panel, std::vector<Coefficients>>> done;
    std::vector<Panel> open;
    for (std::uint64_t i = 0; i < 1U << first; ++i) open.push_back({first, i});
    std::array<double, AngleSeries::kPanelDegree + 1> samples;
    while (!open.empty()) {
        std::vector<double> angles;
        for (const Panel& panel : open)
            for (const double angle : nodes_of(panel)) angles.push_back(angle);
        const std::vector<double> values = evaluate(angles);
        std::vector<Panel> halves;
        const bool is_last =
            open.front().level == last || done.size() + 2 * open.size() > kMostPanels;
        for (std::size_t i = 0; i < open.size(); ++i) {
            std::vector<Coefficients> series(functions);
            bool is_good = true;
            for (std::size_t f = 0; f < functions; ++f) {
                for (std::size_t j = 0; j <= AngleSeries::kPanelDegree; ++j)
                    samples[j] = values[(i * (AngleSeries::kPanelDegree + 1) + j) * functions + f];
                chebyshev_transform(AngleSeries::kPanelDegree)(samples, series[f]);
                is_good = is_good && last_of(series[f]) <= tolerance;
            }
            const Panel& panel = open[i];
            if (is_good || is_last) {
                done.emplace_back(panel, std::move(series));
            } else {
                halves.push_back({panel.level + 1, 2 * panel.index});
                halves.push_back({panel.level + 1, 2 * panel.index + 1});
            }
        }
        open = std::move(halves);
    }
    std::ranges::sort(done, {}, [](const auto& one) { return one.first.begin_deg(); });
    for (const auto& [panel, series] : done) {
        panels_.push_back(panel);
        coefficients_.insert(coefficients_.end(), series.begin(), series.end());
    }
}

double AngleSeries::error(std::size_t panel, std::size_t function) const {
    return 2 * last_of(coefficients(panel, function));
}

std::size_t AngleSeries::panel_of(double theta_deg) const {
    const auto above = std::ranges::upper_bound(panels_, theta_deg, {}, &Panel::begin_deg);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - panels_.begin() - 1, 0));
}

double AngleSeries::value(std::size_t function, double theta_deg) const {
    const std::size_t panel = panel_of(theta_deg);
    const double begin = panels_[panel].begin_deg(), end = panels_[panel].end_deg();
    Coefficients polynomials{};
    add_polynomials(((theta_deg - begin) - (end - theta_deg)) / (end - begin), 1, polynomials);
    return sum_of_products(coefficients(panel, function), polynomials);
}

void AngleSeries::values(double theta_deg, std::span<double> out) const {
    const std::size_t panel = panel_of(theta_deg);
    const double begin = panels_[panel].begin_deg(), end = panels_[panel].end_deg();
    Coefficients polynomials{};
    add_polynomials(((theta_deg - begin) - (end - theta_deg)) / (end - begin), 1, polynomials);
    for (std::size_t f = 0; f < functions_; ++f)
        out[f] = sum_of_products(coefficients(panel, f), polynomials);
}

double AngleSeries::error_at(double theta_deg) const {
    const std::size_t panel = panel_of(theta_deg);
    double largest = 0;
    for (std::size_t f = 0; f < functions_; ++f) largest = std::max(largest, error(panel, f));
    return largest;
}

AngleMoments::Integral AngleMoments::operator()(const AngleSeries& series, std::size_t function) {
    Integral integral;
    for (std::size_t i = 0; i < series.panels().size(); ++i) {
        const AngleSeries::Coefficients& moments = of(series.panels()[i]);
        integral.value += sum_of_products(series.coefficients(i, function), moments);
        integral.error += series.error(i, function) * moments[0];
        integral.weight += moments[0];
    }
    return integral;
}

void AngleMoments::values(const AngleSeries& series, std::size_t first, std::span<double> out) {
    std::ranges::fill(out, 0);
    for (std::size_t i = 0; i < series.panels().size(); ++i) {
        const AngleSeries::Coefficients& moments = of(series.panels()[i]);
        for (std::size_t f = 0; f < out.size(); ++f)
            out[f] += sum_of_products(series.coefficients(i, first + f), moments);
    }
}

const AngleSeries::Coefficients& AngleMoments::of(const AngleSeries::Panel& panel) {
    const auto [place, is_new] = moments_.try_emplace(panel.key());
    AngleSeries::Coefficients& moments = place->second;
    if (!is_new) return moments;
    const double begin = panel.begin_deg(), end = panel.end_deg();
    const WeightedAngles nodes = nodes_(begin, end);
    for (std::size_t i = 0; i < nodes.weight.size(); ++i) {
        const double theta = nodes.theta_deg[i];
        add_polynomials(((theta - begin) - (end - theta)) / (end - begin), nodes.weight[i],
                        moments);
    }
    return moments;
}

std::vector<double> graded_panels(double begin, double end, std::span<const Feature> features) {
    std::vector<double> ends{begin};
    while (ends.back() < end) {
        const double x = ends.back();
        double step = end - x;
        for (const auto& [at, width] : features)
            step =
                std::min(step, x < at ? std::max(width, 0.5 * (width + at - x)) : width + x - at);
        // do not leave a last panel too narrow to be distinguished
        const double next = x + step;
        ends.push_back(next < end && next > x ? next : end);
    }
    return ends;
}

}  // namespace irido
