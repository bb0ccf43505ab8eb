#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/comparison/compared_engine.hpp"

namespace irido {

/// An engine's parameter under its user-visible name.
struct FittedParameter {
    std::string name;
    double value;
};

/// The parameters with which an engine best matches given colours.
struct EngineFit {
    std::string form;  ///< which of the engine's materials: "metal", "dielectric", or "" if it has
                       ///< only one
    std::vector<FittedParameter> parameters;
    double delta_e_mean = 0, delta_e_max = 0;
    std::vector<Triple> rgb;  ///< per angle, as the engine returns it

    double value_of(std::string_view name) const;
};

/// Colours to be matched.
struct FitTarget {
    std::span<const double> angles_deg;  ///< [0, 90]
    std::span<const double> weights;     ///< per angle, >= 0, not all 0
    std::span<const Triple> xyz;         ///< exact colours under the illuminant of `difference`
};

/// Whether an engine has parameters: every formula does, no method does.
bool has_parameters(const ComparedEngine& engine);

/// Minimizes the weighted mean CIEDE2000 over the angles, starting from the most promising of many
/// random points and from `start`. Parameters are rounded to a sensible number of digits, and the
/// differences reported are those of the rounded values. The result does not depend on the number
/// of threads.
///   engine      a formula, see has_parameters()
///   difference  converts and compares colours
///   target      colours to match
///   start       the film given to engines for the stack
///   threads     0: one per core
EngineFit fit_engine(const ComparedEngine& engine, const EngineDifference& difference,
                     const FitTarget& target, const EngineFilm& start, unsigned threads);

/// A fit with a mean CIEDE2000 of this or more counts as no match.
inline constexpr double kNoMatch = 8;

}  // namespace irido
