#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "core/math/gauss.hpp"
#include "core/rough/angle_series.hpp"

namespace irido {

/// Quadrature over the directions into which the facets of a rough layer reflect light from
/// theta_i, ordered by the facets' theta_d, for smooth functions E(o) and R(theta_d):
///     integral f E cos_o dw_o with R = R(theta_d)
///         = integral dtheta_d R 2 cos td sin td  integral D G1(i)/cos i G1(o) E(o) dpsi,
/// with cos o = cos i cos 2td + sin i sin 2td cos psi. Directions beyond `top`, where E may vanish
/// as a square root, are left out. Nodes in psi are uniform in the square root of the distance to
/// the end and graded towards D's peak at psi = 0 and to where G1 and E vary; nodes in theta_d are
/// those of AlbedoNodes.
class LobeNodes {
public:
    /// alpha in [1e-4, 1], theta_i_deg in [0, top_deg], top_deg in (0, 90].
    LobeNodes(double alpha, double theta_i_deg, double top_deg);

    /// Calls add(cos_o, weight) at the psi nodes of one theta_d in (0, 90) degrees.
    template <class Add>
    void over_psi(double theta_d_deg, const Add& add) const {
        const Ring ring = ring_at(theta_d_deg);
        if (!(ring.c_first > ring.c_top)) return;
        double begin = 0;
        for (const double end : panels_of(ring)) {
            for (const GaussNode& node : gauss_legendre<10>()) {
                const double u = 0.5 * ((begin + end) + (end - begin) * node.x);
                const Node at = node_at(ring, u);
                add(at.cos_o, 0.5 * (end - begin) * node.weight * at.weight);
            }
            begin = end;
        }
    }

    /// Calls visit(begin, end, theta_of, slope_of, variable_of) for panels in the variable in which
    /// the weights are smooth: theta_of(x) in degrees, its derivative slope_of(x), and the inverse
    /// variable_of(theta_deg).
    template <class Visit>
    void over_panels(const Visit& visit) const {
        const auto same = [](double x) { return x; };
        for (std::size_t k = 0; k + 1 < before_.size(); ++k)
            visit(
                before_[k], before_[k + 1], same, [](double) { return 1.0; }, same);
        const auto theta_of = [this](double phi) {
            return whole_deg_ + theta_i_deg_ * std::sin(phi) * std::sin(phi);
        };
        const auto slope_of = [this](double phi) { return theta_i_deg_ * std::sin(2 * phi); };
        const auto phi_of = [this](double theta) { return angle_behind(theta); };
        for (std::size_t k = 0; k + 1 < behind_.size(); ++k)
            visit(behind_[k], behind_[k + 1], theta_of, slope_of, phi_of);
    }

    /// Weight per radian of theta_d, the integral over psi with E = exit.
    double weight(double theta_d_deg, const std::function<double(double cos_o)>& exit) const;

    /// Nodes in theta_d between two angles with weights dtheta_d, not integrated over psi.
    WeightedAngles over_theta_d(double begin_deg, double end_deg) const;

private:
    struct Ring {
        double c_first, c_last, c_top;  ///< cos o at psi = 0 and pi, and its cut-off
        double b, psi_max, P, swing, scale;
    };
    struct Node {
        double cos_o, weight;
    };
    double angle_behind(double theta_d_deg) const;  ///< phi: theta_d = whole + theta_i sin^2 phi
    Ring ring_at(double theta_d_deg) const;
    std::vector<double> panels_of(const Ring& ring) const;  ///< panel boundaries in u
    Node node_at(const Ring& ring, double u) const;

    double alpha_, s_, rest_;
    double theta_i_deg_, si_, seen_i_;  ///< seen_i_: G1 / cos
    double top_deg_, c_top_;
    double whole_deg_, end_deg_;
    std::vector<double> before_, behind_;
};

}  // namespace irido
