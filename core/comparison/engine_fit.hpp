#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/comparison/compared_engine.hpp"

namespace irido {

/// A parameter of an engine, by the name that its users type.
struct FittedParameter {
    std::string name;
    double value;
};

/// The parameters of an engine that come nearest to given colours.
struct EngineFit {
    std::string form;  ///< of the engine's material: "metal", "dielectric" or "" if it has only one
    std::vector<FittedParameter> parameters;
    double delta_e_mean = 0, delta_e_max = 0;
    std::vector<Triple> rgb;  ///< of each angle, as the engine returns it

    double value_of(std::string_view name) const;
};

/// The colours that a fit aims at.
struct FitTarget {
    std::span<const double> angles_deg;  ///< [0, 90]
    std::span<const double> weights;     ///< of the angles, >= 0, not all 0
    std::span<const Triple> xyz;         ///< exact colours under the illuminant of `difference`
};

/// Whether an engine has parameters: all formulas have, methods have none.
bool has_parameters(const ComparedEngine& engine);

/// Minimizes the weighted mean CIEDE2000 over the angles by many starts, those that look best of
/// random ones and the film `start` that engines are given for the stack. Parameters are rounded to
/// the digits that are worth typing, and the differences are those of the rounded ones. The same
/// arguments give the same result on any number of threads.
EngineFit fit_engine(const ComparedEngine& engine, const EngineDifference& difference,
                     const FitTarget& target, const EngineFilm& start, unsigned threads);

/// Mean CIEDE2000 from which on a fit is no match.
inline constexpr double kNoMatch = 8;

}  // namespace irido
