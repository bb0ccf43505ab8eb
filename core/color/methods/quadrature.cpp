#include <limits>

#include "core/color/exact_color.hpp"

namespace irido {

namespace {

/// Prepared as for very many colours, however many there are: a row is the same in any sweep.
std::unique_ptr<ColorAlgorithm> quadrature(const ColorTables& tables, const Stack& stack,
                                           const ColorMethod& method, const ColorRequest& request) {
    ColorRequest many = request;
    many.colors = std::numeric_limits<std::size_t>::max();
    many.structures = 1;
    return exact_color(tables, stack, method, many);
}

}  // namespace

extern constinit const ColorMethodKind color_method_quadrature = {
    .name = "quadrature",
    .place = 2,
    .use = MethodUse::exact,
    .help = "quadrature: product quadrature of the spectrum; any stack",
    .trials = {.last_power = 10},
    .prepare = quadrature,
};

}  // namespace irido
