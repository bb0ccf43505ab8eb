#include "tables/lut/lut_maker.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace irido;
using namespace irido::tables;

namespace {

const LutKind kKind{.name = "test", .summary = "", .axes = ""};

LutMeasure largest_difference_of(std::size_t channels) {
    return {"absolute", [channels](const std::vector<LutAxis>&, std::span<const double> a,
                                   std::span<const double> b) {
                std::vector<double> d(a.size() / channels);
                for (std::size_t i = 0; i < a.size(); ++i)
                    d[i / channels] = std::max(d[i / channels], std::abs(a[i] - b[i]));
                return d;
            }};
}

/// A plan of f(x, y) over [0, x_end] and [0, 1].
template <class F>
LutPlan plan_of(F f, double x_end = 1, std::size_t count = 16) {
    LutPlan plan;
    plan.axes = {{{"x", "", equally_spaced(0, x_end, count)}},
                 {{"y", "nm", equally_spaced(0, 1, count)}}};
    plan.channels = {"F"};
    plan.evaluate = [f](const std::vector<LutAxis>& axes) {
        std::vector<double> values;
        for (const double x : axes[0].values)
            for (const double y : axes[1].values) values.push_back(f(x, y));
        return values;
    };
    plan.measure = largest_difference_of(1);
    return plan;
}

LutMaking with_tolerance(double tolerance, bool power_of_two = true) {
    LutMaking making;
    making.type = LutType::f64;
    making.sizing.tolerance = tolerance;
    making.sizing.power_of_two = power_of_two;
    return making;
}

}  // namespace

TEST_CASE("numbers are rounded to the type a table has", "[lut]") {
    // the spacing of half precision is 2^-10 in [1, 2), 2^-24 below 2^-14; ties go to even
    CHECK(rounded(1 + std::ldexp(1, -11), LutType::f16) == 1);
    CHECK(rounded(1 + 3 * std::ldexp(1, -11), LutType::f16) == 1 + std::ldexp(1, -9));
    CHECK(rounded(1e-13, LutType::f16) == 0);
    CHECK(rounded(std::ldexp(3, -25), LutType::f16) == std::ldexp(1, -23));
    CHECK(rounded(65519, LutType::f16) == 65504);
    CHECK(std::isinf(rounded(65520, LutType::f16)));
    CHECK(rounded(-0.1, LutType::f32) == static_cast<double>(-0.1F));
    CHECK(rounded(0.1, LutType::f64) == 0.1);
}

TEST_CASE("equally spaced samples end exactly at both ends", "[lut]") {
    const std::vector<double> x = equally_spaced(0.1, 0.7, 7);
    CHECK(x.front() == 0.1);
    CHECK(x.back() == 0.7);
    CHECK(LutAxis{"x", "", x}.is_linear());
    CHECK_FALSE(LutAxis{"x", "", {0, 1, 2.1}}.is_linear());
    CHECK(equally_spaced(3, 5, 1) == std::vector<double>{3});
}

TEST_CASE("the interpolation error of a parabola is that of its chord", "[lut]") {
    // between samples h apart, x^2 is h^2/4 below its chord, equally in every cell
    const LutPlan plan = plan_of([](double x, double y) { return x * x + 3 * y; });
    const Lut lut = make_lut(kKind, plan, {.type = LutType::f64});
    CHECK(lut.facts["error"]["value"].get<double>() == Approx(0.25 / 225).epsilon(1e-9));
    CHECK(lut.facts["error"]["measure"] == "absolute");
    const InterpolationError error = interpolation_errors(plan, lut, 1).front();
    CHECK(error.of_axis[0] == Approx(0.25 / 225).epsilon(1e-9));
    CHECK(error.of_axis[1] < 1e-14);
}

TEST_CASE("a worst place between the middles of cells is found", "[lut]") {
    // a kink at a quarter of a cell
    const LutPlan plan = plan_of([](double x, double) { return std::abs(x - 0.525); }, 1, 11);
    const Lut lut = make_lut(kKind, plan, {.type = LutType::f64});
    CHECK(lut.facts["error"]["value"].get<double>() == Approx(0.0375).epsilon(1e-9));
}

TEST_CASE("what the type rounds off is part of the error", "[lut]") {
    const LutPlan plan = plan_of([](double x, double y) { return 1 + (x + y) * 1e-4; });
    const double half = make_lut(kKind, plan, {.type = LutType::f16}).facts["error"]["value"];
    const double single = make_lut(kKind, plan, {.type = LutType::f32}).facts["error"]["value"];
    CHECK(half > 1e-4);
    CHECK(single < 1e-7);
}

