#include "core/rough/ggx.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace irido {

namespace {

/// cos(theta) sqrt(1 + alpha^2 tan^2(theta)).
double stretched(double alpha, double cosine) {
    return std::sqrt(alpha * alpha * (1 - cosine * cosine) + cosine * cosine);
}

}  // namespace

double ggx_distribution(double alpha, double cos_theta_m) {
    require_in_range("alpha", alpha, kSmoothest, kRoughest);
    require_in_range("cos_theta_m", cos_theta_m, 0, 1);
    const double sin2 = (1 - cos_theta_m) * (1 + cos_theta_m);
    const double slope = alpha * cos_theta_m, spread = sin2 + slope * slope;
    return alpha * alpha / (std::numbers::pi * spread * spread);
}

double smith_masking(double alpha, double cos_theta) {
    require_in_range("alpha", alpha, kSmoothest, kRoughest);
    require_in_range("cos_theta", cos_theta, 0, 1);
    return 2 * cos_theta / (cos_theta + stretched(alpha, cos_theta));
}

double smith_masking_shadowing(double alpha, double cos_theta_i, double cos_theta_o) {
    require_in_range("alpha", alpha, kSmoothest, kRoughest);
    require_in_range("cos_theta_i", cos_theta_i, 0, 1);
    require_in_range("cos_theta_o", cos_theta_o, 0, 1);
    if (cos_theta_i == 0 || cos_theta_o == 0) return 0;
    return 2 * cos_theta_i * cos_theta_o /
           (cos_theta_o * stretched(alpha, cos_theta_i) +
            cos_theta_i * stretched(alpha, cos_theta_o));
}

}  // namespace irido
