#include "cli/options/long_work.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <thread>

#include "core/error.hpp"
#include "core/spectrum/stack_power.hpp"

namespace irido::cli {

namespace {

/// `count` of the samples, evenly spread.
std::vector<double> some_of(const std::vector<double>& samples, std::size_t count) {
    std::vector<double> some;
    for (std::size_t i = 0; i < count; ++i)
        some.push_back(samples[(2 * i + 1) * samples.size() / (2 * count)]);
    return some;
}

/// A part of the plan's grid with at least that many samples, or the whole grid.
std::vector<tables::LutAxis> part_of_grid(const tables::LutPlan& plan, double samples) {
    std::vector<std::size_t> counts(plan.axes.size(), 1);
    double product = 1;
    for (bool grows = true; grows && product < samples;) {
        grows = false;
        for (std::size_t a = 0; a < counts.size() && product < samples; ++a) {
            const std::size_t more = std::min(2 * counts[a], plan.axes[a].axis.count());
            grows = grows || more > counts[a];
            product *= static_cast<double>(more) / static_cast<double>(counts[a]);
            counts[a] = more;
        }
    }
    std::vector<tables::LutAxis> part;
    for (std::size_t a = 0; a < counts.size(); ++a) {
        part.push_back(plan.axes[a].axis);
        part.back().values = some_of(part.back().values, counts[a]);
    }
    return part;
}

double samples_of(const std::vector<tables::LutAxis>& axes) {
    double samples = 1;
    for (const tables::LutAxis& axis : axes) samples *= static_cast<double>(axis.count());
    return samples;
}

}  // namespace

unsigned threads_used(unsigned asked) {
    return asked > 0 ? asked : std::max(1U, std::thread::hardware_concurrency());
}

double tried_seconds(double units, double first,
                     const std::function<double(double units)>& seconds_of, double long_s) {
    constexpr double kTold_s = 0.1, kLittle = 0.05;
    double all = 0;
    try {
        double tried = first;
        while (tried <= kLittle * units) {
            const double seconds = seconds_of(tried);
            all = seconds * units / tried;
            if (seconds >= kTold_s || (seconds > 0 && all < long_s)) break;
            tried *= 2;
        }
    } catch (const std::exception&) {
        return 0;
    }
    return all;
}

bool is_slow(const tables::LutKind& kind, const tables::LutRequest& request) {
    try {
        return kind.color && StackPower(request.document.stack).spread_layers() ==
                                 StackPower::kLargestSpreadLayers;
    } catch (const DomainError&) {  // the plan will report it
        return false;
    }
}

double least_seconds(const tables::LutPlan& plan, const tables::LutMaking& making, double share) {
    const auto seconds_of = [&](double samples) {
        const std::vector<tables::LutAxis> axes = part_of_grid(plan, samples);
        return processor_seconds([&] { plan.evaluate(axes); }) * samples / samples_of(axes) /
               threads_used(making.threads);
    };
    return tried_seconds(tables::least_evaluations(plan, making), 1, seconds_of,
                         share * kLongWork_s);
}

std::string coarse_time(double seconds) {
    constexpr double kMinute = 60, kHour = 3600, kDay = 86400;
    const auto text = [](double number, const char* unit) {
        std::array<char, 64> out{};
        const double scale = number < 10 ? 1 : std::pow(10, std::floor(std::log10(number)) - 1);
        const double rounded = std::max(1.0, std::round(number / scale) * scale);
        std::snprintf(out.data(), out.size(), "%.0f %s%s", rounded, unit,
                      rounded == 1 || *unit == 's' ? "" : "s");
        return std::string(out.data());
    };
    if (seconds < kMinute) return text(seconds, "s");
    if (seconds < kHour) return text(seconds / kMinute, "minute");
    if (seconds < 2 * kDay) return text(seconds / kHour, "hour");
    return text(seconds / kDay, "day");
}

void note_long_work(double seconds, bool is_least,
                    const std::function<void(const std::string&)>& say) {
    if (seconds < kLongWork_s) return;
    say("this will take about " + coarse_time(seconds) + (is_least ? ", or longer" : ""));
}

}  // namespace irido::cli
