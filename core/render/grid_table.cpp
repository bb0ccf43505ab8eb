#include "core/render/grid_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/parallel.hpp"
#include "core/render/as_array.hpp"

namespace irido {

namespace {

constexpr std::size_t kFewest = 5;  ///< samples of an axis
constexpr double kCubicGain = 8;    ///< at least, of halving the spacing of cubics: 16 in the limit

/// Four neighbouring samples and their weights; fewer at an axis of one sample.
struct Stencil {
    std::size_t first = 0, count = 1;
    std::array<double, 4> weight{1, 0, 0, 0};
};

/// At a place in units of samples from the first.
Stencil stencil(double place, std::size_t count) {
    if (count == 1) return {};
    const auto last = static_cast<double>(count - 4);
    const double first = std::clamp(std::floor(place) - 1, 0.0, last);
    const double t = place - first;  // between 1 and 2 but for the ends
    const double a = t, b = t - 1, c = t - 2, d = t - 3;
    return {static_cast<std::size_t>(first),
            4,
            {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6}};
}

}  // namespace

double GridTable::cosine(double index, std::size_t count) const {
    const ShownRange& r = plan_.range;
    if (count == 1) return r.least_cosine;
    return std::lerp(r.least_cosine, r.largest_cosine, index / static_cast<double>(count - 1));
}

double GridTable::thickness(double index, std::size_t count) const {
    const ShownRange& r = plan_.range;
    if (count == 1) return r.least_nm;
    return std::lerp(r.least_nm, r.largest_nm, index / static_cast<double>(count - 1));
}

GridTable::GridTable(const Plan& plan, const Function& function, const Distance& distance)
    : plan_(plan),
      cosines_(plan.range.has_one_angle() ? 1 : kFewest),
      thicknesses_(plan.range.is_uniform() ? 1 : kFewest) {
    values_.resize(cosines_ * thicknesses_ * plan_.channels);
    std::vector<double> all;
    for (std::size_t i = 0; i < cosines_; ++i)
        all.push_back(cosine(static_cast<double>(i), cosines_));
    parallel_for(thicknesses_, plan_.threads, [&](std::size_t t) {
        function(thickness(static_cast<double>(t), thicknesses_), all,
                 std::span(values_).subspan(at(t, 0), cosines_ * plan_.channels));
    });
    evaluations_ = cosines_ * thicknesses_;
    const auto has_room = [&] { return 2 * cosines_ * thicknesses_ <= plan_.most_samples; };
    // errors of the grid before it was last refined along an axis
    constexpr double kUnknown = 1e300;
    double of_cosines = cosines_ == 1 ? 0 : kUnknown;
    double of_thicknesses = thicknesses_ == 1 ? 0 : kUnknown;
    for (;;) {
        const double wanted = kCubicGain * plan_.tolerance / 2;
        while (of_cosines > wanted || of_thicknesses > wanted) {
            if (!has_room()) return;
            (of_cosines >= of_thicknesses ? of_cosines : of_thicknesses) =
                of_cosines >= of_thicknesses ? refine_cosines(function, distance)
                                             : refine_thicknesses(function, distance);
        }
        const double along = cosines_ == 1 ? 0 : measured(function, distance, true);
        const double across = thicknesses_ == 1 ? 0 : measured(function, distance, false);
        error_ = along + across;
        if (error_ <= plan_.tolerance) break;
        (along >= across ? of_cosines : of_thicknesses) = kUnknown;
    }
    is_good_ = true;
}

double GridTable::refine_cosines(const Function& function, const Distance& distance) {
    const std::size_t count = 2 * cosines_ - 1, added = cosines_ - 1, width = plan_.channels;
    std::vector<float> finer(count * thicknesses_ * width);
    std::vector<double> worst(thicknesses_), between;
    for (std::size_t i = 0; i < added; ++i)
        between.push_back(cosine(static_cast<double>(2 * i + 1), count));
    parallel_for(thicknesses_, plan_.threads, [&](std::size_t t) {
        std::vector<float> fresh(added * width), old(width);
        const double nm = thickness(static_cast<double>(t), thicknesses_);
        function(nm, between, fresh);
        for (std::size_t i = 0; i < count; ++i) {
            const float* from = i % 2 == 0 ? &values_[at(t, i / 2)] : &fresh[i / 2 * width];
            std::copy_n(from, width, &finer[(t * count + i) * width]);
            if (i % 2 == 0) continue;
            lookup(between[i / 2], nm, old);
            worst[t] =
                std::max(worst[t], distance(std::span(fresh).subspan(i / 2 * width, width), old));
        }
    });
    evaluations_ += added * thicknesses_;
    values_ = std::move(finer);
    cosines_ = count;
    return std::ranges::max(worst);
}

double GridTable::refine_thicknesses(const Function& function, const Distance& distance) {
    const std::size_t count = 2 * thicknesses_ - 1, added = thicknesses_ - 1;
    const std::size_t width = plan_.channels, row = cosines_ * width;
    std::vector<float> finer(count * row);
    std::vector<double> worst(added), all;
    for (std::size_t i = 0; i < cosines_; ++i)
        all.push_back(cosine(static_cast<double>(i), cosines_));
    for (std::size_t t = 0; t < thicknesses_; ++t)
        std::copy_n(&values_[at(t, 0)], row, &finer[2 * t * row]);
    parallel_for(added, plan_.threads, [&](std::size_t t) {
        const double nm = thickness(static_cast<double>(2 * t + 1), count);
        const auto fresh = std::span(finer).subspan((2 * t + 1) * row, row);
        std::vector<float> old(width);
        function(nm, all, fresh);
        for (std::size_t i = 0; i < cosines_; ++i) {
            lookup(all[i], nm, old);
            worst[t] = std::max(worst[t], distance(fresh.subspan(i * width, width), old));
        }
    });
    evaluations_ += added * cosines_;
    values_ = std::move(finer);
    thicknesses_ = count;
    return std::ranges::max(worst);
}

/// In the middle between samples along one axis, at about a tenth of those of the other.
double GridTable::measured(const Function& function, const Distance& distance, bool along_cosines) {
    constexpr std::size_t kPart = 10;
    const std::size_t width = plan_.channels;
    std::vector<double> cosines, thicknesses;
    const std::size_t cosine_step = along_cosines ? 1 : kPart;
    for (std::size_t i = 0; i == 0 || i + 1 < cosines_; i += cosine_step)
        cosines.push_back(cosine(static_cast<double>(i) + (along_cosines ? 0.5 : 0.0), cosines_));
    const std::size_t thickness_step = along_cosines ? kPart : 1;
    for (std::size_t t = 0; t == 0 || t + 1 < thicknesses_; t += thickness_step)
        thicknesses.push_back(
            thickness(static_cast<double>(t) + (along_cosines ? 0.0 : 0.5), thicknesses_));
    std::vector<double> worst(thicknesses.size());
    parallel_for(thicknesses.size(), plan_.threads, [&](std::size_t t) {
        std::vector<float> exact(cosines.size() * width), table(width);
        function(thicknesses[t], cosines, exact);
        for (std::size_t i = 0; i < cosines.size(); ++i) {
            lookup(cosines[i], thicknesses[t], table);
            worst[t] =
                std::max(worst[t], distance(std::span(exact).subspan(i * width, width), table));
        }
    });
    evaluations_ += cosines.size() * thicknesses.size();
    return std::ranges::max(worst);
}

void GridTable::lookup(double cosine, double thickness_nm, std::span<float> values) const {
    const ShownRange& r = plan_.range;
    const auto place = [](double x, double first, double last, std::size_t count) {
        if (count == 1) return 0.0;
        const auto cells = static_cast<double>(count - 1);
        return std::clamp((x - first) / (last - first) * cells, 0.0, cells);
    };
    const Stencil c = stencil(place(cosine, r.least_cosine, r.largest_cosine, cosines_), cosines_);
    const Stencil t =
        stencil(place(thickness_nm, r.least_nm, r.largest_nm, thicknesses_), thicknesses_);
    auto sum = as_array(values);
    sum.setZero();
    for (std::size_t j = 0; j < t.count; ++j) {
        const auto weight = [&](std::size_t i) {
            return static_cast<float>(t.weight[j] * c.weight[i]);
        };
        const auto sample = [&](std::size_t i) {
            return as_array(
                std::span(values_).subspan(at(t.first + j, c.first + i), values.size()));
        };
        if (c.count == 1)
            sum += weight(0) * sample(0);
        else
            sum += weight(0) * sample(0) + weight(1) * sample(1) + weight(2) * sample(2) +
                   weight(3) * sample(3);
    }
}

}  // namespace irido
