#pragma once

#include "core/rough/filter.hpp"

namespace irido {

/// One row of a TransmissionFilter.
struct FilterRow {
    HalfAngles theta_i;
    double scale;    ///< factor of F_alpha that does not depend on theta_d
    double s, rest;  ///< sqrt(1 - alpha^2) and 1 - s
};

/// Vector version of TransmissionFilter::operator(), step by step; not for SimdLevel::plain.
///   row      the fixed theta_i and roughness
///   theta_d  axis of angles
///   out      results, one per theta_d
///   level    instruction set
void filter_row(const FilterRow& row, const FilterAxis& theta_d, double* out, SimdLevel level);

}  // namespace irido
