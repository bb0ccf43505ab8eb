#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tables/files/plain_file.hpp"
#include "tables/records/record_layout.hpp"
#include "tables/resume/record_stream.hpp"

namespace irido::tables {

/// The journal of a stream of records: one line of JSON, then a line for each event, which ends in
/// a checksum of itself and the first line, so that a torn or foreign line is noticed:
///     boot ID                 a process writes on, since this start of the machine
///     done UNITS ROWS BYTES   so many bytes of the part are whole blocks
///     safe UNITS ROWS BYTES   and the disk has them
///     file BYTES INODE TIME [SHA256]  the file that is to be given its name; a shard's checksum
///     complete                it has its name

/// The first line.
struct JournalHead {
    std::string format;
    RecordLayout layout;
    StreamIdentity identity;
};

struct Checkpoint {
    std::uint64_t units = 0, rows = 0, bytes = 0;
    bool is_safe = false;
    std::uint64_t journal_bytes = 0;  ///< up to its line's end
};

/// What tells a finished file from any other.
struct FileMark {
    std::uint64_t bytes = 0, inode = 0, changed_ns = 0;

    bool operator==(const FileMark&) const = default;
};

/// What a journal says, up to the first line that is not whole.
struct JournalContent {
    bool is_empty = true;
    std::optional<JournalHead> head;  ///< none if the first line is torn or damaged
    std::vector<Checkpoint> checkpoints;
    std::string boot;              ///< of the last such line
    std::optional<FileMark> file;  ///< if nothing but "complete" follows its line
    std::string checksum;          ///< of that file, if it is a shard
    bool is_complete = false;
    std::uint64_t whole_bytes = 0;  ///< up to the last whole line's end
};

/// Throws OutputError if a text, that is not empty, does not begin as a journal does.
JournalContent read_journal(const std::string& text, const std::string& journal);

/// Throws OutputError.
std::string read_whole(const std::string& path);

/// PATH.sweep, which nobody else can write as long as this object is there.
class Journal {
public:
    /// `target` without links; errors name `shown`. Throws OutputError.
    Journal(const std::string& target, const std::string& shown);

    const JournalContent& found() const { return found_; }
    bool was_there() const { return was_there_; }

    /// Empties it, so that from now on it tells of nothing.
    void clear();
    void begin(const JournalHead& head, mode_t mode);
    /// Forgets what is after a checkpoint.
    void go_back(const Checkpoint& checkpoint);
    void add_boot();
    void add_checkpoint(const Checkpoint& checkpoint);
    void add_file(const FileMark& mark, const std::string& checksum);
    void add_complete();
    void sync() const { file_->sync(); }
    void remove() noexcept;

private:
    void add(const std::string& line);

    std::string path_, shown_;
    bool was_there_ = false;  // before file_, whose opening sets it
    std::unique_ptr<PlainFile> file_;
    JournalContent found_;
    std::string head_;
    std::uint64_t bytes_ = 0;
};

/// Of the machine's running, "" if unknown: what was written before and not synced may be lost.
std::string boot_id();

/// The name of the journal of a file, and of what the file is until it is whole.
std::string journal_name(const std::string& target);
std::string part_name(const std::string& target);

}  // namespace irido::tables
