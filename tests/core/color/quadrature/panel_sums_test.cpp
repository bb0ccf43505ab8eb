#include "core/color/quadrature/panel_sums.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
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
                    CHECK(std::abs(sums[r] - sum) < 1e-14);  // roundings in another order
                }
            }
        }
    }
}

TEST_CASE("the steepest logarithmic slope between neighbours") {
    Random random(4);
    constexpr std::size_t count = 13, stride = 16;
    const auto re = random_numbers(stride + 1, random), im = random_numbers(stride + 1, random);
    std::vector<double> inverse(stride, 0), log_scale(stride + 1, 0.7);
    double largest = 0;
    for (std::size_t j = 0; j + 1 < count; ++j) {
        inverse[j] = random.uniform(1, 20);
        const double step = std::hypot(re[j + 1] - re[j], im[j + 1] - im[j]);
        const double size = std::min(std::hypot(re[j], im[j]), std::hypot(re[j + 1], im[j + 1]));
        largest = std::max(largest, step * inverse[j] / size);
    }
    for (const SimdLevel level : kSimdLevels) {
        if (!is_available(level)) continue;
        const auto steepest = [&] {
            return steepness(re.data(), im.data(), log_scale.data(), inverse.data(), count, stride,
                             level);
        };
        CHECK(std::abs(steepest() - largest) < 1e-13 * largest);
        log_scale[5] = 0.8;
        CHECK(steepest() == std::numeric_limits<double>::infinity());
        log_scale[5] = 0.7;
    }
}
