#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/design/design_problem.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

/// What a problem's targets make of one point.
struct DesignRows {
    double objective = 0;          ///< what is minimized; see DesignModel::merit()
    std::vector<double> value;     ///< of the quantities, [entry]; of lab L, a, b
    std::vector<double> residual;  ///< [row]: value - target, 0 where an inequality holds, angles
                                   ///< within half a turn. A colour has three rows, whose squares
                                   ///< add up to that of its difference
    std::vector<double> weight;    ///< [row], as the objective has it
    std::vector<double> jacobian;  ///< [free][row], of the residuals
};

/// A problem made ready for evaluations one after the other, on one thread. Values that are not
/// integers are differentiated in closed form (layer_slopes.hpp), but for delays, for stacks with
/// incoherent layers or spread thicknesses and for values that are Rebuilt, which are differenced.
class DesignModel {
public:
    /// Throws DomainError where a target or a material does not fit, naming it.
    explicit DesignModel(const DesignProblem& problem, SimdLevel simd = best_simd_level());
    ~DesignModel();
    DesignModel(DesignModel&&) noexcept;
    DesignModel& operator=(DesignModel&&) = delete;

    const DesignProblem& problem() const;
    std::size_t size() const { return problem().free.size(); }
    std::vector<double> start() const;

    /// The objective; infinite where the stack cannot be computed.
    double objective(std::span<const double> x);
    /// With its gradient, of size(): 0 for integers.
    double objective(std::span<const double> x, std::span<double> gradient);
    /// With gradient and the Gauss-Newton matrix [size()][size()] of second derivatives; for
    /// mean_abs that of the squares with the same gradient.
    double objective(std::span<const double> x, std::span<double> gradient,
                     std::span<double> hessian);
    /// All of the last point that was evaluated with derivatives.
    const DesignRows& rows() const;

    /// The problem's merit of an objective: its root for rms.
    double merit(double objective) const;

    /// Points at which the objective was computed so far; differences count each of theirs.
    std::size_t evaluations() const;

    /// Takes as many wavelengths for colours as leave them at x within about `tolerance` of CIELAB;
    /// whether that changed their number. They stay the same until the next call.
    bool adapt_colors(std::span<const double> x, double tolerance);
    bool has_colors() const;
    /// Whether derivatives are in closed form.
    bool is_analytic() const;

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

/// The problem's merit at x, colours by stack_color() to 1e-9: what every other command prints.
/// rows  gets values and residuals if given
double exact_merit(const DesignProblem& problem, std::span<const double> x,
                   DesignRows* rows = nullptr);

}  // namespace irido
