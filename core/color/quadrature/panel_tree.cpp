#include "core/color/quadrature/panel_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/color/quadrature/index_effect.hpp"

namespace irido {

namespace {

/// Degree, as an index, at which the coefficients of a fringe of this half turn are below the
/// tolerance: those of cos(h x) are Bessel functions J_k(h) < (e h/2k)^k. Twice the turn, because
/// light that bounces twice has fringes twice as fast.
std::size_t first_degree(double half_turn, double tolerance) {
    const double h = 2 * half_turn;
    std::size_t degree = 0;
    for (; degree + 1 < kDegrees.size(); ++degree) {
        const auto k = static_cast<double>(kDegrees[degree]);
        if (k * std::log(std::numbers::e * h / (2 * k)) < std::log(tolerance)) break;
    }
    return degree;
}

/// Panels with more fringes are halved before they are sampled.
constexpr double kLargestHalfTurn = 16;

/// The same of panels whose denominators are resolved, so that few points can stand for many.
constexpr double kFollowedHalfTurn = 8;

/// Part of the tolerance that the first coefficient of a denominator that is left out may be, as
/// far as is known before.
constexpr double kUnseen = 3e-2;

/// Part of the error allowed that is planned for a panel's fitted indices.
constexpr double kPlannedLost = 0.4;

}  // namespace

std::vector<SpectralPanel> panels_of(const std::vector<double>& ends, double path_nm) {
    std::vector<SpectralPanel> panels;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        panels.push_back(
            {{ends[i], ends[i + 1]}, std::numbers::pi * path_nm * (1 / ends[i] - 1 / ends[i + 1])});
    return panels;
}

const QuadratureRule& PanelTree::Node::rule(std::size_t degree) {
    return *rules_[degree].get(lock_, [&] {
        return std::make_unique<std::shared_ptr<const QuadratureRule>>(
            tree_.tables_.rule(range_, kDegrees[degree]));
    });
}

const SpectralPoints& PanelTree::Node::all_points(std::size_t degree) {
    const std::vector<double>& every = rule(degree).wavelength_nm;
    const IndexFit* indices = fit();
    return all_[degree].get(
        lock_, [&] { return std::make_unique<SpectralPoints>(tree_.make_points(every, indices)); });
}

const SpectralPoints& PanelTree::Node::added_points(std::size_t degree) {
    const std::vector<double>& every = rule(degree).wavelength_nm;
    const IndexFit* indices = fit();
    return added_[degree].get(lock_, [&] {
        std::vector<double> odd;
        for (std::size_t j = 1; j < every.size(); j += 2) odd.push_back(every[j]);
        return std::make_unique<SpectralPoints>(tree_.make_points(std::move(odd), indices));
    });
}

PanelTree::Node& PanelTree::Node::half(std::size_t which) {
    return halves_[which].get(lock_, [&] {
        const double middle = has_rows_ ? tree_.indices_->middle_row(range_)
                                        : 2 / (1 / range_.first_nm + 1 / range_.last_nm);
        return std::make_unique<Node>(tree_, which == 0 ? WavelengthRange{range_.first_nm, middle}
                                                        : WavelengthRange{middle, range_.last_nm});
    });
}

const IndexFit* PanelTree::Node::fit() {
    if (!has_rows_) return nullptr;
    return &fit_.get(lock_, [&] { return tree_.indices_->fit(range_); });
}

std::size_t PanelTree::Node::seeing(std::size_t degree) {
    if (const IndexFit* indices = fit())
        while (kDegrees[degree] < indices->degree()) ++degree;
    return degree;
}

double PanelTree::Node::half_turn(std::size_t which, double half_turn) {
    const WavelengthRange part = half(which).range();
    return half_turn * (1 / part.first_nm - 1 / part.last_nm) /
           (1 / range_.first_nm - 1 / range_.last_nm);
}

PanelTree::Start PanelTree::start(const std::vector<SpectralPanel>& panels, double tolerance,
                                  std::size_t most_panels, bool follows) {
    double half_turns = 0;
    for (const SpectralPanel& panel : panels) half_turns += panel.half_turn;
    // more panels than can be afforded do not help: the fringes stay unresolved
    const double largest = std::max(follows ? kFollowedHalfTurn : kLargestHalfTurn,
                                    2 * half_turns / static_cast<double>(most_panels));
    Start start;
    std::vector<Part> parts;
    for (const SpectralPanel& panel : panels) {
        Node* root = nullptr;
        {
            const std::scoped_lock guard(lock_);
            const std::pair key{panel.range.first_nm, panel.range.last_nm};
            root = &roots_.try_emplace(key, *this, panel.range).first->second;
        }
        begin_with(*root, panel.half_turn, {largest, tolerance, follows}, start, parts);
    }
    start.points = joined(std::move(parts));
    start.points.id = points_made_++;
    return start;
}

SpectralPoints PanelTree::joined(std::vector<Part> parts) const {
    std::vector<SpectralPoints> made;
    for (Part& part : parts) made.push_back(make_points_(std::move(part.wavelength_nm), part.fit));
    if (made.size() == 1) return std::move(made.front());
    SpectralPoints all = std::move(made.front());
    std::vector<const IndexTable*> indices{all.indices.get()};
    for (const SpectralPoints& some : std::span(made).subspan(1)) {
        all.wavelength_nm.insert(all.wavelength_nm.end(), some.wavelength_nm.begin(),
                                 some.wavelength_nm.end());
        indices.push_back(some.indices.get());
    }
    auto table = std::make_unique<IndexTable>(*indices.front());
    table->assign(indices);
    all.indices = std::move(table);
    return all;
}

SpectralPoints PanelTree::make_points(std::vector<double> wavelength_nm,
                                      const IndexFit* fit) const {
    SpectralPoints points = make_points_(std::move(wavelength_nm), fit);
    points.id = points_made_++;
    return points;
}

/// Whether what the fit of a panel's indices loses is small enough, as far as is known before the
/// first evaluation: denominators turn as their fringes do.
bool PanelTree::is_smooth(Node& node, double half_turn, std::size_t degree, double tolerance) {
    const IndexFit* fit = node.fit();
    if (!fit) return true;
    if (degree >= IndexFit::kLevels) return false;
    const WavelengthRange range = node.range(), all = tables_.sensitivity().support();
    const std::vector<double> inverse = indices_->inverse_indices(range);
    const double slope = half_turn / (1 - range.first_nm / range.last_nm);
    const auto n = static_cast<double>(kDegrees[degree]);
    std::size_t rate = 0;
    while (rate + 1 < kFallRates.size() && half_turn <= steepest_of(kFallRates[rate + 1], n))
        ++rate;
    const Triple light = tables_.sensitivity().integral(range);
    const double share =
        (1 / range.first_nm - 1 / range.last_nm) / (1 / all.first_nm - 1 / all.last_nm);
    for (std::size_t c = 0; c < 3; ++c) {
        double lost = 0, root = 0;
        for (const IndexFit::Error& error : fit->errors(degree, rate)) {
            const double effect = index_effect(inverse[error.material], slope);
            lost += effect * error.first[c];
            root += effect * std::sqrt(error.second[c]);
        }
        const double part = light[c] / tables_.sensitivity().white()[c] + share;
        if (!(lost + root * root <= kPlannedLost * tolerance / 2 * part)) return false;
    }
    return true;
}

void PanelTree::begin_with(Node& node, double half_turn, const Begin& begin, Start& start,
                           std::vector<Part>& parts) {
    const std::size_t degree = node.seeing(first_degree(half_turn, begin.tolerance));
    if (half_turn > begin.largest_half_turn ||
        !is_smooth(node, half_turn, degree, begin.tolerance)) {
        for (std::size_t half = 0; half < 2; ++half)
            begin_with(node.half(half), node.half_turn(half, half_turn), begin, start, parts);
        return;
    }
    std::size_t sampled = degree;
    if (begin.follows)
        sampled = std::min(degree, first_degree(half_turn / 4, kUnseen * begin.tolerance));
    std::size_t first = 0;
    if (!start.panels.empty()) {
        const Start::Panel& before = start.panels.back();
        first = before.first + kDegrees[before.sampled];
    }
    start.panels.push_back({&node, degree, half_turn, first, sampled});
    const IndexFit* fit = node.fit();
    if (fit || parts.empty() || parts.back().fit) parts.push_back({fit, {}});
    const std::vector<double>& points = node.rule(sampled).wavelength_nm;
    std::vector<double>& all = parts.back().wavelength_nm;
    all.insert(all.end(), points.begin() + (start.panels.size() == 1 ? 0 : 1), points.end());
}

}  // namespace irido
