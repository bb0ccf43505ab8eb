#include "core/truth/stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/math/parallel.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/truth/reference.hpp"

namespace irido {

namespace {

/// Below these values too few digits are left to compare: of subnormal T, and of A = 1 - R - T.
constexpr double kSmallestT = 1e-290, kSmallestA = 1e-30;

/// Beyond this, first derivatives do not bound the relative error of T: T may be 0.
constexpr double kLargestRelativeBound = 0.5;

/// Wavelengths that the vector kernel evaluates at once, including the one compared.
constexpr std::size_t kCompany = 11;

using Powers = std::array<Power, 2>;  // s, p
constexpr std::array kPolarizations{Polarization::s, Polarization::p};

/// The vector kernel evaluates the case among wavelengths that take other code paths, at a random
/// position; the plain kernel works point by point.
Powers powers_of(const StackCase& c, Random& random, SimdLevel simd) {
    const std::size_t count = simd == SimdLevel::plain ? 1 : kCompany;
    const std::size_t place = random.below(count);
    std::vector<double> wavelengths_nm(count);
    for (double& nm : wavelengths_nm)
        nm = std::clamp(c.wavelength_nm * random.log_uniform(0.5, 2), kAllWavelengths.first_nm,
                        kAllWavelengths.last_nm);
    wavelengths_nm[place] = c.wavelength_nm;
    const IndexTable table(c.stack, std::move(wavelengths_nm));
    const IncidentAngle direction = incident_angle(c.angle_deg);
    const Spectra at = spectra(StackPower(c.stack), table, std::span(&direction, 1), {}, {1, simd});
    return {at.s.power(place), at.p.power(place)};
}

/// An error and the condition to judge it by; absent if there is nothing to compare.
struct CaseError {
    double error = 0, condition = 0;
};

/// Errors of one case in one polarization.
struct Answer {
    CaseError R, T, A;
    std::optional<CaseError> T_relative, A_relative;
    bool finite = true, negative = false, excess = false, refused = false;
    double beyond = 0;       ///< largest error / bound
    std::string_view which;  ///< quantity of that error
};

CaseError absolute_error(double value, double exact, double condition) {
    const double scale = std::max(1.0, std::abs(exact));
    return {std::abs(value - exact) / scale, condition / scale};
}

/// Relative error, or that of the logarithm if smaller: for a tiny T the accuracy of its exponent
/// is what counts.
CaseError relative_error(double value, double exact, double condition) {
    const double relative = std::abs(value - exact) / std::abs(exact), ratio = value / exact;
    return {ratio > 1 ? std::min(relative, std::log(ratio)) : relative, condition};
}

/// One quantity to be checked.
struct Judged {
    std::string_view which;
    const StackCase& question;
    Polarization polarization;
    double Power::*quantity;
    double value;
    double well_posed = kWellPosedError, roundings = kAllowedRoundings;

