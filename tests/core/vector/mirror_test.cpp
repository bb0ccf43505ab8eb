// Yeh's closed form of embedded mirrors, compared with the general kernel and with 50 digits.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "core/coherent/hosted_mirror.hpp"
#include "core/periodic/bragg.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/truth/reference.hpp"
#include "core/truth/stability.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::WithinAbs;
using Catch::WithinRel;
using oracle::StackBuilder;

namespace {

struct Mirror {
    RealLayer host, other;
    std::uint64_t repeat = 10;
    bool turned = false;  ///< light meets the other layer first
};

Stack stack_of(const Mirror& mirror) {
    StackBuilder b(mirror.host.n);
    std::vector<Element> pair{b.layer(mirror.host.n, mirror.host.thickness_nm),
                              b.layer(mirror.other.n, mirror.other.thickness_nm)};
    if (mirror.turned) std::swap(pair[0], pair[1]);
    b.add(StackBuilder::group(mirror.repeat, pair));
    return b.over(mirror.host.n);
}

/// The same stack for the general kernel, hiding that the substrate is the host.
Stack without_host(Stack stack) {
    stack.materials.push_back(stack.materials[stack.substrate]);
    stack.substrate = stack.materials.size() - 1;
    return stack;
}

Spectra at(const Stack& stack, std::vector<double> wavelengths_nm, std::vector<double> cosines,
           const Needs& needs = {}, SimdLevel level = best_simd_level()) {
    return spectra(StackPower(stack), IndexTable(stack, std::move(wavelengths_nm)), cosines, needs,
                   {1, level});
}

bool takes_closed_form(const Stack& stack, const Needs& needs = {}) {
    const IncidentAngle cosine(0.7);
    return work_of(StackPower(stack), IndexTable(stack, {500, 600}), std::span(&cosine, 1), needs)
        .mirror;
}

Mirror random_mirror(Random& random, double most_repeats) {
    Mirror mirror{{1, random.uniform(30, 400)}, {random.uniform(1.2, 2.7), 0}};
    mirror.other.thickness_nm = random.uniform(30, 400);
    if (random.one_in(2)) mirror.host.n = random.uniform(1.1, 2.7);
    mirror.repeat = static_cast<std::uint64_t>(random.log_uniform(7, most_repeats));
    mirror.turned = random.one_in(2);
    return mirror;
}

const Spectrum& of(const Spectra& spectra, std::size_t polarization) {
    return polarization == 0 ? spectra.s : spectra.p;
}

std::size_t mirrors_to_try() {
    const char* const text = std::getenv("IRIDO_TEST_MIRRORS");
    return text ? std::strtoull(text, nullptr, 10) : 400;
}

}  // namespace

TEST_CASE("mirrors in their host are what the general kernel says", "[mirror]") {
    // compared where the problem is well-conditioned: 90 roundings of the inputs are 1e-14
    Random random(21);
    double worst_R = 0, worst_T = 0;
    std::size_t compared = 0;
    const std::size_t mirrors = mirrors_to_try();
    for (std::size_t i = 0; i < mirrors; ++i) {
        const Mirror mirror = random_mirror(random, random.one_in(2) ? 60 : 1e9);
        const Stack stack = stack_of(mirror), other = without_host(stack);
        const double nm = random.uniform(380, 780);
        const double angle_deg = random.one_in(4) ? 0 : random.uniform(0, 85);
        CAPTURE(oracle::text_of(stack), nm, angle_deg);
        REQUIRE(takes_closed_form(stack));
        REQUIRE_FALSE(takes_closed_form(other));
        const auto exact = conditioned_power(stack, nm, angle_deg);
        const std::vector<double> cosine{cos_of_incidence(angle_deg)};
        const Spectra yeh = at(stack, {nm}, cosine), general = at(other, {nm}, cosine);
        for (const std::size_t p : {0U, 1U}) {
            const Condition& condition = exact[p].condition;
            const Power a = of(yeh, p).power(0), b = of(general, p).power(0);
            CHECK(std::abs(a.R - exact[p].power.R) <= error_bound(condition.R));
            if (condition.R < 90) {
                ++compared;
                CHECK_THAT(a.R, WithinAbs(b.R, 1e-13));
                worst_R = std::max(worst_R, std::abs(a.R - b.R));
            }
            if (condition.log_T < 90 && b.T > 0) {
                CHECK_THAT(a.T, WithinRel(b.T, 1e-13));
                worst_T = std::max(worst_T, std::abs(a.T / b.T - 1));
            }
        }
    }
    CHECK(compared > mirrors / 2);
    if (mirrors > 1000) WARN("worst R " << worst_R << ", T " << worst_T << " of " << compared);
}

