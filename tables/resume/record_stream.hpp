#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tables/records/record_format.hpp"
#include "tables/version.hpp"

namespace irido::tables {

/// What makes two runs write the same bytes, and which part of the whole this one is.
struct StreamIdentity {
    std::string request;      ///< SHA-256 of all that the rows depend on, in hexadecimal
    std::string simd;         ///< name of the SIMD level, on which last digits depend
    std::uint64_t shard = 1;  ///< of `shards`
    std::uint64_t shards = 1;
    std::uint64_t begin = 0;  ///< of the units of work of the whole that are this shard's
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

    /// Units of work, counted from identity.begin, that the file has already, as a resumed one may.
    virtual std::uint64_t units_done() const = 0;
    virtual std::uint64_t rows_done() const = 0;
    /// Whether the resumed file is whole: nothing is left to do.
    virtual bool is_complete() const = 0;

    /// The next block: `bytes` of RecordFormat::rows(), of that many units and rows. Throws
    /// OutputError, or BrokenPipe.
    virtual void append(const std::string& bytes, std::uint64_t units, std::uint64_t rows) = 0;
    /// Also of a stream that has all its units, but was not finished. Does nothing to a complete
    /// one. Throws OutputError.
    virtual void finish() = 0;
    /// Leaves what is there for a later --resume: the part, cut after its last whole block, and its
    /// journal.
    virtual void suspend() = 0;
    /// Takes part and journal away.
    virtual void discard() noexcept = 0;
};

/// `resume` continues a part of the same identity and begins one where there is none; without it,
/// a part that is there is begun again. Holds a lock on the journal until it is destroyed. Throws
/// OutputError if the file cannot be written, if another process is writing it, or if the part to
/// be resumed is of another request, shard, SIMD level or build of irido (the text says which, and
/// what to do).
/// A device or a pipe is written to directly, without a part, and needs `rows` as record_output()
/// does.
std::unique_ptr<RecordStream> record_file(const std::string& path, const RecordFormat& format,
                                          const RecordLayout& layout,
                                          const StreamIdentity& identity, bool resume,
                                          std::uint64_t rows = 0);

/// Standard output; `rows` is the number of rows of the stream if it is known, or 0 for a format
/// whose head does not need it.
std::unique_ptr<RecordStream> record_output(const RecordFormat& format, const RecordLayout& layout,
                                            std::uint64_t rows);

/// `rows` rows into a file, whole or not at all and with nothing beside it but a temporary file, or
/// to standard output if `path` is empty. A device or a pipe is written to directly. Throws
/// OutputError.
std::unique_ptr<RecordStream> counted_output(const std::string& path, const RecordFormat& format,
                                             const RecordLayout& layout, std::uint64_t rows);

/// Puts the shards of one stream, in any order, together: the same bytes as of one run, in constant
/// memory. Throws OutputError if a file is not what its journal says, shards are missing or given
/// twice, or they are of different requests, builds of irido or SIMD levels.
void merge_streams(const std::vector<std::string>& shards, const std::string& path,
                   const RecordFormat& format);

}  // namespace irido::tables
