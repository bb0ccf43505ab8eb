#include "core/colorimetry/sensitivity.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "tests/oracle/color_oracle.hpp"
#include "tests/oracle/legendre.hpp"

using namespace irido;
using Catch::WithinAbs;

namespace {

/// Rounding difference between two orders of summing some 500 cells in double.
constexpr double kRounding = 2e-14;

constexpr double kLast_nm = 830;

/// Integral of the sensitivity times T_k(x) = cos(k phi) by Gauss-Legendre in phi, cell by cell, on
/// pieces over which k phi changes by less than 1: x = 1 at the panel's short end, linear in
/// 1/lambda.
Triple chebyshev_moment(const Sensitivity& sensitivity, WavelengthRange panel, std::size_t k) {
    static const oracle::LegendreRule<double> rule(10);
    const double middle = (1 / panel.first_nm + 1 / panel.last_nm) / 2;
    const double half = (1 / panel.first_nm - 1 / panel.last_nm) / 2;
    const std::vector<double> cells = sensitivity.cells(panel);
    const auto phi_of = [&](double nm) {
        return std::acos(std::clamp((1 / nm - middle) / half, -1.0, 1.0));
    };
    Triple sum{};
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
        const double from = phi_of(cells[i]), to = phi_of(cells[i + 1]);
        const auto order = static_cast<double>(k);
        const int pieces =
            2 + static_cast<int>(order * (to - from)) + static_cast<int>(4 * (to - from));
        for (int piece = 0; piece < pieces; ++piece) {
            for (std::size_t j = 0; j < rule.x.size(); ++j) {
                const double phi = from + (to - from) * (piece + (1 + rule.x[j]) / 2) / pieces;
                const double nm = 1 / (middle + half * std::cos(phi));
                const double d_nm = nm * nm * half * std::sin(phi);
                const Triple s = sensitivity.at(nm);
                for (std::size_t c = 0; c < 3; ++c)
                    sum[c] += rule.weight[j] / 2 * (to - from) / pieces * d_nm *
                              std::cos(order * phi) * s[c];
            }
        }
    }
    return sum;
}

/// Brute force over one panel only.
Triple over_panel(const std::function<double(double)>& f, const Observer& eye, const Table& light,
                  WavelengthRange panel) {
    const auto inside = [&](double nm) {
        return nm > panel.first_nm && nm < panel.last_nm ? f(nm) : 0.0;
    };
    return oracle::integrate(inside, eye, light, {panel.first_nm, panel.last_nm}, 1e-13);
}

}  // namespace

TEST_CASE("the white is the integral of the tables") {
    for (const int degrees : {2, 10}) {
        for (const std::string_view name : illuminant_names()) {
            const Table light = illuminant(name);
            const Sensitivity sensitivity(observer(degrees), light);
            const Triple white =
                oracle::integrate([](double) { return 1.0; }, observer(degrees), light, {}, 1e-13);
            CAPTURE(degrees, name);
            CHECK(sensitivity.white()[1] == 1);
            CHECK_THAT(sensitivity.white()[0], WithinAbs(white[0], kRounding));
            CHECK_THAT(sensitivity.white()[2], WithinAbs(white[2], kRounding));
        }
    }
}

TEST_CASE("the support is where observer and illuminant both are") {
    const Sensitivity d65(observer(2), illuminant("D65"));
    CHECK(d65.support() == WavelengthRange{360, kLast_nm});
    const Sensitivity lamp(observer(2), illuminant("FL2"));
    CHECK(lamp.support() == WavelengthRange{380, 780});
    CHECK_THROWS_AS(Sensitivity(observer(2), Table({900, 1000}, {1, 1})), DomainError);
    CHECK_THROWS_AS(Sensitivity(observer(2), Table({830, 1000}, {1, 1})), DomainError);
    CHECK_THROWS_AS(Sensitivity(observer(2), Table({400, 500}, {0, 0})), DomainError);
    // two rows, offset from the observer's
    const Sensitivity narrow(observer(2), Table({500.25, 500.75}, {0, 3}));
    CHECK(narrow.support() == WavelengthRange{500.25, 500.75});
    CHECK(narrow.white()[1] == 1);
}

