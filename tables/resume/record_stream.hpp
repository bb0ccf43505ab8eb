#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tables/records/record_format.hpp"
#include "tables/version.hpp"

namespace irido::tables {

/// Identifies the bytes that a run writes: request, build and part of the whole.
struct StreamIdentity {
    std::string request;      ///< SHA-256 of all that the rows depend on, in hexadecimal
    std::string simd;         ///< name of the SIMD level, on which last digits depend
    std::uint64_t shard = 1;  ///< of `shards`
    std::uint64_t shards = 1;
    std::uint64_t begin = 0;  ///< units of this shard: [begin, end)
    std::uint64_t end = 0;
    std::uint64_t total = 0;  ///< units of the whole
    bool is_shard = false;    ///< to be merged, perhaps the only one
    Build build = this_build();
};

/// A file of records that is written in order, a block at a time, in constant memory, and can be
/// continued after the process ended at any moment.
///
/// While it grows it is PATH.part, beside its journal PATH.sweep: a line that says what the file is
/// and, after every so many blocks, how many units, rows and bytes are complete. finish() puts head
/// and tail right and renames PATH.part to PATH; only then is there a PATH, and an older one is
/// replaced. The journal is removed then, unless the file is a shard: merging needs it, and the
/// checksum of the file that it has.
///
/// A process that ends, however, costs no more than the work of the last millisecond or, after a
/// second, the last thousandth of the time that it ran; a power cut that of the last seconds: what
/// a disk was not made to keep does not count after the machine was started again.
class RecordStream {
public:
    virtual ~RecordStream() = default;

    /// Units of work that a resumed file already has, counted from identity.begin.
    virtual std::uint64_t units_done() const = 0;
    virtual std::uint64_t rows_done() const = 0;
    /// Whether the resumed file is complete.
    virtual bool is_complete() const = 0;

    /// Appends the next block: `bytes` of RecordFormat::rows() for that many units and rows. Throws
    /// OutputError, or BrokenPipe.
    virtual void append(const std::string& bytes, std::uint64_t units, std::uint64_t rows) = 0;
    /// Completes the file. Does nothing if it is already complete. Throws OutputError.
    virtual void finish() = 0;
    /// Keeps the part, cut after its last complete block, and its journal for a later --resume.
    virtual void suspend() = 0;
    /// Removes part and journal.
    virtual void discard() noexcept = 0;
};

/// A file of records. Holds a lock on the journal until it is destroyed. A device or a pipe is
/// written to directly, without a part. Throws OutputError if the file cannot be written, if
/// another process is writing it, or if the part to be resumed belongs to another request, shard,
/// SIMD level or build of irido. path      the file format    format of the records layout    the
/// columns identity  request, build and part of the whole resume    continue a part of the same
/// identity, if there is one; else start over rows      number of rows, required for a device or
/// pipe if the format's head contains it; else 0
std::unique_ptr<RecordStream> record_file(const std::string& path, const RecordFormat& format,
                                          const RecordLayout& layout,
                                          const StreamIdentity& identity, bool resume,
                                          std::uint64_t rows = 0);

/// Records to standard output; `rows` is their number, or 0 for a format whose head does not need
/// it.
std::unique_ptr<RecordStream> record_output(const RecordFormat& format, const RecordLayout& layout,
                                            std::uint64_t rows);

/// A known number of records, without journal. A file is written whole or not at all, under a
/// temporary name; a device or a pipe directly. Throws OutputError.
/// path    the file; "" for standard output
/// format  format of the records
/// layout  the columns
/// rows    number of rows
std::unique_ptr<RecordStream> counted_output(const std::string& path, const RecordFormat& format,
                                             const RecordLayout& layout, std::uint64_t rows);

/// Joins the shards of one stream, in any order and constant memory: byte-identical to a single
/// run. Throws OutputError if a file does not match its journal, shards are missing or repeated, or
/// they belong to different requests, builds of irido or SIMD levels.
void merge_streams(const std::vector<std::string>& shards, const std::string& path,
                   const RecordFormat& format);

}  // namespace irido::tables
