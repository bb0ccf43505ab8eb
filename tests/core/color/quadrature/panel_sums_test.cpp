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

TEST_CASE("denominators at other points, and the powers that follow, are those of a plain loop") {
    Random random(5);
    for (const SimdLevel level : kSimdLevels) {
        if (!is_available(level)) continue;
        for (const std::size_t denominators : {1, 2})
            for (const std::size_t inputs : {5, 17})
                for (const std::size_t stride : {8, 16, 40}) {
                    CAPTURE(name_of(level), denominators, inputs, stride);
                    const auto columns = random_numbers(inputs * stride, random);
                    std::vector<std::vector<double>> in, out(4, std::vector<double>(stride));
                    std::vector<const double*> from;
                    std::vector<double*> to;
                    for (std::size_t r = 0; r < 4; ++r)
                        in.push_back(random_numbers(inputs, random));
                    for (std::size_t r = 0; r < 4; ++r) from.push_back(in[r].data());
                    for (std::size_t r = 0; r < 4; ++r) to.push_back(out[r].data());
                    const std::vector<double> flux{0.3, 0.7};
                    std::vector<double> R(stride, 2), T(stride, 2);
                    const double scale = 1 / static_cast<double>(denominators);
                    resampled_denominators(columns.data(), inputs, stride, denominators,
                                           from.data(), to.data(), flux.data(),
                                           {scale, R.data(), T.data()}, level);
                    std::vector<std::vector<double>> again = out;
                    for (std::size_t r = 0; r < 4; ++r) to[r] = again[r].data();
                    resampled_denominators(columns.data(), inputs, stride, denominators,
                                           from.data(), to.data(), flux.data(), {}, level);
                    CHECK(again == out);
                    for (std::size_t j = 0; j < stride; ++j) {
                        std::vector<double> part(4);
                        for (std::size_t r = 0; r < 2 * denominators; ++r) {
                            for (std::size_t i = 0; i < inputs; ++i)
                                part[r] += columns[i * stride + j] * in[r][i];
                            CHECK(std::abs(out[r][j] - part[r]) < 1e-14);
                        }
                        double sum = 0;
                        for (std::size_t d = 0; d < denominators; ++d)
                            sum += flux[d] /
                                   (part[2 * d] * part[2 * d] + part[2 * d + 1] * part[2 * d + 1]);
                        const double most = std::min(1.0, scale * sum);
                        CHECK(std::abs(T[j] - most) < 1e-10);
                        CHECK(R[j] == 1 - T[j]);
                    }
                }
    }
}
