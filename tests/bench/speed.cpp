// Times of the parts that a request is made of, on this machine: ./dev bench
#include <benchmark/benchmark.h>

#include <numeric>

#include "core/color/illuminant.hpp"
#include "core/color/observer.hpp"
#include "core/color/stack_color.hpp"
#include "core/interference/spectrum.hpp"
#include "schemas/json_document.hpp"
#include "schemas/stack_document.hpp"

namespace {

using namespace irido;

const char* const kFilm = "1 | 1.33@380 | 1";
const char* const kFilmOnCopper = "1 | 1.5@300 | Cu";
const char* const kMirror = "1 | (2.3@60 | 1.46@94)^20 | 1.52";

Stack stack_of(const std::string& expression) {
    return read_stack({expression, {}}).stack;
}

/// 40 different lossless layers.
Stack forty_layers() {
    std::string text = "1";
    for (int i = 0; i < 40; ++i)
        text += " | " + std::to_string(1.4 + 0.02 * i) + "@" + std::to_string(50 + 2 * i);
    return stack_of(text + " | 1.52");
}

/// Items are (wavelength, angle) points, both polarizations.
void spectrum(benchmark::State& state, const Stack& stack) {
    std::vector<double> wavelengths(401);
    std::iota(wavelengths.begin(), wavelengths.end(), 380.0);
    const StackPower power(stack);
    const IndexTable table(stack, wavelengths);
    const double cosine = cos_of_incidence(40);
    for (auto _ : state) {
        const Spectra out = spectra(power, table, std::span(&cosine, 1), {});
        benchmark::DoNotOptimize(out.s.R.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(wavelengths.size()));
}

/// Items are colours: 81 angles at once, weights and indices shared.
void color(benchmark::State& state, const Stack& stack) {
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    std::vector<double> angles(81);
    std::iota(angles.begin(), angles.end(), 0.0);
    const std::vector<Side> sides{Side::reflected};
    for (auto _ : state)
        benchmark::DoNotOptimize(stack_color(stack, sensitivity, angles, sides, {}, 1));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(angles.size()));
}

void rule(benchmark::State& state) {
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    const auto degree = static_cast<std::size_t>(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(panel_rule(sensitivity, sensitivity.support(), degree));
}

void read_expression(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(stack_of(kFilm));
}

BENCHMARK_CAPTURE(spectrum, one_film, stack_of(kFilm));
BENCHMARK_CAPTURE(spectrum, film_on_copper, stack_of(kFilmOnCopper));
BENCHMARK_CAPTURE(spectrum, twenty_periods, stack_of(kMirror));
BENCHMARK_CAPTURE(spectrum, forty_layers, forty_layers());
BENCHMARK_CAPTURE(color, one_film, stack_of(kFilm));
BENCHMARK_CAPTURE(color, film_on_copper, stack_of(kFilmOnCopper));
BENCHMARK_CAPTURE(color, twenty_periods, stack_of(kMirror));
BENCHMARK(rule)->RangeMultiplier(2)->Range(8, 128);
BENCHMARK(read_expression);

}  // namespace

BENCHMARK_MAIN();
