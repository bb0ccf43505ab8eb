#pragma once

#include <functional>
#include <memory>

#include "tables/resume/record_stream.hpp"

namespace irido::tables {

/// The format of the rows of a collecting stream.
const RecordFormat& packed_format();

/// A stream into memory, in packed_format(): finish() passes all rows to `take`. Without a file, it
/// cannot be resumed.
std::unique_ptr<RecordStream> collected_rows(const RecordLayout& layout,
                                             std::function<void(Records)> take);

}  // namespace irido::tables
