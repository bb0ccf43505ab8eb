#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "core/spectrum/spectrum.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::WithinAbs;
using oracle::incoherent;
using oracle::spread;
using oracle::StackBuilder;

namespace {

constexpr Needs kAlmostEverything{.A = false, .amplitudes = true, .denominators = true};

/// Kinds of layers in the test's stacks.
enum class Sort { transparent, absorbing, mixed, frustrated, periods, gain, count };

Stack random_layers(Sort sort, std::size_t count, Random& random) {
    StackBuilder b(sort == Sort::frustrated ? 1.8 : 1.0);
    const auto layer = [&] {
        double k = 0;
        if (sort == Sort::absorbing) k = random.uniform(0, 2);
        if (sort == Sort::mixed) k = random.below(2) == 0 ? 0 : random.uniform(0, 0.1);
        if (sort == Sort::gain) k = -std::pow(10, random.uniform(-8, -4));
        return b.layer({random.uniform(1.2, 2.6), k}, random.uniform(0, 300));
    };
    for (std::size_t i = 0; i < count; ++i) {
        if (sort == Sort::periods && random.below(3) == 0) {
            b.add(StackBuilder::group(1 + random.below(40), {layer(), layer()}));
        } else {
            b.add(layer());
        }
    }
    return b.over({random.uniform(1, 2), sort == Sort::absorbing ? random.uniform(0, 3) : 0});
}

Layer& layer_of(Element& element) {
    if (Group* group = std::get_if<Group>(&element.value)) return layer_of(group->elements[0]);
    return std::get<Layer>(element.value);
}

std::vector<std::size_t> random_places(std::size_t elements, Random& random) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < elements; ++i)
        if (random.below(elements) < 2) places.push_back(i);
    if (places.empty()) places.push_back(random.below(elements));
    return places;
}

std::vector<double> random_wavelengths(std::size_t count, Random& random) {
    std::vector<double> wavelengths;
    for (std::size_t i = 0; i < count; ++i) wavelengths.push_back(random.uniform(350, 850));
    return wavelengths;
}

std::vector<IncidentAngle> incident_angles(std::span<const double> cosines) {
    return {cosines.begin(), cosines.end()};
}

Spectra compute(const SpectrumKernel& kernel, const IndexTable& table,
                std::span<const double> cosines) {
    Spectra out;
    SpectrumMemory memory;
    kernel(table, incident_angles(cosines), out, memory);
    return out;
}

SpectrumKernel kernel_of(const StackPower& power, const IndexTable& table, const Needs& needs,
                         std::span<const std::size_t> varied, SimdLevel simd = best_simd_level()) {
    return SpectrumKernel(power, table.absorbs(), table.amplifies(), needs, simd, varied);
}

Complex denominator(const Spectrum& spectrum, std::size_t point) {
    return {spectrum.denominator_re[point], spectrum.denominator_im[point]};
}

void check_close(const Spectrum& a, const Spectrum& b, double tolerance) {
    REQUIRE(a.R.size() == b.R.size());
    for (std::size_t i = 0; i < a.R.size(); ++i) {
        const double scale = std::max(1.0, b.R[i] + b.T[i]);
        CHECK_THAT(a.R[i], WithinAbs(b.R[i], tolerance * scale));
        CHECK_THAT(a.T[i], WithinAbs(b.T[i], tolerance * b.T[i]));
        CHECK(std::abs(a.r[i] - b.r[i]) <= tolerance * scale);
        CHECK(std::abs(a.t[i] - b.t[i]) <= tolerance * std::abs(b.t[i]));
        const Complex ratio =
            denominator(a, i) / denominator(b, i) * std::exp(a.log_scale[i] - b.log_scale[i]);
        CHECK(std::abs(ratio - 1.0) < 10 * tolerance);
    }
}

void check_same(const Spectrum& a, const Spectrum& b) {
    CHECK(a.R == b.R);
    CHECK(a.T == b.T);
    CHECK(a.r == b.r);
    CHECK(a.t == b.t);
    CHECK(a.denominator_re == b.denominator_re);
    CHECK(a.denominator_im == b.denominator_im);
    CHECK(a.log_scale == b.log_scale);
}

}  // namespace

TEST_CASE("stored layers do what they do one by one", "[slow]") {
    Random random(31);
    int shared = 0;
    for (int i = 0; i < 400; ++i) {
        const auto sort = static_cast<Sort>(i % static_cast<int>(Sort::count));
        Stack stack = random_layers(sort, 4 + random.below(30), random);
        const std::vector<std::size_t> varied = random_places(stack.elements.size(), random);
        const IndexTable table(stack, random_wavelengths(13, random));
        const std::vector<double> cosines{random.uniform(0.05, 1), 1, 0, random.uniform(0.01, 0.1)};
        for (const SimdLevel level : tested_vector_levels()) {
            StackPower power(stack);
            SpectrumKernel kernel = kernel_of(power, table, kAlmostEverything, varied, level);
            shared += kernel.shares_layers();
            for (const double factor : {1.0, 0.0, 1.7}) {
                Stack other = stack;
                for (const std::size_t place : varied)
                    layer_of(other.elements[place]).thickness_nm *= factor;
                power.assign(other);
                kernel.update();
                const Spectra a = compute(kernel, table, cosines);
                const Spectra b = spectra(power, table, cosines, kAlmostEverything, {1, level});
                CAPTURE(oracle::text_of(other), factor, name_of(level));
                // resonances, gain and evanescent periods amplify rounding errors of 1e-15 that
                // much
                const double tolerance = sort == Sort::transparent ? 1e-11 : 1e-9;
                check_close(a.s, b.s, tolerance);
                check_close(a.p, b.p, tolerance);
            }
        }
    }
    CHECK(shared > 600);
}

