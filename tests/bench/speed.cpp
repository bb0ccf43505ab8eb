// Times of the parts of a colour computation on this machine: ./dev bench. For spectra, see `irido
// bench speed`.
#include <benchmark/benchmark.h>

#include <array>
#include <numeric>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/math/random.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/stack_document.hpp"

namespace {

using namespace irido;
using namespace irido::schemas;

const char* const kFilm = "1 | 1.33@380 | 1";
const char* const kFilmOnCopper = "1 | 1.5@300 | Cu";
const char* const kMirror = "1 | (2.3@60 | 1.46@94)^20 | 1.52";

Stack stack_of(const std::string& expression) {
    return read_stack({expression, {}}).stack;
}

/// Items are colours: 81 angles at once, including the work done once for all of them.
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

/// Items are colours: 200 thicknesses of the middle layer, at one angle.
///   shared  whether the layers that do not vary are computed once
void sweep(benchmark::State& state, bool shared, const char* first, const char* substrate) {
    const auto layers = static_cast<std::size_t>(state.range(0));
    Random random(7);
    std::string expression = "1";
    for (std::size_t i = 0; i < layers; ++i)
        expression += std::string(" | ") + std::array{first, "1.46", "1.9", "1.65"}[i % 4] + "@" +
                      std::to_string(random.uniform(30, 150));
    Stack stack = stack_of(expression + " | " + substrate);
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    ColorRequest request;
    if (shared) request.varied = {{layers / 2}};
    const auto algorithm = color_algorithm(tables, stack, color_method("quadrature"), request);
    const double angle = 40;
    StackColor color;
    constexpr int kThicknesses = 200;
    for (auto _ : state) {
        for (int i = 0; i < kThicknesses; ++i) {
            std::get<Layer>(stack.elements[layers / 2].value).thickness_nm = 30 + 0.6 * i;
            (*algorithm)(stack, {&angle, 1}, {&color, 1});
            benchmark::DoNotOptimize(color);
        }
    }
    state.SetItemsProcessed(state.iterations() * kThicknesses);
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
BENCHMARK_CAPTURE(sweep, one_by_one, false, "2.3", "1.52")->Arg(10)->Arg(20)->Arg(40);
BENCHMARK_CAPTURE(sweep, shared, true, "2.3", "1.52")->Arg(10)->Arg(20)->Arg(40);
BENCHMARK_CAPTURE(sweep, absorbing_one_by_one, false, "2.3+0.01i", "1.52")->Arg(20)->Arg(40);
BENCHMARK_CAPTURE(sweep, absorbing_shared, true, "2.3+0.01i", "1.52")->Arg(20)->Arg(40);
BENCHMARK_CAPTURE(sweep, on_copper_one_by_one, false, "2.3", "Cu")->Arg(20)->Arg(40);
BENCHMARK_CAPTURE(sweep, on_copper_shared, true, "2.3", "Cu")->Arg(20)->Arg(40);
BENCHMARK(rule)->RangeMultiplier(2)->Range(8, 128);
BENCHMARK(read_expression);

}  // namespace

BENCHMARK_MAIN();
