#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/design/design_problem.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

/// A problem's targets evaluated at one point.
struct DesignRows {
    double objective = 0;          ///< quantity minimized; see DesignModel::merit()
    std::vector<double> value;     ///< of the quantities, [entry]; L, a, b for lab
    std::vector<double> residual;  ///< [row]: value - target, 0 where an inequality holds, angles
                                   ///< wrapped to +-180. A colour has three rows, whose
                                   ///< squares sum to that of its difference
    std::vector<double> weight;    ///< [row], as used by the objective
    std::vector<double> jacobian;  ///< [free][row], of the residuals
};

/// A problem prepared for repeated evaluation on one thread. Non-integer values are differentiated
/// in closed form (layer_slopes.hpp), except for delays, for absorbing incoherent layers,
/// thickness distributions, and for Rebuilt values, which use finite differences.
class DesignModel {
public:
    /// Throws DomainError naming a target or material that does not fit.
    explicit DesignModel(const DesignProblem& problem, SimdLevel simd = best_simd_level());
    ~DesignModel();
    DesignModel(DesignModel&&) noexcept;
    DesignModel& operator=(DesignModel&&) = delete;

    const DesignProblem& problem() const;
    std::size_t size() const { return problem().free.size(); }
    std::vector<double> start() const;

    /// The objective; infinite if the stack cannot be computed.
    double objective(std::span<const double> x);
    /// With its gradient, [size()]; 0 for integers.
    double objective(std::span<const double> x, std::span<double> gradient);
    /// With the gradient and the Gauss-Newton approximation [size()][size()] of the Hessian; for
    /// mean_abs, that of the sum of squares with the same gradient.
    double objective(std::span<const double> x, std::span<double> gradient,
                     std::span<double> hessian);
    /// Details of the last point evaluated with derivatives.
    const DesignRows& rows() const;

    /// The problem's merit for an objective: its root for rms.
    double merit(double objective) const;

    /// Number of evaluations so far, including those for finite differences.
    std::size_t evaluations() const;

    /// Chooses enough wavelengths for colours to be within about `tolerance` in CIELAB at x;
    /// returns whether that changed their number, which stays fixed until the next call.
    bool adapt_colors(std::span<const double> x, double tolerance);
    bool has_colors() const;
    /// Whether derivatives are in closed form.
    bool is_analytic() const;

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

/// The problem's merit at x, with colours by stack_color() to 1e-9: the value that every other
/// command prints. Fills `rows`, if given, with values and residuals.
double exact_merit(const DesignProblem& problem, std::span<const double> x,
                   DesignRows* rows = nullptr);

}  // namespace irido
