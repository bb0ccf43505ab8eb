// What each layer absorbs, and points at which materials that absorb elsewhere do not.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/spectrum/spectrum.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::WithinAbs;
using oracle::StackBuilder;

namespace {

constexpr Needs kLayers{.layers = true};

/// How layers absorb.
enum class Regime {
    transparent,
    weak,
    mixed,
    thick,
    metal,
    frustrated,
    gain,
    groups,
    plates,
    count
};

Stack random_stack(Regime regime, Random& random) {
    StackBuilder b(regime == Regime::frustrated ? 1.9 : random.uniform(1, 1.5));
    const auto layer = [&] {
        double n = random.uniform(1.2, 2.6), k = 0, nm = random.uniform(0, 300);
        switch (regime) {
            case Regime::weak:
                k = std::pow(10, random.uniform(-14, -3));
                break;
            case Regime::mixed:
            case Regime::frustrated:
            case Regime::groups:
            case Regime::plates:
                k = random.one_in(2) ? 0 : std::pow(10, random.uniform(-9, -0.5));
                break;
            case Regime::thick:
                k = random.uniform(0, 2);
                nm *= 20;
                break;
            case Regime::metal:
                n = random.uniform(0.05, 3);
                k = random.uniform(1, 7);
                nm /= 5;
                break;
            case Regime::gain:
                k = (random.one_in(2) ? 1 : -1) * std::pow(10, random.uniform(-8, -2.5));
                break;
            default:
                break;
        }
        if (random.one_in(9)) nm = random.one_in(2) ? 0 : 1e-3 * nm;
        return b.layer({n, k}, nm);
    };
    if (regime == Regime::groups)
        b.add(StackBuilder::group(1 + random.below(90), {layer(), layer(), layer()}));
    for (std::size_t left = 1 + random.below(7); left > 0; --left) b.add(layer());
    if (regime == Regime::groups) b.add(StackBuilder::group(2 + random.below(9), {layer()}));
    if (regime == Regime::plates) {  // some absorb slightly
        b.add(oracle::incoherent(b.layer({random.uniform(1.3, 1.7), 0}, random.uniform(1e3, 1e5))));
        b.add(layer());
        const double k = random.one_in(2) ? 0 : 1e-7;
        b.add(oracle::incoherent(b.layer({random.uniform(1.3, 1.7), k}, random.uniform(1e3, 1e5))));
    }
    return b.over({random.uniform(1, 2), random.one_in(2) ? 0 : random.uniform(0, 3)});
}

std::vector<double> random_wavelengths(Random& random, int count) {
    std::vector<double> wavelengths;
    for (int i = 0; i < count; ++i) wavelengths.push_back(random.uniform(350, 850));
    return wavelengths;
}

/// 2.1 + i k, k = 0 up to 500 nm and 0.2 from 600 nm on.
Material partly_absorbing() {
    return {"partly",
            RefractiveIndex{Constant{2.1}, Table{{300, 500, 600, 900}, {0, 0, 0.2, 0.2}}}};
}

}  // namespace

TEST_CASE("every instruction set finds what each layer absorbs", "[slow]") {
    for (int regime = 0; regime < static_cast<int>(Regime::count); ++regime) {
        Random random(static_cast<std::uint64_t>(regime) + 5);
        for (int i = 0; i < 60; ++i) {
            const Stack stack = random_stack(static_cast<Regime>(regime), random);
            const IndexTable table(stack, random_wavelengths(random, 11));
            const StackPower power(stack);
            const std::vector<IncidentAngle> cosines{1, random.uniform(0, 1),
                                                     random.uniform(0.01, 0.1)};
            const Spectra plain = spectra(power, table, cosines, kLayers, {1, SimdLevel::plain});
            for (const SimdLevel level : tested_vector_levels()) {
                CAPTURE(regime, i, name_of(level), oracle::text_of(stack));
                const Spectra fast = spectra(power, table, cosines, kLayers, {1, level});
                for (const auto of : {&Spectra::s, &Spectra::p}) {
                    const std::vector<double>&a = (fast.*of).A_layers, &e = (plain.*of).A_layers;
                    REQUIRE(a.size() == e.size());
                    const std::size_t points = (plain.*of).R.size();
                    for (std::size_t j = 0; j < e.size(); ++j) {
                        const double R = (plain.*of).R[j % points], T = (plain.*of).T[j % points];
                        // resonances and amplification enlarge rounding errors
                        const double relative = 1e-10 * std::max(1.0, R + T);
                        CAPTURE(j / points, j % points, R, T);
                        CHECK_THAT(a[j], WithinAbs(e[j], relative * std::abs(e[j]) + 1e-250));
                        if (a[j] == 0) CHECK_FALSE(std::signbit(a[j]));
                    }
                }
            }
        }
    }
}

