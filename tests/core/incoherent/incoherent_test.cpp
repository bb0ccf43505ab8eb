#include "core/incoherent/incoherent.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>

#include "tests/core/coherent/ask.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/oracle/stack_oracle.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::WithinAbs;
using Catch::WithinRel;
using oracle::incoherent;
using oracle::Query;
using oracle::spread;
using oracle::StackBuilder;

namespace {

constexpr std::array kBoth{Polarization::s, Polarization::p};

std::size_t stacks_to_try() {
    const char* const text = std::getenv("IRIDO_TEST_INCOHERENT");
    return text ? std::strtoull(text, nullptr, 10) : 3000;
}

Power of(const Powers& powers, Polarization polarization) {
    return polarization == Polarization::s ? powers.s : powers.p;
}

void check_same(const Power& a, const Power& b, double tolerance) {
    CHECK_THAT(a.R, WithinAbs(b.R, tolerance));
    CHECK_THAT(a.T, WithinAbs(b.T, tolerance));
    CHECK_THAT(a.A, WithinAbs(b.A, tolerance));
}

void check_same(const Powers& a, const Powers& b, double tolerance) {
    check_same(a.s, b.s, tolerance);
    check_same(a.p, b.p, tolerance);
}

/// k of any order of magnitude, or 0.
double random_k(Random& random) {
    switch (random.below(5)) {
        case 0:
            return 0;
        case 1:
            return random.one_in(2) ? 1e-300 : random.log_uniform(1e-300, 1e-16);
        case 2:
            return random.log_uniform(1e-16, 1e-3);
        case 3:
            return random.log_uniform(1e-3, 0.1);
        default:
            return random.log_uniform(0.1, 10);
    }
}

Complex random_index(Random& random) {
    const double n = random.one_in(4) ? random.log_uniform(0.03, 5) : random.uniform(1, 2.7);
    return {n, random_k(random)};
}

double random_thickness(Random& random) {
    switch (random.below(6)) {
        case 0:
            return random.one_in(2) ? 0 : random.log_uniform(1e-300, 1e-3);
        case 1:
            return random.log_uniform(1e-3, 10);
        case 2:
            return random.log_uniform(1e4, 1e9);
        default:
            return random.log_uniform(10, 1e4);
    }
}

/// Incoherent layers with films, metals and periods around and between them; often the light comes
/// from a dense medium, near the critical angle of one of the layers.
struct Question {
    Stack stack;
    double wavelength_nm, angle_deg;
    bool near_critical = false;
};
Question random_question(Random& random) {
    const double n0 = random.one_in(2) ? 1 : random.uniform(1, 3);
    StackBuilder b(n0);
    std::vector<double> indices;
    const auto plate = [&] {
        const Complex index = random_index(random);
        indices.push_back(index.real());
        return incoherent(b.layer(index, random_thickness(random)));
    };
    const auto film = [&] {
        const Complex index = random_index(random);
        return b.layer(index, random.log_uniform(1, index.imag() > 0.1 ? 50 : 1000));
    };
    for (std::size_t left = 1 + random.below(4); left > 0; --left) {
        for (std::size_t films = random.below(3); films > 0; --films) b.add(film());
        if (random.one_in(6)) b.add(StackBuilder::group(1 + random.below(30), {film(), film()}));
        if (random.one_in(6)) {
            b.add(StackBuilder::group(1 + random.below(4), {film(), plate()}));
        } else {
            b.add(plate());
        }
    }
    const Stack stack = b.over(random.one_in(3) ? random_index(random) : random.uniform(1, 3));
    double angle = random.one_in(4) ? 0 : random.uniform(0, 90);
    const double ratio = indices[random.below(indices.size())] / n0;
    const bool near_critical = ratio < 1 && random.one_in(2);
    if (near_critical) {
        const double off = random.one_in(5) ? 0 : random.log_uniform(1e-16, 0.1);
        const double sine = ratio * (random.one_in(2) ? 1 + off : 1 - off);
        angle = std::asin(std::min(sine, 1.0)) * 180 / std::numbers::pi;
    }
    return {stack, random.uniform(300, 1000), angle, near_critical};
}

Spectra answer(const Question& question, SimdLevel level, const Needs& needs = {}) {
    const IndexTable table(question.stack, {question.wavelength_nm});
    const double cosine = cos_of_incidence(question.angle_deg);
    return spectra(StackPower(question.stack), table, std::span(&cosine, 1), needs, {1, level});
}

std::string text_of(const Question& question) {
    return oracle::text_of(question.stack) + " " + std::to_string(question.wavelength_nm) + " nm " +
           std::to_string(question.angle_deg);
}

/// The stack with all layers coherent.
Stack all_coherent(Stack stack) {
    for (Element& element : stack.elements) std::get<Layer>(element.value).coherent = true;
    return stack;
}

/// An incoherent layer between a film and a base that both reflect, transmit and absorb.
Stack plate_between(Complex index, double thickness_nm, double n0 = 1) {
    StackBuilder b(n0);
    b.add(b.layer({2.2, 0.01}, 70));
    b.add(incoherent(b.layer(index, thickness_nm)));
    b.add(b.layer({1.8, 0.1}, 50));
    return b.over({1.5, 0.2});
}

}  // namespace

