#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "core/design/design_model.hpp"

namespace irido {

/// Why a local search stopped.
enum class LocalEnd {
    flat,         ///< the merit no longer falls by the required relative amount
    gradient,     ///< no descent direction inside the bounds
    evaluations,  ///< limit reached
    stopped,      ///< on request
    failed,       ///< the stack cannot be computed at the start
};
std::string_view words_of(LocalEnd end);

struct LocalLimits {
    double relative = 1e-12;           ///< smallest relative decrease of the objective that counts
    std::size_t evaluations = 100000;  ///< limit for this search
    std::function<bool()> should_stop{};
};

struct LocalResult {
    std::vector<double> x;
    double objective = 0;
    LocalEnd end = LocalEnd::flat;
};

/// Levenberg-Marquardt least squares with bounds: a step is cut at a bound and solved again for the
/// values that remain free. Damping starts at 1, because nearly undamped first steps throw layers
/// onto the bound at 0, where they get stuck. The result is never worse than the start nor outside
/// the bounds; integers are held. For all merits except mean_abs.
/// Source: J. J. More, Lecture Notes in Mathematics 630, 105 (1978); K. Madsen, H. B. Nielsen, O.
/// Tingleff, Methods for Non-Linear Least Squares Problems (2004), section 3.2.
LocalResult least_squares(DesignModel& model, std::vector<double> x, const LocalLimits& limits);

/// Limited-memory quasi-Newton steps projected onto the bounds, for any merit: many cheap steps.
/// The result is never worse than the start nor outside the bounds; integers are held.
/// Source: J. Nocedal, S. J. Wright, Numerical Optimization (2006), section 7.2; D. P. Bertsekas,
/// SIAM J. Control Optim. 20, 221 (1982).
LocalResult quasi_newton(DesignModel& model, std::vector<double> x, const LocalLimits& limits);

/// Combines both: quasi-Newton steps, then least squares if the merit allows it.
///   model            evaluates the problem
///   x                start
///   limits           when to stop
///   color_tolerance  accuracy of colours during the search, CIELAB
LocalResult refined(DesignModel& model, std::vector<double> x, const LocalLimits& limits,
                    double color_tolerance);

}  // namespace irido
