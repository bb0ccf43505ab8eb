#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tables/records/record_format.hpp"

namespace irido::test {

using namespace tables;

/// Columns of every type, with names and strings that need quoting in some format.
RecordLayout sample_layout();

/// Rows first, first + 1, ... of an endless sample.
Records sample_rows(std::uint64_t first, std::uint64_t count);

/// One dataset of an HDF5 file, with its values as strings.
struct H5Column {
    std::string name, type;
    std::vector<std::string> values;
};

/// The datasets in order of creation, and anything unusual about the file: a timestamp, or a
/// dataset that is not contiguous.
struct H5Content {
    std::vector<H5Column> columns;
    std::vector<std::string> faults;
};
H5Content read_h5(const std::string& path);

}  // namespace irido::test
