#pragma once

#include <vector>

#include "core/render/environment.hpp"

namespace irido {

/// Samples directions in proportion to brightness: from cells of equal solid angle, by their mean
/// radiance at a few points. Every direction has nonzero probability. Thread-safe.
class EnvironmentSampler {
public:
    explicit EnvironmentSampler(const Environment& environment);

    /// Whether all cells are equally bright.
    bool is_uniform() const { return is_uniform_; }
    /// The direction of u and v, in (0, 1).
    Vector3 direction(double u, double v) const;
    /// Probability per steradian of a direction.
    double density(const Vector3& direction) const;

private:
    std::vector<double> sums_;  ///< of the probabilities of cells up to each, [row][column]
    bool is_uniform_ = false;
};

}  // namespace irido
