#include "core/color/color_tables.hpp"

#include <cmath>

#include "core/color/quadrature/panel_starts.hpp"

namespace irido {

namespace {

constexpr std::array kAccuracies{1e-8, 1e-13};
constexpr double kLongestPath_nm = 5e5;

}  // namespace

ColorTables::ColorTables(Sensitivity sensitivity) : sensitivity_(std::move(sensitivity)) {}
ColorTables::~ColorTables() = default;

const SensitivityTransform& ColorTables::transform(double accuracy) const {
    const std::size_t which = accuracy >= kAccuracies[0] ? 0 : 1;
    return transforms_[which].get(making_, [&] {
        return std::make_unique<SensitivityTransform>(sensitivity_, kLongestPath_nm,
                                                      kAccuracies[which]);
    });
}

const std::array<ChannelPoints, 3>& ColorTables::channel_points() const {
    return channel_points_.get(making_, [&] {
        return std::make_unique<std::array<ChannelPoints, 3>>(irido::channel_points(sensitivity_));
    });
}

const CumulativeSensitivity& ColorTables::cumulative() const {
    return cumulative_.get(making_,
                           [&] { return std::make_unique<CumulativeSensitivity>(sensitivity_); });
}

const SmoothSensitivity& ColorTables::smooth(std::size_t level) const {
    return smooth_.at(level).get(making_, [&] {
        return std::make_unique<SmoothSensitivity>(
            sensitivity_, kFirstSmooth_nm * std::exp2(static_cast<double>(level)));
    });
}

const SensitivityDecay& ColorTables::decay() const {
    return decay_.get(making_, [&] { return std::make_unique<SensitivityDecay>(sensitivity_); });
}

const CosineNodes& ColorTables::nodes(std::size_t least) const {
    // 2, 3, 4, 6, 8, 12 ...
    std::size_t k = 0, count = 2;
    while (count < least) {
        count += k % 2 == 0 ? count / 2 : count / 3;
        ++k;
    }
    return nodes_.at(k).get(making_, [&] { return std::make_unique<CosineNodes>(count); });
}

std::size_t ColorTables::RuleHash::operator()(const RuleKey& key) const {
    constexpr std::size_t kMix = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
    const std::hash<double> hash;
    return ((hash(key.first_nm) * kMix) ^ hash(key.last_nm)) * kMix ^ key.degree;
}

std::shared_ptr<const QuadratureRule> ColorTables::rule(WavelengthRange panel,
                                                        std::size_t degree) const {
    const RuleKey key{panel.first_nm, panel.last_nm, degree};
    {
        const std::scoped_lock guard(lock_);
        if (const auto found = rules_.find(key); found != rules_.end()) return found->second;
    }
    auto rule = std::make_shared<const QuadratureRule>(sensitivity_, panel, degree);
    const std::scoped_lock guard(lock_);
    const std::size_t numbers = 4 * rule->weights.size();
    if (numbers > kMostNumbers) return rule;
    if (numbers_ + numbers > kMostNumbers) {
        // one mirror of very many fringes would fill the cache for all stacks after it
        rules_.clear();
        numbers_ = 0;
    }
    if (rules_.emplace(key, rule).second) numbers_ += numbers;
    return rule;
}

std::shared_ptr<const SampleRule> ColorTables::equal(std::size_t count) const {
    const std::scoped_lock guard(lock_);
    std::shared_ptr<const SampleRule>& rule = equal_[count];
    if (!rule) rule = std::make_shared<const SampleRule>(equal_rule(sensitivity_, count));
    return rule;
}

std::shared_ptr<const PanelStarts> ColorTables::constant_starts() const {
    const std::scoped_lock guard(lock_);
    if (!constant_starts_ || constant_starts_->size() > kMostShared) {
        const WavelengthRange support = sensitivity_.support();
        constant_starts_ = std::make_shared<const PanelStarts>(
            *this, std::vector{support.first_nm, support.last_nm},
            [](std::vector<double> wavelength_nm, const IndexFit*) {
                return SpectralPoints{std::move(wavelength_nm), nullptr};
            });
    }
    return constant_starts_;
}

}  // namespace irido
