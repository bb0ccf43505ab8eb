#include "tables/lut/lut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/half.hpp"

namespace irido::tables {

namespace {

constexpr double kSpacingTolerance = 1e-9;

}  // namespace

std::string_view name_of(LutType type) {
    return type == LutType::f16 ? "f16" : type == LutType::f32 ? "f32" : "f64";
}

std::optional<LutType> find_lut_type(std::string_view name) {
    const auto* const found =
        std::ranges::find(kLutTypes, name, [](LutType type) { return name_of(type); });
    return found == kLutTypes.end() ? std::nullopt : std::optional(*found);
}

std::size_t bytes_of(LutType type) {
    return type == LutType::f16 ? 2 : type == LutType::f32 ? 4 : 8;
}

double rounded(double value, LutType type) {
    switch (type) {
        case LutType::f16:
            return rounded_to_half(value);
        case LutType::f32:
            return static_cast<double>(static_cast<float>(value));
        case LutType::f64:
            return value;
    }
    return value;
}

bool LutAxis::is_linear() const {
    const std::vector<double> even = equally_spaced(values.front(), values.back(), count());
    if (count() < 2) return true;
    const double spacing = std::abs(even[1] - even[0]);
    for (std::size_t i = 0; i < count(); ++i)
        if (std::abs(values[i] - even[i]) > kSpacingTolerance * spacing) return false;
    return true;
}

std::size_t LutAxis::cell_of(double x) const {
    const bool falls = values.back() < values.front();
    std::size_t i = 0;
    while (i + 2 < count() && (falls ? x < values[i + 1] : x > values[i + 1])) ++i;
    return i;
}

std::vector<double> LutAxis::spaced(std::size_t count) const {
    std::vector<double> result =
        equally_spaced(place_of(values.front()), place_of(values.back()), count);
    for (double& x : result) x = at_place(x);
    result.front() = values.front();
    if (count > 1) result.back() = values.back();
    return result;
}

std::vector<double> equally_spaced(double first, double last, std::size_t count) {
    std::vector<double> values(count, first);
    const auto intervals = static_cast<double>(count - 1);
    if (count > 1) values.back() = last;
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const auto x = static_cast<double>(i);
        values[i] = (first * (intervals - x) + last * x) / intervals;
    }
    return values;
}

std::vector<LutAxis> Lut::axes_of_level(std::size_t level) const {
    std::vector<LutAxis> result(axes.begin() + (mips ? 1 : 0), axes.end());
    if (level == 0) return result;
    for (LutAxis& axis : result)
        axis.values = equally_spaced(axis.values.front(), axis.values.back(),
                                     std::max<std::size_t>(1, axis.count() >> level));
    return result;
}

std::size_t Lut::values_of_level(std::size_t level) const {
    std::size_t count = channels.size();
    for (const LutAxis& axis : axes_of_level(level)) count *= axis.count();
    return count;
}

}  // namespace irido::tables
