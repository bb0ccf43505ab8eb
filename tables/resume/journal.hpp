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

/// The journal of a stream of records: one line of JSON, then a line per event, ending in a
/// checksum of itself and the first line, so that torn or foreign lines are detected:
///     boot ID                 a process started writing during this boot of the machine
///     done UNITS ROWS BYTES   that many bytes of the part are complete blocks
///     safe UNITS ROWS BYTES   the same, flushed to disk
///     file BYTES INODE TIME [SHA256]  the finished file before its rename; a shard's checksum
///     complete                the file was renamed

/// The first line.
struct JournalHead {
    std::string format;
    RecordLayout layout;
    StreamIdentity identity;
};

struct Checkpoint {
    std::uint64_t units = 0, rows = 0, bytes = 0;
    bool is_safe = false;
    std::uint64_t journal_bytes = 0;  ///< up to the end of the first line
};

/// Identifies a finished file.
struct FileMark {
    std::uint64_t bytes = 0, inode = 0, changed_ns = 0;

    bool operator==(const FileMark&) const = default;
};

/// The content of a journal, up to the first incomplete line.
struct JournalContent {
    bool is_empty = true;
    std::optional<JournalHead> head;  ///< empty if the first line is torn or damaged
    std::vector<Checkpoint> checkpoints;
    std::string boot;              ///< from the last such line
    std::optional<FileMark> file;  ///< if followed by nothing but "complete"
    std::string checksum;          ///< of that file, if it is a shard
    bool is_complete = false;
    std::uint64_t whole_bytes = 0;  ///< up to the end of the last complete line
};

/// Parses a journal. Throws OutputError if non-empty text does not start like a journal.
JournalContent read_journal(const std::string& text, const std::string& journal);

/// Reads a whole file. Throws OutputError.
std::string read_whole(const std::string& path);

/// PATH.sweep, locked against other writers while this object lives.
class Journal {
public:
    /// `target` has its links resolved; errors name `shown`. Throws OutputError.
    Journal(const std::string& target, const std::string& shown);

    const JournalContent& found() const { return found_; }
    bool was_there() const { return was_there_; }

    /// Empties the journal.
    void clear();
    void begin(const JournalHead& head, mode_t mode);
    /// Discards everything after a checkpoint.
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
    bool was_there_ = false;  // declared before file_, whose initialization sets it
    std::unique_ptr<PlainFile> file_;
    JournalContent found_;
    std::string head_;
    std::uint64_t bytes_ = 0;
};

/// Identifies the current boot of the machine, "" if unknown: unsynced data of earlier boots may be
/// lost.
std::string boot_id();

/// The names of a file's journal and of its unfinished part.
std::string journal_name(const std::string& target);
std::string part_name(const std::string& target);

}  // namespace irido::tables
