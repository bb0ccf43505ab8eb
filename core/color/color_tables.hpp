#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

#include "core/color/quadrature_rule.hpp"
#include "core/color/sensitivity.hpp"
#include "core/color/sensitivity_transform.hpp"
#include "core/math/lazy.hpp"

namespace irido {

/// What the colours of all stacks under one sensitivity have in common. Parts are computed when
/// they are first asked for, once. Safe from many threads.
class ColorTables {
public:
    explicit ColorTables(Sensitivity sensitivity) : sensitivity_(std::move(sensitivity)) {}

    const Sensitivity& sensitivity() const { return sensitivity_; }

    /// The transform for paths up to 0.5 mm, with an error of at most `accuracy` or, if that is
    /// smaller, 1e-13: tables of 1e-8 and of 1e-13 serve all.
    const SensitivityTransform& transform(double accuracy) const;

    /// channel_points() of the sensitivity.
    const std::array<ChannelPoints, 3>& channel_points() const;

    /// The quadrature rule of a panel; rules of up to kMostNumbers numbers in all are kept.
    std::shared_ptr<const QuadratureRule> rule(WavelengthRange panel, std::size_t degree) const;

    /// equal_rule() of the sensitivity.
    std::shared_ptr<const SampleRule> equal(std::size_t count) const;

    static constexpr std::size_t kMostNumbers = 1U << 22;

private:
    Sensitivity sensitivity_;
    mutable std::array<Lazy<SensitivityTransform>, 2> transforms_;
    mutable Lazy<std::array<ChannelPoints, 3>> channel_points_;
    mutable std::mutex making_, lock_;
    mutable std::map<std::tuple<double, double, std::size_t>, std::shared_ptr<const QuadratureRule>>
        rules_;
    mutable std::size_t numbers_ = 0;  ///< in the rules
    mutable std::map<std::size_t, std::shared_ptr<const SampleRule>> equal_;
};

}  // namespace irido
