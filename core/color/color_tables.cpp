#include "core/color/color_tables.hpp"

namespace irido {

namespace {

constexpr std::array kAccuracies{1e-8, 1e-13};
constexpr double kLongestPath_nm = 5e5;

}  // namespace

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

std::shared_ptr<const QuadratureRule> ColorTables::rule(WavelengthRange panel,
                                                        std::size_t degree) const {
    const std::tuple key{panel.first_nm, panel.last_nm, degree};
    {
        const std::scoped_lock guard(lock_);
        if (const auto found = rules_.find(key); found != rules_.end()) return found->second;
    }
    auto rule = std::make_shared<const QuadratureRule>(sensitivity_, panel, degree);
    const std::scoped_lock guard(lock_);
    const std::size_t numbers = 2 * rule->rows.size();
    if (numbers_ + numbers <= kMostNumbers && rules_.emplace(key, rule).second) numbers_ += numbers;
    return rule;
}

std::shared_ptr<const SampleRule> ColorTables::equal(std::size_t count) const {
    const std::scoped_lock guard(lock_);
    std::shared_ptr<const SampleRule>& rule = equal_[count];
    if (!rule) rule = std::make_shared<const SampleRule>(equal_rule(sensitivity_, count));
    return rule;
}

}  // namespace irido
