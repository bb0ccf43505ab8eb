#pragma once

#include "core/math/simd_level.hpp"
#include "core/render/color_nodes.hpp"
#include "core/render/grid_table.hpp"

namespace irido {

struct ColorReport;
class StackSpectra;

/// Tables of spectra for a picture, how they are made and what they took.
struct TablePlan {
    const PictureNodes* nodes = nullptr;
    double tolerance = 0.1;  ///< CIEDE2000 of the colours of a table's spectra
    unsigned threads = 1;
    SimdLevel simd = best_simd_level();
};

/// Colours of two spectra of a table: their CIEDE2000.
GridTable::Distance spectral_distance(const PictureNodes& nodes);

/// The larger of two reports' sizes and errors, evaluations added.
void add_table(const GridTable& table, ColorReport& report);

/// Reflectance of a stack, the mean of s and p, for a table. `spectra` must outlive it.
GridTable::Function mean_reflectance(const StackSpectra& spectra);

}  // namespace irido