TEST_CASE("every instruction set has the same mirrors, whatever stands beside a point",
          "[mirror]") {
    Random random(22);
    for (int i = 0; i < 60; ++i) {
        const Stack stack = stack_of(random_mirror(random, 100));
        std::vector<double> wavelengths, cosines{1, random.uniform(0.05, 1), 0};
        for (int w = 0; w < 11; ++w) wavelengths.push_back(random.uniform(300, 900));
        const Spectra plain = at(stack, wavelengths, cosines, {}, SimdLevel::plain);
        CAPTURE(oracle::text_of(stack), cosines[1]);
        for (const SimdLevel level : tested_vector_levels()) {
            const Spectra all = at(stack, wavelengths, cosines, {}, level);
            for (std::size_t w = 0; w < wavelengths.size(); ++w) {
                const Spectra across = at(stack, {wavelengths[w]}, cosines, {}, level);
                for (std::size_t c = 0; c < cosines.size(); ++c)
                    for (const std::size_t p : {0U, 1U}) {
                        const std::size_t point = c * wavelengths.size() + w;
                        const Power a = of(all, p).power(point);
                        CHECK(a.R == of(across, p).R[c]);
                        CHECK(a.T == of(across, p).T[c]);
                        // 100 periods amplify rounding errors of 1e-15 that much
                        CHECK_THAT(a.R, WithinAbs(of(plain, p).R[point], 1e-11));
                        CHECK_THAT(a.T, WithinRel(of(plain, p).T[point], 1e-10));
                    }
            }
        }
    }
}

TEST_CASE("a mirror in its host takes nothing, and R and T are all", "[mirror]") {
    Random random(23);
    for (int i = 0; i < 100; ++i) {
        const Stack stack = stack_of(random_mirror(random, 1e9));
        std::vector<double> wavelengths;
        for (int w = 0; w < 8; ++w) wavelengths.push_back(random.uniform(300, 900));
        const Spectra both = at(stack, wavelengths, {1, random.uniform(0.01, 1)});
        for (const std::size_t p : {0U, 1U})
            for (std::size_t point = 0; point < both.s.R.size(); ++point) {
                const Power power = of(both, p).power(point);
                CHECK(power.A == 0);
                CHECK_FALSE(std::signbit(power.A));
                CHECK(power.R >= 0);
                CHECK(power.T >= 0);
                CHECK(std::abs(power.R + power.T - 1) <= std::numeric_limits<double>::epsilon());
            }
    }
}

TEST_CASE("at the edge of a gap a mirror keeps the digits that the edge has", "[mirror]") {
    Random random(24);
    double worst_thousand = 0;
    for (int i = 0; i < 60; ++i) {
        Mirror mirror = random_mirror(random, 1e9);
        const double angle_deg = random.one_in(2) ? 0 : random.uniform(0, 40);
        mirror.host.n = 1;
        if (i % 2 == 0) mirror.repeat = 1000;
        const Stack stack = stack_of(mirror);
        const double cosine = cos_of_incidence(angle_deg);
        for (const std::size_t p : {0U, 1U}) {
            const BraggPeriod period = bragg_period(mirror.host, mirror.other, 1, cosine,
                                                    p == 0 ? Polarization::s : Polarization::p);
            const BandGap gap = band_gap(period, static_cast<double>(1 + random.below(5)));
            for (const double omega : {gap.low_per_nm, gap.high_per_nm}) {
                const double nm = 2 * std::numbers::pi / omega;
                const ConditionedPower exact = conditioned_power(stack, nm, angle_deg)[p];
                const Power power = of(at(stack, {nm}, {cosine}), p).power(0);
                CAPTURE(oracle::text_of(stack), nm, angle_deg, p);
                CHECK(std::abs(power.R - exact.power.R) <= error_bound(exact.condition.R));
                if (mirror.repeat == 1000)
                    worst_thousand = std::max(worst_thousand, std::abs(power.R - exact.power.R));
            }
        }
    }
    CHECK(worst_thousand < 1e-11);  // 1000 periods change R by 1e4 times a change of phase
}

