#include "core/color/fourier/film_color.hpp"

namespace irido {

extern constinit const ColorMethodKind color_method_fourier_constant = {
    .name = "fourier-constant",
    .place = 4,
    .use = MethodUse::variant,
    .number = {.fewest = 1, .most = 1000},
    .help = "fourier-constant(/M) replaces dispersive media by constant indices",
    .trials = {.last_power = 8},
    .fault = [](const Stack& stack, const ColorRequest&) { return series_fault(stack); },
    .prepare = film_color,
};

}  // namespace irido