TEST_CASE("no stack with incoherent layers gains or loses light", "[incoherent]") {
    Random random(151);
    double worst = 0, lowest = 0, apart = 0;
    const std::size_t stacks = stacks_to_try();
    for (std::size_t i = 0; i < stacks; ++i) {
        const Question question = random_question(random);
        CAPTURE(i, text_of(question));
        const Spectra plain = answer(question, SimdLevel::plain);
        for (const SimdLevel level : tested_levels()) {
            const Spectra at = answer(question, level);
            CAPTURE(name_of(level));
            for (const auto polarization : {&Spectra::s, &Spectra::p}) {
                const Power power = (at.*polarization).power(0);
                const Power expected = (plain.*polarization).power(0);
                const double off = std::abs(power.R + power.T + power.A - 1);
                const double low = std::min({power.R, power.T, power.A});
                const double differs =
                    std::max(std::abs(power.R - expected.R), std::abs(power.T - expected.T));
                worst = std::max(worst, off);
                lowest = std::min(lowest, low);
                // there kz is the square root of a rounded difference
                const double tolerance = question.near_critical ? 1e-6 : 1e-10;
                if (!question.near_critical) apart = std::max(apart, differs);
                if (!(low >= 0 && off < 1e-12 && differs < tolerance))
                    FAIL_CHECK(power.R << " " << power.T << " " << power.A << " for " << expected.R
                                       << " " << expected.T << " " << expected.A);
            }
        }
    }
    if (stacks > 10000)
        WARN("R + T + A off by " << worst << ", lowest " << lowest << ", levels apart by "
                                 << apart);
}

TEST_CASE("every layer takes light, and all of them A", "[incoherent]") {
    Random random(152);
    for (int i = 0; i < 500; ++i) {
        const Question question = random_question(random);
        CAPTURE(i, text_of(question));
        Needs needs;
        needs.layers = true;
        const Spectra at = answer(question, SimdLevel::plain, needs);
        for (const Spectrum* spectrum : {&at.s, &at.p}) {
            for (const double a : spectrum->A_layers) CHECK(a >= 0);
            const double sum =
                std::accumulate(spectrum->A_layers.begin(), spectrum->A_layers.end(), 0.0);
            CHECK_THAT(sum, WithinAbs(spectrum->A[0], 1e-11));
        }
    }
}

