#include "core/color/exact_color.hpp"

namespace irido {

extern constinit const ColorMethodKind color_method_quadrature = {
    .name = "quadrature",
    .place = 2,
    .use = MethodUse::exact,
    .help = "quadrature: product quadrature of the spectrum; any stack",
    .trials = {.last_power = 10},
    .prepare = exact_color,
};

}  // namespace irido
