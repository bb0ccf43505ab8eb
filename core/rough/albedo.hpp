#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"
#include "core/rough/angle_series.hpp"

namespace irido {

/// Quadrature over the half angle theta_d, for one theta_i, of smooth functions times W_alpha: the
/// fraction of the light incident at theta_i that meets a facet at theta_d and, if all facets are
/// perfect mirrors, leaves after this one reflection. W_alpha is derived in albedo.cpp.
class AlbedoNodes {
public:
    /// alpha in [1e-4, 1], theta_i_deg in [0, 90], else DomainError. From a tolerance of 1e-6 on,
    /// relative to a function's largest value, there are fewer nodes.
    AlbedoNodes(double alpha, double theta_i_deg, double tolerance = 0);

    /// Nodes of Gauss rules between two angles, with weights W_alpha dtheta_d.
    WeightedAngles operator()(double begin_deg, double end_deg) const;

    /// Error due to the nodes of the integral of a function that is 1 at its largest.
    double error() const;

    /// W_alpha(theta_i, theta_d) per radian, theta_d in (0, 90) degrees.
    double weight(double theta_d_deg) const;

private:
    double alpha_, s_, rest_;  ///< s = sqrt(1 - alpha^2), rest = 1 - s
    double theta_i_deg_, ci_, si_, seen_i_;
    bool are_few_;
    double whole_deg_, end_deg_;  ///< psi reaches pi up to the first; W = 0 beyond the second
    std::vector<double> before_, behind_;  ///< panel boundaries: theta_d, and the angle phi
};

/// Directional albedo, as a colour, of a rough surface whose facets are the stack: the illuminant's
/// light from theta_i that leaves in any direction after a single reflection,
///     E(theta_i) = integral over o of D G2 R / (4 cos_i cos_o) cos_o,
/// with GGX's D, Smith's height-correlated G2 and the stack's reflectance R at the half angle. The
/// shortfall from the white of perfectly reflecting facets is light shadowed or reflected again.
class RoughAlbedo {
public:
    /// Computes the stack's colours over the half angle with color_algorithm's automatic method,
    /// and throws as it does.
    ///   tables   observer and illuminant
    ///   stack    of the facets
    ///   request  options; request.sides is ignored
    ///   threads  0: one per core
    RoughAlbedo(const ColorTables& tables, const Stack& stack, const ColorRequest& request,
                unsigned threads);

    struct Value {
        Triple xyz{};
        double error = 0;  ///< estimated largest error of X, Y, Z: a few request.tolerance
    };

    /// Values for one roughness and many angles of incidence. alpha is 0 (a smooth surface) or in
    /// [1e-4, 1], cos_theta_i in [0, 1], else DomainError.
    std::vector<Value> operator()(double alpha, std::span<const double> cos_theta_i) const;

private:
    double tolerance_, color_error_ = 0;
    AngleSeries colors_;
};

}  // namespace irido
