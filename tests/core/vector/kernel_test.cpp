#include "core/vector/kernel.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/spectrum/spectrum.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::WithinAbs;
using oracle::incoherent;
using oracle::StackBuilder;

namespace {

constexpr Needs kEverything{.amplitudes = true, .denominators = true};

/// All kinds of film for which the kernel has its own path.
enum class Sort {
    transparent,
    absorbing,
    mixed,
    weakly_absorbing,
    metal,
    frustrated,
    gain,
    pairs,
    triples,
    absorbing_periods,
    frustrated_periods,
    count
};

bool is_one_of(Sort sort, std::initializer_list<Sort> sorts) {
    return std::find(sorts.begin(), sorts.end(), sort) != sorts.end();
}

Complex denominator(const Spectrum& spectrum, std::size_t point) {
    return {spectrum.denominator_re[point], spectrum.denominator_im[point]};
}

Stack random_films(Sort sort, Random& random) {
    const bool frustrated = is_one_of(sort, {Sort::frustrated, Sort::frustrated_periods});
    StackBuilder b(frustrated ? 1.8 : 1.0);
    const auto film = [&] {
        double k = 0;
        if (sort == Sort::absorbing) k = random.uniform(0, 3);
        if (is_one_of(sort, {Sort::mixed, Sort::absorbing_periods}))
            k = random.below(2) == 0 ? 0 : random.uniform(0, 0.1);
        if (sort == Sort::weakly_absorbing) k = std::pow(10, random.uniform(-14, -2));
        if (sort == Sort::metal) k = random.uniform(1, 6);
        if (sort == Sort::gain) k = -std::pow(10, random.uniform(-8, -3));
        return b.layer({random.uniform(sort == Sort::metal ? 0.05 : 1.2, 2.6), k},
                       random.uniform(0, sort == Sort::metal ? 60 : 400));
    };
    std::vector<Element> period{film(), film()};
    if (sort == Sort::triples) period.push_back(film());
    if (is_one_of(sort,
                  {Sort::pairs, Sort::triples, Sort::absorbing_periods, Sort::frustrated_periods}))
        b.add(StackBuilder::group(1 + random.below(60), period));
    for (std::size_t left = random.below(6) + 1; left > 0; --left) b.add(film());
    const bool absorbing_base = is_one_of(sort, {Sort::absorbing, Sort::metal});
    return b.over({random.uniform(1, 2), absorbing_base ? random.uniform(0, 3) : 0});
}

template <class F>
void for_random_films(std::uint64_t seed, int count, const F& f) {
    Random random(seed);
    for (int i = 0; i < count; ++i)
        for (int sort = 0; sort < static_cast<int>(Sort::count); ++sort) {
            const Stack stack = random_films(static_cast<Sort>(sort), random);
            CAPTURE(sort, oracle::text_of(stack));
            f(stack, static_cast<Sort>(sort), random);
        }
}

void check_close(const Spectrum& a, const Spectrum& b, std::size_t i, Sort sort) {
    // resonances, gain and grazing periods amplify rounding errors of 1e-15 that much
    const double scale = std::max(1.0, b.R[i] + b.T[i]);
    CHECK_THAT(a.R[i], WithinAbs(b.R[i], 1e-10 * scale));
    CHECK_THAT(a.T[i], WithinAbs(b.T[i], 1e-10 * b.T[i]));
    CHECK_THAT(
        a.A[i],
        WithinAbs(b.A[i], (sort == Sort::gain ? 1e-10 : 1e-9 * std::abs(b.A[i]) + 1e-22) * scale));
    CHECK(std::abs(a.r[i] - b.r[i]) < 1e-10 * scale);
    CHECK(std::abs(a.t[i] - b.t[i]) <= 1e-10 * std::abs(b.t[i]));
    const double ratio =
        std::abs(denominator(a, i) / denominator(b, i)) * std::exp(a.log_scale[i] - b.log_scale[i]);
    CHECK_THAT(ratio, WithinAbs(1, 1e-8));
}

void check_same_point(const Spectrum& a, std::size_t i, const Spectrum& b, std::size_t j) {
    CHECK(a.R[i] == b.R[j]);
    CHECK(a.T[i] == b.T[j]);
    CHECK(a.A[i] == b.A[j]);
    CHECK(a.r[i] == b.r[j]);
    CHECK(a.t[i] == b.t[j]);
    CHECK(denominator(a, i) == denominator(b, j));
    CHECK(a.log_scale[i] == b.log_scale[j]);
}

}  // namespace

