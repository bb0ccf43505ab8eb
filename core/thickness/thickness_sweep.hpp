#pragma once

#include "core/coherent/slab_response.hpp"
#include "core/thickness/fringe_series.hpp"

namespace irido {

/// A layer of any thickness.
class SweptLayer {
public:
    SweptLayer(const Medium& medium, double k0, Polarization polarization);

    struct State {
        LayerTurn turn;
        AbsorbedPower absorbed;  ///< zero if the medium does not absorb
    };
    /// A round trip has `phase` radians more than the thickness says: as layer_turn() and
    /// absorbed_power(), with Re(delta) + phase/2 for Re(delta) in all sines and cosines.
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

/// A coherent stack as a function of one layer's thickness. What lies above and below is worked out
/// once; then the fields at the top are c P + sd Q with c, sd of LayerTurn, and a thickness costs a
/// sine and a cosine.
class ThicknessSweep {
public:
    ThicknessSweep(const Wave& in, const Slab& above, const Medium& layer, const Slab& below,
                   const Wave& out, double k0, Polarization polarization);

    /// Powers and a denominator, without amplitudes; `phase` as in SweptLayer. As slab_response()
    /// else.
    Response operator()(double thickness_nm, double phase = 0) const;

    /// R and T as functions of a round trip through the layer, without what the interference above
    /// an absorbing incident medium takes.
    Fringes fringes() const;
    /// Whether any layer absorbs or amplifies.
    bool absorbs() const { return absorbs_; }

private:
    /// A part of the incident power; unit = unit_ / |sum|^2.
    double absorbed(const SweptLayer::State& at, double unit) const;

    /// What both fields of a column contribute.
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
