#pragma once

namespace irido {

/// The facet that reflects one direction into another.
struct MirrorFacet {
    double theta_d_deg = 0;     ///< half the angle between the directions
    double sin2 = 0, cos2 = 1;  ///< of its tilt
    double sin_i = 0, cos_i = 1, sin_o = 0, cos_o = 1;
};

/// Of two directions above the surface: polar angles in [0, 90] degrees, azimuth between them in
/// [0, 180], 0 being the same side. No step cancels: with the vectors i and o of length 1,
///     theta_d = atan2(|i - o|, |i + o|),
///     sin^2 = ((sin i - sin o)^2 + 4 sin i sin o cos^2(phi/2)) / |i + o|^2.
MirrorFacet mirror_facet(double theta_i_deg, double theta_o_deg, double phi_deg);

/// The same of one pair of polar angles at many azimuths.
class MirrorFacets {
public:
    MirrorFacets(double theta_i_deg, double theta_o_deg);
    /// near, far  cos and sin of half the azimuth
    MirrorFacet operator()(double near, double far) const;

    /// |i + o|^2 is up2 + across2 + both cos^2(phi/2): squares of its part along the normal, and
    /// across it where the azimuth is 180 degrees.
    double up2() const { return upward2_; }
    double across2() const { return sines2_; }
    double both() const { return both_; }

private:
    double sines2_, cosines2_, upward2_, both_;
    MirrorFacet facet_;
};

/// D G1(i) G1(o) / (4 cos i cos o) of GGX facets, per steradian: the BRDF where R = 1. It is finite
/// at grazing, where G1 goes as the cosine. Source: FPB24 eqs. 17 to 19, whose masking is
/// separable.
double lobe(double alpha, const MirrorFacet& facet);

/// G1(theta) / cos theta of Smith's masking, finite at grazing. alpha [1e-4, 1].
double visibility(double alpha, double cos_theta, double sin_theta);

}  // namespace irido
