#include <catch2/catch.hpp>
#include <cmath>

#include "core/coherent/media.hpp"
#include "core/error.hpp"
#include "core/material/index_series.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"
#include "core/spectrum/delay.hpp"
#include "core/spectrum/profile.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/stack/builder.hpp"
#include "core/stack/reversed.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::WithinAbs;

namespace {

Material constant(Complex index) {
    return {"c", RefractiveIndex{Constant{index.real()}, Constant{index.imag()}}, Outside::refuse};
}

Material axial(Complex ordinary, Complex extraordinary) {
    return {"axial", Uniaxial{{constant(ordinary), constant(extraordinary)}}, Outside::refuse};
}

Spectra spectra_of(const Stack& stack, const std::vector<double>& nm,
                   const std::vector<double>& angles_deg, const Needs& needs = {},
                   SimdLevel simd = SimdLevel::plain) {
    const IndexTable table(stack, nm);
    std::vector<IncidentAngle> angles;
    for (const double angle : angles_deg) angles.push_back(incident_angle(angle));
    return spectra(StackPower(stack), table, angles, needs, {1, simd});
}

/// Layers of all kinds, some of them uniaxial, some repeated.
Stack random_axial_stack(Random& random, bool absorbs) {
    StackBuilder b(random.uniform(1, 1.6));
    const auto index = [&]() -> Complex {
        return {random.uniform(1.2, 2.6), absorbs && random.one_in(2) ? random.uniform(0, 1) : 0};
    };
    const auto layer = [&] {
        const Material material = random.one_in(3) ? constant(index()) : axial(index(), index());
        return StackBuilder::layer_of(b.material(material), random.uniform(0, 300));
    };
    const std::size_t count = 1 + random.below(4);
    for (std::size_t i = 0; i < count; ++i) {
        if (random.one_in(3)) {
            b.add(StackBuilder::group(2 + random.below(40), {layer(), layer()}));
        } else {
            b.add(layer());
        }
    }
    return b.over_material(
        b.material(random.one_in(2) ? axial(index(), index()) : constant(index())));
}

}  // namespace

TEST_CASE("a uniaxial half-space has its closed form", "[uniaxial]") {
    // R. M. A. Azzam and N. M. Bashara, Ellipsometry and Polarized Light (1977), eq. 4.216
    const double o = 1.658, e = 1.486, n0 = 1.2;
    StackBuilder b(n0);
    const Stack stack = b.over_material(b.material(axial(o, e)));
    for (const double angle : {0.0, 20.0, 50.0, 85.0}) {
        const double c = std::cos(angle * kDegree), across = n0 * std::sin(angle * kDegree);
        const double s = std::sqrt(o * o - across * across);
        const double p = std::sqrt(e * e - across * across);
        const Spectra found = spectra_of(stack, {500}, {angle});
        CHECK_THAT(found.s.R[0], WithinAbs(std::pow((n0 * c - s) / (n0 * c + s), 2), 1e-15));
        CHECK_THAT(found.p.R[0],
                   WithinAbs(std::pow((o * e * c - n0 * p) / (o * e * c + n0 * p), 2), 1e-15));
    }
}

TEST_CASE("a uniaxial film has Airy's closed form with its own phase", "[uniaxial]") {
    const Complex o(1.7, 0.02), e(1.5, 0.05);
    const double n0 = 1, d = 730, nm = 600, angle = 65;
    const Complex base(3.8, 0.1);
    StackBuilder b(n0);
    const std::size_t film = b.material(axial(o, e));
    b.add(StackBuilder::layer_of(film, d));
    const Stack stack = b.over(base);
    const double c = std::cos(angle * kDegree), across = std::sin(angle * kDegree);
    // phase thickness 2 pi d/nm (n_o/n_e) sqrt(n_e^2 - S^2), admittances eps/q
    const Complex q = o / e * std::sqrt(e * e - across * across);
    const Complex y0 = n0 / c, y1 = o * o / q,
                  y2 = base * base / std::sqrt(base * base - across * across);
    const Complex r01 = (y0 - y1) / (y0 + y1), r12 = (y1 - y2) / (y1 + y2);
    const Complex turn = std::exp(Complex(0, 2) * (kTwoPi * d / nm * q));
    const Complex r = (r01 + r12 * turn) / (1.0 + r01 * r12 * turn);
    Needs needs;
    needs.amplitudes = true;
    const Spectra found = spectra_of(stack, {nm}, {angle}, needs);
    CHECK(std::abs(found.p.r[0] - r) < 1e-14);
    CHECK_THAT(found.p.R[0] + found.p.T[0] + found.p.A[0], WithinAbs(1, 1e-15));
}

