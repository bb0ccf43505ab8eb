#pragma once

#include "core/coherent/slab_response.hpp"
#include "core/thickness/fringe_series.hpp"

namespace irido {

/// A layer as a function of its thickness.
class SweptLayer {
public:
    SweptLayer(const Medium& medium, double k0, Polarization polarization);

    struct State {
        LayerTurn turn;
        AbsorbedPower absorbed;  ///< zero if the medium does not absorb
    };
    /// State at a thickness, with `phase` radians added to each round trip: layer_turn() and
    /// absorbed_power() with Re(delta) + phase/2 in place of Re(delta) in all sines and cosines.
    State operator()(double thickness_nm, double phase) const;

    Complex kz() const { return kz_; }  ///< over k0, Im >= 0

private:
    AbsorbedPower absorbed(double cos_a, double sin_a, double exp_less) const;

    Medium medium_;
    double k0_;
    Polarization polarization_;
    Complex kz_;  ///< Im >= 0
    Coupling coupling_;
};

/// A coherent stack as a function of one layer's thickness. The layers above and below are combined
/// once; the fields at the top are then c P + sd Q with c, sd of LayerTurn, so that each thickness
/// costs one sine and one cosine.
class ThicknessSweep {
public:
    /// Combines the fixed layers.
    ///   in            incident wave
    ///   above         slab between the incident side and the layer
    ///   layer         its medium
    ///   below         slab between the layer and the substrate
    ///   out           transmitted wave
    ///   k0            2 pi / wavelength, 1/nm
    ///   polarization  s or p, the one that media and waves were computed for
    ThicknessSweep(const Wave& in, const Slab& above, const Medium& layer, const Slab& below,
                   const Wave& out, double k0, Polarization polarization);

    /// Powers and denominator, without amplitudes; otherwise as slab_response(). `phase` as in
    /// SweptLayer.
    Response operator()(double thickness_nm, double phase = 0) const;

    /// R and T as functions of the layer's round trip, without the interference flux in an
    /// absorbing incident medium.
    Fringes fringes() const;
    /// Whether any layer absorbs or amplifies.
    bool absorbs() const { return absorbs_; }

private:
    /// A part of the incident power; unit = unit_ / |sum|^2.
    double absorbed(const SweptLayer::State& at, double unit) const;

    /// Contributions of one column of the layer's matrix.
    struct Column {
        Complex b, c;             ///< at the layer's upper face
        Complex sum, difference;  ///< at the top: Y0 B + C and Y0 B - C, times in.b
    };
    Column column(Complex b, Complex c) const;

    Wave in_;
    Slab above_;
    SweptLayer layer_;
    bool layer_absorbs_, absorbs_;
    double k0_, unit_, below_log_scale_, out_flux_;
    SlabAbsorption below_absorbed_;
    double below_flux_;
    Column cos_, sd_;
};

}  // namespace irido