TEST_CASE("the size follows from the tolerance", "[lut]") {
    // x^2 alone needs 1/(4 (n-1)^2) <= 1e-4: 51 samples, 64 as a power of two; y is linear
    const auto f = [](double x, double y) { return x * x + 3 * y; };
    const Lut lut = make_lut(kKind, plan_of(f), with_tolerance(1e-4));
    CHECK(lut.axes[0].count() == 64);
    CHECK(lut.axes[1].count() == 2);
    CHECK(lut.facts["error"]["value"].get<double>() <= 1e-4);
    const Lut any = make_lut(kKind, plan_of(f), with_tolerance(1e-4, false));
    CHECK(any.axes[0].count() >= 51);
    CHECK(any.axes[0].count() <= 53);
}

TEST_CASE("an axis that does not matter gets one sample and a note", "[lut]") {
    const Lut lut = make_lut(kKind, plan_of([](double x, double) { return std::sin(x); }),
                             with_tolerance(1e-3));
    CHECK(lut.axes[0].count() > 2);
    CHECK(lut.axes[1].values == std::vector<double>{0.5});
    REQUIRE(lut.facts["notes"].size() == 1);
    CHECK(lut.facts["notes"][0].get<std::string>() ==
          "y: constant over [0, 1]: stored as one sample");
    const Lut other =
        make_lut(kKind, plan_of([](double x, double y) { return std::sin(x) + 0.01 * y; }),
                 with_tolerance(1e-3));
    CHECK(other.axes[1].count() == 2);
    CHECK(other.facts["notes"].empty());
}

TEST_CASE("a range ends where the function is constant", "[lut]") {
    LutPlan plan = plan_of([](double x, double y) { return std::exp(-x) * (1 + y); }, 100);
    plan.axes[0].may_end_early = true;
    const Lut lut = make_lut(kKind, plan, with_tolerance(1e-2));
    // 2 exp(-x) falls below a quarter of the tolerance at x = 6.7
    CHECK(lut.axes[0].values.back() > 6.6);
    CHECK(lut.axes[0].values.back() < 7);
    CHECK(lut.facts["notes"][0].get<std::string>().find("x: constant beyond 6.") == 0);
    plan.axes[0].may_end_early = false;
    CHECK(make_lut(kKind, plan, with_tolerance(1e-2)).axes[0].values.back() == 100);
}

TEST_CASE("a tolerance that no size meets is said", "[lut]") {
    const LutPlan jump = plan_of([](double x, double) { return x < 0.3 ? 0.0 : 1.0; });
    CHECK_THROWS_AS(make_lut(kKind, jump, with_tolerance(1e-3)), ToleranceError);
}

TEST_CASE("a size that cannot be met is seen early", "[lut]") {
    std::size_t samples = 0;
    LutPlan jump = plan_of([&](double x, double) {
        ++samples;
        return x < 0.3 ? 0.0 : 1.0;
    });
    LutMaking making = with_tolerance(1e-3);
    making.threads = 1;
    CHECK_THROWS_AS(make_lut(kKind, jump, making), ToleranceError);
    CHECK(samples < 5000);
}

TEST_CASE("a corner that is the same on any scale is seen early", "[lut]") {
    std::size_t samples = 0;
    LutPlan ratio = plan_of([&](double x, double y) {
        ++samples;
        return x > 0 ? 2 * x * y / (x * x + y * y) : 0;
    });
    LutMaking making = with_tolerance(0.02);
    making.threads = 1;
    CHECK_THROWS_AS(make_lut(kKind, ratio, making), ToleranceError);
    CHECK(samples < 50000);
}

TEST_CASE("trials go by rough values, what is written does not", "[lut]") {
    const auto f = [](double x, double y) { return x * x + 3 * y; };
    LutPlan plan = plan_of(f);
    std::vector<double> asked;
    plan.roughly = [&](double error) {
        asked.push_back(error);
        return plan_of([=](double x, double y) { return f(x, y) + 1e-6; }).evaluate;
    };
    const Lut lut = make_lut(kKind, plan, with_tolerance(1e-4));
    CHECK(asked == std::vector<double>{1e-4 * 0.1});
    CHECK(lut.axes[0].count() == 64);
    CHECK(lut.values == make_lut(kKind, plan_of(f), with_tolerance(1e-4)).values);
}

