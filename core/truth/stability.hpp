#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/simd_level.hpp"
#include "core/truth/regimes.hpp"

namespace irido {

/// Relative rounding of a double.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// An error is within its bound while it is at most
///     max(well_posed, kAllowedRoundings condition kUnitRoundoff),
/// with the Condition of reference.hpp. A question is well posed where the first of the two is the
/// larger one, that is where all inputs together, moved by half an ulp each, move the answer by
/// less than a tenth of it. Beyond it, it is within its bound where the answer is exact for inputs
/// kAllowedRoundings away (is_answer_nearby() of reference.hpp): where fringes are so narrow that
/// roundings pass them, derivatives say nothing. The relative error of A has a bound of its own: it
/// is a quadratic form of the fields, which loses twice the digits that cancel in them (guided
/// modes behind a gap), or the difference 1 - R - T where it exceeds 0.01.
inline constexpr double kWellPosedError = 1e-13, kWellPosedRelativeA = 1e-9;
/// Relative errors of T and A may be ten times larger: they are products of all that lies above.
inline constexpr double kAllowedRoundings = 10, kAllowedRelativeRoundings = 100;
double error_bound(double condition, double well_posed = kWellPosedError,
                   double roundings = kAllowedRoundings);

/// R + T of a passive stack may exceed 1 by this.
inline constexpr double kAllowedExcess = 1e-13;

/// Error of one quantity over all cases of a regime, against 50 digits.
struct ErrorSummary {
    double worst = 0, p99 = 0;
    double condition = 0;  ///< at the worst error
    /// Largest error / (kUnitRoundoff (1 + condition)): how many roundings of each input, or of the
    /// answer, explain it.
    double roundings = 0;
};

/// What a sweep over one regime found. Every case has two polarizations, which count as two
/// answers. Where gain makes a power exceed 1, R, T and A are relative errors.
struct RegimeReport {
    std::string_view regime;
    std::uint64_t count = 0;  ///< answers that were compared
    ErrorSummary R, T, A;     ///< absolute
    ErrorSummary T_relative;  ///< where T > 1e-290; of its logarithm where that is less
    ErrorSummary A_relative;  ///< where |A| > 1e-30
    std::uint64_t not_finite = 0;
    std::uint64_t negative = 0;    ///< R, T or A < 0 though nothing amplifies
    std::uint64_t excess = 0;      ///< R + T > 1 + kAllowedExcess though nothing amplifies
    std::uint64_t beyond = 0;      ///< an error above its bound, or refused without gain
    std::uint64_t thresholds = 0;  ///< refused: at a laser threshold
    /// The first answer that is any of the first four, or refused without gain: "" if there is
    /// none, else what is wrong; `first_seed` with a count of 1 repeats that case.
    std::string first_violation;
    std::uint64_t first_seed = 0;

    bool passed() const { return first_violation.empty(); }
};

inline constexpr double kLargestStabilityCount = 1e6;

/// Sweeps `count` random cases of a regime, both polarizations, against conditioned_power().
/// Case i depends on the regime and on seed + i only; the report does not depend on threads.
///   count  [1, kLargestStabilityCount], else DomainError
RegimeReport measure_stability(const Regime& regime, std::uint64_t count, std::uint64_t seed,
                               const Execution& execution = {});

/// The case of that seed.
StackCase stability_case(const Regime& regime, std::uint64_t seed);

/// What is wrong with a kernel's answer to one case, as in RegimeReport: "" for nothing.
///   passive  nothing in it amplifies
std::string stability_violation(const StackCase& question, bool passive,
                                SimdLevel simd = best_simd_level());

}  // namespace irido
