// Times of the parts that a colour is made of, on this machine: ./dev bench. Those of spectra are
// in `irido bench speed`.
#include <benchmark/benchmark.h>

#include <numeric>

#include "core/color/illuminant.hpp"
#include "core/color/observer.hpp"
#include "core/color/stack_color.hpp"
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

/// Items are colours: 81 angles at once, with all that is computed once for them.
void color(benchmark::State& state, const Stack& stack) {
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    std::vector<double> angles(81);
    std::iota(angles.begin(), angles.end(), 0.0);
    for (auto _ : state) {
        const ColorTables tables(sensitivity);
        benchmark::DoNotOptimize(stack_color(tables, stack, {}, {}, angles));
    }
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

BENCHMARK_CAPTURE(color, one_film, stack_of(kFilm));
BENCHMARK_CAPTURE(color, film_on_copper, stack_of(kFilmOnCopper));
BENCHMARK_CAPTURE(color, twenty_periods, stack_of(kMirror));
BENCHMARK(rule)->RangeMultiplier(2)->Range(8, 128);
BENCHMARK(read_expression);

}  // namespace

BENCHMARK_MAIN();
