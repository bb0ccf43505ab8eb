#include "core/rough/filter.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"
#include "core/rough/filter_nodes.hpp"
#include "core/rough/ggx.hpp"
#include "core/truth/filter_reference.hpp"
#include "tests/oracle/filter_oracle.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

struct Angles {
    double i, d;
};

/// Angles strictly between 0 and 90: random, in the peak, at the kink, at grazing, near normal.
std::vector<Angles> angles(double alpha, int count) {
    std::vector<Angles> all;
    Random random(11);
    const auto any = [&] { return random.uniform(0.01, 89.99); };
    const auto tiny = [&] { return std::pow(10, random.uniform(-10, 1.9)); };
    for (int k = 0; k < count; ++k) {
        const double i = k % 5 == 3 ? 90 - tiny() : k % 5 == 4 ? tiny() : any();
        double d = any();
        if (k % 5 == 1) d = i + alpha / kDegree * random.uniform(-3, 3);
        if (k % 5 == 2) d = 90 - i + (k % 2 == 0 ? 1e-6 : -1e-6) * tiny();
        if (k % 5 == 3) d = 90 - tiny();
        if (k % 5 == 4) d = k % 2 == 0 ? tiny() : 90 - tiny();
        if (d > 0 && d < 90) all.push_back({i, d});
    }
    return all;
}

double row_of_one(const TransmissionFilter& filter, const Angles& at, SimdLevel level) {
    double F = 0;
    filter.row(at.i, FilterAxis({&at.d, 1}, "theta_d_deg", level), {&F, 1}, level);
    return F;
}

const std::vector<double> kAlphas{1e-4, 1e-3, 0.01, 0.1, 0.2, 0.5, 0.999, 1};

}  // namespace

TEST_CASE("the transmission filter has the values of a 60-digit evaluation", "[rough]") {
    const TransmissionFilter filter(0.2);
    // computed independently in 60 digits
    const std::vector<std::pair<Angles, double>> expected{
        {{20, 15}, 1.8901438839298736},   {{20, 45}, 0.2722569611850245},
        {{20, 75}, 0.023254638025755423}, {{60, 15}, 0.07600163461048545},
        {{60, 45}, 0.7872043926777261},   {{60, 75}, 0.33354570223087154},
    };
    for (const auto& [at, F] : expected) CHECK_THAT(filter(at.i, at.d), WithinRel(F, 1e-14));
}

TEST_CASE("the reference of the filter is the integral over psi by tanh-sinh", "[rough]") {
    for (const double alpha : kAlphas)
        for (const Angles& at : angles(alpha, 10))
            CHECK_THAT(reference_filter(alpha, at.i, at.d),
                       WithinRel(oracle::transmission_filter(alpha, at.i, at.d), 1e-15));
}

TEST_CASE("the closed form of the filter is within 1e-14 at every level and roughness", "[rough]") {
    for (const double alpha : kAlphas) {
        const TransmissionFilter filter(alpha);
        for (const Angles& at : angles(alpha, 300)) {
            const double exact = reference_filter(alpha, at.i, at.d);
            CAPTURE(alpha, at.i, at.d);
            CHECK_THAT(filter(at.i, at.d), WithinRel(exact, 1e-14));
            for (const SimdLevel level : tested_levels())
                CHECK_THAT(row_of_one(filter, at, level), WithinRel(exact, 1e-14));
        }
    }
}

TEST_CASE("the filter has its limits", "[rough]") {
    for (const double alpha : kAlphas) {
        const TransmissionFilter filter(alpha);
        for (const double theta : {0.001, 1.0, 44.0, 89.0}) {
            const double c = cos_of_incidence(theta), s = std::sin(theta * kDegree);
            // normal incidence: theta_m is theta_d for every azimuth
            CHECK_THAT(filter(0, theta), WithinRel(2 * kPi * c * s * ggx_distribution(alpha, c),
                                                   alpha < 0.01 ? 1e-7 : 1e-11));
            CHECK(filter(theta, 0) == 0);
            CHECK(filter(theta, 90) == 0);
            CHECK(filter(90, theta) == 0);
            // the value itself is continuous at the kink
            CHECK_THAT(filter(theta, 90 - theta), WithinRel(filter(theta, 90.00000000001 - theta),
                                                            alpha < 0.01 ? 1e-2 : 1e-4));
        }
        CHECK(filter(0, 0) == 0);
        CHECK(filter(90, 90) == 0);
    }
    // D is 1/pi at alpha 1
    const TransmissionFilter rough(1);
    const double G1 = smith_masking(1, 0.5);
    const double psi_max = std::acos(-1 / (std::tan(kPi / 3) * std::tan(kPi / 4)));
    CHECK_THAT(rough(60, 45),
               WithinRel(2 * G1 * G1 * std::sqrt(2) * std::sqrt(0.5) * psi_max / kPi, 1e-14));
}