TEST_CASE("what layers absorb does not depend on other points") {
    Random random(12);
    for (int i = 0; i < 40; ++i) {
        const Stack stack = random_stack(
            static_cast<Regime>(random.below(static_cast<std::uint64_t>(Regime::count))), random);
        const std::vector<double> wavelengths = random_wavelengths(random, 9);
        std::vector<double> cosines{1, 0};
        for (int j = 0; j < 12; ++j) cosines.push_back(random.uniform(0, 1));
        const StackPower power(stack);
        for (const SimdLevel level : tested_vector_levels()) {
            const Spectra all =
                spectra(power, IndexTable(stack, wavelengths), cosines, kLayers, {1, level});
            for (std::size_t w = 0; w < wavelengths.size(); ++w) {
                const Spectra across = spectra(power, IndexTable(stack, {wavelengths[w]}), cosines,
                                               kLayers, {1, level});
                for (std::size_t j = 0; j < across.p.A_layers.size(); ++j) {
                    const std::size_t row = j * wavelengths.size() + w;
                    CHECK(all.s.A_layers[row] == across.s.A_layers[j]);
                    CHECK(all.p.A_layers[row] == across.p.A_layers[j]);
                }
            }
        }
    }
}

TEST_CASE("one polarization absorbs what it does beside the other, and memory is used again") {
    Random random(13);
    const Stack stack = random_stack(Regime::mixed, random);
    const StackPower power(stack);
    const IndexTable table(stack, random_wavelengths(random, 20));
    const std::vector<IncidentAngle> incidence{1, 0.6};
    const Spectra both = spectra(power, table, incidence, kLayers);
    Spectra some = both;
    for (double& value : some.p.A_layers) value = 7;
    spectra(power, table, incidence, {.s = false, .layers = true}, {1}, some);
    CHECK(some.p.A_layers == both.p.A_layers);
    CHECK(some.s.A_layers.empty());
    spectra(power, table, incidence, {.p = false, .layers = true}, {2}, some);
    CHECK(some.s.A_layers == both.s.A_layers);
}

TEST_CASE("materials that absorb elsewhere absorb nothing where k is 0") {
    const std::vector<double> clear{400, 430, 470, 480, 499, 500}, mixed{400, 550, 499, 700, 480};
    const std::vector<double> cosines{1, 0.9, 0.5, 0.1};
    for (const bool in_group : {false, true}) {
        const auto build = [&](bool partly) {
            StackBuilder b(1.3);
            const Element film =
                partly ? b.layer_of(b.material(partly_absorbing()), 70) : b.layer(2.1, 70);
            const std::vector<Element> pair{film, b.layer(1.1, 120)};
            b.add(film);
            b.add(StackBuilder::group(in_group ? 60 : 5, pair));
            return b.over(1.5);
        };
        const Stack partly = build(true), never = build(false);
        for (const SimdLevel level : kSimdLevels) {
            if (!is_available(level)) continue;
            CAPTURE(in_group, name_of(level));
            // tables of these and of longer wavelengths: only the latter know that it absorbs
            for (const std::vector<double>& wavelengths : {clear, mixed}) {
                std::vector<double> longer = wavelengths;
                longer.push_back(700);
                const Spectra a = spectra(StackPower(partly), IndexTable(partly, longer), cosines,
                                          kLayers, {1, level});
                const Spectra e = spectra(StackPower(never), IndexTable(never, longer), cosines,
                                          kLayers, {1, level});
                for (std::size_t i = 0; i < a.s.R.size(); ++i) {
                    const double nm = longer[i % longer.size()];
                    CAPTURE(nm, i / longer.size());
                    for (const auto of : {&Spectra::s, &Spectra::p}) {
                        const Power power = (a.*of).power(i), expected = (e.*of).power(i);
                        CHECK_THAT(power.R + power.T + power.A, WithinAbs(1, 1e-14));
                        if (nm > 500) {
                            CHECK(power.A > 0);
                            continue;
                        }
                        CHECK(power.A == 0);
                        CHECK_THAT(power.R, WithinAbs(expected.R, 2e-13));
                        CHECK_THAT(power.T, WithinAbs(expected.T, 2e-12 * expected.T));
                        for (std::size_t j = i; j < (a.*of).A_layers.size(); j += a.s.R.size())
                            CHECK((a.*of).A_layers[j] == 0);
                    }
                }
            }
        }
    }
}
