#pragma once

namespace irido {

/// Bound on |dR/dn| and |dT/dn|, for n and k of one material, on a panel. The phase k0 n d of light
/// crossing once, or as often as it stays in the stack, is what varies a denominator: n dR/dn is at
/// most 1 due to interfaces, and |dD/d ln lambda| / |D| due to what lies between them. Not proven
/// for every stack, but satisfied by random ones with a factor of 4 to spare.
///   effect  |n| / |kz/k0|^2: a change of n is one of kz, larger off the normal
///   slope   largest |dD/d ln lambda| / |D| of the denominators
inline double index_effect(double effect, double slope) {
    return effect * (1 + slope);
}

}  // namespace irido