TEST_CASE("stored layers agree to 1e-13 where nothing resonates") {
    Random random(32);
    for (int i = 0; i < 300; ++i) {
        StackBuilder b;
        for (int layer = 0; layer < 20; ++layer)
            b.add(b.layer({random.uniform(1.4, 1.7), i % 2 == 0 ? 0 : random.uniform(0, 0.02)},
                          random.uniform(20, 200)));
        const Stack stack = b.over(1.5);
        const std::vector<std::size_t> varied{random.below(20)};
        const IndexTable table(stack, random_wavelengths(9, random));
        const StackPower power(stack);
        const SpectrumKernel kernel = kernel_of(power, table, kAlmostEverything, varied);
        REQUIRE(kernel.shares_layers());
        const std::vector<double> cosines{random.uniform(0.3, 1)};
        const Spectra a = compute(kernel, table, cosines);
        const Spectra c = spectra(power, table, cosines, kAlmostEverything);
        check_close(a.s, c.s, 1e-13);
        check_close(a.p, c.p, 1e-13);
    }
}

TEST_CASE("stored layers of many decades are scaled") {
    // exponents of 1700 and more, above and below the layers that vary
    StackBuilder b;
    for (int i = 0; i < 3; ++i) b.add(b.layer({1.5, 1}, 30000));
    b.add(b.layer(1.4, 120));
    for (int i = 0; i < 3; ++i) b.add(b.layer({1.7, 0.8}, 40000));
    const Stack stack = b.over(1.5);
    const IndexTable table(stack, {400, 500, 600, 700});
    const StackPower power(stack);
    const std::vector<std::size_t> varied{3};
    const SpectrumKernel kernel = kernel_of(power, table, kAlmostEverything, varied);
    REQUIRE(kernel.shares_layers());
    const std::vector<double> cosines{0.3, 0.8};
    const Spectra a = compute(kernel, table, cosines);
    const Spectra c = spectra(power, table, cosines, kAlmostEverything);
    for (const auto of : {&Spectra::s, &Spectra::p}) {
        for (std::size_t i = 0; i < table.wavelength_nm().size() * cosines.size(); ++i) {
            CHECK((c.*of).log_scale[i] > 1700);
            CHECK_THAT((a.*of).R[i], WithinAbs((c.*of).R[i], 1e-13));
            CHECK((a.*of).T[i] == 0);
            // logarithms of thousands are rounded to 1e-12
            const double size = std::log(std::abs(denominator(a.*of, i))) + (a.*of).log_scale[i];
            const double same = std::log(std::abs(denominator(c.*of, i))) + (c.*of).log_scale[i];
            CHECK_THAT(size, WithinAbs(same, 1e-10));
        }
    }
}

TEST_CASE("points of which stored layers come in parts are the same to the last bit") {
    Random random(33);
    for (int i = 0; i < 60; ++i) {
        const auto sort = static_cast<Sort>(i % static_cast<int>(Sort::count));
        const Stack stack = random_layers(sort, 12, random);
        const std::vector<std::size_t> varied{random.below(12)};
        const std::vector<double> wavelengths = random_wavelengths(60, random);
        const IndexTable table(stack, wavelengths);
        const std::vector<double> cosines{1, 0.6};
        for (const SimdLevel level : tested_vector_levels()) {
            const StackPower power(stack);
            const SpectrumKernel kernel = kernel_of(power, table, kAlmostEverything, varied, level);
            if (!kernel.shares_layers()) continue;
            SpectrumMemory memory;
            std::vector<FixedLayers> parts(cosines.size() * 4);
            std::vector<const FixedLayers*> fixed;
            const std::vector<std::size_t> ends{0, 9, 17, 18, 60};
            for (std::size_t part = 0; part < parts.size(); ++part) {
                const auto first = wavelengths.begin();
                const IndexTable some(stack,
                                      {first + static_cast<std::ptrdiff_t>(ends[part % 4]),
                                       first + static_cast<std::ptrdiff_t>(ends[part % 4 + 1])});
                kernel.fix_layers(some, cosines[part / 4], parts[part], memory);
                fixed.push_back(&parts[part]);
            }
            Spectra in_parts;
            kernel(table, incident_angles(cosines), fixed, in_parts, memory);
            const Spectra whole = compute(kernel, table, cosines);
            check_same(in_parts.s, whole.s);
            check_same(in_parts.p, whole.p);
            Spectra by_threads;
            kernel(table, incident_angles(cosines), 3, by_threads);
            check_same(by_threads.s, whole.s);
        }
    }
}

