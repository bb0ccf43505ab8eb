#pragma once

#include "core/coherent/coherent.hpp"
#include "core/complex.hpp"

namespace irido {

/// I + exp(log_scale) [[a, b], [c, d]], acting on tangential fields (B, C), log_scale >= 0. What
/// thin layers add to the identity keeps its digits, and thick ones do not overflow.
struct Matrix {
    Complex a{}, b{}, c{}, d{};
    double log_scale = 0;

    /// The identity's part once exp(log_scale) is taken out.
    double identity() const;
};

/// Power that one layer absorbs above the fields v = (B, C) at its lower face, in the units of the
/// flux Re(conj(B) C) and up to the layer's exp(2 log_scale): v^H Q v, Q = [[bb, bc], [conj(bc),
/// cc]].
struct AbsorbedPower {
    double bb = 0, cc = 0;
    Complex bc{};
};

/// F = [[b, c], [0, rest]] of a form Q = F^H F that is nowhere negative. Where fields cancel, F v
/// has twice the digits of v^H Q v.
struct FormRoot {
    double b = 0, rest = 0;
    Complex c{};

    bool is_zero() const { return b == 0 && rest == 0; }
};

/// The same of a slab: exp(2 (log_scale + the slab's own)) (|F v|^2 of what absorbs - |F v|^2 of
/// what amplifies).
struct SlabAbsorption {
    FormRoot loss, gain;
    double log_scale = 0;  ///< relative to the matrix, so that thick slabs lose no digits
};

/// A layer, or layers taken together.
struct Slab {
    Matrix matrix;            ///< fields at the lower face to fields at the upper face
    SlabAbsorption absorbed;  ///< all zero if nothing absorbs
    bool absorbs = false;
};

/// Principal square root, exact on the real axis.
Complex square_root(Complex z);

/// cos(z) and sin(z), both times exp(-Im z), for Im z >= 0.
struct ScaledTurn {
    Complex cos, sin;
};
ScaledTurn scaled_turn(Complex z);

/// Coupling of the fields in a medium: with c, sd of LayerTurn, B' = c B - i w sd C and
/// C' = c C - i v sd B.
struct Coupling {
    Complex w, v;
};
Coupling coupling(const Medium& medium, Polarization polarization);

/// cos(delta) and k0 d sinc(delta), delta = k0 d sqrt(q2), both times exp(-log_scale).
struct LayerTurn {
    Complex cos, sd;
    double log_scale = 0;
};
LayerTurn layer_turn(Complex q2, double k0_d);

/// Power that one layer absorbs, by the fields at its lower face: an exact integral over its depth.
AbsorbedPower absorbed_power(const Medium& medium, double k0_d, Polarization polarization);

/// v^H Q v of the fields v = (b, c), without exp(2 log_scale).
double absorbed_flux(const AbsorbedPower& q, Complex b, Complex c);
double absorbed_flux(const SlabAbsorption& q, Complex b, Complex c);

/// Characteristic matrix of one layer, thickness k0 d (radians in vacuum, >= 0).
Matrix layer_matrix(const Medium& medium, double k0_d, Polarization polarization);

/// The same layer acting on amplitudes (f, g) instead of fields, B = b (f + g) and C = c (f - g):
/// those of the waves down and up in a medium of admittance y0 = c/b. Where waves grow, as in media
/// that amplify, the weak one of the two keeps its digits, which B and C add to the strong one's.
///     f' = (e - i h s) f - i w s g     e = exp(-i delta), s = sin(delta), y of the layer
///     g' = i w s f + (1/e + i h s) g   h = (y - y0)^2/(2 y y0), w = (y^2 - y0^2)/(2 y y0)
/// Not finite at the layer's critical angle.
Matrix wave_matrix(const Medium& medium, double k0_d, Polarization polarization, Complex y0);

/// The layer with the power it absorbs, as an exact integral over its depth; gain is negative.
Slab layer_slab(const Medium& medium, double k0_d, Polarization polarization);

/// `upper` on top of `lower`.
Matrix operator*(const Matrix& upper, const Matrix& lower);
Slab operator*(const Slab& upper, const Slab& lower);

/// Moves the size of a very large or very small matrix into its log_scale, as far as that stays
/// above 0; returns what it moved.
double normalize(Matrix& matrix);

}  // namespace irido
