#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/rough/layered/coating.hpp"
#include "core/rough/layered/lobe_nodes.hpp"

namespace irido {

/// Share of light that is as bright in all directions inside which the coating throws back:
/// 2 integral R0 cos sin dtheta.
double coating_return(const Coating& coating);

/// Share of such light that gets out, 2 integral T0 tau cos sin dtheta, of each function of a
/// series; tau is the function times the masking, of angles inside in degrees.
///   alpha  of the smoothest layer above: masking varies within it at grazing
std::vector<double> exit_from_below(const Coating& coating, double alpha, const AngleSeries& series,
                                    const std::function<double(double theta_deg)>& masking);

/// Shares that facets of R reflect from one direction and that get out:
///     integral dtheta_d R 2 cos td sin td integral D G1(i)/cos i G1(o) E(o) dpsi,
/// of each component.
///   nodes   of the direction
///   exit    E(o) of all components at cos o, in [0, 1]
///   series  R of each component, its function `function`
void reflected_share(const LobeNodes& nodes,
                     const std::function<void(double cos_o, std::span<double> values)>& exit,
                     std::span<const std::shared_ptr<const AngleSeries>> series,
                     std::size_t function, std::span<double> out);

}  // namespace irido