TEST_CASE("T keeps its digits in gaps, down to 1e-300", "[mirror]") {
    Random random(25);
    double least = 1;
    for (int i = 0; i < 200; ++i) {
        Mirror mirror{{1, 0}, {random.uniform(1.3, 2.7), 0}};
        const double nm = random.uniform(380, 780);
        mirror.host.thickness_nm = nm / 4 * random.uniform(0.95, 1.05);
        mirror.other.thickness_nm = nm / (4 * mirror.other.n) * random.uniform(0.95, 1.05);
        // at the centre of the gap T is about 4 n^(-2N)
        const double digits = random.uniform(2, 300);
        mirror.repeat =
            static_cast<std::uint64_t>(7 + digits * std::log(10) / (2 * std::log(mirror.other.n)));
        const Stack stack = stack_of(mirror);
        const ConditionedPower exact = conditioned_power(stack, nm, 0)[0];
        if (exact.power.T < 1e-300) continue;
        const double T = at(stack, {nm}, {1}).s.T[0];
        CAPTURE(oracle::text_of(stack), nm, exact.power.T);
        // the exponent is at most 690, with four roundings of each unit
        CHECK_THAT(T, WithinRel(exact.power.T, 1e-13 - 2e-16 * 2 * std::log(exact.power.T)));
        least = std::min(least, T);
    }
    CHECK(least < 1e-280);
}

TEST_CASE("closed gaps are ordinary points", "[mirror]") {
    // half waves for both layers, at every number of periods, and one ulp away
    for (const std::uint64_t repeat : {7UL, 1000UL, 1000000000UL}) {
        const Mirror mirror{{1, 300}, {1.5, 200}, repeat};
        for (const double nm : {600.0, 300.0, std::nextafter(600.0, 0), std::nextafter(300.0, 999)})
            CHECK_THAT(at(stack_of(mirror), {nm}, {1}).s.T[0], WithinAbs(1, 1e-12));
        // Brewster's angle: p sees no interface, s has its gaps
        const Mirror glass{{1, 210}, {1.5, 130}, repeat};
        const double cosine = 1 / std::hypot(1.0, 1.5);
        std::vector<double> wavelengths;
        for (int i = 0; i < 40; ++i) wavelengths.push_back(300 + 17.3 * i);
        const Spectra both = at(stack_of(glass), wavelengths, {cosine});
        for (const double R : both.p.R) {
            // the angle is off by a rounding error, at which every period reflects a little
            const double r = 1e-15 * static_cast<double>(repeat);
            CHECK(R <= r * r + 1e-28);
        }
        CHECK(*std::max_element(both.s.R.begin(), both.s.R.end()) > 0.5);
    }
}

TEST_CASE("indices that hardly differ keep the digits of their difference", "[mirror]") {
    for (const double contrast : {1e-3, 1e-6, 1e-9, 1e-12})
        for (const double angle_deg : {0.0, 35.0, 80.0}) {
            const Mirror mirror{{1.5, 210}, {1.5 * (1 + contrast), 130}, 1000};
            const Stack stack = stack_of(mirror);
            const auto exact = conditioned_power(stack, 517, angle_deg);
            const Spectra both = at(stack, {517}, {cos_of_incidence(angle_deg)});
            for (const std::size_t p : {0U, 1U}) {
                CAPTURE(contrast, angle_deg, p);
                // phases of 1000 periods, 1e4 radians, have rounding errors of 1e-12
                CHECK_THAT(of(both, p).R[0], WithinRel(exact[p].power.R, 1e-10));
            }
        }
}

TEST_CASE("an evanescent layer in the host is a mirror too", "[mirror]") {
    for (const double thickness_nm : {0.1, 20.0, 300.0, 5e3, 1e6}) {
        const Mirror mirror{{1.8, 150}, {1.2, thickness_nm}, 9};
        const Stack stack = stack_of(mirror);
        std::vector<double> wavelengths;
        for (int i = 0; i < 20; ++i) wavelengths.push_back(400 + 19 * i);
        // past, at and before the critical angle
        const std::vector<double> cosines{0.3, std::sqrt(1 - 1.2 * 1.2 / (1.8 * 1.8)), 0.9};
        const Spectra yeh = at(stack, wavelengths, cosines);
        const Spectra general = at(without_host(stack), wavelengths, cosines, {}, SimdLevel::plain);
        CAPTURE(thickness_nm);
        for (const std::size_t p : {0U, 1U})
            for (std::size_t i = 0; i < yeh.s.R.size(); ++i) {
                // at the critical angle the last digits of the cosine are amplified a million times
                const bool critical = i / wavelengths.size() == 1;
                CHECK_THAT(of(yeh, p).R[i],
                           WithinAbs(of(general, p).R[i], critical ? 1e-5 : 1e-11));
                if (!critical && of(general, p).T[i] > 1e-290)
                    CHECK_THAT(of(yeh, p).T[i], WithinRel(of(general, p).T[i], 1e-9));
            }
    }
}

