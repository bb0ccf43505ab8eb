#include "core/design/fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/parallel.hpp"
#include "core/math/random.hpp"

namespace irido {

namespace {

/// One minimum, from one start.
struct Minimum {
    std::vector<double> x;
    double chi2 = kInfinity;
    LocalEnd end = LocalEnd::failed;
    std::size_t evaluations = 0;
};

/// How far a value may move: through its bounds, if it has any.
double scale_of(const FreeValue& value, double x) {
    const double range = value.high - value.low;
    return std::isfinite(range) ? range : std::abs(x) + 1;
}

/// Fills in errors and correlations from half of the second derivatives. In units of their own
/// errors the matrix has ones on its diagonal; where its eigenvalues are rounding, the values along
/// the eigenvector are not known.
void find_errors(const DesignProblem& problem, const std::vector<double>& hessian,
                 FitResult& result) {
    constexpr double kRounding = 1e-13, kPart = 1e-3, kInfluence = 1e-9;
    const std::size_t size = problem.free.size();
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < size; ++i)
        if (std::sqrt(hessian[i * size + i] / 2) * scale_of(problem.free[i], result.x[i]) >
            kInfluence)
            known.push_back(i);
    result.standard_error.assign(size, kInfinity);
    result.correlation.assign(size * size, 0);
    for (std::size_t i = 0; i < size; ++i) result.correlation[i * size + i] = 1;
    const auto count = static_cast<Eigen::Index>(known.size());
    if (count == 0) return;
    const auto at = [&](Eigen::Index i) { return known[static_cast<std::size_t>(i)]; };
    Eigen::VectorXd scale(count);
    for (Eigen::Index i = 0; i < count; ++i)
        scale(i) = std::sqrt(hessian[at(i) * size + at(i)] / 2);
    Eigen::MatrixXd matrix(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
        for (Eigen::Index j = 0; j < count; ++j)
            matrix(i, j) = hessian[at(i) * size + at(j)] / 2 / (scale(i) * scale(j));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
    std::vector<bool> is_lost(known.size(), false);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const Eigen::VectorXd v = eigen.eigenvectors().col(k);
        if (eigen.eigenvalues()(k) > kRounding) {
            covariance += v * v.transpose() / eigen.eigenvalues()(k);
            continue;
        }
        for (Eigen::Index i = 0; i < count; ++i)
            if (std::abs(v(i)) > kPart) is_lost[static_cast<std::size_t>(i)] = true;
    }
    for (Eigen::Index i = 0; i < count; ++i) {
        if (is_lost[static_cast<std::size_t>(i)]) continue;
        result.standard_error[at(i)] = std::sqrt(covariance(i, i)) / scale(i);
        for (Eigen::Index j = 0; j < count; ++j)
            if (i != j && !is_lost[static_cast<std::size_t>(j)])
                result.correlation[at(i) * size + at(j)] =
                    covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
    }
}

bool is_elsewhere(const DesignProblem& problem, const std::vector<double>& a,
                  const std::vector<double>& b) {
    constexpr double kNear = 1e-3;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::abs(a[i] - b[i]) > kNear * scale_of(problem.free[i], a[i])) return true;
    }
    return false;
}

}  // namespace

FitResult fit(const DesignProblem& problem, const SearchSettings& settings, std::size_t starts) {
    constexpr double kFineColor = 1e-7;
    std::vector<Minimum> minima(starts + 1);
    const std::vector<double> given = DesignModel(problem, settings.simd).start();
    parallel_for(minima.size(), settings.threads, [&](std::size_t i) {
        if (i > 0 && settings.should_stop && settings.should_stop()) return;
        DesignModel model(problem, settings.simd);
        Random random(settings.seed * 0x9e3779b97f4a7c15U + i);
        std::vector<double> x = given;
        for (std::size_t p = 0; i > 0 && p < x.size(); ++p)
            if (!problem.free[p].is_integer)
                x[p] = random.uniform(problem.free[p].low, problem.free[p].high);
        LocalLimits limits;
        limits.evaluations = 2000;
        limits.relative = 1e-13;
        limits.should_stop = settings.should_stop;
        const LocalResult local = refined(model, std::move(x), limits, kFineColor);
        minima[i] = {local.x, local.objective, local.end, model.evaluations()};
    });
    FitResult result;
    result.is_stopped = settings.should_stop && settings.should_stop();
    for (const Minimum& one : minima) result.evaluations += one.evaluations;
    std::ranges::stable_sort(minima, {}, &Minimum::chi2);
    const Minimum& best = minima.front();
    if (!std::isfinite(best.chi2))
        throw DomainError("the stack could not be computed at any point tried within the bounds");
    result.x = best.x;
    result.chi2 = best.chi2;
    result.end = best.end;
    result.starts = minima.size();
    for (const Minimum& one : minima) {
        if (one.chi2 <= best.chi2 * 1.01 + 1e-12) ++result.starts_within;
        if (!result.other.empty() || !std::isfinite(one.chi2)) continue;
        if (!is_elsewhere(problem, best.x, one.x)) continue;
        result.other = one.x;
        result.other_chi2 = one.chi2;
    }
    DesignModel model(problem, settings.simd);
    model.adapt_colors(best.x, kFineColor);
    std::vector<double> gradient(model.size()), hessian(model.size() * model.size());
    model.objective(best.x, gradient, hessian);
    find_errors(problem, hessian, result);
    const std::size_t rows = model.rows().residual.size();
    std::size_t moving = 0;
    for (const FreeValue& value : problem.free) moving += value.is_integer ? 0 : 1;
    result.dof = rows > moving ? rows - moving : 0;
    return result;
}

}  // namespace irido
