#pragma once

#include <cstdint>
#include <string>

#include "cli/options/command.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// Options of irido compare --lut, as given.
struct TableComparison {
    std::string file;
    schemas::StackRequest stack;  ///< by default the stack in the table's metadata
    std::size_t points = 1000;
    std::uint64_t seed = 1;
    bool rows = false;
    unsigned threads = 0;
    SimdLevel simd = SimdLevel::plain;
};

/// Compares a table of irido lut color, interpolated as by a texture unit (linearly along each
/// axis), with exact colours at random points, distributed uniformly along each axis. With `rows`:
/// the axes, r, g, b, hex in the table's space, true_r, true_g, true_b, true_hex, delta_e_2000;
/// otherwise count, mean, median, p95, max, worst (a point). Throws UsageError for tables of
/// another kind or with mip levels, InputError and tables::LutError for files that cannot be read.
tables::Records table_rows(const TableComparison& typed);

}  // namespace irido::cli
