#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tables/records/record_layout.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

/// A complete file to be joined with others.
struct StreamPiece {
    std::string path;
    std::uint64_t rows;
};

/// An open head is written before the number of rows is known, and later replaced by a final one of
/// the same length.
enum class HeadKind { open, final };

/// A format of records, written in blocks or at once. The bytes of a file are
///     head, rows of a block, separator, rows of the next non-empty block, ..., tail
/// and depend only on the rows, not on their division into blocks.
struct RecordFormat {
    std::string_view name;  ///< value of --format, and the file extension
    std::string_view summary;
    bool is_binary;
    std::string_view separator;
    /// `rows` is the number of rows of the whole stream; an open head's length does not depend on
    /// it.
    std::string (*head)(const RecordLayout&, std::uint64_t rows, HeadKind);
    /// The rows of one block, whose columns match the layout. Thread-safe.
    std::string (*rows)(const RecordLayout&, const Records&);
    std::string_view tail;
    /// Converts the complete part file (head, rows and tail) to the final file; nullptr if the part
    /// is already in the final format.
    void (*finish)(const RecordLayout&, std::uint64_t rows, const std::string& part,
                   const std::string& to) = nullptr;
    /// Joins files in the given order into the file `to`; nullptr for formats without `finish`.
    void (*join)(const RecordLayout&, const std::vector<StreamPiece>&,
                 const std::string& to) = nullptr;
};

/// All formats, by name. The list is made from the files in tables/records/formats/.
std::span<const RecordFormat* const> record_formats();

/// nullptr if there is no format of that name.
const RecordFormat* find_record_format(std::string_view name);

/// The layout of complete records: strings are as wide as the longest one.
RecordLayout layout_of(const Records& records);

/// The layout with a number after names that occur again, as in b, b_2: for formats whose readers
/// find columns by their names.
RecordLayout with_distinct_names(RecordLayout layout);

/// The bytes of a file with these records, for a format without `finish`.
std::string written(const RecordFormat& format, const Records& records);

}  // namespace irido::tables
