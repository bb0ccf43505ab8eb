#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tables/records/record_format.hpp"
#include "tables/version.hpp"

namespace irido::tables {

/// Identifies the content of a stream: request, build and part of the whole.
struct StreamIdentity {
    std::string request;      ///< SHA-256 of everything that the rows depend on, in hexadecimal
    std::string simd;         ///< name of the SIMD level, which affects the last digits
    std::uint64_t shard = 1;  ///< of `shards`
    std::uint64_t shards = 1;
    std::uint64_t begin = 0;  ///< units of this shard: [begin, end)
    std::uint64_t end = 0;
    std::uint64_t total = 0;  ///< units of the whole
    bool is_shard = false;    ///< to be merged, even if it is the only one
    Build build = this_build();
};

/// A file of records written in order, block by block, in constant memory. It can be resumed even
/// if the process dies at any moment.
///
/// While it grows it is PATH.part, next to its journal PATH.sweep: a line that identifies the file
/// and, at intervals, the number of complete units, rows and bytes. finish() writes the final head
/// and tail and renames PATH.part to PATH, replacing any older file; until then there is no new
/// PATH. The journal is then removed, unless the file is a shard, whose journal and checksum are
/// needed for merging.
///
/// However a process ends, no more is lost than the work of the last millisecond or, after a
/// second, of the last thousandth of the run time. A power cut costs the last few seconds: after a
/// reboot, only data that were flushed to disk are trusted.
class RecordStream {
public:
    virtual ~RecordStream() = default;

    /// Units of work already done in a resumed file, counted from identity.begin.
    virtual std::uint64_t units_done() const = 0;
    virtual std::uint64_t rows_done() const = 0;
    /// Whether the resumed file is complete.
    virtual bool is_complete() const = 0;

    /// Appends the next block. Throws OutputError, or BrokenPipe.
    /// bytes  result of RecordFormat::rows()
    /// units  number of units in the block
    /// rows   number of rows in the block
    virtual void append(const std::string& bytes, std::uint64_t units, std::uint64_t rows) = 0;
    /// Completes the file. Does nothing if it is already complete. Throws OutputError.
    virtual void finish() = 0;
    /// Keeps the journal and the part, truncated after its last complete block, for a later
    /// --resume.
    virtual void suspend() = 0;
    /// Removes part and journal.
    virtual void discard() noexcept = 0;
};

/// A file of records. Holds a lock on the journal until it is destroyed. A device or a pipe is
/// written to directly, without a part. Throws OutputError if the file cannot be written, if
/// another process is writing it, or if the part to be resumed belongs to another request, shard,
/// SIMD level or build of irido.
/// path      the file
/// format    format of the records
/// layout    the columns
/// identity  request, build and part of the whole
/// resume    continue a part with the same identity, if there is one; otherwise start over
/// rows      number of rows, required for a device or pipe if the format's head contains it; else 0
std::unique_ptr<RecordStream> record_file(const std::string& path, const RecordFormat& format,
                                          const RecordLayout& layout,
                                          const StreamIdentity& identity, bool resume,
                                          std::uint64_t rows = 0);

/// Records to standard output; `rows` is their number, or 0 if the format's head does not need it.
std::unique_ptr<RecordStream> record_output(const RecordFormat& format, const RecordLayout& layout,
                                            std::uint64_t rows);

/// A stream with a known number of records, without journal. A file is written whole or not at all,
/// under a temporary name; a device or a pipe directly. Throws OutputError.
/// path    the file; "" for standard output
/// format  format of the records
/// layout  the columns
/// rows    number of rows
std::unique_ptr<RecordStream> counted_output(const std::string& path, const RecordFormat& format,
                                             const RecordLayout& layout, std::uint64_t rows);

/// Joins the shards of one stream, given in any order, in constant memory: byte-identical to a
/// single run. Throws OutputError if a file does not match its journal, if shards are missing or
/// repeated, or if they belong to different requests, builds of irido or SIMD levels.
void merge_streams(const std::vector<std::string>& shards, const std::string& path,
                   const RecordFormat& format);

}  // namespace irido::tables
