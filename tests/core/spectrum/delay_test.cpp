#include <catch2/catch.hpp>
#include <cmath>

#include "core/incoherent/chain.hpp"
#include "core/material/index_series.hpp"
#include "core/math/constants.hpp"
#include "core/stack/builder.hpp"
#include "core/truth/regimes.hpp"
#include "tests/oracle/delay_oracle.hpp"

using namespace irido;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace {

Delays delays_of(const Stack& stack, double wavelength_nm, double angle_deg,
                 Polarization polarization) {
    std::vector<Series<Complex>> index;
    for (const Material& material : stack.materials)
        index.push_back(index_series(material, wavelength_nm));
    return delays(stack, index, wavelength_nm, incident_angle(angle_deg), polarization);
}

Material formula(int number, std::vector<double> coefficients) {
    Material material;
    material.model =
        RefractiveIndex{Formula{number, std::move(coefficients), kAllWavelengths}, Constant{0}};
    return material;
}

/// Schott's N-BK7 by its plain formula, ignoring that it was measured in air.
Material glass() {
    return formula(
        2, {0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653});
}

/// Optical path in nm, with groups expanded.
double path_of(std::span<const Element> elements, const Stack& stack, double nm) {
    double path = 0;
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            path += std::abs(index_at(stack.materials[layer->material], nm)) * layer->thickness_nm;
            continue;
        }
        const Group& group = std::get<Group>(element.value);
        path += static_cast<double>(group.repeat) * path_of(group.elements, stack, nm);
    }
    return path;
}

/// Checks errors in units of (tau/|a|)^m, where tau is the path's delay plus a period of light, or
/// relative to the value.
///   got, want  the delays to compare
///   tau_fs     tau, fs
///   modulus    |a|
void check_delay(const Delay& got, const Delay& want, double tau_fs, double modulus) {
    constexpr double kMost = 1e-11;
    const double scale = tau_fs / std::min(1.0, modulus);
    CHECK(std::abs(std::remainder(got.phase_deg - want.phase_deg, 360)) <=
          kMost / kDegree / std::min(1.0, modulus));
    CHECK(std::abs(got.gd_fs - want.gd_fs) <= kMost * std::max(scale, std::abs(want.gd_fs)));
    CHECK(std::abs(got.gdd_fs2 - want.gdd_fs2) <=
          kMost * std::max(scale * scale, std::abs(want.gdd_fs2)));
    CHECK(std::abs(got.tod_fs3 - want.tod_fs3) <=
          10 * kMost * std::max(scale * scale * scale, std::abs(want.tod_fs3)));
}

void check_against_differences(const Stack& stack, double nm, double angle_deg) {
    const double tau_fs = (path_of(stack.elements, stack, nm) + nm) / 299.792458;
    for (const Polarization p : {Polarization::s, Polarization::p}) {
        const Delays got = delays_of(stack, nm, angle_deg, p);
        const Delays want = oracle::differenced_delays(stack, nm, angle_deg, p);
        const oracle::Moduli moduli = oracle::moduli(stack, nm, angle_deg, p);
        if (!std::isnan(got.r.phase_deg)) check_delay(got.r, want.r, tau_fs, moduli.r);
        check_delay(got.t, want.t, tau_fs, 1);
    }
}

}  // namespace

TEST_CASE("a millimetre of BK7 delays and disperses a pulse as published") {
    StackBuilder b;
    const std::size_t material = b.material(glass());
    b.add(StackBuilder::layer_of(material, 1e6));
    Stack stack = b.over_material(material);
    stack.incident = material;
    const Delays at = delays_of(stack, 800, 0, Polarization::s);
    CHECK_THAT(at.t.gd_fs, WithinAbs(5092.355, 5e-4));
    CHECK_THAT(at.t.gdd_fs2, WithinAbs(44.652, 5e-4));  // tables of glasses give 44.65 fs^2/mm
    CHECK_THAT(at.t.tod_fs3, WithinAbs(32.10, 5e-3));
    CHECK(std::isnan(at.r.phase_deg));  // nothing is reflected
    CHECK(std::isnan(at.r.gd_fs));
}

