#include "core/render/environment_sampler.hpp"

#include <algorithm>
#include <numeric>

#include "core/math/constants.hpp"

namespace irido {

namespace {

constexpr std::size_t kColumns = 512, kRows = 256;  ///< rows of equal height along y

/// The direction at a place in units of cells.
Vector3 at_place(double column, double row) {
    const double y = 1 - 2 * row / kRows, phi = kTwoPi * column / kColumns;
    const double across = std::sqrt(std::max(0.0, 1 - y * y));
    return {across * std::sin(phi), y, across * std::cos(phi)};
}

}  // namespace

EnvironmentSampler::EnvironmentSampler(const Environment& environment) {
    constexpr int kPoints = 2;       // along each side of a cell
    constexpr double kLeast = 0.05;  // of the mean, for what the points miss
    std::vector<double> light;
    for (std::size_t row = 0; row < kRows; ++row)
        for (std::size_t column = 0; column < kColumns; ++column) {
            double sum = 0;
            for (int j = 0; j < kPoints; ++j)
                for (int i = 0; i < kPoints; ++i) {
                    const Triple rgb =
                        environment(at_place(static_cast<double>(column) + (i + 0.5) / kPoints,
                                             static_cast<double>(row) + (j + 0.5) / kPoints));
                    sum += rgb[0] + rgb[1] + rgb[2];
                }
            light.push_back(sum);
        }
    const auto [least, most] = std::ranges::minmax(light);
    is_uniform_ = least == most;
    const double mean =
        std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
    const double whole = static_cast<double>(light.size()) * mean * (1 + kLeast);
    double sum = 0;
    for (const double cell : light) {
        sum += whole > 0 ? (cell + kLeast * mean) / whole : 1 / static_cast<double>(light.size());
        sums_.push_back(sum);
    }
    sums_.back() = 1;
}

Vector3 EnvironmentSampler::direction(double u, double v) const {
    const auto found = std::min(std::ranges::upper_bound(sums_, u), sums_.end() - 1);
    const auto cell = static_cast<std::size_t>(found - sums_.begin());
    const double before = cell == 0 ? 0 : sums_[cell - 1];
    const double part = std::clamp((u - before) / (*found - before), 0.0, 1.0);
    return at_place(static_cast<double>(cell % kColumns) + part,
                    static_cast<double>(cell / kColumns) + v);
}

double EnvironmentSampler::density(const Vector3& direction) const {
    const auto index = [](double place, std::size_t count) {
        return std::min(count - 1, static_cast<std::size_t>(std::max(0.0, place)));
    };
    const double turn = std::atan2(direction.x, direction.z) / kTwoPi;
    const std::size_t row = index((1 - direction.y) / 2 * kRows, kRows);
    const std::size_t column = index((turn < 0 ? turn + 1 : turn) * kColumns, kColumns);
    const std::size_t cell = row * kColumns + column;
    const double probability = sums_[cell] - (cell == 0 ? 0 : sums_[cell - 1]);
    return probability * static_cast<double>(kRows * kColumns) / (4 * kPi);
}

}  // namespace irido
