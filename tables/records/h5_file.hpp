#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tables/records/record_format.hpp"
#include "tables/records/record_layout.hpp"

namespace irido::tables {

/// Throws OutputError if HDF5 cannot have a dataset of the name of a column.
void check_h5_names(const RecordLayout& layout);

/// Makes an HDF5 file, `to`, of the packed rows (packed_rows.hpp, texts as UTF-8) that the
/// file `part` holds: one contiguous dataset for each column, in their order; texts are of fixed
/// length in UTF-8, null-padded; flags the boolean enumeration of h5py. No times: the bytes follow
/// from the rows. In constant memory. Throws OutputError.
void write_h5(const RecordLayout& layout, std::uint64_t rows, const std::string& part,
              const std::string& to);

/// Puts such files together, in that order: the same bytes as of one of all their rows.
void join_h5(const RecordLayout& layout, const std::vector<StreamPiece>& pieces,
             const std::string& to);

}  // namespace irido::tables
