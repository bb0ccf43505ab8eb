#include <catch2/catch.hpp>
#include <cmath>

#include "core/design/sheet.hpp"
#include "core/math/random.hpp"
#include "core/stack/builder.hpp"
#include "core/truth/reference.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;

namespace {

/// Layers of constant indices, some in a group, with thickness and index slots for all.
struct SlopeCase {
    Stack stack;
    std::vector<double> wavelength_nm;
    double angle_deg = 0;
};

SlopeCase random_case(Random& random, bool absorbs) {
    const auto index = [&](bool may_absorb) {
        const double n = random.uniform(1.2, 2.6);
        const double k = may_absorb && random.one_in(2) ? random.log_uniform(1e-3, 3) : 0;
        return Complex(k > 1 ? random.uniform(0.05, 2) : n, k);
    };
    StackBuilder builder(random.uniform(1, 1.6));
    const std::size_t count = 1 + random.below(7);
    for (std::size_t i = 0; i < count; ++i)
        builder.add(builder.layer(index(absorbs), random.uniform(1, absorbs ? 80 : 300)));
    if (random.one_in(2)) {
        const std::size_t a = builder.material(index(false)), b = builder.material(index(absorbs));
        builder.add(StackBuilder::group(1 + random.below(6),
                                        {StackBuilder::layer_of(a, random.uniform(10, 200)),
                                         StackBuilder::layer_of(b, random.uniform(5, 60))}));
    }
    SlopeCase one{builder.over(index(absorbs)), {}, random.uniform(0, 80)};
    for (int i = 0; i < 5; ++i) one.wavelength_nm.push_back(random.uniform(350, 900));
    if (random.one_in(4)) one.angle_deg = 0;
    return one;
}

/// All results for a case: slots of layers, then of materials.
struct Computed {
    WrittenOut written;
    SlopeSlots slots;
    IndexGrid grid;
    Sheet sheet;

    Computed(const SlopeCase& one, bool amplitudes, SimdLevel simd)
        : written(one.stack), grid(one.stack, one.wavelength_nm, {}), sheet(grid, one.angle_deg) {
        for (std::size_t l = 0; l < written.layers.size(); ++l)
            slots.of_layer.push_back(slots.count++);
        for (std::size_t m = 0; m < one.stack.materials.size(); ++m)
            slots.of_material.push_back(slots.count++);
        sheet.needs = {true, true, amplitudes, true};
        sheet.set_media(one.stack);
        sheet.set_layers(one.stack, written, slots);
        sheet.compute(written, slots, true, simd);
    }
};

/// Allowed error of a slope.
double tolerance(double exact) {
    return 1e-10 * (1 + std::abs(exact));
}

}  // namespace

TEST_CASE("slopes by thicknesses and indices are those of the 50-digit adjoint", "[design]") {
    Random random(7);
    for (int i = 0; i < 60; ++i) {
        const SlopeCase one = random_case(random, i % 2 == 1);
        const Computed computed(one, false, best_simd_level());
        const std::size_t stride = computed.grid.stride;
        for (const Polarization polarization : {Polarization::s, Polarization::p}) {
            const SlopeAnswer& answer = computed.sheet.answer(polarization);
            for (std::size_t w = 0; w < one.wavelength_nm.size(); ++w) {
                const double nm = one.wavelength_nm[w];
                const Power power = reference_power(one.stack, nm, one.angle_deg, polarization,
                                                    Precision::digits50);
                CHECK(std::abs(answer.R[w] - power.R) < 1e-12);
                CHECK(std::abs(answer.T[w] - power.T) < 1e-12);
                const auto exact = reference_slopes(one.stack, nm, one.angle_deg, polarization);
                std::vector<PowerSlope> by_n(one.stack.materials.size()), by_k = by_n;
                for (std::size_t l = 0; l < exact.size(); ++l) {
                    const bool is_layer = l + 1 < exact.size();
                    const std::size_t m =
                        is_layer ? computed.written.layers[l].material : one.stack.substrate;
                    by_n[m].R += exact[l].n.R;
                    by_n[m].log_T += exact[l].n.log_T;
                    by_k[m].R += exact[l].k.R;
                    by_k[m].log_T += exact[l].k.log_T;
                    if (!is_layer) continue;
                    const std::size_t slot = computed.slots.of_layer[l];
                    const double dR = 2 * answer.row(answer.reflected, slot, false, stride)[w];
                    const double dT = 2 * answer.row(answer.transmitted, slot, false, stride)[w];
                    INFO("case " << i << ", layer " << l);
                    CHECK(std::abs(dR - exact[l].thickness.R) <
                          tolerance(exact[l].thickness.R) / 10);
                    CHECK(std::abs(dT - power.T * exact[l].thickness.log_T) < 1e-11);
                }
                for (std::size_t m = 0; m < by_n.size(); ++m) {
                    if (m == one.stack.incident) continue;
                    const std::size_t slot = computed.slots.of_material[m];
                    const double n = 2 * answer.row(answer.reflected, slot, false, stride)[w];
                    const double k = -2 * answer.row(answer.reflected, slot, true, stride)[w];
                    const double nT = 2 * answer.row(answer.transmitted, slot, false, stride)[w];
                    const double kT = -2 * answer.row(answer.transmitted, slot, true, stride)[w];
                    INFO("case " << i << ", material " << m << ", angle " << one.angle_deg);
                    CHECK(std::abs(n - by_n[m].R) < tolerance(by_n[m].R));
                    CHECK(std::abs(nT - power.T * by_n[m].log_T) <
                          tolerance(power.T * by_n[m].log_T));
                    if (computed.grid.n_im[m][w] == 0) continue;  // x d/dx is trivial there
                    CHECK(std::abs(k - by_k[m].R) < tolerance(by_k[m].R));
                    CHECK(std::abs(kT - power.T * by_k[m].log_T) <
                          tolerance(power.T * by_k[m].log_T));
                }
            }
        }
    }
}

