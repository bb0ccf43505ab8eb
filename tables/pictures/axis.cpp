#include "tables/pictures/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace irido::tables {

namespace {

/// A curve is flat if its values differ by less than this fraction.
constexpr double kFlat = 1e-3;
constexpr const char* kMinus = "\u2212";
/// Larger coordinates are useless in any format.
constexpr double kFarthest = 20000;

/// The step of 1, 2 or 5 times a power of ten that gives at most `most` steps.
double round_step(double length, double most) {
    for (double decade = std::pow(10, std::floor(std::log10(length / most)));; decade *= 10)
        for (const double digit : {1.0, 2.0, 5.0})
            if (length <= most * digit * decade) return digit * decade;
}

std::string raised(int power) {
    constexpr std::array digits{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string out = power < 0 ? "\u207b" : "";
    for (const char digit : std::to_string(std::abs(power)))
        out += digits[static_cast<std::size_t>(digit - '0')];
    return out;
}

}  // namespace

std::string tick_text(double value, double step) {
    if (std::abs(value) < step * 1e-6) return "0";
    std::array<char, 48> text{};
    const double size = std::abs(value);
    const std::string sign = value < 0 ? kMinus : "";
    // numbers with many leading zeros become powers of ten
    if (size < 1e6 && (step >= 0.99e-4 || size > 1000 * step)) {
        const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
        std::snprintf(text.data(), text.size(), "%.*f", decimals, size);
        return sign + text.data();
    }
    const int digits =
        std::clamp(static_cast<int>(std::ceil(std::log10(size / step) - 1e-9)), 0, 12);
    std::snprintf(text.data(), text.size(), "%.*e", digits, size);
    std::string mantissa = text.data();
    const std::size_t e = mantissa.find('e');
    const int power = std::atoi(mantissa.c_str() + e + 1);
    mantissa.resize(e);
    if (mantissa.find('.') != std::string::npos) {
        mantissa.erase(mantissa.find_last_not_of('0') + 1);
        if (mantissa.back() == '.') mantissa.pop_back();
    }
    return sign + (mantissa == "1" ? "" : mantissa + "\u00b7") + "10" + raised(power);
}

AxisPlaces::AxisPlaces(const FigureAxis& axis, double low, double high, bool widen, double from,
                       double to)
    : axis_(axis), from_(from), to_(to) {
    // far from 0, or flat
    if (axis.from_zero && (low <= high / 2 || high - low < kFlat * high)) {
        low = std::min(low, 0.0);
        high = std::max(high, 0.0);
    }
    if (!(high > low)) {  // a single value: some room around it
        const double room = low == 0 ? 1 : std::abs(low) * 0.1;
        low = axis.from_zero ? 0 : low - room;
        high += room;
    } else if (widen && !axis.logarithmic) {
        const double step = round_step(high - low, 20);
        low = step * std::floor(low / step + 1e-9);
        high = step * std::ceil(high / step - 1e-9);
    }
    first_ = axis.first.value_or(low);
    last_ = axis.last.value_or(high);
    const double largest = std::max(std::abs(first_), std::abs(last_));
    if (!(largest < 1e290))
        throw PictureError("cannot draw numbers as large as these: " + axis.quantity);
    if (std::abs(last_ - first_) < 1e-12 * largest)
        throw PictureError("cannot tell the values apart: " + axis.quantity);
    if (axis.logarithmic && !(first_ > 0 && last_ > 0))
        throw PictureError("must be above 0 on an axis of powers of ten: " + axis.quantity);
}

double AxisPlaces::scaled(double value) const {
    if (!axis_.logarithmic) return (value - first_) / (last_ - first_);
    const double power = std::log10(std::max(value, 1e-300));
    return (power - std::log10(first_)) / (std::log10(last_) - std::log10(first_));
}

double AxisPlaces::operator()(double value) const {
    return std::clamp(from_ + (to_ - from_) * scaled(value), -kFarthest, kFarthest);
}

double AxisPlaces::value_at(double coordinate) const {
    const double part = (coordinate - from_) / (to_ - from_);
    if (!axis_.logarithmic) return first_ + part * (last_ - first_);
    return first_ * std::pow(last_ / first_, part);
}

std::vector<Tick> AxisPlaces::powers(double space) const {
    const double low = std::log10(std::min(first_, last_)),
                 high = std::log10(std::max(first_, last_));
    const double unit = std::abs(to_ - from_) / (high - low);
    const double step = std::max(1.0, std::ceil(space / unit));
    std::vector<Tick> ticks;
    for (double power = std::ceil(low - 1e-9); power <= high + 1e-9; power += step)
        ticks.push_back({std::pow(10, power), "10" + raised(static_cast<int>(power))});
    return ticks;
}

std::vector<Tick> AxisPlaces::ticks(double space) const {
    if (axis_.logarithmic) return powers(space);
    const double low = std::min(first_, last_), high = std::max(first_, last_);
    std::vector<Tick> ticks;
    if (!axis_.names.empty()) {
        for (std::size_t i = 0; i < axis_.names.size(); ++i)
            ticks.push_back({static_cast<double>(i), axis_.names[i]});
        return ticks;
    }
    const double most = std::max(1.0, std::abs(to_ - from_) / space);
    double step = axis_.step > 0 ? axis_.step : round_step(high - low, most);
    if ((high - low) / step > 4 * most) step = round_step(high - low, most);
    for (double i = std::ceil(low / step - 1e-6); i * step <= high + 1e-6 * step; ++i)
        ticks.push_back({i * step, tick_text(i * step, step)});
    return ticks;
}

}  // namespace irido::tables
