#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "tests/core/coherent/ask.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;
using Catch::WithinAbs;
using oracle::Kind;
using oracle::StackBuilder;

namespace {

/// Rounding error of phases of a few hundred radians, amplified by resonances.
constexpr double kRounding = 1e-11;

void check_same(const Power& a, const Power& b, double tolerance = kRounding) {
    CHECK_THAT(a.R, WithinAbs(b.R, tolerance));
    CHECK_THAT(a.T, WithinAbs(b.T, tolerance));
    CHECK_THAT(a.A, WithinAbs(b.A, tolerance));
}

void check_same(const Powers& a, const Powers& b, double tolerance = kRounding) {
    check_same(a.s, b.s, tolerance);
    check_same(a.p, b.p, tolerance);
}

/// Calls f(stack, wavelength, angle) for random stacks of every kind.
template <class F>
void for_random_stacks(std::uint64_t seed, F f) {
    oracle::Random random(seed);
    for (int i = 0; i < 400; ++i) {
        const auto kind = static_cast<Kind>(static_cast<std::size_t>(i) % oracle::kKinds);
        const Stack stack = oracle::random_stack(kind, random);
        const double wavelength = random.uniform(400, 750);
        const double angle = oracle::random_angle(random);
        CAPTURE(oracle::text_of(stack), wavelength, angle);
        f(stack, wavelength, angle);
    }
}

std::vector<Element> mirrored(const std::vector<Element>& elements) {
    std::vector<Element> result(elements.rbegin(), elements.rend());
    for (Element& element : result)
        if (Group* group = std::get_if<Group>(&element.value))
            group->elements = mirrored(group->elements);
    return result;
}

}  // namespace

TEST_CASE("power is conserved and nothing is negative") {
    for_random_stacks(1, [](const Stack& stack, double wavelength, double angle) {
        const Powers both = ask(stack, wavelength, angle);
        for (const Power& power : {both.s, both.p}) {
            // 30 periods of 1e-15 each, amplified by resonances
            CHECK_THAT(power.R + power.T + power.A, WithinAbs(1, 1e-12));
            CHECK(power.R >= 0);
            CHECK(power.T >= 0);
            CHECK(power.A >= 0);
        }
    });
}

TEST_CASE("light crosses a stack both ways alike") {
    for_random_stacks(2, [](Stack stack, double wavelength, double angle) {
        stack.incident = 0;
        stack.substrate = 0;
        Stack back = stack;
        back.elements = mirrored(stack.elements);
        const Powers one = ask(stack, wavelength, angle), other = ask(back, wavelength, angle);
        CHECK_THAT(one.s.T, WithinAbs(other.s.T, kRounding));
        CHECK_THAT(one.p.T, WithinAbs(other.p.T, kRounding));
    });
    // different outer media at normal incidence
    StackBuilder b(1.2);
    b.add(b.layer({2, 0.3}, 70));
    b.add(b.layer(1.4, 110));
    Stack stack = b.over(1.7);
    const double forward = ask(stack, 520, 0).s.T;
    std::swap(stack.incident, stack.substrate);
    stack.elements = mirrored(stack.elements);
    CHECK_THAT(ask(stack, 520, 0).s.T, WithinAbs(forward, 1e-15));
}

TEST_CASE("a layer of no thickness changes nothing") {
    for_random_stacks(3, [](Stack stack, double wavelength, double angle) {
        const Powers before = ask(stack, wavelength, angle);
        Layer nothing;
        nothing.material = stack.materials.size() - 1;
        stack.elements.insert(stack.elements.begin(), Element{nothing});
        check_same(ask(stack, wavelength, angle), before, 1e-14);
        nothing.coherent = true;
        stack.elements.push_back({Group{1000000, {Element{nothing}, Element{nothing}}}});
        check_same(ask(stack, wavelength, angle), before, 1e-14);
    });
}

TEST_CASE("a layer cut in two stays the same layer") {
    for_random_stacks(4, [](Stack stack, double wavelength, double angle) {
        const Powers before = ask(stack, wavelength, angle);
        Layer* layer = std::get_if<Layer>(&stack.elements.front().value);
        if (!layer) return;
        Layer upper = *layer;
        upper.thickness_nm *= 0.3;
        layer->thickness_nm -= upper.thickness_nm;
        stack.elements.insert(stack.elements.begin(), Element{upper});
        check_same(ask(stack, wavelength, angle), before);
    });
}