TEST_CASE("a mirror's layers may have dispersion, its host's medium too", "[mirror]") {
    const auto cauchy = [](double a, double b) {
        return Material{"", RefractiveIndex{Formula{5, {a, b, -2}, kAllWavelengths}, Constant{0}}};
    };
    for (const bool host_too : {false, true}) {
        StackBuilder b(1);
        const std::size_t host = host_too ? b.material(cauchy(1.32, 0.003)) : 0;
        const std::size_t high = b.material(cauchy(2.1, 0.02));
        b.add(StackBuilder::group(
            30, {StackBuilder::layer_of(high, 61), StackBuilder::layer_of(host, 100)}));
        Stack stack = b.over_material(host);
        stack.incident = host;
        CHECK(takes_closed_form(stack));
        std::vector<double> wavelengths;
        for (int i = 0; i < 60; ++i) wavelengths.push_back(380 + 6.7 * i);
        const Spectra yeh = at(stack, wavelengths, {1, 0.6, 0.2});
        const Spectra general = at(without_host(stack), wavelengths, {1, 0.6, 0.2});
        for (const std::size_t p : {0U, 1U})
            for (std::size_t i = 0; i < yeh.s.R.size(); ++i) {
                CHECK_THAT(of(yeh, p).R[i], WithinAbs(of(general, p).R[i], 1e-11));
                CHECK_THAT(of(yeh, p).T[i], WithinRel(of(general, p).T[i], 1e-10));
            }
    }
}

TEST_CASE("the host may go on, and the other layer may stand on both ends", "[mirror]") {
    StackBuilder b(1.3);
    const Element host = b.layer(1.3, 120), more = b.layer(1.3, 77), other = b.layer(2.2, 90);
    const auto stack = [&](std::vector<Element> elements) {
        Stack result = b.over(1.3);
        result.elements = std::move(elements);
        return result;
    };
    const auto group = [](std::uint64_t repeat, std::vector<Element> pair) {
        return StackBuilder::group(repeat, std::move(pair));
    };
    const Stack ten = stack({group(10, {host, other})});
    const std::vector<Stack> same{
        ten,
        stack({group(10, {other, host})}),
        stack({other, group(9, {host, other})}),
        stack({group(9, {other, host}), other}),
        stack({more, group(10, {host, other}), more, host}),
        stack({more, other, group(9, {host, other})}),
    };
    const std::vector<double> wavelengths{401, 487, 523, 612, 777}, cosines{1, 0.5};
    const Spectra expected = at(without_host(ten), wavelengths, cosines);
    for (std::size_t k = 0; k < same.size(); ++k) {
        CAPTURE(k);
        CHECK(takes_closed_form(same[k]));
        // the host layers around the periods change the phase of the denominator
        CHECK(takes_closed_form(same[k], {.denominators = true}) == (k < 2));
        const Spectra got = at(same[k], wavelengths, cosines);
        for (const std::size_t p : {0U, 1U})
            for (std::size_t i = 0; i < got.s.R.size(); ++i)
                CHECK_THAT(of(got, p).R[i], WithinAbs(of(expected, p).R[i], 1e-13));
    }
    for (const Stack& not_one :
         {stack({group(9, {host, other}), other}), stack({other, group(9, {other, host})}),
          stack({b.layer(2.2, 91), group(9, {host, other})}),
          stack({other, more, group(9, {host, other})}),
          stack({group(9, {host, other}), group(9, {host, other})}),
          stack({group(9, {host, other, host})}), stack({group(9, {other, other})}),
          stack({group(3, {host, other})}), stack({group(9, {host, host})}), stack({host}),
          stack({})})
        CHECK_FALSE(takes_closed_form(not_one));
}

