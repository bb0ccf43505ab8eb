#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace irido::oracle {

/// Gauss-Legendre points and weights on [-1, 1], by Newton's method on the recurrence.
template <class Real>
struct LegendreRule {
    std::vector<Real> x, weight;

    explicit LegendreRule(int order) {
        for (int i = 0; i < order; ++i) {
            Real z = std::cos(std::numbers::pi_v<Real> * (static_cast<Real>(i) + Real(0.75)) /
                              (static_cast<Real>(order) + Real(0.5)));
            Real slope = 0;
            for (int step = 0; step < 100; ++step) {
                Real p0 = 1, p1 = z;
                for (int n = 2; n <= order; ++n) {
                    const Real p2 =
                        (static_cast<Real>(2 * n - 1) * z * p1 - static_cast<Real>(n - 1) * p0) /
                        static_cast<Real>(n);
                    p0 = p1;
                    p1 = p2;
                }
                slope = static_cast<Real>(order) * (z * p1 - p0) / (z * z - 1);
                const Real move = p1 / slope;
                z -= move;
                if (std::abs(move) < 4 * std::numeric_limits<Real>::epsilon()) break;
            }
            x.push_back(z);
            weight.push_back(2 / ((1 - z * z) * slope * slope));
        }
    }
};

}  // namespace irido::oracle