TEST_CASE("a group is its layers written out") {
    oracle::Random random(5);
    for (const std::uint64_t repeat : {1U, 2U, 3U, 7U, 40U}) {
        for (int i = 0; i < 40; ++i) {
            StackBuilder b;
            std::vector<Element> period;
            for (std::size_t left = 1 + random.below(4); left > 0; --left) {
                const double n = random.uniform(1.2, 2.6);
                const double k = i % 2 == 0 ? 0 : random.uniform(0, 0.2);
                period.push_back(b.layer({n, k}, random.uniform(0, 300)));
            }
            Stack grouped = b.over(1.5), written = grouped, nested = grouped;
            grouped.elements = {StackBuilder::group(repeat, period)};
            for (std::uint64_t j = 0; j < repeat; ++j)
                written.elements.insert(written.elements.end(), period.begin(), period.end());
            const Element twice = StackBuilder::group(2, period);
            nested.elements = {StackBuilder::group(repeat / 2, {twice})};
            if (repeat % 2 == 1) nested.elements.push_back(StackBuilder::group(1, period));
            if (repeat == 1) nested.elements.erase(nested.elements.begin());
            const double wavelength = random.uniform(400, 700), angle = random.uniform(0, 85);
            CAPTURE(oracle::text_of(grouped), wavelength, angle);
            const Powers expected = ask(written, wavelength, angle);
            check_same(ask(grouped, wavelength, angle), expected);
            check_same(ask(nested, wavelength, angle), expected);
        }
    }
}

TEST_CASE("a repeated layer is a thicker layer") {
    for (const Complex n : {Complex(1.5), Complex(2, 0.05)}) {
        StackBuilder b, c, d;
        b.add(StackBuilder::group(64, {b.layer(n, 10)}));
        c.add(c.layer(n, 640));
        d.add(StackBuilder::group(32, {d.layer(n, 10), d.layer(n, 10)}));
        const Powers expected = ask(c.over(1.7), 550, 50);
        check_same(ask(b.over(1.7), 550, 50), expected, 1e-14);
        check_same(ask(d.over(1.7), 550, 50), expected, 1e-13);
    }
}

TEST_CASE("equal indices vanish") {
    StackBuilder b(1.3), c(1.3);
    b.add(b.layer(1.3, 400));
    b.add(b.layer({1.7, 0.1}, 100));
    b.add(StackBuilder::group(9, {b.layer(1.5, 50), b.layer(1.5, 70)}));
    c.add(c.layer({1.7, 0.1}, 100));
    check_same(ask(b.over(1.5), 550, 60), ask(c.over(1.5), 550, 60), 1e-13);
    StackBuilder all(1.5);
    all.add(all.layer(1.5, 123));
    const Stack nothing = all.over(1.5);
    CHECK(ask(nothing, 550, 90).s.T == 1);
    CHECK(ask(nothing, 550, 90).p.R == 0);
    CHECK_THAT(ask(nothing, 550, 89).p.T, WithinAbs(1, 1e-14));
}

TEST_CASE("at exactly 90 degrees everything is reflected") {
    for_random_stacks(6, [](const Stack& stack, double wavelength, double) {
        const Powers both = ask(stack, wavelength, 90);
        CHECK(both.s.R == 1);
        CHECK(both.p.R == 1);
        CHECK(both.s.T == 0);
        CHECK(both.p.A == 0);
    });
}

TEST_CASE("an angle outside 0 to 90 degrees is refused") {
    CHECK(cos_of_incidence(90) == 0);
    CHECK(cos_of_incidence(0) == 1);
    // sin(90 - angle) from an exact difference: accurate to the last digit at 1e-9 degrees
    CHECK_THAT(cos_of_incidence(90 - 0x1p-30),
               Catch::WithinRel(0x1p-30 * 3.14159265358979324 / 180, 4e-16));
    CHECK_THROWS_AS(cos_of_incidence(-1e-300), DomainError);
    CHECK_THROWS_AS(cos_of_incidence(std::nextafter(90.0, 91.0)), DomainError);
    CHECK_THROWS_AS(cos_of_incidence(std::numeric_limits<double>::quiet_NaN()), DomainError);
}

TEST_CASE("the incident medium must be transparent and every index known") {
    CHECK_THROWS_AS(IndexTable(StackBuilder({1.5, 1e-3}).over(1), {550}), DomainError);
    CHECK_THROWS_AS(IndexTable(StackBuilder({1.5, -1e-3}).over(1), {550}), DomainError);
    CHECK_THROWS_AS(IndexTable(StackBuilder(1).over(1.5), {550, 0.5}), DomainError);
    CHECK_THROWS_AS(IndexTable(StackBuilder(1).over({-1.5, 0}), {550}), DomainError);
    const Stack glass = StackBuilder({1.5, 0.999e-3}).over(1);
    CHECK(IndexTable(glass, {550}).n(0, 0) == 1.5);
    CHECK_THAT(ask(glass, 550, 0).s.R, WithinAbs(0.04, 1e-15));
}

TEST_CASE("only the polarizations asked for are computed") {
    const Stack glass = StackBuilder(1).over(1.5);
    const IndexTable table(glass, {500, 600});
    const double cosine = 0.5;
    const Spectra at = spectra(StackPower(glass), table, std::span(&cosine, 1),
                               {.s = true, .p = false, .T = false});
    CHECK(at.p.R.empty());
    CHECK(at.s.T.empty());
    CHECK(at.s.R[1] == ask(glass, 600, 60).s.R);
}