TEST_CASE("what is no lossless mirror in its host goes the general way", "[mirror]") {
    StackBuilder b(1.3);
    const Element host = b.layer(1.3, 120), other = b.layer(2.2, 90);
    b.add(StackBuilder::group(10, {host, other}));
    CHECK(takes_closed_form(b.over(1.3)));
    CHECK_FALSE(takes_closed_form(b.over(1.31)));
    CHECK_FALSE(takes_closed_form(b.over(1.3), {.amplitudes = true}));
    CHECK(takes_closed_form(b.over(1.3), {.layers = true}));
    const IncidentAngle cosine(1);
    const Stack stack = b.over(1.3);
    CHECK_FALSE(work_of(StackPower(stack), IndexTable(stack, {500}), std::span(&cosine, 1), {},
                        {1, SimdLevel::plain})
                    .mirror);
    StackBuilder other_incident(1.2);
    other_incident.add(
        StackBuilder::group(10, {other_incident.layer(1.3, 120), other_incident.layer(2.2, 90)}));
    CHECK_FALSE(takes_closed_form(other_incident.over(1.3)));
    StackBuilder absorbing(1.3);
    absorbing.add(
        StackBuilder::group(10, {absorbing.layer(1.3, 120), absorbing.layer({2.2, 1e-9}, 90)}));
    CHECK_FALSE(takes_closed_form(absorbing.over(1.3)));
    StackBuilder plate(1.3);
    plate.add(StackBuilder::group(10, {plate.layer(1.3, 120), plate.layer(2.2, 90)}));
    plate.add(oracle::incoherent(plate.layer(1.3, 1e5)));
    CHECK_FALSE(takes_closed_form(plate.over(1.3)));
}

TEST_CASE("the plain closed form leaves what it has no digits for", "[mirror]") {
    const HostedMirror mirror{0, 1, 100, 80, 12};
    const auto power = [&](Complex host, Complex other, double cosine, double k0 = 0.01) {
        return mirror_power(mirror, medium(host, host.real(), cosine),
                            medium(other, host.real(), cosine), k0, Polarization::p);
    };
    const std::optional<Power> lossless = power(1.5, 2.2, 0.8);
    REQUIRE(lossless);
    CHECK(lossless->A == 0);
    CHECK(std::abs(lossless->R + lossless->T - 1) < 1e-15);
    CHECK_FALSE(power(1.5, {2.2, 1e-12}, 0.8));
    CHECK_FALSE(power({1.5, 1e-12}, 2.2, 0.8));
    CHECK_FALSE(power(1.5, 2.2, 0));
    CHECK(power(1.5, 1.1, 0.1));                    // evanescent, |b| about 0.8
    CHECK_FALSE(power(1.5, 1.1, 0.1, 0.01 * 1e3));  // and 800
    // with no layer of either kind, what remains is nothing, or one film
    HostedMirror nothing = mirror;
    nothing.other_nm = 0;
    const Medium host = medium(1.5, 1.5, 0.8), other = medium(2.2, 1.5, 0.8);
    CHECK(mirror_power(nothing, host, other, 0.01, Polarization::s)->R == 0);
    HostedMirror film = mirror;
    film.host_nm = 0;
    StackBuilder b(1.5);
    b.add(b.layer(2.2, 12 * 80));
    const double R = at(b.over(1.5), {2 * std::numbers::pi / 0.01}, {0.8}).s.R[0];
    CHECK_THAT(mirror_power(film, host, other, 0.01, Polarization::s)->R, WithinAbs(R, 1e-14));
}

TEST_CASE("a mirror's denominator is that of the general kernel, sign and all", "[mirror]") {
    Random random(26);
    const Needs needs{.denominators = true};
    for (int i = 0; i < 300; ++i) {
        Mirror mirror = random_mirror(random, 60);
        mirror.turned = random.one_in(2);
        const Stack stack = stack_of(mirror);
        REQUIRE(takes_closed_form(stack, needs));
        const std::vector<double> cosines{1, random.uniform(0.05, 1)};
        CAPTURE(oracle::text_of(stack));
        for (const SimdLevel level : tested_vector_levels()) {
            const double nm = random.uniform(350, 800);
            const Spectra a = at(stack, {nm}, cosines, needs, level);
            const Spectra b = at(without_host(stack), {nm}, cosines, needs, level);
            for (const std::size_t p : {0U, 1U})
                for (std::size_t c = 0; c < cosines.size(); ++c) {
                    const Spectrum &x = of(a, p), &y = of(b, p);
                    const Complex ratio = Complex(x.denominator_re[c], x.denominator_im[c]) /
                                          Complex(y.denominator_re[c], y.denominator_im[c]) *
                                          std::exp(x.log_scale[c] - y.log_scale[c]);
                    // grazing periods next to an edge amplify rounding errors of the phase by 1e4
                    CHECK(std::abs(ratio - 1.0) < 1e-9);
                    const double sine = std::sqrt(1 - cosines[c] * cosines[c]);
                    const bool travels = mirror.host.n * sine < mirror.other.n;
                    // quadrature has a fast path for panels with a single logarithm
                    if (2 * mirror.repeat <= 40 && travels) CHECK(x.log_scale[c] == y.log_scale[c]);
                }
        }
    }
}
