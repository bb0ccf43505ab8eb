#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/coherent/coherent.hpp"
#include "core/material/material.hpp"
#include "core/stack/index_table.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Points that fringes need for each nm of their path.
constexpr double kPointsPerPath = 0.032;

/// Optical paths are rounded up to 125 nm times 2^(k/2), k < kPathClasses.
constexpr std::size_t kPathClasses = 128;

/// The class of a path, k; paths too long for any are in the last.
std::size_t path_class(double path_nm);
double path_of_class(std::size_t k);

/// Wavelengths at which paths are as long as anywhere, more or less.
///   constant  whether all indices are
std::vector<double> path_wavelengths(bool constant, WavelengthRange support);

/// Past this exponent of attenuation, one way and of the power, fringes of what is below are less
/// than a hundredth of the tolerance.
double opaque_exponent(double tolerance);

/// Twice the optical thickness, nm, of what light passes on its way to faces that it returns from,
/// and what it loses on its way: exponents of what is absorbed, and of the gaps through which it
/// tunnels.
struct Path {
    double length_nm = 0;
    double absorbed = 0, tunnelled = 0;
    double exponent() const { return absorbed + tunnelled; }
};

/// Gaps that stand in periods attenuate with each of these, or, in bands as wide as a gap of one
/// period makes them, once.
enum class Gaps { attenuate, have_bands };

/// Adds the path through elements as far as to what is opaque.
///   elements  from the incident side
///   normal    kz/k0 of every material
///   k0        2 pi / wavelength, 1/nm
///   opaque    opaque_exponent()
///   gaps      of groups
///   path      to add to
void add_path(std::span<const Element> elements, std::span<const Complex> normal, double k0,
              double opaque, Gaps gaps, Path& path);

/// Longest paths at any wavelength of a table, nm: with gaps that attenuate, and that have bands.
struct PathLengths {
    double attenuated_nm = 0, with_bands_nm = 0;
};
/// Of elements, as add_path() finds them.
///   table   indices of the stack's materials; the first wavelength is the shortest
///   normal  memory
PathLengths longest_paths(std::span<const Element> elements, const IndexTable& table,
                          IncidentAngle incidence, double opaque, std::vector<Complex>& normal);

/// Adds the thickness, nm, that an element has of each material, `repeat` times.
void add_lengths(const Element& element, double repeat, std::vector<double>& length_nm);

/// Layers whose matrices one evaluation takes, a doubling of an absorbing group among them.
double work_of(std::span<const Element> elements);

/// kz/k0 of the polarization that turns more in a medium.
///   table       indices of the stack's materials
///   material    the medium
///   wavelength  position in the table
///   incidence   direction of the light in the incident medium
Complex longest_normal(const IndexTable& table, std::size_t material, std::size_t wavelength,
                       IncidentAngle incidence);

/// Estimated work of quadrature_color() for one colour, points times layers. Depends on its
/// arguments only: no table is needed, and the result is the same on every machine.
///   stack      to be coloured
///   indices    of its materials, at one wavelength
///   pieces     smooth_pieces() of the stack, less one
///   incidence  direction of the light
double quadrature_work(const Stack& stack, const IndexTable& indices, std::size_t pieces,
                       IncidentAngle incidence);

}  // namespace irido
