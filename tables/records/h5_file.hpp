#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tables/records/record_format.hpp"
#include "tables/records/record_layout.hpp"

namespace irido::tables {

/// Throws OutputError if a column's name is not possible for an HDF5 dataset.
void check_h5_names(const RecordLayout& layout);

/// Converts packed rows (packed_rows.hpp, strings as UTF-8) to an HDF5 file in constant memory: one
/// contiguous dataset per column, in order; strings of fixed length in UTF-8, null-padded; flags as
/// the boolean enumeration of h5py. Without timestamps: the bytes depend only on the rows. Throws
/// OutputError.
/// layout  the columns
/// rows    number of rows
/// part    path of the packed rows
/// to      path of the HDF5 file
void write_h5(const RecordLayout& layout, std::uint64_t rows, const std::string& part,
              const std::string& to);

/// Joins such files in the given order: byte-identical to writing all rows at once.
void join_h5(const RecordLayout& layout, const std::vector<StreamPiece>& pieces,
             const std::string& to);

}  // namespace irido::tables