TEST_CASE("many thin layers are a uniaxial one", "[uniaxial]") {
    const double n1 = 1.45, n2 = 2.3, f = 0.4, d = 400;
    const double o = std::sqrt(f * n1 * n1 + (1 - f) * n2 * n2);
    const double e = 1 / std::sqrt(f / (n1 * n1) + (1 - f) / (n2 * n2));
    StackBuilder whole(1);
    const std::size_t film = whole.material(axial(o, e));
    whole.add(StackBuilder::layer_of(film, d));
    const Spectra expected = spectra_of(whole.over(1.52), {550}, {60});
    double last_s = 1, last_p = 1;
    for (const std::uint64_t periods : {20U, 80U, 320U}) {
        const double one = d / static_cast<double>(periods);
        StackBuilder fine(1);
        const Element half = fine.layer(n1, f * one / 2), other = fine.layer(n2, (1 - f) * one);
        fine.add(StackBuilder::group(periods, {half, other, half}));
        const Spectra found = spectra_of(fine.over(1.52), {550}, {60});
        const double off_s = std::abs(found.s.R[0] - expected.s.R[0]);
        const double off_p = std::abs(found.p.R[0] - expected.p.R[0]);
        CHECK(off_s < last_s / 12);
        CHECK(off_p < last_p / 12);
        last_s = off_s;
        last_p = off_p;
    }
    CHECK(last_p < 1e-5);
    CHECK(std::abs(expected.p.R[0] - expected.s.R[0]) > 0.1);
}

TEST_CASE("equal indices are an isotropic medium; s sees the ordinary one", "[uniaxial]") {
    for (const Complex n : {Complex(1.8), Complex(0.2, 3), Complex(1.6, 0.01)}) {
        const auto stack_of = [&](const Material& material) {
            StackBuilder b(1.5);
            const std::size_t film = b.material(material);
            b.add(StackBuilder::layer_of(film, 120));
            return b.over(1.3);
        };
        const std::vector<double> nm{400, 500, 700}, angles{0, 30, 61, 89};
        for (const SimdLevel level : tested_levels()) {
            const Spectra same = spectra_of(stack_of(axial(n, n)), nm, angles, {}, level);
            const Spectra other =
                spectra_of(stack_of(axial(n, {1.5, n.imag()})), nm, angles, {}, level);
            const Spectra plain = spectra_of(stack_of(constant(n)), nm, angles, {}, level);
            for (std::size_t i = 0; i < nm.size() * angles.size(); ++i) {
                CHECK_THAT(same.p.R[i], WithinAbs(plain.p.R[i], 1e-13));
                CHECK_THAT(same.p.T[i], WithinAbs(plain.p.T[i], 1e-13));
                CHECK_THAT(same.p.A[i], WithinAbs(plain.p.A[i], 1e-13));
                CHECK_THAT(other.s.R[i], WithinAbs(plain.s.R[i], 1e-14));
            }
        }
    }
}

TEST_CASE("both kernels agree on uniaxial layers, and energy is kept", "[uniaxial]") {
    Random random(21);
    const std::vector<double> nm{380, 432.1, 500, 555, 610, 700.5, 780}, angles{0, 17, 44, 70, 88};
    for (int trial = 0; trial < 60; ++trial) {
        const Stack stack = random_axial_stack(random, trial % 2 == 1);
        const Spectra plain = spectra_of(stack, nm, angles);
        Needs with_layers;
        with_layers.layers = true;
        const Spectra layers = spectra_of(stack, nm, angles, with_layers);
        const std::size_t points = nm.size() * angles.size();
        for (const Spectrum* spectrum : {&layers.s, &layers.p})
            for (std::size_t i = 0; i < points; ++i) {
                double sum = 0;
                for (std::size_t at = i; at < spectrum->A_layers.size(); at += points)
                    sum += spectrum->A_layers[at];
                CHECK_THAT(sum, WithinAbs(spectrum->A[i], 1e-11));
                CHECK_THAT(spectrum->R[i] + spectrum->T[i] + spectrum->A[i], WithinAbs(1, 1e-12));
                CHECK(spectrum->A[i] >= -1e-13);
            }
        for (const SimdLevel level : tested_vector_levels()) {
            const Spectra fast = spectra_of(stack, nm, angles, {}, level);
            for (std::size_t i = 0; i < points; ++i) {
                CHECK_THAT(fast.s.R[i], WithinAbs(plain.s.R[i], 2e-11));
                CHECK_THAT(fast.p.R[i], WithinAbs(plain.p.R[i], 2e-11));
                CHECK_THAT(fast.p.T[i], WithinAbs(plain.p.T[i], 2e-11));
                CHECK_THAT(fast.p.A[i], WithinAbs(plain.p.A[i], 2e-11));
            }
        }
    }
}

TEST_CASE("an extraordinary index alone may absorb", "[uniaxial]") {
    StackBuilder b(1);
    const std::size_t film = b.material(axial(1.7, {1.5, 0.4}));
    b.add(StackBuilder::layer_of(film, 300));
    const Stack stack = b.over(1.5);
    for (const SimdLevel level : tested_levels()) {
        const Spectra found = spectra_of(stack, {550, 600}, {0, 50}, {}, level);
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(found.s.A[i] == 0);
            CHECK_THAT(found.p.R[i] + found.p.T[i] + found.p.A[i], WithinAbs(1, 1e-14));
        }
        CHECK_THAT(found.p.A[0], WithinAbs(0, 1e-15));
        CHECK(found.p.A[2] > 0.1);
    }
}

