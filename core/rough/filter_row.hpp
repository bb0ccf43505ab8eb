#pragma once

#include "core/rough/filter.hpp"

namespace irido {

/// One row of a TransmissionFilter.
struct FilterRow {
    HalfAngles theta_i;
    double scale;    ///< of F_alpha, without what depends on theta_d
    double s, rest;  ///< sqrt(1 - alpha^2) and 1 - s
};

/// The vector form of TransmissionFilter::operator(), step by step; not for SimdLevel::plain.
void filter_row(const FilterRow& row, const FilterAxis& theta_d, double* out, SimdLevel level);

}  // namespace irido
