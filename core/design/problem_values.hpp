#pragma once

#include <span>
#include <vector>

#include "core/design/design_model.hpp"

namespace irido {

/// Whether a quantity has one value of both polarizations: psi and delta.
bool is_of_both(DesignQuantity quantity);

/// Whether derivatives of the problem are differences; see DesignModel.
bool has_differences(const DesignProblem& problem);

/// Puts values into a stack of the problem, all but those that are Rebuilt; whether the repeat of a
/// group changed.
bool set_values(const DesignProblem& problem, std::span<const double> x, Stack& stack);

/// The problem's stack at these values.
Stack stack_of(const DesignProblem& problem, std::span<const double> x);

/// Weights of all rows (see DesignRows): w / sum w over the entries, or w / sigma^2 for chi2.
std::vector<double> row_weights(const DesignProblem& problem);

/// Residuals of some entries of a target, from the one at `offset` on, that are not colours.
void settle(const DesignProblem& problem, std::size_t target, std::size_t offset, std::size_t count,
            const double* values, double* residuals);

/// psi, delta (both conventions) or a phase in degrees, of the amplitudes that it belongs to.
double angle_value(DesignQuantity quantity, Complex r_s, Complex r_p, Complex own);

/// Values and residuals of a stack by spectra(), delays(), ellipsometry() and, to `tolerance`,
/// stack_color(): any stack, no derivatives. Throws DomainError as these do.
void compute_values(const DesignProblem& problem, const Stack& stack, double tolerance,
                    SimdLevel simd, DesignRows& rows);

/// The sum that is minimized, of residuals and weights.
double objective_of(const DesignProblem& problem, const DesignRows& rows);

double merit_of(MeritKind merit, double objective);

}  // namespace irido
