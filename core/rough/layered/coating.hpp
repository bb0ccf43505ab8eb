#pragma once

namespace irido {

/// A smooth face between two transparent media, for unpolarized light: the medium outside a surface
/// and the one around its rough layers. Powers are the means of both polarizations.
class Coating {
public:
    /// Indices above 0.
    Coating(double n_outside, double n_inside);

    /// Light that meets the face.
    struct Crossing {
        double theta_deg = 0;  ///< of the refracted light; 90 where there is none
        double R = 0, T = 1;
    };
    /// From outside and from inside, theta in [0, 90] degrees.
    Crossing inward(double theta_deg) const;
    Crossing outward(double theta_deg) const;
    /// T of light from inside, by its cosine in [0, 1].
    double outward_transmittance(double cos_theta) const;

    bool is_there() const { return n_outside_ != n_inside_; }
    /// Directions inside beyond this angle cannot leave, degrees.
    double top_deg() const { return top_deg_; }
    /// (n_outside / n_inside)^2, the factor of a BRDF seen through the face.
    double dilution() const { return ratio_ * ratio_; }

private:
    double n_outside_, n_inside_, ratio_, top_deg_;
};

}  // namespace irido