TEST_CASE("the worst places of large tables are found by their curvature", "[lut]") {
    // a narrow ridge: all cells are looked at here, few of them in the table
    const auto f = [](double x, double y) {
        return std::exp(-std::pow((x - 0.3713) / 0.01, 2)) * std::cos(3 * y) + std::sin(9 * y);
    };
    constexpr std::size_t count = 200;
    std::size_t samples = 0;
    LutPlan plan = plan_of([&](double x, double y) { return ++samples, f(x, y); }, 1, count);
    LutMaking making;
    making.type = LutType::f64;
    making.threads = 1;
    const double error = make_lut(kKind, plan, making).facts["error"]["value"];
    CHECK(samples < 2 * count * count);
    double worst = 0;
    const std::vector<double> at = equally_spaced(0, 1, count);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        for (std::size_t j = 0; j + 1 < count; ++j) {
            const double middle = (f(at[i], at[j]) + f(at[i + 1], at[j]) + f(at[i], at[j + 1]) +
                                   f(at[i + 1], at[j + 1])) /
                                  4;
            worst = std::max(
                worst, std::abs(middle - f((at[i] + at[i + 1]) / 2, (at[j] + at[j + 1]) / 2)));
        }
    }
    CHECK(error >= worst);
    CHECK(error < 1.1 * worst);
}

TEST_CASE("sizes that were typed are taken", "[lut]") {
    const LutPlan plan = plan_of([](double x, double y) { return x + y; });
    LutMaking making;
    making.sizing.counts = {5, 1};
    const Lut lut = make_lut(kKind, plan, making);
    CHECK(lut.axes[0].values == equally_spaced(0, 1, 5));
    CHECK(lut.axes[1].values == std::vector<double>{0.5});
    // one sample for all of y: the error is that at the ends
    CHECK(lut.facts["error"]["value"].get<double>() == Approx(0.5));
    making.sizing.counts = {5};
    CHECK_THROWS_AS(make_lut(kKind, plan, making), LutError);
    LutPlan fixed = plan;
    fixed.axes[0].fixed = true;
    making.sizing.counts = {5, 1};
    CHECK_THROWS_AS(make_lut(kKind, fixed, making), LutError);
}

TEST_CASE("mip levels are sampled exactly, each at its own places", "[lut]") {
    LutPlan plan = plan_of([](double x, double y) { return x + y * y; }, 3, 4);
    plan.axes[0].fixed = true;
    plan.axes[1].axis.values = equally_spaced(0, 1, 8);
    plan.mips = true;
    const Lut lut = make_lut(kKind, plan, {.type = LutType::f64, .mips = true});
    REQUIRE(lut.levels() == 4);
    REQUIRE(lut.values.size() == 8 + 4 + 2 + 1);
    CHECK(lut.values[7] == 1);      // level 0 at y = 1
    CHECK(lut.values[8 + 3] == 2);  // level 1 at y = 1
    CHECK(lut.values[8 + 4 + 1] == 3);
    CHECK(lut.values[14] == 3);  // one sample, the first
    CHECK(lut.values_of_level(2) == 2);
    // the chord of y^2 is off by h^2/4, h = 1/7, 1/3, 1; a single sample is off by its distance
    const auto errors = lut.facts["error"]["levels"].get<std::vector<double>>();
    REQUIRE(errors.size() == 4);
    CHECK(errors[0] == Approx(0.25 / 49));
    CHECK(errors[1] == Approx(0.25 / 9));
    CHECK(errors[2] == Approx(0.25));
    CHECK(errors[3] == Approx(1));
    CHECK(lut.facts["error"]["value"] == errors[0]);
    const Lut flat = make_lut(kKind, plan, {.type = LutType::f64});
    CHECK(flat.values.size() == 32);
}

TEST_CASE("a table does not depend on the number of threads", "[lut]") {
    const LutPlan plan =
        plan_of([](double x, double y) { return std::sin(7 * x * y + x); }, 5, 200);
    LutMaking making{.type = LutType::f64, .threads = 1};
    const Lut one = make_lut(kKind, plan, making);
    making.threads = 7;
    const Lut many = make_lut(kKind, plan, making);
    CHECK(one.values == many.values);
    CHECK(one.facts == many.facts);
}

TEST_CASE("progress grows to the whole", "[lut]") {
    double last = 0;
    bool grows = true;
    make_lut(kKind, plan_of([](double x, double y) { return x + y; }),
             {.threads = 1, .progress = [&](double done, const std::string& what) {
                  if (what == "error") return;
                  grows = grows && done >= last;
                  last = done;
              }});
    CHECK(grows);
    CHECK(last == 1);
}