TEST_CASE("every instruction set agrees with the plain kernel") {
    for_random_films(3, 60, [](const Stack& stack, Sort sort, Random& random) {
        std::vector<double> wavelengths;
        for (int i = 0; i < 11; ++i) wavelengths.push_back(random.uniform(300, 900));
        const IndexTable table(stack, wavelengths);
        const StackPower power(stack);
        const std::vector<IncidentAngle> cosines{random.uniform(0, 1), 1,
                                                 random.uniform(0.01, 0.1)};
        const Spectra plain = spectra(power, table, cosines, kEverything, {1, SimdLevel::plain});
        for (const SimdLevel level : tested_vector_levels()) {
            CAPTURE(name_of(level));
            CHECK(work_of(power, table, cosines, kEverything, {1, level}).kernel == level);
            const Spectra fast = spectra(power, table, cosines, kEverything, {1, level});
            for (std::size_t i = 0; i < plain.s.R.size(); ++i) {
                check_close(fast.s, plain.s, i, sort);
                check_close(fast.p, plain.p, i, sort);
            }
        }
    });
}

TEST_CASE("incoherent layers between vector blocks agree with the plain kernel") {
    Random random(11);
    for (int i = 0; i < 300; ++i) {
        const auto sort = static_cast<Sort>(random.below(static_cast<std::uint64_t>(Sort::count)));
        if (sort == Sort::gain) continue;
        Stack stack = random_films(sort, random);
        // a plate somewhere, another one on the substrate; some absorb slightly, some are
        // evanescent
        for (const double k : {0.0, random.below(2) == 0 ? 0.0 : 1e-8}) {
            StackBuilder b;
            stack.materials.push_back(b.over({random.uniform(1.3, 1.7), k}).materials.back());
            const std::size_t at = random.below(stack.elements.size() + 1);
            stack.elements.insert(
                stack.elements.begin() + static_cast<std::ptrdiff_t>(at),
                incoherent({Layer{stack.materials.size() - 1, random.uniform(1e3, 1e6)}}));
        }
        CAPTURE(i, static_cast<int>(sort), oracle::text_of(stack));
        std::vector<double> wavelengths, cosines{1, random.uniform(0, 1), 0.05, 0};
        for (int w = 0; w < 10; ++w) wavelengths.push_back(random.uniform(400, 700));
        const IndexTable table(stack, wavelengths);
        const StackPower power(stack);
        const Needs needs{.denominators = true};
        const Spectra plain = spectra(power, table, cosines, needs, {1, SimdLevel::plain});
        for (const SimdLevel level : tested_vector_levels()) {
            const Spectra fast = spectra(power, table, cosines, needs, {1, level});
            for (std::size_t j = 0; j < plain.s.R.size(); ++j)
                for (const auto of : {&Spectra::s, &Spectra::p}) {
                    const Spectrum &a = fast.*of, &e = plain.*of;
                    CHECK_THAT(a.R[j], WithinAbs(e.R[j], 1e-10));
                    CHECK_THAT(a.T[j], WithinAbs(e.T[j], 1e-10 * e.T[j]));
                    CHECK_THAT(a.A[j], WithinAbs(e.A[j], 1e-9 * e.A[j] + 1e-15));
                }
        }
    }
}

