#include "core/color/exact_color.hpp"

namespace irido {

extern constinit const ColorMethodKind color_method_quadrature = {
    .name = "quadrature",
    .place = 2,
    .use = MethodUse::exact,
    .help = {2, "quadrature: product quadrature of the spectrum; any stack"},
    .trials = {.place = 1, .last_power = 10},
    .prepare = exact_color,
};

}  // namespace irido
