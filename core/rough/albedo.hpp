#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"
#include "core/rough/angle_series.hpp"

namespace irido {

/// Quadrature of anything smooth times W_alpha over the half angle theta_d, for one theta_i: how
/// much of the light that comes in at theta_i meets a facet at theta_d and leaves after this one
/// reflection, by a perfect mirror's facets. W_alpha and its nodes are those of albedo.cpp.
class AlbedoNodes {
public:
    /// alpha [1e-4, 1];  theta_i_deg [0, 90], else DomainError.
    AlbedoNodes(double alpha, double theta_i_deg);

    /// Nodes of 16-point Gauss rules and their weights W_alpha dtheta_d, between two angles.
    WeightedAngles operator()(double begin_deg, double end_deg) const;

    /// W_alpha(theta_i, theta_d) per radian, theta_d in (0, 90) degrees.
    double weight(double theta_d_deg) const;

private:
    double alpha_, s_, rest_;  ///< s = sqrt(1 - alpha^2), rest = 1 - s
    double theta_i_deg_, ci_, si_, seen_i_;
    double whole_deg_, end_deg_;           ///< up to here psi goes to pi; beyond the end W is 0
    std::vector<double> before_, behind_;  ///< ends of panels: theta_d and the angle phi
};

/// Directional albedo of a rough surface whose facets each are the stack, as a colour: the light
/// of the illuminant from theta_i that leaves in any direction after one reflection,
///     E(theta_i) = integral over o of D G2 R / (4 cos_i cos_o) cos_o,
/// with GGX's D, Smith's height-correlated G2 and the stack's reflectance R at the half angle. What
/// is missing to the white of a perfect mirror's facets has been shadowed or reflected again.
class RoughAlbedo {
public:
    /// The stack's colours over the half angle, by color_algorithm's automatic method;
    /// request.sides is not looked at. `threads` as in Execution. Throws as color_algorithm does.
    RoughAlbedo(const ColorTables& tables, const Stack& stack, const ColorRequest& request,
                unsigned threads);

    struct Value {
        Triple xyz{};
        double error = 0;  ///< estimate of the largest of X, Y, Z: a few request.tolerance
    };

    /// Values of one roughness and many angles of incidence. alpha 0 (a smooth surface) or in
    /// [1e-4, 1];  cos_theta_i [0, 1], else DomainError.
    std::vector<Value> operator()(double alpha, std::span<const double> cos_theta_i) const;

private:
    double color_error_ = 0;
    AngleSeries colors_;
};

}  // namespace irido
