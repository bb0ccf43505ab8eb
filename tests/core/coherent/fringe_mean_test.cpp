#include "core/coherent/fringe_mean.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/stack/builder.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array<std::size_t, 1> kFirst{0}, kSecond{1};

std::vector<Medium> media_of(const Stack& stack, double wavelength_nm, double angle_deg) {
    const double n0 = index_at(stack.materials[stack.incident], wavelength_nm).real();
    const IncidentAngle incidence = incident_angle(angle_deg);
    std::vector<Medium> media;
    for (const Material& material : stack.materials)
        media.push_back(medium(index_at(material, wavelength_nm), n0, incidence));
    media.push_back(medium(n0, n0, incidence));
    return media;
}

Power power_of(const Stack& stack, std::span<const Medium> media, double k0,
               Polarization polarization) {
    return coherent_response(media.back(), stack.elements, media[stack.substrate], media, k0,
                             polarization)
        .power;
}

}  // namespace

TEST_CASE("the mean over a layer's phase is that of thicknesses close by") {
    oracle::Random random(5);
    for (int i = 0; i < 40; ++i) {
        irido::StackBuilder b(random.uniform(1, 1.5));
        b.add(b.layer({random.uniform(1.5, 2.5), random.one_in(2) ? 0 : 0.01}, 80));
        b.add(b.layer(random.uniform(1.5, 2.5), 3e5));
        b.add(b.layer(random.uniform(1.5, 2.5), 120));
        Stack stack = b.over({random.uniform(0.5, 2), random.one_in(2) ? 0 : 2.0});
        const double nm = random.uniform(400, 700), k0 = 2 * kPi / nm;
        const std::vector<Medium> media = media_of(stack, nm, random.uniform(0, 80));
        const auto polarization = random.one_in(2) ? Polarization::s : Polarization::p;
        const FringeMean mean = fringe_mean(stack, kSecond, media, k0, polarization);
        auto& layer = std::get<Layer>(stack.elements[1].value);
        const double fringe_nm = kPi / (k0 * std::sqrt(media[layer.material].q2.real()));
        constexpr int kSteps = 256;
        double R = 0, T = 0, swing_R = 0, swing_T = 0;
        for (int j = 0; j < kSteps; ++j) {
            layer.thickness_nm += fringe_nm / kSteps;
            const Power power = power_of(stack, media, k0, polarization);
            R += power.R / kSteps;
            T += power.T / kSteps;
            swing_R = std::max(swing_R, std::abs(power.R - mean.R));
            swing_T = std::max(swing_T, std::abs(power.T - mean.T));
        }
        CAPTURE(i, nm);
        CHECK(std::abs(mean.R - R) < 1e-9);
        CHECK(std::abs(mean.T - T) < 1e-9);
        CHECK(swing_R <= mean.swing_R + 1e-9);
        CHECK(swing_T <= mean.swing_T + 1e-9);
    }
}

TEST_CASE("the mean over a group's phase is that of numbers of periods close by") {
    oracle::Random random(16);
    for (int i = 0; i < 40; ++i) {
        irido::StackBuilder b;
        b.add(b.layer(random.uniform(1.5, 2.5), 80));
        std::vector<Element> period;
        for (std::size_t left = 2 + random.below(3); left > 0; --left)
            period.push_back(b.layer(random.uniform(1.2, 2.7), random.uniform(30, 300)));
        b.add(irido::StackBuilder::group(100000, period));
        Stack stack = b.over({random.uniform(0.5, 2), random.one_in(2) ? 0 : 2.0});
        const double nm = random.uniform(400, 700), k0 = 2 * kPi / nm;
        const std::vector<Medium> media = media_of(stack, nm, random.uniform(0, 80));
        const auto polarization = random.one_in(2) ? Polarization::s : Polarization::p;
        const FringeMean mean = fringe_mean(stack, kSecond, media, k0, polarization);
        // varying the number of periods samples all phases, unless K is close to a rational
        // multiple of pi
        const double K = std::abs(mean.form.turn[0]) / (2 * 100000 * kPi);
        bool is_rational = mean.swing_R > 0.8;
        for (double q = 1; q <= 12; ++q)
            is_rational = is_rational || std::abs(q * K - std::round(q * K)) < 5e-3;
        if (is_rational) continue;
        constexpr int kSteps = 4000;
        double R = 0, T = 0, sum = 0;
        for (int j = 0; j < kSteps; ++j) {
            ++std::get<Group>(stack.elements[1].value).repeat;
            const double weight = std::pow(std::sin(kPi * (j + 0.5) / kSteps), 4);
            const Power power = power_of(stack, media, k0, polarization);
            R += weight * power.R;
            T += weight * power.T;
            sum += weight;
        }
        CAPTURE(i, nm);
        CHECK(std::abs(mean.R - R / sum) < 1e-6);
        CHECK(std::abs(mean.T - T / sum) < 1e-6);
    }
}

TEST_CASE("next to the edge of a gap there is no mean") {
    irido::StackBuilder b;
    b.add(irido::StackBuilder::group(20, {b.layer(2.3, 60), b.layer(1.4, 95)}));
    const Stack stack = b.over(1.5);  // so few periods that every wavelength is near an edge
    for (double nm = 400; nm < 700; nm += 7) {
        const std::vector<Medium> media = media_of(stack, nm, 20);
        const double k0 = 2 * kPi / nm;
        const FringeMean mean = fringe_mean(stack, kFirst, media, k0, Polarization::s);
        if (mean.swing_R > 1e-9) continue;
        CAPTURE(nm);
        CHECK(std::abs(mean.R - power_of(stack, media, k0, Polarization::s).R) < 1e-8);
    }
}

