#pragma once

#include "core/colorimetry/space.hpp"

namespace irido {

/// Fourier transform of the CIE 1931 observer under E at one optical path difference, fitted by
/// four Gaussians in the wavenumber; 1.0005, 1.0002, 1.0011 at 0.
/// Source: L. Belcour and P. Barla, ACM TOG 36(4) (2017), supplemental code.
class GaussianObserver {
public:
    explicit GaussianObserver(double opd_nm);

    /// Real part for X, Y, Z, each with its own phase in radians.
    Triple operator()(const Triple& phase) const;

private:
    double p_;  ///< 2 pi times the optical path difference in m
    std::array<double, 4> heights_{};
};

}  // namespace irido