TEST_CASE("a mirror's delays agree with 40-digit values") {
    StackBuilder b;
    const std::size_t high = b.material(formula(5, {2.3, 0.0253, -2, 0.0015, -4}));
    const std::size_t low = b.material(formula(5, {1.452, 0.0031, -2, 4e-05, -4}));
    const std::size_t silica = b.material(
        formula(2, {0, 0.6961663, 0.00467914826, 0.4079426, 0.0135120631, 0.8974794, 97.9340025}));
    b.add(StackBuilder::group(
        10, {StackBuilder::layer_of(high, 80.5), StackBuilder::layer_of(low, 137.2)}));
    const Delays at = delays_of(b.over_material(silica), 700, 45, Polarization::s);
    CHECK_THAT(at.r.phase_deg, WithinAbs(-177.0931122961727, 7e-12));
    CHECK_THAT(at.t.phase_deg, WithinAbs(4.0893935732704865, 7e-12));
    CHECK_THAT(at.r.gd_fs, WithinAbs(0.9099680236244945, 2.9e-12));
    CHECK_THAT(at.t.gd_fs, WithinAbs(1.8695530726452694, 5.7e-12));
    CHECK_THAT(at.r.gdd_fs2, WithinAbs(0.2883099446411519, 5.7e-12));
    CHECK_THAT(at.t.gdd_fs2, WithinAbs(0.37380554044667047, 6e-12));
    CHECK_THAT(at.r.tod_fs3, WithinAbs(6.8122440778572475, 2.1e-10));
    CHECK_THAT(at.t.tod_fs3, WithinAbs(8.74144742201606, 2.2e-10));
}

TEST_CASE("delays of random stacks agree with differences of 100 digits") {
    // resonances and periods exactly at critical angles are omitted: there rounding of the inputs,
    // or the oracle's square roots, dominate
    for (const char* name :
         {"ordinary", "grazing", "evanescent", "dense_metal", "near_equal", "repeats_pair",
          "repeats_absorbing", "thin", "brewster", "metal_cavity", "absorbing_gap", "small_index",
          "frustrated_mirror", "metal_periods"}) {
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
            Random random(seed * 7919);
            const StackCase question = find_regime(name)->make(random);
            if (count_layers(question.stack.elements) > 60) continue;
            INFO(name << ", seed " << seed);
            check_against_differences(question.stack, question.wavelength_nm, question.angle_deg);
        }
    }
}

TEST_CASE("delays of dispersive stacks agree with differences, the incident medium included") {
    for (const double angle : {0.0, 30.0, 50.0, 80.0}) {
        StackBuilder b;
        const std::size_t low = b.material(formula(5, {1.33, 0.003, -2}));
        const std::size_t high = b.material(formula(5, {2.2, 0.03, -2, 0.001, -4}));
        b.add(StackBuilder::layer_of(high, 120));
        b.add(StackBuilder::group(
            6, {StackBuilder::layer_of(low, 150), StackBuilder::layer_of(high, 60)}));
        Stack stack = b.over_material(b.material(glass()));
        stack.incident = low;
        INFO(angle << " degrees");
        check_against_differences(stack, 620, angle);
    }
}

TEST_CASE("series of an index are its differences") {
    Material drude;
    drude.model = LorentzDrude{2, 9, {{0.8, 0.05, 0}, {0.3, 0.9, 4}}, kAllWavelengths};
    Material air = glass();
    std::get<Formula>(std::get<RefractiveIndex>(air.model).n).reference = {true, true, 20};
    for (const Material& material : {glass(), drude, air}) {
        const double nm = 600, h = 1e-3;
        const auto at = [&](double x) { return index_at(material, nm / (1 + x)); };
        const Series<Complex> series = index_series(material, nm);
        CHECK(series[0] == at(0));
        CHECK(std::abs(series[1] - (at(h) - at(-h)) / (2 * h)) < 1e-4 * std::abs(series[1]));
        CHECK(std::abs(series[2] - (at(h) - 2.0 * at(0) + at(-h)) / (2 * h * h)) <
              1e-4 * std::abs(series[2]) + 1e-8);
    }
}

TEST_CASE("a table's derivative is that of the line between two rows") {
    Material material;
    material.model = RefractiveIndex{Table{{400, 500, 600}, {1.6, 1.5, 1.45}}, Constant{0}};
    CHECK(has_rows(material));
    // dn/dx = -lambda dn/dlambda
    CHECK_THAT(index_series(material, 450)[1].real(), WithinRel(450 * 0.1 / 100, 1e-12));
    CHECK_THAT(index_series(material, 500)[1].real(), WithinRel(500 * 0.05 / 100, 1e-12));
    CHECK_THAT(index_series(material, 600)[1].real(), WithinRel(600 * 0.05 / 100, 1e-12));
    material.outside = Outside::clamp;
    CHECK(index_series(material, 700)[1] == 0.0);
}
