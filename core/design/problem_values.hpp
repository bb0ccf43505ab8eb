#pragma once

#include <span>
#include <vector>

#include "core/design/design_model.hpp"

namespace irido {

/// Whether a quantity combines both polarizations: psi and delta.
bool is_of_both(DesignQuantity quantity);

/// Whether the problem's derivatives are finite differences; see DesignModel.
bool has_differences(const DesignProblem& problem);

/// Writes values into a stack of the problem, except Rebuilt ones; returns whether the repeat count
/// of a group changed.
bool set_values(const DesignProblem& problem, std::span<const double> x, Stack& stack);

/// The problem's stack for these values.
Stack stack_of(const DesignProblem& problem, std::span<const double> x);

/// Weights of all rows (see DesignRows): w / sum w over the entries, or w / sigma^2 for chi2.
std::vector<double> row_weights(const DesignProblem& problem);

/// Residuals of consecutive entries of a target other than colours.
///   problem, target    the target's index in the problem
///   offset, count      first entry and number of entries
///   values, residuals  input and output, `count` each
void settle(const DesignProblem& problem, std::size_t target, std::size_t offset, std::size_t count,
            const double* values, double* residuals);

/// psi, delta (both conventions) or a phase, in degrees.
///   quantity  which of them
///   r_s, r_p  reflected amplitudes, for psi and delta
///   own       amplitude whose phase is wanted
double angle_value(DesignQuantity quantity, Complex r_s, Complex r_p, Complex own);

/// Values and residuals of any stack, without derivatives. Throws DomainError as spectra(),
/// delays(), ellipsometry() and stack_color() do.
///   problem    targets
///   stack      to evaluate
///   tolerance  of colours, for stack_color()
///   simd       instruction set
///   rows       output
void compute_values(const DesignProblem& problem, const Stack& stack, double tolerance,
                    SimdLevel simd, DesignRows& rows);

/// The sum minimized, from residuals and weights.
double objective_of(const DesignProblem& problem, const DesignRows& rows);

double merit_of(MeritKind merit, double objective);

}  // namespace irido
