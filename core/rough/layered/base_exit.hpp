#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/rough/layered/coating.hpp"
#include "core/rough/layered/lobe_nodes.hpp"

namespace irido {

/// Fraction of isotropic light (equal radiance in all directions inside) that the coating reflects
/// back: 2 integral R0 cos sin dtheta.
double coating_return(const Coating& coating);

/// Fraction of such light that escapes, 2 integral T0 tau cos sin dtheta, for each function of a
/// series.
///   coating  refracting interface on top
///   alpha    of the smoothest layer above, which sets the scale of masking at grazing
///   series   tau without masking, over the angle inside
///   masking  factor that completes tau, as a function of the angle inside in degrees
std::vector<double> exit_from_below(const Coating& coating, double alpha, const AngleSeries& series,
                                    const std::function<double(double theta_deg)>& masking);

/// Fraction of light from one direction that facets of reflectance R reflect and that then escapes,
///     integral dtheta_d R 2 cos td sin td  integral D G1(i)/cos i G1(o) E(o) dpsi,
/// for each component.
///   nodes     of the direction
///   exit      E(o) of all components at cos o in [0, 1]
///   series    R of each component, as its function number `function`
///   function  index of R in the series
///   out       results, one per component
void reflected_share(const LobeNodes& nodes,
                     const std::function<void(double cos_o, std::span<double> values)>& exit,
                     std::span<const std::shared_ptr<const AngleSeries>> series,
                     std::size_t function, std::span<double> out);

}  // namespace irido
