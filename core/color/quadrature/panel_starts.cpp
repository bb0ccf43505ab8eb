#include "core/color/quadrature/panel_starts.hpp"

#include <algorithm>

#include "core/color/quadrature/optical_path.hpp"

namespace irido {

namespace {

/// Part of the tolerance that the first wavelengths are chosen for, between these tolerances.
constexpr double kFirstPart = 0.1, kSmallestFirst = 1e-5, kLargestFirst = 1e-4;

}  // namespace

double first_tolerance(double tolerance) {
    return std::min(tolerance, std::clamp(kFirstPart * tolerance, kSmallestFirst, kLargestFirst));
}

const PanelTree::Start& PanelStarts::at(const Key& key) const {
    const std::scoped_lock guard(lock_);
    std::unique_ptr<const PanelTree::Start>& start = starts_[key];
    if (!start)
        start = std::make_unique<const PanelTree::Start>(
            tree_.start(panels_of(ends_, path_of_class(key.path)), first_tolerance(key.tolerance),
                        key.most_panels, key.follows));
    return *start;
}

}  // namespace irido
