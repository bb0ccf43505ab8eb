#include "core/color/integration.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/color/illuminant.hpp"
#include "core/error.hpp"
#include "tests/oracle/color_oracle.hpp"

using namespace irido;
using Catch::WithinAbs;

namespace {

constexpr WavelengthRange kVisible{360, 830};

const Sensitivity& d65() {
    static const Sensitivity sensitivity(observer(2), illuminant("D65"));
    return sensitivity;
}

/// One spectrum per item: f(item, wavelength).
template <class F>
std::vector<ColorIntegral> integrate(std::size_t items, const IntegrationLimits& limits, F f,
                                     const std::vector<SpectralPanel>& panels = {{kVisible, 4}}) {
    const SpectraAt spectra = [&](std::span<const double> wavelength_nm,
                                  std::span<const std::size_t> asked,
                                  std::span<SpectrumSample> samples) {
        for (std::size_t i = 0; i < asked.size(); ++i)
            for (std::size_t w = 0; w < wavelength_nm.size(); ++w)
                samples[i * wavelength_nm.size() + w].value = f(asked[i], wavelength_nm[w]);
    };
    return integrate_color(d65(), panels, items, spectra, limits);
}

double largest_error(const Triple& a, const Triple& b) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
    return largest;
}

}  // namespace

TEST_CASE("a spectrum of one is exactly the white") {
    const std::vector<SpectralPanel> panels{{{360, 401.7}, 3}, {{401.7, 600}, 90}, {{600, 830}, 1}};
    const auto result = integrate(
        2, {}, [](std::size_t i, double) { return i == 0 ? 1.0 : 0.0; }, panels);
    CHECK(result[0].xyz == d65().white());
    CHECK(result[1].xyz == Triple{0, 0, 0});
    CHECK(result[0].error <= 1e-6);
}

TEST_CASE("polynomials in 1 / lambda are integrated exactly") {
    const auto f = [](std::size_t power, double nm) {
        return std::pow(360 / nm, static_cast<double>(power));
    };
    const auto result = integrate(7, {.tolerance = 1e-12}, f);
    for (std::size_t power = 0; power < 7; ++power) {
        const Triple exact = oracle::integrate([&](double nm) { return f(power, nm); }, observer(2),
                                               illuminant("D65"), {}, 1e-14);
        CHECK(largest_error(result[power].xyz, exact) < 1e-14);
    }
}

TEST_CASE("kinks between panels cost nothing") {
    const auto f = [](std::size_t, double nm) { return std::abs(nm - 543.21) / 300; };
    const Triple exact = oracle::integrate([&](double nm) { return f(0, nm); }, observer(2),
                                           illuminant("D65"), {543.21}, 1e-14);
    const std::vector<SpectralPanel> panels{{{360, 543.21}, 1}, {{543.21, 830}, 1}};
    const auto result = integrate(1, {.tolerance = 1e-11}, f, panels);
    CHECK(largest_error(result[0].xyz, exact) < 1e-11);
    CHECK(result[0].evaluations < 200);
}

TEST_CASE("items that are done do not pay for those that are not") {
    const auto f = [](std::size_t item, double nm) {
        return item == 0 ? 0.5 + 0.001 * std::sin(nm / 100) : 1 / (1 + std::pow((nm - 555) / 2, 2));
    };
    const auto result = integrate(2, {}, f);
    CHECK(result[0].evaluations < 100);
    CHECK(result[1].evaluations > 200);
    const Triple peak = oracle::integrate([&](double nm) { return f(1, nm); }, observer(2),
                                          illuminant("D65"), {}, 1e-12);
    CHECK(largest_error(result[1].xyz, peak) < 1e-6);
    const auto alone = integrate(1, {}, [&](std::size_t, double nm) { return f(1, nm); });
    CHECK(alone[0].xyz == result[1].xyz);
}

TEST_CASE("a spectrum that cannot be resolved says so, and ends") {
    // 2e5 turns over the visible, and a step in every nm
    const auto fringes = [](std::size_t, double nm) { return 0.5 + 0.5 * std::cos(1e9 / nm); };
    const auto steps = [](std::size_t, double nm) { return std::fmod(nm * 7.3, 1.0); };
    for (const std::size_t limit : {std::size_t{2000}, std::size_t{20000}}) {
        const IntegrationLimits limits{.tolerance = 1e-6, .evaluations = limit};
        for (const auto& result :
             {integrate(1, limits, fringes)[0], integrate(1, limits, steps)[0]}) {
            CHECK(result.error > 1e-6);
            CHECK(result.evaluations >= limit);
            // what was begun is ended: one panel per bisection that was under way
            CHECK(result.evaluations < limit + 129 * 30);
        }
    }
}

TEST_CASE("a tolerance outside 1e-12 to 1 is refused") {
    const auto one = [](std::size_t, double) { return 1.0; };
    for (const double tolerance :
         {0.0, -1.0, 0.9e-12, 1.1, std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(integrate(1, {.tolerance = tolerance}, one), DomainError);
    CHECK_NOTHROW(integrate(1, {.tolerance = 1}, one));
    CHECK_NOTHROW(integrate(1, {.tolerance = 1e-12}, one));
}