    bool is_answer_nearby() const {
        return irido::is_answer_nearby(question.stack, question.wavelength_nm, question.angle_deg,
                                       polarization, quantity, value, roundings);
    }
};

void judge(Answer& answer, const Judged& judged, const std::optional<CaseError>& e) {
    if (!e) return;
    const double share = e->error / error_bound(e->condition, judged.well_posed, judged.roundings);
    if (share <= answer.beyond || (share > 1 && judged.is_answer_nearby())) return;
    answer.beyond = share;
    answer.which = judged.which;
}

bool is_finite(const Power& power) {
    return std::isfinite(power.R) && std::isfinite(power.T) && std::isfinite(power.A);
}

Answer compared(const StackCase& question, Polarization polarization, const Power& power,
                const ConditionedPower& exact, bool passive) {
    const auto& [reference, condition] = exact;
    Answer answer;
    answer.finite = is_finite(power) && is_finite(reference);
    if (!answer.finite) return answer;
    answer.negative = passive && (power.R < 0 || power.T < 0 || power.A < 0);
    answer.excess = passive && power.R + power.T > 1 + kAllowedExcess;
    answer.R = absolute_error(power.R, reference.R, condition.R);
    answer.T = absolute_error(power.T, reference.T, condition.T);
    answer.A = absolute_error(power.A, reference.A, condition.A);
    if (reference.T > kSmallestT)
        answer.T_relative = relative_error(power.T, reference.T, condition.log_T);
    if (std::abs(reference.A) > kSmallestA)
        answer.A_relative =
            relative_error(power.A, reference.A, condition.A / std::abs(reference.A));
    const auto of = [&](std::string_view which, double Power::*quantity) {
        return Judged{which, question, polarization, quantity, power.*quantity};
    };
    const auto relative = [&](std::string_view which, double Power::*quantity, double well_posed) {
        Judged judged = of(which, quantity);
        judged.well_posed = well_posed;
        judged.roundings = kAllowedRelativeRoundings;
        return judged;
    };
    judge(answer, of("R", &Power::R), answer.R);
    judge(answer, of("T", &Power::T), answer.T);
    judge(answer, of("A", &Power::A), answer.A);
    if (answer.T_relative && error_bound(answer.T_relative->condition) < kLargestRelativeBound)
        judge(answer, relative("T (relative)", &Power::T, kWellPosedError), answer.T_relative);
    judge(answer, relative("A (relative)", &Power::A, kWellPosedRelativeA), answer.A_relative);
    return answer;
}

/// A random stream per regime and seed.
Random random_of(const Regime& regime, std::uint64_t seed) {
    std::uint64_t key = 0xcbf29ce484222325U;  // FNV-1a of the name
    for (const char letter : regime.name)
        key = (key ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
    return Random(key ^ Random(seed).bits());
}

/// Both polarizations; `random` draws the accompanying wavelengths.
std::array<Answer, 2> answers(const StackCase& c, bool passive, Random random, SimdLevel simd) {
    const auto exact = conditioned_power(c.stack, c.wavelength_nm, c.angle_deg);
    std::array<Answer, 2> result;
    try {
        const Powers powers = powers_of(c, random, simd);
        for (std::size_t i = 0; i < 2; ++i)
            result[i] = compared(c, kPolarizations[i], powers[i], exact[i], passive);
    } catch (const DomainError&) {
        result[0].refused = result[1].refused = true;
    }
    return result;
}

ErrorSummary summary_of(std::vector<CaseError> errors) {
    ErrorSummary summary;
    if (errors.empty()) return summary;
    for (const CaseError& e : errors)
        summary.roundings =
            std::max(summary.roundings, e.error / (kUnitRoundoff * (1 + e.condition)));
    std::ranges::sort(errors, {}, &CaseError::error);
    summary.worst = errors.back().error;
    summary.condition = errors.back().condition;
    const double rank = std::ceil(0.99 * static_cast<double>(errors.size()));
    summary.p99 = errors[static_cast<std::size_t>(rank) - 1].error;
    return summary;
}

/// Description of a failure, or "".
std::string violation_of(const Answer& answer, bool passive) {
    if (answer.refused) return passive ? "refused though nothing amplifies" : "";
    if (!answer.finite) return "not a finite number";
    if (answer.negative) return "a negative power";
    if (answer.excess) return "R + T above 1";
    if (answer.beyond > 1)
        return "an error of " + std::string(answer.which) + " " + to_text(answer.beyond) +
               " times its bound";
    return "";
}

void count(RegimeReport& report, const Answer& answer, bool passive, std::uint64_t seed) {
    report.thresholds += answer.refused;
    report.count += !answer.refused;
    report.not_finite += !answer.finite;
    report.negative += answer.negative;
    report.excess += answer.excess;
    report.beyond += answer.beyond > 1 || (passive && answer.refused);
    if (!report.passed()) return;
    report.first_violation = violation_of(answer, passive);
    report.first_seed = seed;
}

}  // namespace

double error_bound(double condition, double well_posed, double roundings) {
    return std::max(well_posed, roundings * condition * kUnitRoundoff);
}

StackCase stability_case(const Regime& regime, std::uint64_t seed) {
    Random random = random_of(regime, seed);
    return regime.make(random);
}

std::string stability_violation(const StackCase& question, bool passive, SimdLevel simd) {
    const auto [s, p] = answers(question, passive, Random(1), simd);
    if (const std::string wrong = violation_of(s, passive); !wrong.empty()) return "s: " + wrong;
    const std::string wrong = violation_of(p, passive);
    return wrong.empty() ? "" : "p: " + wrong;
}

RegimeReport measure_stability(const Regime& regime, std::uint64_t cases, std::uint64_t seed,
                               const Execution& execution) {
    require_in_range("count", static_cast<double>(cases), 1, kLargestStabilityCount);
    std::vector<std::array<Answer, 2>> all(cases);
    parallel_for(cases, execution.threads, [&](std::size_t i) {
        Random random = random_of(regime, seed + i);
        const StackCase c = regime.make(random);
        all[i] = answers(c, regime.passive, random, execution.simd);
    });
    RegimeReport report;
    report.regime = regime.name;
    std::vector<CaseError> r, t, a, t_relative, a_relative;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (const Answer& answer : all[i]) {
            count(report, answer, regime.passive, seed + i);
            if (answer.refused || !answer.finite) continue;
            r.push_back(answer.R);
            t.push_back(answer.T);
            a.push_back(answer.A);
            if (answer.T_relative) t_relative.push_back(*answer.T_relative);
            if (answer.A_relative) a_relative.push_back(*answer.A_relative);
        }
    }
    report.R = summary_of(std::move(r));
    report.T = summary_of(std::move(t));
    report.A = summary_of(std::move(a));
    report.T_relative = summary_of(std::move(t_relative));
    report.A_relative = summary_of(std::move(a_relative));
    return report;
}

}  // namespace irido
