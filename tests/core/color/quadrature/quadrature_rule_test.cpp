#include "core/color/quadrature/quadrature_rule.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/colorimetry/illuminant.hpp"
#include "core/math/random.hpp"
#include "core/math/square.hpp"

using namespace irido;

namespace {

const Sensitivity& d65() {
    static const Sensitivity sensitivity(observer(2), illuminant("D65"));
    return sensitivity;
}

std::vector<double> sums_of(const QuadratureRule& rule, const std::function<double(double)>& f) {
    std::vector<double> values(rule.stride, 0), sums(rule.sum_count());
    for (std::size_t j = 0; j < rule.points; ++j) values[j] = f(rule.x[j]);
    rule.sum(values.data(), 0, sums.data(), SimdLevel::baseline);
    return sums;
}

double chebyshev(std::size_t k, double x) {
    return std::cos(static_cast<double>(k) * std::acos(x));
}

}  // namespace

TEST_CASE("the rows of a rule are moments and coefficients of Chebyshev polynomials") {
    for (const std::size_t degree : kDegrees) {
        const QuadratureRule rule(d65(), {420, 555}, degree);
        const PanelRule panel = panel_rule(d65(), {420, 555}, degree);
        for (std::size_t k = 0; k <= degree; ++k) {
            const auto sums = sums_of(rule, [&](double x) { return chebyshev(k, x); });
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(std::abs(sums[c] - panel.moment[c][k]) < 1e-14);
            const auto is_one = [&](std::size_t row, std::size_t of) {
                CHECK(std::abs(sums[row] - (k == of ? 1.0 : 0.0)) < 1e-13);
            };
            for (std::size_t t = 0; t < rule.middle; ++t)
                is_one(3 + t, degree / 2 + 1 - rule.middle + t);
            for (std::size_t t = 0; t < rule.tail; ++t)
                is_one(3 + rule.middle + t, degree + 1 - rule.tail + t);
        }
    }
}

TEST_CASE("the light of a panel adds to the white") {
    const QuadratureRule left(d65(), {360, 540.5}, 8), right(d65(), {540.5, 830}, 16);
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(left.light[c] + right.light[c] - 1) < 1e-14);
}

TEST_CASE("the error of a rule bounds that of fringes and of poles off the panel") {
    const WavelengthRange panel{400, 700};
    const QuadratureRule fine(d65(), panel, 128);
    for (const std::size_t degree : {16, 32, 64}) {
        const QuadratureRule rule(d65(), panel, degree);
        const auto check = [&](const std::function<double(double)>& f) {
            const auto exact = sums_of(fine, f), sums = sums_of(rule, f);
            const Triple error = rule.error(sums, 0);
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(std::abs(sums[c] - exact[c]) <= error[c] + 1e-14);  // rounding
        };
        for (const double turn : {0.3, 2.0, 7.0, 15.0, 25.0})
            for (const double phase : {0.0, 1.0, 1.5707})
                check([&](double x) { return 0.5 + 0.5 * std::cos(turn * x + phase); });
        for (const double at : {-0.9, -0.2, 0.35, 0.97})
            for (const double width : {0.3, 0.6, 1.5})
                check([&](double x) { return 1 / (1 + std::pow((x - at) / width, 2)); });
    }
}

TEST_CASE("the error of a rule bounds that of square roots in the panel") {
    const WavelengthRange panel{520, 560};
    Random random(3);
    for (int trial = 0; trial < 12; ++trial) {
        const double nm = random.uniform(panel.first_nm, panel.last_nm);
        const auto f = [&](double at_nm) { return std::sqrt(std::max(0.0, 1 / at_nm - 1 / nm)); };
        const double largest = f(panel.first_nm);
        // short panels next to the root, where it is
        Triple exact{};
        double width = nm - panel.first_nm, to = panel.first_nm;
        for (int i = 0; i < 40; ++i) {
            const double from = to;
            to = i < 39 ? nm - (width /= 2) : nm;
            const QuadratureRule part(d65(), {from, to}, 32);
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t j = 0; j < part.points; ++j)
                    exact[c] += part.weights[c * part.stride + j] * f(part.wavelength_nm[j]);
        }
        for (const std::size_t degree : kDegrees) {
            const QuadratureRule rule(d65(), panel, degree);
            std::vector<double> values(rule.stride, 0), sums(rule.sum_count());
            for (std::size_t j = 0; j < rule.points; ++j) values[j] = f(rule.wavelength_nm[j]);
            rule.sum(values.data(), 0, sums.data(), SimdLevel::baseline);
            const Triple error = rule.error_with_root(sums);
            CAPTURE(nm, degree);
            for (std::size_t c = 0; c < 3; ++c) {
                CHECK(std::abs(sums[c] - exact[c]) <= error[c]);
                CHECK(error[c] < 200 / square(static_cast<double>(degree)) * largest *
                                     rule.light[c] * d65().white()[c]);
            }
        }
    }
}
