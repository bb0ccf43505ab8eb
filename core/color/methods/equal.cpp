#include <array>

#include "core/color/baselines/sampled_color.hpp"

namespace irido {

namespace {

constexpr std::array<std::size_t, 10> kWavelengthCounts{8,   16,  32,   64,   128,
                                                        256, 512, 1024, 2048, 4096};

std::unique_ptr<ColorAlgorithm> equal_color(const ColorTables& tables, const Stack& stack,
                                            const ColorMethod& method,
                                            const ColorRequest& request) {
    return sampled_color(tables.sensitivity(), tables.equal(method.count), stack, "equal", request);
}

}  // namespace

/// Equally spaced wavelengths over the whole support; error O(1/count^2), since the sensitivity is
/// piecewise linear.
extern constinit const ColorMethodKind color_method_equal = {
    .name = "equal",
    .place = 7,
    .number = {.fewest = 2, .most = 1e6, .fallback = 32},
    .help = "equal/N: N equally spaced wavelengths, [2, 1e6] [32]",
    .trials = {.counts = kWavelengthCounts, .what = "`parameter` equally spaced wavelengths"},
    .prepare = equal_color,
};

}  // namespace irido
