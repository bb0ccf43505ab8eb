#pragma once

#include <functional>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/rough/layered/layered_scattering.hpp"

namespace irido {

/// Colours of what all paths add to the BRDF by single reflections where that is by Adding, for
/// very many pairs of directions: on a grid of both polar angles and the azimuth, linear in
/// between, at wavelengths 8 nm apart. It is smooth but for reflections between rough layers.
class RestTable {
public:
    /// Throws as Adding does.
    ///   tolerance  of Adding, relative to what all paths give
    ///   progress   called with a growing fraction
    RestTable(const LayeredScattering& scattering, const Sensitivity& sensitivity, double tolerance,
              const Execution& execution, const std::function<void(double done)>& progress);

    /// X, Y, Z per steradian; angles in [0, 90] degrees, cos and sin of half the azimuth.
    Triple operator()(double theta_i_deg, double theta_o_deg, double near, double far) const;

    double error() const { return error_; }  ///< of Adding, relative

private:
    const Coating& coating_;
    std::vector<Triple> values_;  ///< [i][o][azimuth], over the transmittances of the coating
    double error_ = 0;
};

}  // namespace irido
