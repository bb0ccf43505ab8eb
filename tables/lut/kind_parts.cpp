#include "tables/lut/kind_parts.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/rough/ggx.hpp"
#include "core/stack/index_table.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kMostProblems = 5;

}  // namespace

AxisPlan listed_axis(const LutRequest& request, std::string_view option, LutAxis otherwise) {
    if (!request.has(option)) return {std::move(otherwise), false, false};
    otherwise.values = request.list(option);
    const std::vector<double>& values = otherwise.values;
    if (values.empty()) throw DomainError(std::string(option) + " must have at least one value");
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!((values[i] - values[i - 1]) * (values[1] - values[0]) > 0))
            throw DomainError(std::string(option) + " must ascend or descend strictly (got " +
                              to_text(values[i - 1]) + ", " + to_text(values[i]) + ")");
    const bool fixed = !otherwise.is_linear();
    return {std::move(otherwise), fixed, false};
}

std::vector<double> stepped(double step, std::size_t count) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = step * static_cast<double>(i);
    return values;
}

LutOption alpha_option() {
    return {.name = "alpha",
            .help = "roughness, [1e-4, 1] [0.1]",
            .lowest = kSmoothest,
            .highest = kRoughest};
}

LutOption angles_option(std::string_view name, std::string_view help) {
    return {.name = name, .help = help, .lowest = 0, .highest = 90};
}

AxisPlan alpha_axis(const LutRequest& request) {
    AxisPlan plan = listed_axis(request, "alpha", {"alpha", "", {0.1}});
    for (const double alpha : plan.axis.values)
        require_in_range("alpha", alpha, kSmoothest, kRoughest);
    return plan;
}

AxisPlan angles_axis(const LutRequest& request, std::string_view option, std::string name) {
    AxisPlan plan = listed_axis(request, option, {std::move(name), "deg", stepped(0.25, 360)});
    for (const double angle : plan.axis.values) require_in_range(option, angle, 0, 90);
    return plan;
}

bool amplifies(const Stack& stack, std::vector<double> wavelength_nm) {
    const IndexTable table(stack, std::move(wavelength_nm));
    return std::ranges::find(table.amplifies(), true) != table.amplifies().end();
}

LutMeasure relative_to(std::string name,
                       std::function<double(double alpha, double theta_i_deg)> scale) {
    return {std::move(name), [scale = std::move(scale)](const std::vector<LutAxis>& axes,
                                                        std::span<const double> exact,
                                                        std::span<const double> approximate) {
                std::vector<double> differences;
                for (const double alpha : axes[0].values)
                    for (const double theta_i_deg : axes[1].values) {
                        const double unit = scale(alpha, theta_i_deg);
                        for (std::size_t i = 0; i < axes[2].count(); ++i) {
                            const std::size_t at = differences.size();
                            const double off = std::abs(exact[at] - approximate[at]);
                            differences.push_back(unit > 0 ? off / unit : off);
                        }
                    }
                return differences;
            }};
}

std::string letter_of(Light light) {
    return light == Light::s ? "s" : light == Light::p ? "p" : "u";
}

double rounding_of(LutType type) {
    return type == LutType::f16 ? 1e-3 : type == LutType::f32 ? 1e-6 : 1e-11;
}

std::string place_in(const Lut& lut, std::size_t sample) {
    std::string text;
    for (auto axis = lut.axes.rbegin(); axis != lut.axes.rend(); ++axis) {
        const std::string here = axis->name + " " + to_text(axis->values[sample % axis->count()]);
        text = text.empty() ? here : here + ", " + text;
        sample /= axis->count();
    }
    return text;
}

std::vector<std::string> out_of_range(const Lut& lut,
                                      const std::function<double(std::size_t sample)>& most) {
    std::vector<std::string> problems;
    for (std::size_t i = 0; i < lut.values.size(); ++i) {
        const std::size_t sample = i / lut.channels.size();
        const double value = lut.values[i], highest = most(sample);
        if (value >= 0 && value <= highest) continue;
        if (problems.size() == kMostProblems) break;
        problems.push_back(lut.channels[i % lut.channels.size()] + " must be in [0, " +
                           to_text(highest) + "] at " + place_in(lut, sample) + " (got " +
                           to_text(value) + ")");
    }
    return problems;
}

}  // namespace irido::tables