TEST_CASE("a layer that is not too thin is the mean over its phase", "[incoherent]") {
    Random random(153);
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
        const double n0 = random.uniform(1, 1.3), n = random.uniform(1.3, 2.5);
        const Complex index{
            n, random.one_in(2) ? random.log_uniform(1e-9, 0.1) : random.uniform(0.1, n)};
        const double nm = random.uniform(400, 700), angle = random.uniform(0, 80);
        const double thickness = random.log_uniform(10, 1e4);
        const Medium inside = medium(index, n0, cos_of_incidence(angle));
        if (!travels(inside) || !has_own_wave(inside, 2 * std::numbers::pi / nm * thickness))
            continue;
        ++compared;
        const Stack stack = plate_between(index, thickness, n0);
        CAPTURE(oracle::text_of(stack), nm, angle);
        const Powers both = ask(stack, nm, angle);
        for (const auto polarization : kBoth)
            check_same(of(both, polarization),
                       oracle::incoherent(stack, {nm, angle, polarization}, 100), 1e-13);
    }
    CHECK(compared > 100);
}

TEST_CASE("a layer that is too thin has the admittance of one that is not", "[incoherent]") {
    // a layer with the same single-pass attenuation and the limited Y of the thin one: with its own
    // kz it is k0 d Im kz / Im kz' thick, and then just thick enough
    Random random(154);
    for (int i = 0; i < 100; ++i) {
        const double nm = random.uniform(400, 700), angle = i % 3 ? random.uniform(0, 60) : 0;
        const Complex index{random.uniform(1.3, 2.5), random.log_uniform(1e-6, 0.1)};
        const double k0 = 2 * std::numbers::pi / nm,
                     sine = std::sin(angle * std::numbers::pi / 180);
        const Medium inside = medium(index, 1, cos_of_incidence(angle));
        const Complex kz = std::sqrt(inside.q2);
        const double thickness = random.uniform(0.05, 0.5) / k0 / kz.real();
        CHECK_FALSE(has_own_wave(inside, k0 * thickness));
        const double exponent = k0 * thickness * kz.imag(), limit = std::sinh(exponent);
        for (const auto polarization : kBoth) {
            const bool s = polarization == Polarization::s;
            const Complex y = s ? kz : inside.eps / kz;
            if (std::abs(y.imag()) < limit * y.real()) continue;
            const Complex limited = y.real() * Complex(1, std::copysign(limit, y.imag()));
            // for p: Y kz = eps = kz^2 + S^2
            const Complex root = std::sqrt(limited * limited - 4 * sine * sine);
            const Complex sum = (limited + root) / 2.0, difference = (limited - root) / 2.0;
            const bool first = std::abs(sum - kz) < std::abs(difference - kz);
            const Complex other = s ? limited : first ? sum : difference;
            if (other.imag() <= 0) continue;
            const Complex other_index = std::sqrt(other * other + sine * sine);
            const Stack stack = plate_between(index, thickness);
            const Stack thick = plate_between(other_index, exponent / k0 / other.imag());
            CAPTURE(oracle::text_of(stack), oracle::text_of(thick), nm, angle, s);
            check_same(of(ask(stack, nm, angle), polarization),
                       oracle::incoherent(thick, {nm, angle, polarization}, 100), 1e-13);
        }
    }
}

TEST_CASE("a thin absorber neither jumps nor amplifies", "[incoherent]") {
    for (const double angle : {0.0, 50.0}) {
        for (const double thickness : {1.0, 20.0, 200.0}) {
            const Powers clear = ask(plate_between(1.5, thickness), 550, angle);
            for (const double k : {1e-300, 1e-30, 1e-18})
                check_same(ask(plate_between({1.5, k}, thickness), 550, angle), clear, 1e-14);
            // first order in k: vanishes with it
            check_same(ask(plate_between({1.5, 1e-6}, thickness), 550, angle), clear,
                       1e-6 * (1 + thickness / 50));
        }
        // across the thickness at which the limit sets in
        for (const double k : {1e-3, 0.1, 0.6}) {
            const double begin = 550 / (2 * std::numbers::pi * 1.5);
            Powers before = ask(plate_between({1.5, k}, begin / 2), 550, angle);
            for (double d = begin / 2; d < 2 * begin; d += begin / 200) {
                const Powers now = ask(plate_between({1.5, k}, d), 550, angle);
                check_same(now, before, 0.01);
                before = now;
            }
        }
    }
    // 1 nm that used to amplify by 0.002 of the light
    StackBuilder b;
    b.add(incoherent(b.layer({1.5, 0.1}, 1)));
    const Power thin = ask(b.over(1.5), 550, 0).s;
    CHECK(thin.A > 0);
    CHECK_THAT(thin.A, WithinAbs(0.96 * 4 * std::numbers::pi * 0.1 / 550, 5e-5));
}

