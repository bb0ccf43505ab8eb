// Layers with a thickness distribution that hardly any light reaches: behind deep gaps their
// resonances are narrower than the rounding of a thickness.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/spectrum/spectrum.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;
using oracle::incoherent;
using oracle::spread;
using oracle::StackBuilder;

namespace {

Spectra answer(const Stack& stack, double wavelength_nm, double angle_deg) {
    const IndexTable table(stack, {wavelength_nm});
    const IncidentAngle at = incident_angle(angle_deg);
    return spectra(StackPower(stack), table, std::span(&at, 1), {});
}

void check_energy(const Stack& stack, double wavelength_nm, double angle_deg) {
    CAPTURE(oracle::text_of(stack), wavelength_nm, angle_deg);
    const Spectra at = answer(stack, wavelength_nm, angle_deg);
    for (const Spectrum* spectrum : {&at.s, &at.p}) {
        const Power power = spectrum->power(0);
        CHECK(std::abs(power.R + power.T + power.A - 1) < 1e-12);
        CHECK(std::min({power.R, power.T, power.A}) >= 0);
    }
}

}  // namespace

TEST_CASE("spread layers between deep gaps have a mean") {
    Random random(15);
    for (int i = 0; i < 150; ++i) {
        const double n0 = random.uniform(2, 2.8), angle = random.uniform(38, 60);
        const double along = n0 * std::sin(angle * std::acos(-1.0) / 180);
        const auto gap = [&] { return along * random.uniform(0.5, 0.95); };
        const double k = random.one_in(3) ? random.log_uniform(1e-9, 1e-7) : 0;
        StackBuilder b(n0);
        b.add(b.layer({gap(), k}, random.log_uniform(2e4, 2e5)));
        const double nm = random.uniform(300, 1000);
        b.add(spread(b.layer(along * random.uniform(1.05, 1.5), nm),
                     nm * random.log_uniform(1e-3, 0.3)));
        b.add(b.layer(gap(), random.log_uniform(300, 3000)));
        if (random.one_in(2)) b.add(incoherent(b.layer({along * 1.02, 1e-10}, 3e4)));
        const Stack stack = b.over(random.one_in(2) ? Complex(gap()) : Complex(0.7, 5));
        check_energy(stack, random.uniform(380, 780), angle);
    }
}

TEST_CASE("absorbers thinner than a radian of phase are not given another one") {
    // behind a gap that lets 1e-9 of the light through, little loss is much
    StackBuilder b(1.58);
    b.add(b.layer({1.083, 4.8e-6}, 800));
    b.add(incoherent(b.layer({2.15, 5e-9}, 25681)));
    b.add(spread(b.layer({2.44, 0.01}, 971), 260));
    check_energy(b.over(1.05), 384, 50.2);
}
