#pragma once

#include "core/coherent/coherent.hpp"
#include "core/complex.hpp"

namespace irido {

/// I + exp(log_scale) [[a, b], [c, d]], acting on tangential fields (B, C), log_scale >= 0. Storing
/// the departure from the identity keeps thin layers accurate; the logarithm keeps thick ones from
/// overflowing.
struct Matrix {
    Complex a{}, b{}, c{}, d{};
    double log_scale = 0;

    /// Weight of the identity once exp(log_scale) is factored out: exp(-log_scale).
    double identity() const;
};

/// Power absorbed in one layer as a quadratic form in the fields v = (B, C) at its lower face, in
/// units of the flux Re(conj(B) C), without the layer's factor exp(2 log_scale): v^H Q v with Q =
/// [[bb, bc], [conj(bc), cc]].
struct AbsorbedPower {
    double bb = 0, cc = 0;
    Complex bc{};
};

/// Factor F = [[b, c], [0, rest]] of a positive semidefinite form Q = F^H F. Where fields cancel,
/// evaluating |F v|^2 keeps twice as many digits as v^H Q v.
struct FormRoot {
    double b = 0, rest = 0;
    Complex c{};

    bool is_zero() const { return b == 0 && rest == 0; }
};

/// Power absorbed in a slab: exp(2 (log_scale + matrix.log_scale)) (|F v|^2 of the loss - |F v|^2
/// of the gain).
struct SlabAbsorption {
    FormRoot loss, gain;
    double log_scale = 0;  ///< relative to the matrix, so that thick slabs lose no precision
};

/// One layer, or several combined.
struct Slab {
    Matrix matrix;            ///< maps fields at the lower face to fields at the upper face
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

/// Coupling coefficients of the fields in a medium: with c and sd of LayerTurn, B' = c B - i w sd C
/// and C' = c C - i v sd B.
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

/// Power absorbed in one layer in terms of the fields at its lower face: an exact integral over
/// depth.
AbsorbedPower absorbed_power(const Medium& medium, double k0_d, Polarization polarization);

/// v^H Q v for the fields v = (b, c), without the factor exp(2 log_scale).
double absorbed_flux(const AbsorbedPower& q, Complex b, Complex c);
double absorbed_flux(const SlabAbsorption& q, Complex b, Complex c);

/// Characteristic matrix of one layer of thickness k0_d = k0 d (radians in vacuum, >= 0).
Matrix layer_matrix(const Medium& medium, double k0_d, Polarization polarization);

/// The same layer as a matrix of wave amplitudes (f, g) instead of fields, B = b (f + g) and C = c
/// (f - g): f travels down and g up in a medium of admittance y0 = c/b. Where waves grow, as in
/// gain media, the weaker of the two stays accurate; in B and C it would drown in the stronger one.
///     f' = (e - i h s) f - i w s g     e = exp(-i delta), s = sin(delta), y of the layer
///     g' = i w s f + (1/e + i h s) g   h = (y - y0)^2/(2 y y0), w = (y^2 - y0^2)/(2 y y0)
///   medium        the layer's
///   k0_d          k0 d, radians in vacuum, >= 0
///   polarization  s or p, the one that `medium` was computed for
///   y0            admittance of the reference medium, not 0
/// Not finite at the layer's critical angle.
Matrix wave_matrix(const Medium& medium, double k0_d, Polarization polarization, Complex y0);

/// Matrix and absorbed power (an exact integral over depth) of one layer; gain counts as negative.
Slab layer_slab(const Medium& medium, double k0_d, Polarization polarization);

/// `upper` on top of `lower`.
Matrix operator*(const Matrix& upper, const Matrix& lower);
Slab operator*(const Slab& upper, const Slab& lower);

/// Moves the magnitude of a very large or very small matrix into its log_scale, as far as that
/// stays >= 0; returns the amount moved.
double normalize(Matrix& matrix);

}  // namespace irido