TEST_CASE("the sensitivity is linear times linear between rows") {
    const Table light = illuminant("D65");
    const Observer& eye = observer(2);
    const Sensitivity sensitivity(eye, light);
    const Triple at_560 = sensitivity.at(560), at_561 = sensitivity.at(561);
    const Triple between = sensitivity.at(560.5);
    const double s560 = 100, s565 = light.value[(565 - 300) / 5];
    const auto s = [&](double nm) { return s560 + (s565 - s560) * (nm - 560) / 5; };
    for (std::size_t c = 0; c < 3; ++c) {
        const auto& bar = c == 0 ? eye.x : c == 1 ? eye.y : eye.z;
        const double k = at_560[1] / (s(560) * eye.y[200]);
        CHECK_THAT(at_560[c], WithinAbs(k * s(560) * bar[200], 1e-17));
        CHECK_THAT(at_561[c], WithinAbs(k * s(561) * bar[201], 1e-17));
        CHECK_THAT(between[c], WithinAbs(k * s(560.5) * (bar[200] + bar[201]) / 2, 1e-17));
    }
}

TEST_CASE("cells are the rows inside") {
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    CHECK(sensitivity.cells({400.5, 402}) == std::vector<double>{400.5, 401, 402});
    CHECK(sensitivity.cells({400.25, 400.5}) == std::vector<double>{400.25, 400.5});
    CHECK(sensitivity.cells({360, 830}).size() == kObserverRows);
}

TEST_CASE("integrals of parts add up") {
    const Table light = illuminant("FL11");
    const Sensitivity sensitivity(observer(10), light);
    const Triple left = sensitivity.integral({380, 517.3}),
                 right = sensitivity.integral({517.3, 780});
    const Triple brute = over_panel([](double) { return 1.0; }, observer(10), light, {380, 517.3});
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK_THAT(left[c] + right[c], WithinAbs(sensitivity.white()[c], kRounding));
        CHECK_THAT(left[c], WithinAbs(brute[c], kRounding));
    }
}

TEST_CASE("moments of a panel are the integrals of Chebyshev polynomials") {
    const Table light = illuminant("D65");
    const Observer& eye = observer(2);
    const Sensitivity sensitivity(eye, light);
    for (const WavelengthRange panel :
         {WavelengthRange{360, 830}, WavelengthRange{512.3, 600}, WavelengthRange{450.2, 450.7}}) {
        for (const std::size_t degree : {8U, 32U, 128U}) {
            const PanelRule rule = panel_rule(sensitivity, panel, degree);
            for (const std::size_t k : {std::size_t{0}, std::size_t{1}, degree / 2 + 1, degree}) {
                const Triple brute = chebyshev_moment(sensitivity, panel, k);
                CAPTURE(panel.first_nm, panel.last_nm, degree, k);
                for (std::size_t c = 0; c < 3; ++c)
                    // the smallest error that the Gauss rule states is 1e-12 of a cell's share
                    CHECK_THAT(rule.moment[c][k], WithinAbs(brute[c], 1e-13));
            }
        }
    }
}

TEST_CASE("a panel's weights integrate polynomials in 1 / lambda") {
    const Table light = illuminant("A");
    const Observer& eye = observer(10);
    const Sensitivity sensitivity(eye, light);
    for (const WavelengthRange panel : {WavelengthRange{360, 830}, WavelengthRange{512.3, 600}}) {
        for (const std::size_t degree : {8U, 16U, 64U}) {
            const PanelRule rule = panel_rule(sensitivity, panel, degree);
            REQUIRE(rule.wavelength_nm.size() == degree + 1);
            CHECK(rule.wavelength_nm.front() == panel.first_nm);
            CHECK(rule.wavelength_nm.back() == panel.last_nm);
            CHECK(std::ranges::is_sorted(rule.wavelength_nm));
            for (const int power : {0, 1, 3, 8}) {
                const auto f = [&](double nm) { return std::pow(panel.first_nm / nm, power); };
                const Triple brute = over_panel(f, eye, light, panel);
                CAPTURE(panel.first_nm, degree, power);
                for (std::size_t c = 0; c < 3; ++c) {
                    double sum = 0;
                    for (std::size_t j = 0; j <= degree; ++j)
                        sum += rule.weight[c][j] * f(rule.wavelength_nm[j]);
                    CHECK_THAT(sum, WithinAbs(brute[c], 1e-13));
                }
            }
        }
    }
}

TEST_CASE("points of a degree are every second point of its double") {
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    const PanelRule coarse = panel_rule(sensitivity, {400, 700}, 16);
    const PanelRule fine = panel_rule(sensitivity, {400, 700}, 32);
    for (std::size_t j = 0; j <= 16; ++j)
        CHECK(coarse.wavelength_nm[j] == fine.wavelength_nm[2 * j]);
}