TEST_CASE("the filter integrates to the masking function", "[rough]") {
    for (const double alpha : kAlphas) {
        const TransmissionFilter filter(alpha);
        for (const double theta : {0.0, 1e-9, 0.25, 10.0, 44.9, 45.0, 45.1, 80.0, 89.75, 89.999}) {
            const WeightedAngles nodes = FilterNodes(filter, theta, best_simd_level())(0, 90);
            double sum = 0;
            for (const double weight : nodes.weight) sum += weight;
            CAPTURE(alpha, theta);
            // angles near theta_i are accurate to 1e-14 degrees, so to 1e-12 of the narrowest peak
            CHECK_THAT(sum, WithinRel(smith_masking(alpha, cos_of_incidence(theta)),
                                      alpha < 0.01 ? 3e-12 : 1e-13));
        }
    }
}

TEST_CASE("rows of the filter are filled to their last angle", "[rough]") {
    const TransmissionFilter filter(0.3);
    for (std::size_t count = 1; count < 20; ++count) {
        std::vector<double> theta(count), F(count + 1, -1);
        for (std::size_t i = 0; i < count; ++i) theta[i] = 90 - 4.5 * static_cast<double>(i);
        for (const SimdLevel level : tested_levels()) {
            filter.row(50, FilterAxis(theta, "theta_d_deg"), std::span(F).first(count), level);
            for (std::size_t i = 0; i < count; ++i)
                CHECK_THAT(F[i], WithinRel(filter(50, theta[i]), 1e-14));
            CHECK(F[count] == -1);
        }
    }
}

TEST_CASE("GGX's distribution projects to the unit disc and masks as Smith has it", "[rough]") {
    for (const double alpha : {0.05, 0.3, 1.0}) {
        double area = 0;
        constexpr int kSteps = 200000;
        for (int k = 0; k < kSteps; ++k) {  // midpoints of sin^2 theta: 2 cos sin dtheta = du
            const double c = std::sqrt(1 - (k + 0.5) / kSteps);
            area += kPi * ggx_distribution(alpha, c) / kSteps;
        }
        CHECK_THAT(area, WithinRel(1, 1e-5));
    }
    CHECK(smith_masking(0.3, 1) == 1);
    CHECK(smith_masking(0.3, 0) == 0);
    CHECK_THAT(smith_masking(1, std::sqrt(0.5)), WithinRel(2 / (1 + std::sqrt(2)), 1e-15));
    CHECK(smith_masking_shadowing(0.3, 1, 1) == 1);
    CHECK(smith_masking_shadowing(0.3, 0.2, 0) == 0);
    CHECK_THAT(1 / smith_masking_shadowing(0.4, 0.2, 0.7),
               WithinRel(1 / smith_masking(0.4, 0.2) + 1 / smith_masking(0.4, 0.7) - 1, 1e-14));
}

TEST_CASE("rough layers refuse what is outside their domain", "[rough][refused]") {
    const double nan = std::nan("");
    const TransmissionFilter filter(0.1);
    const std::vector<double> beyond{10, 90.5};
    CHECK_THROWS_WITH(TransmissionFilter(0), "alpha must be in [1e-04, 1] (got 0)");
    CHECK_THROWS_WITH(TransmissionFilter(nan), Contains("alpha must be"));
    CHECK_THROWS_WITH(TransmissionFilter(1.5), Contains("got 1.5"));
    CHECK_THROWS_WITH(filter(-1, 10), Contains("theta_i_deg must be in [0, 90] (got -1)"));
    CHECK_THROWS_WITH(filter(10, nan), Contains("theta_d_deg must be in [0, 90]"));
    CHECK_THROWS_WITH(FilterAxis(beyond, "theta_d_deg"),
                      Contains("theta_d_deg") && Contains("90.5"));
    CHECK_THROWS_AS(filter.row(nan, FilterAxis({}, "theta_d_deg"), {}, best_simd_level()),
                    DomainError);
    CHECK_THROWS_AS(reference_filter(2, 10, 10), DomainError);
    CHECK_THROWS_AS(ggx_distribution(0.1, 1.1), DomainError);
    CHECK_THROWS_AS(ggx_distribution(0, 1), DomainError);
    CHECK_THROWS_AS(smith_masking(0.1, -0.1), DomainError);
    CHECK_THROWS_AS(smith_masking_shadowing(0.1, 0.1, nan), DomainError);
}
