#include <array>

#include "core/color/fourier/film_color.hpp"

namespace irido {

namespace {

constexpr std::array<std::size_t, 3> kFirstOrders{1, 2, 3};

}  // namespace

extern constinit const ColorMethodKind color_method_fourier = {
    .name = "fourier",
    .place = 3,
    .use = MethodUse::exact,
    .number = {.fewest = 1, .most = 1000},
    .help =
        "fourier: series over the orders of interference; one film of real index over any "
        "substrate; exact for constant indices; fourier/M, M in [1, 1000], truncates it at "
        "order M",
    .trials = {.last_power = 8,
               .counts = kFirstOrders,
               .what = "truncated at the order `parameter`"},
    .fault = [](const Stack& stack, const ColorRequest&) { return series_fault(stack); },
    .prepare = film_color,
};

}  // namespace irido