namespace {

/// A value of a form at any phases.
Power power_at(const FringeForm& form, double psi_1, double psi_2) {
    const Complex w1 = std::polar(1.0, psi_1), w2 = std::polar(1.0, psi_2);
    const auto at = [&](const std::array<Complex, 4>& of) {
        return of[0] + of[1] * w1 + (of[2] + of[3] * w1) * w2;
    };
    const Complex in = at(form.incident);
    return {std::norm(at(form.reflected) / in), form.through / std::norm(in), 0};
}

/// Two elements of very many periods, or thick layers, with others around them.
Stack two_fast_elements(oracle::Random& random, bool transparent) {
    irido::StackBuilder b(random.uniform(1, 1.5));
    const auto index = [&] {
        return Complex(random.uniform(1.3, 2.6),
                       transparent || random.one_in(2) ? 0 : random.log_uniform(1e-8, 1e-6));
    };
    const auto fast = [&] {
        if (random.one_in(3)) return b.layer(index(), random.uniform(1e5, 2e5));
        std::vector<Element> period;
        for (std::size_t left = 2 + random.below(2); left > 0; --left)
            period.push_back(b.layer(index(), random.uniform(30, 200)));
        return irido::StackBuilder::group(1000 + random.below(1000), std::move(period));
    };
    b.add(b.layer(index(), 80));
    b.add(fast());
    if (random.one_in(2)) b.add(b.layer(index(), 120));
    b.add(fast());
    b.add(b.layer(index(), 50));
    // no total reflection at the substrate: lossless cavities behind gaps have no mean
    return b.over({random.uniform(1.5, 2), transparent ? 0 : random.uniform(0, 3)});
}

}  // namespace

TEST_CASE("forms of two fast elements are the stack") {
    oracle::Random random(31);
    constexpr std::array<std::size_t, 2> kFirstFast{1, 2}, kLaterFast{1, 3};
    for (int i = 0; i < 400; ++i) {
        const Stack stack = two_fast_elements(random, i % 2 == 0);
        const std::span<const std::size_t> fast =
            stack.elements.size() == 4 ? kFirstFast : kLaterFast;
        const double nm = random.uniform(400, 700), k0 = 2 * kPi / nm;
        const std::vector<Medium> media = media_of(stack, nm, random.uniform(0, 80));
        const auto polarization = random.one_in(2) ? Polarization::s : Polarization::p;
        const FringeForm form = fringe_form(stack, fast, media, k0, polarization);
        if (std::max(form.own[0], form.own[1]) > 0) continue;
        const Power exact = power_of(stack, media, k0, polarization);
        const Power power = power_at(form, form.turn[0], form.turn[1]);
        CAPTURE(i, oracle::text_of(stack), nm);
        CHECK(std::abs(power.R - exact.R) < 1e-7);
        CHECK(std::abs(power.T - exact.T) < 1e-7);
    }
}

TEST_CASE("means over two phases, and the waves about them, are those of the form") {
    oracle::Random random(32);
    constexpr std::array<std::size_t, 2> kFirstFast{1, 2}, kLaterFast{1, 3};
    int waves = 0;
    for (int i = 0; i < 200; ++i) {
        const Stack stack = two_fast_elements(random, i % 2 == 0);
        const std::span<const std::size_t> fast =
            stack.elements.size() == 4 ? kFirstFast : kLaterFast;
        const double nm = random.uniform(400, 700), k0 = 2 * kPi / nm;
        const std::vector<Medium> media = media_of(stack, nm, random.uniform(0, 80));
        const FringeMean mean = fringe_mean(stack, fast, media, k0, Polarization::s);
        const FringeForm& form = mean.form;
        if (std::max(form.own[0], form.own[1]) > 0) continue;
        constexpr int kSteps = 256;
        double R = 0, T = 0;
        for (int j = 0; j < kSteps; ++j)
            for (int k = 0; k < kSteps; ++k) {
                const Power power = power_at(form, 2 * kPi * j / kSteps, 2 * kPi * k / kSteps);
                R += power.R / kSteps / kSteps;
                T += power.T / kSteps / kSteps;
            }
        CAPTURE(i, oracle::text_of(stack), nm);
        CHECK(std::abs(mean.R - R) < 1e-9);
        CHECK(std::abs(mean.T - T) < 1e-9);
        if (i % 2 == 0) CHECK(std::abs(mean.R + mean.T - 1) < 1e-9);
        const FringeHarmonics all = fringe_harmonics(form, 2);
        double last = 0, sum_R = mean.R, sum_T = mean.T;
        const double psi_1 = random.uniform(0, 6), psi_2 = random.uniform(0, 6);
        for (std::size_t h = 0; h < FringeHarmonics::kOfTwo; ++h) {
            const auto [m1, m2] = FringeHarmonics::wave(h);
            const Complex wave = std::polar(1.0, m1 * psi_1 + m2 * psi_2);
            sum_R += (all.R.at(h) * wave).real();
            sum_T += (all.T.at(h) * wave).real();
            if (std::max(std::abs(m1), m2) == FringeHarmonics::kMost)
                last = std::max({last, std::abs(all.R.at(h)), std::abs(all.T.at(h))});
        }
        if (last > 1e-7) continue;
        ++waves;
        const Power power = power_at(form, psi_1, psi_2);
        CHECK(std::abs(sum_R - power.R) < 1e-5);
        CHECK(std::abs(sum_T - power.T) < 1e-5);
    }
    CHECK(waves > 20);
}
