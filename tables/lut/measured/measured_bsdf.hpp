#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/rough/layered/layered_scattering.hpp"

namespace irido::tables {

/// Parameters of a measured BSDF.
struct MeasuredBsdf {
    std::string description;
    double alpha = 0.1;                 ///< of the GGX facets that guide the samples, [1e-4, 1]
    std::vector<double> wavelength_nm;  ///< ascending
    std::vector<double> theta_i_deg;    ///< ascending from 0, below 90
    std::size_t normals = 128, samples = 32;  ///< nodes of the squares of normals and of samples
};

/// An isotropic spectral BSDF in the format of Mitsuba's and pbrt's measured materials: a
/// tensor_file() with the values f_r cos(theta_o) 4 sigma(i) / D(m) on a square of samples, which
/// is warped by the visible normals of GGX for every theta_i. Readers multiply by D / (4 sigma), so
/// that sharp lobes need no fine grid. Directions that the warp takes below the horizon get the
/// value of their mirror image. Negative values are set to 0.
/// Source: J. Dupuy and W. Jakob, ACM TOG 37(6), 2018, section 3.
///   brdf(pairs)  per steradian, [pair][wavelength]
std::string measured_bsdf(
    const MeasuredBsdf& bsdf,
    const std::function<std::vector<double>(std::span<const ScatterPair>)>& brdf);

}  // namespace irido::tables