TEST_CASE("a layer of no thickness is none, coherent or not", "[incoherent]") {
    Random random(155);
    for (int i = 0; i < 60; ++i) {
        const Complex index = random_index(random);
        StackBuilder b(1.3), c(1.3);
        for (StackBuilder* s : {&b, &c}) s->add(s->layer({2.2, 0.05}, 80));
        b.add(incoherent(b.layer(index, 0)));
        for (StackBuilder* s : {&b, &c}) {
            s->add(s->layer(1.4, 300));
            s->add(incoherent(s->layer(1.5, 1e6)));
        }
        b.add(StackBuilder::group(3, {incoherent(b.layer(index, 0))}));
        const double angle = random.uniform(0, 89);
        check_same(ask(b.over(1.5), 550, angle), ask(c.over(1.5), 550, angle), 1e-15);
    }
}

TEST_CASE("where light does not travel a layer is coherent", "[incoherent]") {
    struct Case {
        Complex index;
        double angle_deg;
    };
    for (const Case& c : {Case{{0.055, 3.32}, 0},
                          {{0.055, 3.32}, 70},
                          {1, 50},
                          {{1, 1e-9}, 50},
                          {{1, 1e-3}, 60},
                          {{1.3, 1.31}, 20},
                          {{1, 0.1}, 42}}) {
        for (const double thickness : {0.0, 1e-3, 1.0, 30.0, 1e3, 1e6, 1e9}) {
            const Stack stack = plate_between(c.index, thickness, 1.5);
            CAPTURE(oracle::text_of(stack), c.angle_deg);
            check_same(ask(stack, 550, c.angle_deg), ask(all_coherent(stack), 550, c.angle_deg),
                       1e-15);
            const Question question{stack, 550, c.angle_deg};
            Needs needs;
            needs.layers = true;
            CHECK(answer(question, SimdLevel::plain, needs).s.A_layers ==
                  answer({all_coherent(stack), 550, c.angle_deg}, SimdLevel::plain, needs)
                      .s.A_layers);
        }
    }
    // an opaque thick layer acts as a substrate for the film above it
    StackBuilder b(1.5), c(1.5);
    for (StackBuilder* s : {&b, &c}) s->add(s->layer({2.2, 0.01}, 70));
    b.add(incoherent(b.layer({1, 1e-9}, 1e5)));
    const Powers thick = ask(b.over(2), 550, 60), bulk = ask(c.over({1, 1e-9}), 550, 60);
    CHECK_THAT(thick.s.R, WithinAbs(bulk.s.R, 1e-15));
    CHECK_THAT(thick.p.R, WithinAbs(bulk.p.R, 1e-15));
    CHECK(thick.s.T < 1e-300);
}

TEST_CASE("an absorbing slab is what its surfaces leave of what it lets through", "[incoherent]") {
    // T = (1 - R)^2 a / (1 - R^2 a^2) and R (1 + a T), a = exp(-4 pi k d / wavelength), for k << n
    for (const double a : {1.0, 0.9, 0.1, 1e-12}) {
        const double thickness = 1e6, k = -std::log(a) * 550 / (4 * std::numbers::pi * thickness);
        StackBuilder b;
        b.add(incoherent(b.layer({1.5, k}, thickness)));
        const Power power = ask(b.over(1), 550, 0).s;
        const double T = 0.96 * 0.96 * a / (1 - 0.0016 * a * a), rest = 10 * k * k + 1e-14;
        CHECK_THAT(power.T, WithinRel(T, rest));
        CHECK_THAT(power.R, WithinAbs(0.04 * (1 + a * T), rest));
        CHECK_THAT(power.A, WithinAbs(1 - power.R - power.T, 1e-15));
    }
}

