#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tables/records/record_layout.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

/// One of the files that are put together: a whole one of the format.
struct StreamPiece {
    std::string path;
    std::uint64_t rows;
};

/// Whether a head is written before the number of rows is known, to be replaced by one of the same
/// length, or is what stands in the end.
enum class HeadKind { open, final };

/// A way to write records, block after block or all at once. The bytes of a file are
///     head, rows of a block, separator, rows of the next block that has any, ..., tail
/// and follow from the rows alone, not from how they were cut into blocks.
struct RecordFormat {
    std::string_view name;  ///< as --format and as a file's extension
    std::string_view summary;
    bool is_binary;
    std::string_view separator;
    /// `rows` is the number of rows of the whole stream; an open head's length does not depend on
    /// it.
    std::string (*head)(const RecordLayout&, std::uint64_t rows, HeadKind);
    /// The rows of one block, whose columns are those of the layout. Safe from many threads.
    std::string (*rows)(const RecordLayout&, const Records&);
    std::string_view tail;
    /// Makes the file out of the part that holds head, rows and tail, when that is complete, if the
    /// part is not already what is asked for; nullptr where it is.
    void (*finish)(const RecordLayout&, std::uint64_t rows, const std::string& part,
                   const std::string& to) = nullptr;
    /// Puts files with a `finish` together, in that order, into the file `to`; else nullptr.
    void (*join)(const RecordLayout&, const std::vector<StreamPiece>&,
                 const std::string& to) = nullptr;
};

/// All formats, by name. The list is made from the files in tables/records/formats/.
std::span<const RecordFormat* const> record_formats();

/// nullptr if there is none of that name.
const RecordFormat* find_record_format(std::string_view name);

/// The layout of records that are all there: texts are as wide as the longest one.
RecordLayout layout_of(const Records& records);

/// The bytes of a file of these records, of a format without `finish`.
std::string written(const RecordFormat& format, const Records& records);

}  // namespace irido::tables
