#pragma once

#include <functional>
#include <memory>

#include "tables/resume/record_stream.hpp"

namespace irido::tables {

/// The format of the rows of a collecting stream.
const RecordFormat& packed_format();

/// A stream into memory, of that format: finish() hands all rows to `take`. It has no file, so
/// nothing of it can be resumed.
std::unique_ptr<RecordStream> collected_rows(const RecordLayout& layout,
                                             std::function<void(Records)> take);

}  // namespace irido::tables
