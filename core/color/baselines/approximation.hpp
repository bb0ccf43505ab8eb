#pragma once

#include <memory>
#include <optional>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// Approximate methods in common use, as baselines; their StackColor::error is infinite. A perfect
/// mirror has the illuminant's white. Materials are clamped outside their range.
///
///     equal     method.count equally spaced wavelengths over the whole support, [2, 1e6]; error
///               O(1/count^2), since the sensitivity is piecewise linear. Any stack.
///     naive     R or T at 650, 510 and 475 nm are linear sRGB r, g, b. Any stack.
///     gaussian  BB17's series with four Gaussians for the observer, up to order method.count, 3 if
///               that is 0; exact Fresnel terms of s and p, the phase of conductors.
///     gltf      what the glTF extension KHR_materials_iridescence tells a shader to do: the same
///               to order 2 with Schlick's terms, phases 0 or pi, a base of real index.
///     smits     two beams, r = r12 + (1 - r12^2) r23 exp(i Phi), in every other respect exact, and
///               integrated to 1e-6. R may exceed 1.
///
/// The last three take one coherent film of one thickness, and reflected light only; gaussian and
/// gltf take indices at 550 nm for all wavelengths and a film that does not absorb there. Where a
/// film reflects totally they give the white, as glTF does.
///
/// The Gaussians stand for the observer under E, with X = Y = Z = 1 for a mirror to 1e-3.
/// `gaussian` divides each channel by its value for a mirror and multiplies it by the illuminant's
/// white, which takes the spectral shape of the light to be the same within each channel. BB17's
/// shader lets the film vanish below 15 nm of optical thickness and clips colours; this does
/// neither.
///
/// `gltf`: iridescenceIor and iridescenceThickness are the film's, outsideIor the incident medium's
/// index. Base F0, a colour, is the base colour of a metallic material, [0, 1] each: that of the
/// bare base in air at normal incidence as bare_base_color() has it, or `base_color` if that is
/// given. The result is that of gltf_reflectance(), linear sRGB, adapted from its white to the
/// illuminant's as in `naive`. The formulas know no polarization: Light::unpolarized only.
///
/// Throws DomainError if the method does not take the stack, the sides, the light or a base colour,
/// or if it is not one of these, and as IndexTable, StackPower, held_stack() and (naive, gltf)
/// bradford() do. `tables` must outlive the result. Source: naive: Bacterius, Thin Film
/// Interference for Computer Graphics (2013). gaussian: BB17 (ACM TOG 36(4), 2017), eqs. 3 to 10,
/// constants of its supplemental code. gltf: Khronos Group, KHR_materials_iridescence (2022),
/// section Iridescence Fresnel. smits: B. E. Smits and G. W. Meyer, Newton's Colors: Simulating
/// Interference Phenomena in Realistic Image Synthesis (1992).
std::unique_ptr<ColorAlgorithm> approximate_color(const ColorTables& tables, const Stack& stack,
                                                  const ColorMethod& method,
                                                  const ColorRequest& request,
                                                  const std::optional<Triple>& base_color = {});

}  // namespace irido
