#include "core/color/quadrature/panel_sums.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/math/random.hpp"

using namespace irido;

namespace {

std::vector<double> random_numbers(std::size_t count, Random& random) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(random.uniform(-1, 1));
    return numbers;
}

}  // namespace

TEST_CASE("row sums are those of a plain loop") {
    Random random(3);
    for (const SimdLevel level : kSimdLevels) {
        if (!is_available(level)) continue;
        for (const std::size_t rows : {1, 2, 3, 6, 9, 17}) {
            for (const std::size_t stride : {8, 16, 40}) {
                const auto row = random_numbers(rows * stride, random);
                const auto values = random_numbers(stride, random);
                std::vector<double> sums(rows);
                row_sums(row.data(), rows, stride, values.data(), 0.25, sums.data(), level);
                for (std::size_t r = 0; r < rows; ++r) {
                    double sum = 0;
                    for (std::size_t j = 0; j < stride; ++j)
                        sum += row[r * stride + j] * (values[j] - 0.25);
                    CHECK(std::abs(sums[r] - sum) < 1e-14);  // summed in another order
                }
            }
        }
    }
}

TEST_CASE("the steepest logarithmic slope between neighbours") {
    Random random(4);
    constexpr std::size_t count = 13, stride = 16;
    const auto re = random_numbers(stride + 1, random), im = random_numbers(stride + 1, random);
    const auto varied = random_numbers(stride + 1, random);
    const std::vector<double> fixed(stride + 1, 0.7);
    std::vector<double> inverse(stride, 0);
    double largest = 0, largest_varied = 0;
    for (std::size_t j = 0; j + 1 < count; ++j) {
        inverse[j] = random.uniform(1, 20);
        const double step = std::hypot(re[j + 1] - re[j], im[j + 1] - im[j]);
        const double size = std::min(std::hypot(re[j], im[j]), std::hypot(re[j + 1], im[j + 1]));
        largest = std::max(largest, step * inverse[j] / size);
        largest_varied = std::max(largest_varied,
                                  (step / size + std::abs(varied[j + 1] - varied[j])) * inverse[j]);
    }
    for (const SimdLevel level : kSimdLevels) {
        if (!is_available(level)) continue;
        const auto steepest = [&](const std::vector<double>& log_scale) {
            return steepness(re.data(), im.data(), log_scale.data(), inverse.data(), stride, level);
        };
        CHECK(std::abs(steepest(fixed) - largest) < 1e-13 * largest);
        CHECK(std::abs(steepest(varied) - largest_varied) < 1e-13 * largest_varied);
    }
}

TEST_CASE("the steepness bounds the logarithmic slope, however a function is scaled") {
    // D = exp(sum of a few terms), for which D'/D is known; its scale is distributed at random
    Random random(5);
    constexpr std::size_t count = 33, stride = 40;
    for (int run = 0; run < 500; ++run) {
        const double turn = random.uniform(-4, 4), growth = random.uniform(-4, 4),
                     bend = random.uniform(-2, 2);
        std::vector<double> re(stride + 1, 0), im(re), log_scale(re), inverse(stride, 0);
        double largest = 0;
        const auto x = [&](std::size_t j) {
            return std::cos(3.141592653589793 * static_cast<double>(j) / (count - 1));
        };
        for (std::size_t j = 0; j < count; ++j) {
            const bool by_powers_of_two = run % 2 == 0;
            const double size = growth * x(j) + bend * x(j) * x(j);
            log_scale[j] = by_powers_of_two ? std::log(2) * std::round(random.uniform(-3, 3))
                                            : random.uniform(0, 1) * size;
            re[j] = std::exp(size - log_scale[j]) * std::cos(turn * x(j));
            im[j] = std::exp(size - log_scale[j]) * std::sin(turn * x(j));
            if (j + 1 == count) break;
            inverse[j] = 1 / (x(j) - x(j + 1));
            const double middle = (x(j) + x(j + 1)) / 2;  // where the mean slope of log D is exact
            largest = std::max(largest, std::hypot(growth + 2 * bend * middle, turn));
        }
        CAPTURE(run, turn, growth, bend);
        CHECK(1.05 * steepness(re.data(), im.data(), log_scale.data(), inverse.data(), stride,
                               SimdLevel::baseline) >=
              largest);
    }
}
