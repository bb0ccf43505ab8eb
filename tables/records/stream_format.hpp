#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tables/records/record_layout.hpp"
#include "tables/records/records.hpp"

namespace irido {

/// One of the files that are put together: a whole one of the format.
struct StreamPiece {
    std::string path;
    std::uint64_t rows;
};

/// A way to write records block after block. The bytes of a file are
///     head, rows of a block, separator, rows of the next block that has any, ..., tail
/// and follow from the rows alone, not from how they were cut into blocks.
struct StreamFormat {
    std::string_view name;  ///< as --format and as a file's extension
    std::string_view summary;
    bool is_binary;
    std::string_view separator;
    /// Its length does not depend on `rows`, the number of rows of the whole stream.
    std::string (*head)(const RecordLayout&, std::uint64_t rows);
    /// The rows of one block, whose columns are those of the layout. Safe from many threads.
    std::string (*rows)(const RecordLayout&, const Records&);
    std::string_view tail;
    /// Makes the file out of the part that holds head, rows and tail, when that is complete, if the
    /// part is not already what is asked for; nullptr where it is.
    void (*finish)(const RecordLayout&, std::uint64_t rows, const std::string& part,
                   const std::string& to);
    /// Puts files with a `finish` together, in that order, into the file `to`; else nullptr.
    void (*join)(const RecordLayout&, const std::vector<StreamPiece>&, const std::string& to);
};

/// csv, json, npy and h5; nullptr for any other name.
const StreamFormat* find_stream_format(std::string_view name);

/// csv, json and npy for streams whose number of rows is known at their head: the bytes are those
/// that the RecordFormat of the name (tables/records/records.hpp) writes. nullptr for any other
/// name.
const StreamFormat* find_counted_format(std::string_view name);

}  // namespace irido