TEST_CASE("a point's result does not depend on its company") {
    for_random_films(4, 12, [](const Stack& stack, Sort, Random& random) {
        std::vector<double> wavelengths, cosines{1, 0};
        for (int i = 0; i < 9; ++i) wavelengths.push_back(random.uniform(300, 900));
        for (int i = 0; i < 12; ++i) cosines.push_back(random.uniform(0, 1));
        const StackPower power(stack);
        for (const SimdLevel level : tested_vector_levels()) {
            CAPTURE(name_of(level));
            const Spectra all =
                spectra(power, IndexTable(stack, wavelengths), cosines, kEverything, {1, level});
            for (std::size_t w = 0; w < wavelengths.size(); ++w) {
                // one wavelength: then other angles are processed together with it
                const Spectra across = spectra(power, IndexTable(stack, {wavelengths[w]}), cosines,
                                               kEverything, {1, level});
                for (std::size_t a = 0; a < cosines.size(); ++a) {
                    check_same_point(all.s, a * wavelengths.size() + w, across.s, a);
                    check_same_point(all.p, a * wavelengths.size() + w, across.p, a);
                }
            }
        }
    });
}

TEST_CASE("spectra have the same bytes for every thread count") {
    Random random(9);
    const Stack stack = random_films(Sort::mixed, random);
    std::vector<double> wavelengths, cosines;
    for (int i = 0; i < 2500; ++i) wavelengths.push_back(300 + 0.2 * i);
    for (int i = 0; i < 30; ++i) cosines.push_back(0.01 + 0.03 * i);
    const IndexTable table(stack, wavelengths);
    const StackPower power(stack);
    const Spectra one = spectra(power, table, cosines, {}, {1});
    for (const unsigned threads : {0U, 2U, 3U, 16U}) {
        const Spectra many = spectra(power, table, cosines, {}, {threads});
        CHECK(many.s.R == one.s.R);
        CHECK(many.s.T == one.s.T);
        CHECK(many.p.A == one.p.A);
    }
}

TEST_CASE("what is not needed is not computed, and the rest keeps its value") {
    for_random_films(6, 4, [](const Stack& stack, Sort, Random& random) {
        const IndexTable table(stack, {random.uniform(400, 700), random.uniform(400, 700)});
        const StackPower power(stack);
        const std::vector<double> cosines{0.4, 1};
        const Spectra all = spectra(power, table, cosines, {});
        const Spectra only_R = spectra(power, table, cosines, {.s = false, .T = false, .A = false});
        for (std::size_t i = 0; i < all.p.R.size(); ++i)  // A has its share of rounding errors
            CHECK_THAT(only_R.p.R[i], WithinAbs(all.p.R[i], 1e-12 * std::max(1.0, all.p.R[i])));
        CHECK(only_R.p.T.empty());
        CHECK(only_R.p.A.empty());
        CHECK(only_R.s.R.empty());
        const Spectra only_T = spectra(power, table, cosines, {.p = false, .R = false, .A = false});
        for (std::size_t i = 0; i < all.s.T.size(); ++i)
            CHECK_THAT(only_T.s.T[i], WithinAbs(all.s.T[i], 1e-12 * all.s.T[i]));
        CHECK(only_T.s.R.empty());
    });
}

TEST_CASE("zeros are not negative") {
    StackBuilder b;
    b.add(b.layer(1.46, 25));
    const Stack stack = b.over({3.9, 0.02});
    const std::vector<double> cosines{1, 0.3};
    for (const SimdLevel level : tested_vector_levels()) {
        const Spectra at =
            spectra(StackPower(stack), IndexTable(stack, {633}), cosines, kEverything, {1, level});
        for (const double A : {at.s.A[0], at.s.A[1], at.p.A[1]}) {
            CHECK(A == 0);
            CHECK_FALSE(std::signbit(A));
        }
    }
}

