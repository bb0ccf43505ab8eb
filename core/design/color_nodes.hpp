#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Quadrature X_k = sum over nodes of weight[k] R, linear in R: derivatives are the same sums.
struct QuadratureNodes {
    std::vector<double> wavelength_nm;
    std::array<std::vector<double>, 3> weight;
};

inline constexpr std::size_t kColorLevels = 9;

/// Nodes of product quadrature (see PanelRule) over the support of the weighted colour-matching
/// functions, finer at every level in [0, kColorLevels). The first levels ignore kinks in tabulated
/// materials of the stack.
QuadratureNodes color_nodes(const Stack& stack, const ColorTables& tables, std::size_t level);

/// Colour tables for one observer and illuminant, shared by all models. Thread-safe.
std::shared_ptr<const ColorTables> color_tables_of(int observer_deg, const Table& illuminant);

/// CIELAB of XYZ and its derivatives, [L, a, b][X, Y, Z].
struct LabSlopes {
    Triple lab;
    std::array<Triple, 3> by_xyz;
};
LabSlopes lab_slopes(const Triple& xyz, const Triple& white);

/// Three numbers whose squares sum to that of a colour difference, and their derivatives with
/// respect to the first colour, [number][L, a, b]: for CIE 1976 the differences of L, a and b, for
/// CIEDE2000
///     l, c + R h/2, h sqrt(1 - R^2/4)
/// with l, c, h and R of DifferenceParts.
struct DifferenceSlopes {
    Triple number;
    std::array<Triple, 3> by_lab;
};
DifferenceSlopes difference_slopes(const Triple& lab, const Triple& target, bool ciede2000);

}  // namespace irido
