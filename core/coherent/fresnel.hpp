#pragma once

namespace irido {

/// Reflectance at normal incidence of a face between two real indices, in (0, 1].
double normal_reflectance(double n1, double n2);

/// Schlick's reflectance of a face from its reflectance R0 at normal incidence; cos_theta in [0,
/// 1]. Source: C. Schlick, Computer Graphics Forum 13 (1994), eq. 15.
double schlick(double R0, double cos_theta);

}  // namespace irido