TEST_CASE("work says which path a stack takes") {
    const auto work = [](const Stack& stack, const Needs& needs = {}) {
        const IndexTable table(stack, {500, 600});
        const std::vector<IncidentAngle> cosines{1, 0.5};
        return work_of(StackPower(stack), table, cosines, needs);
    };
    StackBuilder film;
    film.add(film.layer(1.5, 300));
    const Work one = work(film.over({2, 1}));
    CHECK(one.points == 4);
    CHECK(one.one_film);
    CHECK(one.transparent_layers == 1);
    CHECK(one.constant_media == 2);
    CHECK(one.normal_angles == 1);
    CHECK_FALSE(one.absorbs);
    CHECK(one.kernel == best_simd_level());
    CHECK(work(film.over(2), {.layers = true}).kernel == one.kernel);

    StackBuilder mirror;
    mirror.add(StackBuilder::group(500, {mirror.layer(2.3, 60), mirror.layer(1.46, 94)}));
    const Work periods = work(mirror.over(1.5));
    CHECK(periods.powers == 1);
    CHECK(periods.layers == 2);

    StackBuilder metal;
    for (int i = 0; i < 5; ++i) {
        metal.add(metal.layer({0.1, 3}, 10));
        metal.add(metal.layer(1.5, 80));
    }
    const Work repeated = work(metal.over(1.5));
    CHECK(repeated.layers == 10);
    CHECK(repeated.transparent_layers == 5);
    CHECK(repeated.distinct_layers == 2);
    CHECK(repeated.absorbs);

    StackBuilder spread;
    Element soft = spread.layer(1.5, 1e3);
    std::get<Layer>(soft.value).thickness_sigma_nm = 10;
    spread.add(soft);
    CHECK(work(spread.over(1)).kernel == SimdLevel::plain);

    StackBuilder plate;
    plate.add(plate.layer(1.38, 100));
    plate.add(incoherent(plate.layer(1.5, 1e6)));
    const Work both_sides = work(plate.over(1));
    CHECK(both_sides.kernel == best_simd_level());
    CHECK(both_sides.passes == 3);
}

TEST_CASE("closed powers and written-out periods agree", "[program]") {
    // 20 periods are multiplied out, 21 are raised to their power
    for (const double cosine : {1.0, 0.7, 0.2}) {
        const auto R = [&](std::uint64_t repeat, bool grouped) {
            StackBuilder b;
            const std::vector<Element> pair{b.layer(2.3, 60), b.layer(1.46, 94)};
            if (grouped) {
                b.add(StackBuilder::group(repeat, pair));
            } else {
                for (std::uint64_t i = 0; i < repeat; ++i)
                    for (const Element& element : pair) b.add(element);
            }
            const Stack stack = b.over(1.52);
            std::vector<double> wavelengths;
            for (int i = 0; i < 50; ++i) wavelengths.push_back(400 + 7.3 * i);
            return spectra(StackPower(stack), IndexTable(stack, wavelengths), std::span(&cosine, 1),
                           {})
                .p.R;
        };
        for (const std::uint64_t repeat : {20U, 21U, 90U}) {
            const std::vector<double> closed = R(repeat, true), written = R(repeat, false);
            for (std::size_t i = 0; i < closed.size(); ++i)
                CHECK_THAT(closed[i], WithinAbs(written[i], 1e-12));
        }
    }
}

TEST_CASE("thicknesses whose phases are too large for the vector sine go the plain way") {
    StackBuilder b;
    b.add(b.layer(1.5, 1e9));
    const Stack film = b.over(1.7);
    StackBuilder thick;
    thick.add(thick.layer(1e4, 1e9));
    const Stack extreme = thick.over(1.7);
    const std::vector<IncidentAngle> cosines{0.5};
    const IndexTable visible(film, {550}), xray(extreme, {1});
    CHECK(work_of(StackPower(film), visible, cosines, {}).kernel == best_simd_level());
    CHECK(work_of(StackPower(extreme), xray, cosines, {}).kernel == SimdLevel::plain);
}

TEST_CASE("a laser threshold is an error at every level") {
    // (n - 1)/(n + 1) exp(gain) = 1 at normal incidence, found by scanning the gain of a film
    for (const SimdLevel level : tested_vector_levels()) {
        StackBuilder b;
        b.add(b.layer({1.5, -1e300}, 100));
        const Stack stack = b.over(1);
        const double cosine = 1;
        CHECK_THROWS_AS(spectra(StackPower(stack), IndexTable(stack, {550}), std::span(&cosine, 1),
                                {}, {1, level}),
                        DomainError);
    }
}
