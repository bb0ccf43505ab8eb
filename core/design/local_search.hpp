#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "core/design/design_model.hpp"

namespace irido {

/// Why a local search ended.
enum class LocalEnd {
    flat,         ///< the merit no longer falls by the relative amount asked for
    gradient,     ///< no direction inside the bounds leads down
    evaluations,  ///< as many as allowed
    stopped,      ///< asked to stop
    failed,       ///< the stack cannot be computed at the start
};
std::string_view words_of(LocalEnd end);

struct LocalLimits {
    double relative = 1e-12;           ///< fall of the objective that counts
    std::size_t evaluations = 100000;  ///< of this search
    std::function<bool()> should_stop{};
};

struct LocalResult {
    std::vector<double> x;
    double objective = 0;
    LocalEnd end = LocalEnd::flat;
};

/// Levenberg and Marquardt's damped least squares inside bounds: steps are cut at a bound and
/// solved again for what is still free; the damping begins with 1, since nearly undamped first
/// steps throw layers onto the bound at 0, where they stay. The result is never above the start,
/// nor outside the bounds; integers stay. For all merits but mean_abs. Source: J. J. More, Lecture
/// Notes in Mathematics 630, 105 (1978); K. Madsen, H. B. Nielsen, O. Tingleff, Methods for
/// Non-Linear Least Squares Problems (2004), section 3.2.
LocalResult least_squares(DesignModel& model, std::vector<double> x, const LocalLimits& limits);

/// Limited-memory quasi-Newton steps projected onto the bounds, for any merit; cheap steps, many of
/// them. The same promises.
/// Source: J. Nocedal, S. J. Wright, Numerical Optimization (2006), section 7.2; D. P. Bertsekas,
/// SIAM J. Control Optim. 20, 221 (1982).
LocalResult quasi_newton(DesignModel& model, std::vector<double> x, const LocalLimits& limits);

/// The best of both: quasi-Newton steps, then least squares where the merit has them; colours with
/// as many wavelengths as leave them within `color_tolerance` of CIELAB.
LocalResult refined(DesignModel& model, std::vector<double> x, const LocalLimits& limits,
                    double color_tolerance);

}  // namespace irido