TEST_CASE("uniaxial stacks transmit the same both ways", "[uniaxial]") {
    Random random(22);
    for (int trial = 0; trial < 30; ++trial) {
        Stack stack = random_axial_stack(random, true);
        stack.materials[stack.substrate] = constant(random.uniform(1.5, 2));
        const double n0 = index_at(stack.materials[stack.incident], 550).real();
        const double n1 = index_at(stack.materials[stack.substrate], 550).real();
        const double across = random.uniform(0, std::min(n0, n1) * 0.99);
        const auto at = [&](double n) { return std::asin(across / n) / kDegree; };
        const Spectra down = spectra_of(stack, {550}, {at(n0)});
        const Spectra up = spectra_of(reversed(stack), {550}, {at(n1)});
        CHECK_THAT(down.s.T[0], WithinAbs(up.s.T[0], 1e-11));
        CHECK_THAT(down.p.T[0], WithinAbs(up.p.T[0], 1e-11));
    }
}

TEST_CASE("fields in uniaxial layers add up to what they absorb", "[uniaxial]") {
    StackBuilder b(1);
    const std::size_t film = b.material(axial({1.7, 0.05}, {1.5, 0.3}));
    b.add(b.layer(1.4, 80));
    b.add(StackBuilder::layer_of(film, 200));
    const Stack stack = b.over({2.5, 0.5});
    const IndexTable table(stack, {550});
    const IncidentAngle at = incident_angle(55);
    std::vector<Medium> media;
    set_media(table, 0, at, Polarization::p, media);
    const FieldProfile profile(stack, media, table.k0()[0], at, Polarization::p);
    constexpr int kSteps = 2000;  // Simpson's rule
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double z = 80 + (200 - 1e-9) * i / kSteps;
        const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * profile.at(z).absorbed_per_nm;
    }
    Needs needs;
    needs.layers = true;
    const Spectra found = spectra_of(stack, {550}, {55}, needs);
    CHECK_THAT(sum * 200 / kSteps / 3, WithinAbs(found.p.A_layers[1], 1e-9));
    CHECK_THAT(profile.at(80).flux - profile.at(280).flux, WithinAbs(found.p.A_layers[1], 1e-12));
}

TEST_CASE("delays of uniaxial layers are derivatives of their phases", "[uniaxial]") {
    Material glass{"g", RefractiveIndex{Formula{5, {1.5, 0.01, -2}, kAllWavelengths}}, {}};
    Material crystal{"u", Uniaxial{{glass, constant(1.8)}}, Outside::refuse};
    StackBuilder b(1);
    const std::size_t film = b.material(crystal);
    b.add(StackBuilder::layer_of(film, 900));
    b.add(b.layer({2.2, 0.01}, 70));
    const Stack stack = b.over_material(b.material(axial(1.6, 1.5)));
    const double nm = 633;
    const auto delays_at = [&](double wavelength_nm, Polarization polarization) {
        std::vector<Series<Complex>> index, extraordinary;
        for (const Material& material : stack.materials) {
            index.push_back(index_series(material, wavelength_nm));
            extraordinary.push_back(extraordinary_series(material, wavelength_nm));
        }
        return delays(stack, index, wavelength_nm, incident_angle(50), polarization, extraordinary);
    };
    Needs needs;
    needs.amplitudes = true;
    const Spectra plain = spectra_of(stack, {nm}, {50}, needs);
    for (const Polarization polarization : {Polarization::s, Polarization::p}) {
        const Delays at = delays_at(nm, polarization);
        const Spectrum& spectrum = polarization == Polarization::s ? plain.s : plain.p;
        CHECK_THAT(at.r.phase_deg, WithinAbs(std::arg(spectrum.r[0]) / kDegree, 1e-10));
        constexpr double kLight = 299.792458, h = 1e-3;
        const double w0 = kTwoPi * kLight / nm;
        const auto phase = [&](double x) {
            return delays_at(nm / (1 + x), polarization).t.phase_deg * kDegree;
        };
        const auto delay = [&](double x) { return delays_at(nm / (1 + x), polarization).r.gd_fs; };
        const auto slope = [&](const auto& f) {
            return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h * w0);
        };
        CHECK_THAT(at.t.gd_fs, WithinAbs(slope(phase), 1e-5));
        CHECK_THAT(at.r.gdd_fs2, WithinAbs(slope(delay), 1e-4));
    }
}

TEST_CASE("what needs isotropic media refuses uniaxial ones", "[uniaxial][refused]") {
    const Material odd = axial({1.5, 0.1}, {1.6, -0.1});
    CHECK_THROWS_WITH(extraordinary_index_at(odd, 500),
                      Catch::Contains("absorb along one axis and amplify along another"));
    CHECK(index_at(odd, 500) == Complex(1.5, 0.1));
    CHECK(is_uniaxial(odd));
    CHECK_FALSE(is_uniaxial(constant(2)));
    CHECK(table_rows(odd, {300, 800}).empty());
}
