#pragma once

namespace irido {

/// A smooth interface between two transparent media in unpolarized light: the medium outside a
/// surface and the one around its rough layers. Powers are averaged over both polarizations.
class Coating {
public:
    /// Indices > 0.
    Coating(double n_outside, double n_inside);

    /// Refraction, reflectance and transmittance at one angle.
    struct Crossing {
        double theta_deg = 0;  ///< of the refracted light; 90 under total reflection
        double R = 0, T = 1;
    };
    /// For light from outside and from inside; theta in [0, 90] degrees.
    Crossing inward(double theta_deg) const;
    Crossing outward(double theta_deg) const;
    /// T for light from inside, by its cosine in [0, 1].
    double outward_transmittance(double cos_theta) const;

    bool is_there() const { return n_outside_ != n_inside_; }
    /// Critical angle in degrees, beyond which light inside cannot leave.
    double top_deg() const { return top_deg_; }
    /// (n_outside / n_inside)^2, the factor by which the interface dilutes a BRDF.
    double dilution() const { return ratio_ * ratio_; }

private:
    double n_outside_, n_inside_, ratio_, top_deg_;
};

}  // namespace irido
