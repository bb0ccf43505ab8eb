#include "core/coherent/fringe_mean.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/stack/builder.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;

namespace {

constexpr double kPi = std::numbers::pi;

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
        const FringeMean mean = fringe_mean(stack, 1, media, k0, polarization);
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
        const FringeMean mean = fringe_mean(stack, 1, media, k0, polarization);
        // varying the number of periods samples all phases, unless K is close to a rational
        // multiple of pi
        const double K = mean.phase / (2 * 100000 * kPi);
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
        const FringeMean mean = fringe_mean(stack, 0, media, k0, Polarization::s);
        if (mean.swing_R > 1e-9) continue;
        CAPTURE(nm);
        CHECK(std::abs(mean.R - power_of(stack, media, k0, Polarization::s).R) < 1e-8);
    }
}
