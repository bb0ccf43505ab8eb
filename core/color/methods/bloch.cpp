#include "core/color/bloch/bloch_color.hpp"

#include <array>

#include "core/color/bloch/one_mirror.hpp"

namespace irido {

namespace {

constexpr std::array<std::size_t, 1> kMeanAlone{1};

}  // namespace

extern constinit const ColorMethodKind color_method_bloch = {
    .name = "bloch",
    .place = 5,
    .use = MethodUse::exact,
    .number = {.fewest = 0, .most = 1000, .offset = 1},
    .help =
        "bloch: Bloch waves; one group of two layers, all media of constant real index; "
        "exact, and faster than quadrature from about 100 periods on",
    .trials = {.last_power = 8,
               .counts = kMeanAlone,
               .tolerance_of_counts = 1e-4,  // the error of the mean alone is larger
               .what = "the mean alone"},
    .fault = [](const Stack& stack, const ColorRequest&) { return mirror_fault("bloch", stack); },
    .prepare = bloch_color,
};

}  // namespace irido
