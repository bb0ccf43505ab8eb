#include "core/color/quadrature/integration.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "tests/oracle/color_oracle.hpp"
#include "tests/support/d65_tables.hpp"

using namespace irido;
using Catch::WithinAbs;
using test::d65_tables;

namespace {

constexpr WavelengthRange kVisible{360, 830};

const Sensitivity& d65() {
    return d65_tables().sensitivity();
}

ColorIntegral integrate(const IntegrationLimits& limits,
                        const std::function<double(double wavelength_nm)>& f,
                        const std::vector<SpectralPanel>& panels = {{kVisible, 4}}) {
    PanelTree tree(d65_tables(), [](std::vector<double> wavelength_nm, const IndexFit*) {
        return SpectralPoints{std::move(wavelength_nm), nullptr};
    });
    const SampleAt sample = [&](std::span<const SpectralPoints* const> parts, Samples& samples) {
        double* row = samples.row(0);
        for (const SpectralPoints* part : parts)
            for (const double nm : part->wavelength_nm) *row++ = f(nm);
    };
    IntegrationMemory memory;
    ColorIntegral result;
    integrate_color(d65(), tree.start(panels, limits.tolerance), 0, sample, limits, memory,
                    {&result, 1});
    return result;
}

double largest_error(const Triple& a, const Triple& b) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
    return largest;
}

}  // namespace

TEST_CASE("a spectrum of one is exactly the white") {
    const std::vector<SpectralPanel> panels{{{360, 401.7}, 3}, {{401.7, 600}, 90}, {{600, 830}, 1}};
    const ColorIntegral one = integrate(
        {}, [](double) { return 1.0; }, panels);
    CHECK(one.xyz == d65().white());
    CHECK(one.error <= 1e-6);
    CHECK(integrate(
              {}, [](double) { return 0.0; }, panels)
              .xyz == Triple{0, 0, 0});
}

TEST_CASE("polynomials in 1 / lambda are integrated exactly") {
    for (int power = 0; power < 7; ++power) {
        const auto f = [&](double nm) { return std::pow(360 / nm, power); };
        const Triple exact = oracle::integrate(f, observer(2), illuminant("D65"), {}, 1e-14);
        CHECK(largest_error(integrate({.tolerance = 1e-12}, f).xyz, exact) < 1e-14);
    }
}

TEST_CASE("kinks between panels cost nothing") {
    const auto f = [](double nm) { return std::abs(nm - 543.21) / 300; };
    const Triple exact = oracle::integrate(f, observer(2), illuminant("D65"), {543.21}, 1e-14);
    const std::vector<SpectralPanel> panels{{{360, 543.21}, 1}, {{543.21, 830}, 1}};
    const ColorIntegral result = integrate({.tolerance = 1e-11}, f, panels);
    CHECK(largest_error(result.xyz, exact) < 1e-11);
    CHECK(result.evaluations < 200);
}

TEST_CASE("a line is found by halving the panels around it") {
    const auto peak = [](double nm) { return 1 / (1 + std::pow((nm - 555) / 2, 2)); };
    const ColorIntegral result = integrate({}, peak);
    const Triple exact = oracle::integrate(peak, observer(2), illuminant("D65"), {}, 1e-12);
    CHECK(largest_error(result.xyz, exact) < 1e-6);
    CHECK(result.evaluations > 100);
    CHECK(result.evaluations < 600);
    const ColorIntegral smooth =
        integrate({}, [](double nm) { return 0.5 + 0.001 * std::sin(nm / 100); });
    CHECK(smooth.evaluations < 100);
}

TEST_CASE("a spectrum that cannot be resolved says so, and ends") {
    // 2e5 periods over the visible range, and a step in every nm
    const auto fringes = [](double nm) { return 0.5 + 0.5 * std::cos(1e9 / nm); };
    const auto steps = [](double nm) { return std::fmod(nm * 7.3, 1.0); };
    for (const std::size_t limit : {std::size_t{2000}, std::size_t{20000}}) {
        const IntegrationLimits limits{.tolerance = 1e-6, .evaluations = limit};
        for (const auto& result : {integrate(limits, fringes), integrate(limits, steps)}) {
            CHECK(result.error > 1e-6);
            CHECK(result.evaluations >= limit);
            // a round once begun is completed with all of its panels
            CHECK(result.evaluations < 4 * limit);
        }
    }
}

TEST_CASE("a tolerance outside 1e-12 to 1 is refused") {
    const auto one = [](double) { return 1.0; };
    for (const double tolerance :
         {0.0, -1.0, 0.9e-12, 1.1, std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(integrate({.tolerance = tolerance}, one), DomainError);
    CHECK_NOTHROW(integrate({.tolerance = 1}, one));
    CHECK_NOTHROW(integrate({.tolerance = 1e-12}, one));
}
