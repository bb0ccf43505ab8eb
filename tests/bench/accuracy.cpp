// Errors of spectra and colours against independent methods on seeded random stacks: ./dev accuracy
//   spectra  against transfer matrices in 100 digits
//   colours  against adaptive Gauss-Legendre integration of every cell between two rows
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/math/parallel.hpp"
#include "core/spectrum/spectrum.hpp"
#include "tests/oracle/color_oracle.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/oracle/stack_oracle.hpp"

namespace {

using namespace irido;
using namespace irido::schemas;
using namespace irido::tables;
using namespace irido::cli;

struct Worst {
    double R = 0, T = 0, sum = 0;  ///< |dR|, |dT|/T, |R + T + A - 1|

    void take(const Power& power, const Power& exact) {
        R = std::max(R, std::abs(power.R - exact.R));
        T = std::max(T, std::abs(power.T - exact.T) / exact.T);
        sum = std::max(sum, std::abs(power.R + power.T + power.A - 1));
    }
};

Worst compare_spectra(oracle::Kind kind, int count) {
    Worst worst;
    oracle::Random random(1 + static_cast<std::uint64_t>(kind));
    for (int i = 0; i < count; ++i) {
        const Stack stack = oracle::random_stack(kind, random);
        const double angle = oracle::random_angle(random), nm = random.uniform(400, 700);
        const IndexTable table(stack, {nm});
        const double cosine = cos_of_incidence(angle);
        const Spectra at = spectra(StackPower(stack), table, std::span(&cosine, 1), {});
        worst.take(at.s.power(0), oracle::coherent(stack, {nm, angle, Polarization::s}));
        worst.take(at.p.power(0), oracle::coherent(stack, {nm, angle, Polarization::p}));
    }
    return worst;
}

struct ColorErrors {
    double worst = 0;
    std::size_t violations = 0, evaluations = 0;
};

/// Compares one random stack, for one illuminant and with method auto, with the independent
/// integration.
void compare_color(oracle::Kind kind, std::uint64_t seed, double tolerance, ColorErrors& result,
                   std::mutex& lock) {
    oracle::Random random(seed);
    const Stack stack = oracle::random_stack(kind, random);
    const double angle = oracle::random_angle(random);
    const Side side = random.below(3) == 0 ? Side::transmitted : Side::reflected;
    const Observer& eye = observer(random.below(2) == 0 ? 2 : 10);
    const Table light = illuminant(illuminant_names()[random.below(illuminant_names().size())]);
    const ColorTables tables(Sensitivity(eye, light));
    const ColorRequest request{.sides = {side}, .tolerance = tolerance};
    const StackColor color = stack_color(tables, stack, {}, request, std::span(&angle, 1)).front();
    const Triple exact =
        oracle::stack_xyz(stack, eye, light, angle, side == Side::transmitted, tolerance / 1000);
    double error = 0;
    for (std::size_t c = 0; c < 3; ++c) error = std::max(error, std::abs(color.xyz[c] - exact[c]));
    const std::scoped_lock guard(lock);
    result.worst = std::max(result.worst, error);
    result.evaluations += color.evaluations;
    if (error <= tolerance) return;
    ++result.violations;
    std::printf("# error %.3g, estimate %.3g at %.17g degrees: %s\n", error, color.error, angle,
                oracle::text_of(stack).c_str());
}

ColorErrors compare_colors(oracle::Kind kind, std::size_t count, double tolerance) {
    ColorErrors result;
    std::mutex lock;
    parallel_for(count, 0, [&](std::size_t i) {
        compare_color(kind, i * oracle::kKinds + static_cast<std::size_t>(kind), tolerance, result,
                      lock);
    });
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    const int count = argc > 1 ? std::atoi(argv[1]) : 200;
    std::vector<double> tolerances{1e-3, 1e-6, 1e-9};
    if (argc > 2) tolerances = {std::atof(argv[2])};
    if (count < 1 || !(tolerances.front() >= 1e-12 && tolerances.front() <= 1)) {
        std::fputs(
            "usage: irido_accuracy [COUNT [TOLERANCE]]: random stacks of each kind, colours at "
            "one\n"
            "tolerance only if it is given\n",
            stderr);
        return 2;
    }
    std::puts("what,kind,stacks,tolerance,worst,worst_T_relative,worst_sum,violations,evaluations");
    for (std::size_t k = 0; k < oracle::kAllKinds; ++k) {
        const auto kind = static_cast<oracle::Kind>(k);
        const std::string name(oracle::name_of(kind));
        if (argc <= 2) {
            const Worst worst = compare_spectra(kind, count);
            std::printf("spectrum,%s,%d,,%.2g,%.2g,%.2g,,\n", name.c_str(), count, worst.R, worst.T,
                        worst.sum);
        }
        for (const double tolerance : tolerances) {
            const ColorErrors colors =
                compare_colors(kind, static_cast<std::size_t>(count), tolerance);
            std::printf("color,%s,%d,%.0e,%.2g,,,%zu,%zu\n", name.c_str(), count, tolerance,
                        colors.worst, colors.violations,
                        colors.evaluations / static_cast<std::size_t>(count));
            std::fflush(stdout);
        }
    }
    return 0;
}
