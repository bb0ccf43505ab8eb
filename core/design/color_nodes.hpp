#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// X_k = sum over nodes of weight[k] R: linear in R, so that its derivatives are the same sums.
struct ColorNodes {
    std::vector<double> wavelength_nm;
    std::array<std::vector<double>, 3> weight;
};

inline constexpr std::size_t kColorLevels = 9;

/// Nodes of product quadrature (see PanelRule) over the support of the tables' sensitivity, more of
/// them at every level, [0, kColorLevels): at first as if tables of the stack's materials had no
/// kinks.
ColorNodes color_nodes(const Stack& stack, const ColorTables& tables, std::size_t level);

/// What colours under a light have in common, made once for all models. Safe from many threads.
std::shared_ptr<const ColorTables> color_tables_of(int observer_deg, const Table& illuminant);

/// CIELAB of XYZ and its derivatives, [L, a, b][X, Y, Z].
struct LabSlopes {
    Triple lab;
    std::array<Triple, 3> by_xyz;
};
LabSlopes lab_slopes(const Triple& xyz, const Triple& white);

/// Three numbers whose squares add up to that of a colour difference, and their derivatives by the
/// first colour, [number][L, a, b]: of CIE 1976 the differences of L, a and b, of CIEDE2000
///     l, c + R h/2, h sqrt(1 - R^2/4)
/// with l, c, h and R of DifferenceParts.
struct DifferenceSlopes {
    Triple number;
    std::array<Triple, 3> by_lab;
};
DifferenceSlopes difference_slopes(const Triple& lab, const Triple& target, bool ciede2000);

}  // namespace irido
