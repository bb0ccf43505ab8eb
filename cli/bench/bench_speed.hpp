#pragma once

#include <string>
#include <string_view>

#include "core/math/simd_level.hpp"
#include "core/stack/stack.hpp"

namespace irido::cli {

/// A case of `irido bench speed`: spectra of a stack at 380:780:1 nm and the angles 0.5:89.5:1 or 0
/// degrees; or the transmission filter for a roughness alpha; or a colour table over 64 cos(theta)
/// and 512 values of a varied quantity.
struct SpeedCase {
    std::string_view name;
    int layers;
    std::string_view summary;
    Stack (*stack)(int layers) = nullptr;
    bool normal = false;
    bool only_R = false;
    double alpha = 0;
    std::string_view expression{}, path{};  ///< of a table: its stack and the varied path
    double first = 0, last = 0;
    bool each_layer = false;  ///< with what each layer absorbs
};

struct SpeedRow {
    std::string name, method;
    double layers = 0, threads = 1, points = 0, rate = 0, worst_R = 0;
    double operations = 0, limit = 0;
    double worst_F = 0;
};

/// Times F_alpha at 360 x 360 angles in closed form and by FPB24's sum; `budget` in seconds.
SpeedRow filter_row(const SpeedCase& of, SimdLevel level, double budget);
SpeedRow filter_sum_row(const SpeedCase& of, double budget);

/// Times a whole colour table; `budget` in seconds.
SpeedRow table_row(const SpeedCase& of, const Execution& execution, double budget);

}  // namespace irido::cli