TEST_CASE("one polarization alone has its own stored rows") {
    Random random(34);
    const Stack stack = random_layers(Sort::mixed, 15, random);
    const std::vector<std::size_t> varied{7};
    const IndexTable table(stack, random_wavelengths(20, random));
    const std::vector<double> cosines{1, 0.5};
    const StackPower power(stack);
    const Spectra both =
        compute(kernel_of(power, table, kAlmostEverything, varied), table, cosines);
    Needs only_s = kAlmostEverything, only_p = kAlmostEverything;
    only_s.p = only_p.s = false;
    check_same(compute(kernel_of(power, table, only_s, varied), table, cosines).s, both.s);
    check_same(compute(kernel_of(power, table, only_p, varied), table, cosines).p, both.p);
}

TEST_CASE("layers are shared where that saves work and loses nothing") {
    const auto shares = [](const Stack& stack, std::vector<std::size_t> varied,
                           const Needs& needs = kAlmostEverything,
                           SimdLevel simd = best_simd_level()) {
        const StackPower power(stack);
        return kernel_of(power, IndexTable(stack, {500}), needs, varied, simd).shares_layers();
    };
    Random random(35);
    const Stack lossless = random_layers(Sort::transparent, 10, random);
    const Stack lossy = random_layers(Sort::absorbing, 10, random);
    CHECK(shares(lossless, {0}));
    CHECK(shares(lossless, {4}));
    CHECK(shares(lossless, {1, 9}));
    CHECK(shares(lossy, {4}));
    CHECK_FALSE(shares(lossless, {}));
    CHECK_FALSE(shares(lossless, {0, 2, 4, 6, 8, 9}));  // single layers are left in between
    CHECK_FALSE(shares(random_layers(Sort::transparent, 2, random), {1}));
    CHECK_FALSE(shares(lossless, {4}, kAlmostEverything, SimdLevel::plain));
    // absorptance at full precision is a sum over the layers, which cannot be shared
    CHECK(shares(lossless, {4}, {}));
    CHECK_FALSE(shares(lossy, {4}, {}));
    const Needs powers{.A = false};
    Stack parted = lossless;
    parted.elements[7] = incoherent(parted.elements[7]);
    CHECK_FALSE(shares(parted, {4}, powers));
    Stack blurred = lossless;
    blurred.elements[7] = spread(blurred.elements[7], 2);
    CHECK_FALSE(shares(blurred, {4}, powers));
}

TEST_CASE("an updated kernel is the same as a new one") {
    const auto stack_of = [](const std::function<std::vector<Element>(StackBuilder&)>& elements) {
        StackBuilder b;
        for (const Complex index : {Complex(1.46), Complex(2.3), Complex(1.6, 0.01)})
            b.material(index);
        for (const Element& element : elements(b)) b.add(element);
        return b.over(1);
    };
    using Elements = std::vector<Element>;
    const std::vector<Stack> stacks{
        stack_of([](auto& b) { return Elements{b.layer(1.46, 300)}; }),
        stack_of([](auto& b) {
            return Elements{b.layer(2.3, 60), b.layer(1.46, 90), b.layer({1.6, 0.01}, 200),
                            b.layer(2.3, 60), b.layer(2.3, 0)};
        }),
        stack_of([](auto& b) {
            return Elements{b.layer(2.3, 60), incoherent(b.layer({1.6, 0.01}, 2e4)),
                            b.layer(1.46, 90)};
        }),
        stack_of([](auto& b) {
            return Elements{b.layer(2.3, 60), spread(b.layer(1.46, 90), 5)};
        }),
        stack_of([](auto& b) {
            return Elements{StackBuilder::group(20, {b.layer(2.3, 60), b.layer(1, 90)})};
        }),
        stack_of([](auto& b) {
            return Elements{b.layer(1.46, 10),
                            StackBuilder::group(30, {b.layer(2.3, 60), b.layer(1.46, 90)})};
        }),
        stack_of([](auto&) { return Elements{}; }),
    };
    const Needs needs{.denominators = true};
    const IndexTable table(stacks[0], {400, 433, 521, 650, 711});
    const std::vector<double> cosines{1, 0.7, 0};
    StackPower power(stacks[0]);
    // absorption only in the last material
    const std::vector<bool> absorbs = table.absorbs(), amplifies = table.amplifies();
    SpectrumKernel kernel(power, absorbs, amplifies, needs, best_simd_level());
    Random random(36);
    for (int i = 0; i < 60; ++i) {
        const Stack& stack = stacks[random.below(stacks.size())];
        CAPTURE(oracle::text_of(stack));
        power.assign(stack);
        kernel.update();
        const Spectra a = compute(kernel, table, cosines);
        const StackPower fresh(stack);
        const Spectra b = compute(
            SpectrumKernel(fresh, absorbs, amplifies, needs, best_simd_level()), table, cosines);
        check_same(a.s, b.s);
        check_same(a.p, b.p);
        CHECK(a.s.A == b.s.A);
        CHECK(power.layer_count() == fresh.layer_count());
    }
}
