#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "core/color/bloch/bloch_sums.hpp"
#include "core/color/quadrature/quadrature_rule.hpp"
#include "core/colorimetry/cumulative_sensitivity.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/colorimetry/sensitivity_transform.hpp"
#include "core/colorimetry/smooth_sensitivity.hpp"
#include "core/math/lazy.hpp"

namespace irido {

class PanelStarts;

/// Data shared by the colours of all stacks under the same weighted colour-matching functions. Each
/// part is computed once, on first use. Thread-safe.
class ColorTables {
public:
    explicit ColorTables(Sensitivity sensitivity);
    ~ColorTables();
    ColorTables(const ColorTables&) = delete;
    ColorTables& operator=(const ColorTables&) = delete;

    const Sensitivity& sensitivity() const { return sensitivity_; }

    /// The transform for optical path differences up to 0.5 mm, with an error of at most
    /// `accuracy`, or 1e-13 if that is larger. Two tables, of 1e-8 and 1e-13, serve all requests.
    const SensitivityTransform& transform(double accuracy) const;

    /// channel_points() of the sensitivity.
    const std::array<ChannelPoints, 3>& channel_points() const;

    /// Quadrature rule of a panel. Cached are the rules since these last had more than kMostNumbers
    /// numbers in total.
    std::shared_ptr<const QuadratureRule> rule(WavelengthRange panel, std::size_t degree) const;

    /// equal_rule() of the sensitivity.
    std::shared_ptr<const SampleRule> equal(std::size_t count) const;

    /// X, Y and Z up to any wavelength.
    const CumulativeSensitivity& cumulative() const;

    /// Weighted colour-matching functions, low-pass filtered at kFirstSmooth_nm 2^level, where
    /// level < kSmoothLevels.
    const SmoothSensitivity& smooth(std::size_t level) const;
    static constexpr std::size_t kSmoothLevels = 9;
    static constexpr double kFirstSmooth_nm = 32000;

    const SensitivityDecay& decay() const;

    /// Nodes for at least `least` points; their number is 2^k or 3 2^k.
    const CosineNodes& nodes(std::size_t least) const;

    /// Panels and points for spectra of constant indices, which all such stacks share. Others, once
    /// there are kMostShared points or so.
    std::shared_ptr<const PanelStarts> constant_starts() const;

    static constexpr std::size_t kMostNumbers = 1U << 22;
    static constexpr std::size_t kMostShared = 1U << 12;

private:
    Sensitivity sensitivity_;
    mutable std::array<Lazy<SensitivityTransform>, 2> transforms_;
    mutable Lazy<std::array<ChannelPoints, 3>> channel_points_;
    mutable Lazy<CumulativeSensitivity> cumulative_;
    mutable Lazy<SensitivityDecay> decay_;
    mutable std::array<Lazy<SmoothSensitivity>, kSmoothLevels> smooth_;
    mutable std::array<Lazy<CosineNodes>, 64> nodes_;
    mutable std::mutex making_, lock_;
    struct RuleKey {
        double first_nm, last_nm;
        std::size_t degree;
        bool operator==(const RuleKey&) const = default;
    };
    struct RuleHash {
        std::size_t operator()(const RuleKey& key) const;
    };
    mutable std::unordered_map<RuleKey, std::shared_ptr<const QuadratureRule>, RuleHash> rules_;
    mutable std::size_t numbers_ = 0;  ///< in the rules
    mutable std::map<std::size_t, std::shared_ptr<const SampleRule>> equal_;
    mutable std::shared_ptr<const PanelStarts> constant_starts_;
};

}  // namespace irido