TEST_CASE("slopes of amplitudes give those of powers", "[design]") {
    Random random(11);
    for (int i = 0; i < 40; ++i) {
        const SlopeCase one = random_case(random, i % 2 == 1);
        const Computed powers(one, false, best_simd_level());
        const Computed amplitudes(one, true, best_simd_level());
        const std::size_t stride = powers.grid.stride;
        for (const Polarization polarization : {Polarization::s, Polarization::p}) {
            const SlopeAnswer& a = powers.sheet.answer(polarization);
            const SlopeAnswer& b = amplitudes.sheet.answer(polarization);
            for (std::size_t slot = 0; slot < powers.slots.count; ++slot)
                for (std::size_t w = 0; w < one.wavelength_nm.size(); ++w) {
                    const Complex r{b.r_re[w], b.r_im[w]};
                    const Complex dr{b.row(b.reflected, slot, false, stride)[w],
                                     b.row(b.reflected, slot, true, stride)[w]};
                    const double dR = a.row(a.reflected, slot, false, stride)[w];
                    CHECK(std::abs((std::conj(r) * dr).real() - dR) < 1e-11 * (1 + std::abs(dR)));
                }
        }
    }
}

TEST_CASE("slopes are the same bits at every SIMD level", "[design]") {
    Random random(3);
    for (int i = 0; i < 10; ++i) {
        const SlopeCase one = random_case(random, i % 2 == 1);
        const Computed first(one, true, SimdLevel::baseline);
        for (const SimdLevel level : tested_vector_levels()) {
            const Computed other(one, true, level);
            for (const Polarization polarization : {Polarization::s, Polarization::p}) {
                CHECK(first.sheet.answer(polarization).R == other.sheet.answer(polarization).R);
                CHECK(first.sheet.answer(polarization).t_im ==
                      other.sheet.answer(polarization).t_im);
                CHECK(first.sheet.answer(polarization).reflected ==
                      other.sheet.answer(polarization).reflected);
                CHECK(first.sheet.answer(polarization).transmitted ==
                      other.sheet.answer(polarization).transmitted);
            }
        }
    }
}

TEST_CASE("thick absorbers and layers past the critical angle have finite slopes", "[design]") {
    StackBuilder builder(1.5);
    builder.add(builder.layer({0.1, 6}, 5000));
    builder.add(builder.layer(1.0, 20000));
    builder.add(builder.layer({2.0, 1e-3}, 3000));
    SlopeCase one{builder.over({0.5, 3}), {400, 550, 1e4}, 75};
    const Computed computed(one, true, best_simd_level());
    for (const Polarization polarization : {Polarization::s, Polarization::p}) {
        const SlopeAnswer& answer = computed.sheet.answer(polarization);
        for (const std::vector<double>* row : {&answer.reflected, &answer.transmitted, &answer.R})
            for (const double value : *row) CHECK(std::isfinite(value));
        CHECK(answer.T[0] < 1e-100);
    }
    // a layer exactly at its critical angle
    StackBuilder critical(2.0);
    critical.add(critical.layer(1.0, 100));
    SlopeCase at{critical.over(1.5), {500}, 30};
    const Computed there(at, false, best_simd_level());
    const Power exact = reference_power(at.stack, 500, 30, Polarization::s, Precision::digits50);
    CHECK(std::abs(there.sheet.answer(Polarization::s).R[0] - exact.R) < 1e-12);
}
