#pragma once

namespace irido {

/// The facet that refracts one direction into another.
struct RefractingFacet {
    bool is_there = false;        ///< false where no facet does
    double theta_deg = 0;         ///< angle of incidence on it, from above
    double cos_i = 1, cos_o = 1;  ///< of both directions with its normal
    double sin2 = 0, cos2 = 1;    ///< of its tilt
    double length2 = 1;           ///< |n_i i + n_o o|^2
};

/// Of a direction above the surface and one below it, both pointing away from it: polar angles from
/// the normal on their own side, [0, 90] degrees; azimuth between them, [0, 180] degrees, 180 being
/// the side to which light goes straight on. n_i, n_o: indices above and below, not the same. Its
/// normal is that of -(n_i i + n_o o) which points up. Source: B. Walter et al., EGSR 2007, eq. 16.
RefractingFacet refracting_facet(double n_i, double n_o, double theta_i_deg, double theta_o_deg,
                                 double phi_deg);

/// BTDF of facets that let all light through, per steradian, of radiance:
///     |i.h| |o.h| n_o^2 D G1(i) G1(o) / (cos i cos o (n_i i.h + n_o o.h)^2).
/// It is n_o^2/n_i^2 times that of the way back. 0 where no facet is there. Source: Walter et al.,
/// eq. 21, with the separable masking of lobe().
double refraction_lobe(double alpha, double n_o, double theta_i_deg, double theta_o_deg,
                       const RefractingFacet& facet);

}  // namespace irido