TEST_CASE("a gap of air is the same on both sides of its critical angle", "[incoherent]") {
    // 1 mm: hardly any light passes within 1e-6 of the angle, whether propagating or tunnelling
    const double critical = std::asin(1 / 1.5) * 180 / std::numbers::pi;
    for (const double k : {0.0, 1e-300, 1e-12, 1e-9}) {
        StackBuilder b(1.5);
        b.add(incoherent(b.layer({1, k}, 1e6)));
        const Stack stack = b.over(1.5);
        for (double off = 0; off < 0.1; off = 2 * off + 1e-15) {
            CAPTURE(k, off);
            const Power inside = ask(stack, 550, critical - off).s;
            const Power beyond = ask(stack, 550, critical + off).s;
            // the surfaces transmit in proportion to kz, that is to the square root of the angle
            CHECK(inside.T < std::sqrt(off) + 1e-6);
            CHECK(beyond.T < 1e-6);
            for (const Power& power : {inside, beyond}) {
                CHECK(power.T >= 0);
                CHECK(power.A >= 0);
                CHECK_THAT(power.R + power.T + power.A, WithinAbs(1, 1e-15));
            }
        }
    }
}

TEST_CASE("a spread incoherent layer is the mean of its thicknesses", "[incoherent]") {
    struct Case {
        Complex index;
        double thickness_nm, sigma_nm;
    };
    for (const Case& c : {Case{{1.5, 0.05}, 60, 5},
                          {{1.5, 0.05}, 60, 40},
                          {{1.5, 0.01}, 900, 50},
                          {{1.5, 1e-3}, 3e4, 1e3},
                          {{1.5, 1e-3}, 3e3, 3e3},
                          {{0.06, 3.3}, 20, 2},
                          {{2.5, 1.5}, 40, 20},
                          {{1.5, 0}, 100, 90}}) {
        for (const double angle : {0.0, 60.0}) {
            StackBuilder b;
            b.add(b.layer({2.2, 0.01}, 70));
            b.add(spread(incoherent(b.layer(c.index, c.thickness_nm)), c.sigma_nm));
            const Stack stack = b.over({1.8, 0.3});
            const auto at = [&](double thickness) {
                Stack sharp = stack;
                std::get<Layer>(sharp.elements[1].value).thickness_nm = thickness;
                std::get<Layer>(sharp.elements[1].value).thickness_sigma_nm = 0;
                return ask(sharp, 550, angle).p;
            };
            // midpoint rule: the ends contribute less than 1e-7 of the total
            const double from = std::max(0.0, c.thickness_nm - 8 * c.sigma_nm);
            const double width = (c.thickness_nm + 8 * c.sigma_nm - from) / 4000;
            Power sum;
            double weight = 0;
            for (int i = 0; i < 4000; ++i) {
                const double d = from + width * (i + 0.5), z = (d - c.thickness_nm) / c.sigma_nm;
                const double w = std::exp(-z * z / 2);
                const Power power = at(d);
                sum = {sum.R + w * power.R, sum.T + w * power.T, sum.A + w * power.A};
                weight += w;
            }
            CAPTURE(oracle::text_of(stack), c.sigma_nm, angle);
            const Power mean = ask(stack, 550, angle).p;
            check_same(mean, {sum.R / weight, sum.T / weight, sum.A / weight}, 2e-7);
            CHECK_THAT(mean.R + mean.T + mean.A, WithinAbs(1, 1e-12));
        }
    }
}
