#include "core/thickness/fringe_series.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/math/constants.hpp"
#include "core/math/imaginary.hpp"
#include "core/spectrum/stack_power.hpp"

using namespace irido;
using Catch::WithinAbs;

namespace {

/// The same mean by quadrature.
MeanFringes quadrature(const Fringes& f, double mean_nm, double sigma_nm) {
    std::array<double, 2> mean{};
    const ThicknessFunction at = [&](double d, double phase, std::span<double> values) {
        const Complex trip = std::exp(kI * (f.turn_per_nm * d + phase));
        const Complex denominator = 1.0 + f.bounce * trip;
        values[0] = std::norm(f.near + f.far * trip) / std::norm(denominator);
        values[1] = f.through * std::abs(trip) / std::norm(denominator);
        return denominator;
    };
    thickness_mean({mean_nm, sigma_nm, f.turn_per_nm, true}, at, mean);
    return {mean[0], mean[1]};
}

}  // namespace

TEST_CASE("series of fringes agree with quadrature over the thickness") {
    std::mt19937_64 random(5);
    const auto uniform = [&](double a, double b) {
        return a + (b - a) * std::generate_canonical<double, 53>(random);
    };
    int answered = 0;
    for (int i = 0; i < 3000; ++i) {
        const double largest = i % 3 == 0 ? 0.97 : 0.6;
        const Complex bounce = std::polar(uniform(0, largest), uniform(0, kTwoPi));
        const Complex near = std::polar(uniform(0, 1), uniform(0, kTwoPi));
        const Complex far = std::polar(uniform(0, 1), uniform(0, kTwoPi));
        const double loss = i % 2 == 0 ? 0 : std::pow(10, uniform(-9, 0.5));
        const Complex turn{i % 7 == 0 ? 1e-3 : 0.03, 0.03 * loss};
        const double sigma = std::pow(10, uniform(-2, 2.5));
        const double mean = sigma * (i % 5 == 0 ? uniform(0, 1) : uniform(0, 30));
        const Fringes fringes{near, far, bounce, uniform(0, 1), turn};
        const auto series = mean_fringes(fringes, mean, sigma);
        if (!series) continue;
        ++answered;
        CAPTURE(i, bounce, near, far, turn, sigma, mean);
        const double scale = 1 / std::pow(1 - std::abs(bounce), 2);
        const MeanFringes exact = quadrature(fringes, mean, sigma);
        CHECK_THAT(series->R, WithinAbs(exact.R, kThicknessMeanError * scale));
        CHECK_THAT(series->T, WithinAbs(exact.T, kThicknessMeanError * scale));
    }
    CHECK(answered > 2000);
}

TEST_CASE("series of fringes are left where they converge slowly or amplify") {
    const Fringes slow{0, 1, 0.9999, 1, 0.03};
    CHECK_FALSE(mean_fringes(slow, 500, 10));
    const Fringes amplifies{0, 1, 1.5, 1, 0.03};
    CHECK_FALSE(mean_fringes(amplifies, 500, 10));
    const Fringes critical{0, 1, std::nan(""), 1, 0};
    CHECK_FALSE(mean_fringes(critical, 500, 10));
}

TEST_CASE("means of stacks do not depend on whether absorptance keeps its digits") {
    std::mt19937_64 random(6);
    const auto uniform = [&](double a, double b) {
        return a + (b - a) * std::generate_canonical<double, 53>(random);
    };
    for (int i = 0; i < 1500; ++i) {
        const auto index = [&] {
            const double k = i % 2 == 0 ? 0 : std::pow(10, uniform(-8, 0.5));
            return Complex{uniform(1, 3), uniform(0, 1) < 0.5 ? 0 : k};
        };
        Stack stack;
        const std::size_t layers = static_cast<std::size_t>(uniform(1, 4));
        const std::size_t spread =
            static_cast<std::size_t>(uniform(0, static_cast<double>(layers)));
        std::vector<Complex> indices;
        for (std::size_t j = 0; j < layers; ++j) {
            indices.push_back(index());
            Layer layer;
            layer.material = j;
            layer.thickness_nm = uniform(0, 1000);
            if (j == spread) layer.thickness_sigma_nm = std::pow(10, uniform(-1, 2.5));
            stack.elements.push_back({layer});
        }
        indices.push_back(index());
        stack.substrate = layers;
        const double sin2 = std::pow(std::sin(uniform(0, 1.5)), 2);
        std::vector<Medium> media;
        for (const Complex n : indices) media.push_back({n * n, n * n - sin2});
        media.push_back({1, 1 - sin2});
        stack.incident = layers + 1;
        CAPTURE(i, layers, spread);
        const double k0 = kTwoPi / uniform(380, 780);
        for (const Polarization polarization : {Polarization::s, Polarization::p}) {
            const StackPower power(stack);
            const Power full = power(media, k0, polarization).power;
            const Power fast = power(media, k0, polarization, {true, false}).power;
            CHECK_THAT(fast.R, WithinAbs(full.R, 2 * kThicknessMeanError));
            CHECK_THAT(fast.T, WithinAbs(full.T, 2 * kThicknessMeanError));
            CHECK_THAT(full.R + full.T + full.A, WithinAbs(1, 2 * kThicknessMeanError));
        }
    }
}
