#include "tables/resume/record_stream.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "tables/files/atomic_file.hpp"
#include "tables/files/hash.hpp"
#include "tables/files/plain_file.hpp"
#include "tables/resume/journal.hpp"

namespace irido::tables {

namespace {

using Clock = std::chrono::steady_clock;

/// Minimum time between two checkpoints or, if longer, the fraction of the run time that a kill may
/// cost: keeps the journal small.
constexpr auto kCheckpointInterval = std::chrono::milliseconds(1);
constexpr int kCheckpointShare = 1000;
/// Time between two checkpoints that survive a power cut.
constexpr auto kSafeInterval = std::chrono::seconds(5);
/// Suffix of a part that a format's finish() has converted.
constexpr const char* kMade = ".tmp";

std::optional<FileMark> mark_of(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return std::nullopt;
    return FileMark{static_cast<std::uint64_t>(status.st_size), status.st_ino,
                    static_cast<std::uint64_t>(status.st_mtim.tv_sec) * 1'000'000'000U +
                        static_cast<std::uint64_t>(status.st_mtim.tv_nsec)};
}

std::string shard_text(const StreamIdentity& identity) {
    return "shard " + std::to_string(identity.shard) + " of " + std::to_string(identity.shards);
}

class FileStream : public RecordStream {
public:
    FileStream(const std::string& path, OutputTarget target, const RecordFormat& format,
               const RecordLayout& layout, const StreamIdentity& identity)
        : path_(path),
          target_(std::move(target)),
          part_name_(part_name(target_.path)),
          made_name_(part_name_ + kMade),
          format_(format),
          head_{std::string(format.name), layout, identity},
          journal_(target_.path, path) {}

    void begin();
    /// False if there is nothing to continue.
    bool resume();

    std::uint64_t units_done() const override { return at_.units; }
    std::uint64_t rows_done() const override { return at_.rows; }
    bool is_complete() const override { return is_complete_; }
    void append(const std::string& bytes, std::uint64_t units, std::uint64_t rows) override;
    void finish() override;
    void suspend() override;
    void discard() noexcept override;

private:
    [[noreturn]] void fail(const std::string& text) const { throw OutputError(path_ + text); }
    void require_same(const JournalHead& found) const;
    void require_own_part();
    bool take_finished(const JournalContent& found);
    std::optional<Checkpoint> last_fitting(const JournalContent& found) const;
    std::uint64_t part_bytes() const;
    void checkpoint(bool is_safe);
    std::string made_file() const;
    void give_name(const std::string& file);

    std::string path_;
    OutputTarget target_;
    std::string part_name_, made_name_;
    const RecordFormat& format_;
    JournalHead head_;
    Journal journal_;
    std::unique_ptr<PlainFile> part_;
    Checkpoint at_;
    bool is_complete_ = false, is_over_ = false;
    Clock::time_point opened_ = Clock::now(), noted_ = opened_, safe_ = opened_;
};

std::uint64_t FileStream::part_bytes() const {
    const auto mark = mark_of(part_name_);
    return mark ? mark->bytes : 0;
}

/// Refuses a part without a journal as foreign: irido creates the journal first and removes it
/// last.
void FileStream::require_own_part() {
    if (journal_.was_there() || part_bytes() == 0) return;
    journal_.remove();
    throw OutputError(part_name_ + ": exists but has no journal " + journal_name(target_.path) +
                      "; move it away");
}

void FileStream::begin() {
    require_own_part();
    bool is_ours = !journal_.was_there();
    try {
        const std::string head = format_.head(head_.layout, 0, HeadKind::open);
        part_ = std::make_unique<PlainFile>(part_name_, PlainFile::Use::create, path_);
        is_ours = true;
        journal_.clear();  // before the part: an old part never gets a new journal
        part_->cut(0);
        journal_.begin(head_, target_.mode);
        part_->write_at(0, head);
        at_ = {0, 0, head.size()};
        checkpoint(false);
    } catch (...) {
        if (is_ours) discard();
        throw;
    }
}

void FileStream::require_same(const JournalHead& found) const {
    const std::string anew = ": rerun without --resume to start over, or name another file";
    const StreamIdentity &a = found.identity, &b = head_.identity;
    if (a.build != b.build)
        fail(": its .part was written by irido " + version_text(a.build) + ", this is " +
             version_text(b.build) + ", whose numbers may differ" + anew);
    if (found.format != head_.format)
        fail(": its .part is " + found.format + ", not " + head_.format + anew);
    if (a.request != b.request || a.total != b.total || found.layout != head_.layout)
        fail(": its .part belongs to another request" + anew);
    if (a.shard != b.shard || a.shards != b.shards || a.begin != b.begin || a.end != b.end)
        fail(": its .part is " + shard_text(a) + ", not " + shard_text(b) + anew);
    if (a.simd != b.simd)
        fail(": its .part is at SIMD level " + a.simd + ", this run at " + b.simd +
             ": set IRIDO_SIMD=" + a.simd + ", or rerun without --resume to start over");
}

/// Returns whether the file is already complete; if so, removes leftovers.
bool FileStream::take_finished(const JournalContent& found) {
    const auto mark = mark_of(target_.path);
    if (!found.file || !mark || found.checkpoints.empty()) return false;
    // once complete, it may have been moved to another disk
    if (found.is_complete ? mark->bytes != found.file->bytes : *mark != *found.file) return false;
    const bool is_shard = head_.identity.is_shard;
    if (is_shard && sha256_of_file(target_.path) != found.checksum) return false;
    at_ = found.checkpoints.back();
    is_complete_ = is_over_ = true;
    unlink(part_name_.c_str());
    if (!is_shard) {
        journal_.remove();
    } else if (!found.is_complete) {
        journal_.add_complete();
    }
    return true;
}

std::optional<Checkpoint> FileStream::last_fitting(const JournalContent& found) const {
    const bool is_all_there = found.boot == boot_id();
    const std::uint64_t bytes = part_bytes();
    const auto last = std::find_if(
        found.checkpoints.rbegin(), found.checkpoints.rend(), [&](const Checkpoint& point) {
            return point.bytes <= bytes && (point.is_safe || is_all_there);
        });
    return last == found.checkpoints.rend() ? std::nullopt : std::optional(*last);
}

bool FileStream::resume() {
    const JournalContent& found = journal_.found();
    if (found.is_empty) return false;
    const std::string damaged = ": its journal " + journal_name(target_.path) +
                                " is damaged: rerun without --resume to start over";
    if (!found.head) {
        if (part_bytes() > 0) fail(damaged);
        return false;
    }
    require_same(*found.head);
    unlink(made_name_.c_str());
    if (take_finished(found)) return true;
    const auto point = last_fitting(found);
    if (!point) {
        if (found.checkpoints.empty() &&
            part_bytes() > format_.head(head_.layout, 0, HeadKind::open).size())
            fail(damaged);
        return false;
    }
    part_ = std::make_unique<PlainFile>(part_name_, PlainFile::Use::create, path_);
    part_->cut(point->bytes);
    journal_.go_back(*point);
    journal_.add_boot();
    at_ = *point;
    return true;
}

void FileStream::checkpoint(bool is_safe) {
    if (is_safe) part_->sync();
    at_.is_safe = is_safe;
    journal_.add_checkpoint(at_);
    if (is_safe) journal_.sync();
    noted_ = Clock::now();
    if (is_safe) safe_ = noted_;
}

void FileStream::append(const std::string& bytes, std::uint64_t units, std::uint64_t rows) {
    if (is_over_) throw std::logic_error("no rows after the end of a stream");
    std::uint64_t end = at_.bytes;
    if (!bytes.empty()) {
        if (at_.rows > 0) {
            part_->write_at(end, format_.separator);
            end += format_.separator.size();
        }
        part_->write_at(end, bytes);
        end += bytes.size();
    }
    at_ = {at_.units + units, at_.rows + rows, end};
    const auto now = Clock::now();
    if (now - noted_ >=
        std::max<Clock::duration>(kCheckpointInterval, (now - opened_) / kCheckpointShare))
        checkpoint(now - safe_ >= kSafeInterval);
}

/// The finished file before its rename.
std::string FileStream::made_file() const {
    if (!format_.finish) return part_name_;
    try {
        format_.finish(head_.layout, at_.rows, part_name_, made_name_);
    } catch (...) {
        unlink(made_name_.c_str());
        throw;
    }
    return made_name_;
}

void FileStream::give_name(const std::string& file) {
    const PlainFile made(file, PlainFile::Use::write, path_);
    if (fchmod(made.descriptor(), target_.mode) != 0) fail_to_write(path_, errno);
    made.sync();
    journal_.add_file(mark_of(file).value_or(FileMark{}),
                      head_.identity.is_shard ? sha256_of_file(file) : "");
    if (std::rename(file.c_str(), target_.path.c_str()) != 0) fail_to_write(path_, errno);
}

void FileStream::finish() {
    if (is_over_) return;
    part_->write_at(at_.bytes, format_.tail);
    part_->write_at(0, format_.head(head_.layout, at_.rows, HeadKind::open));
    checkpoint(false);
    give_name(made_file());
    is_complete_ = is_over_ = true;
    if (format_.finish) unlink(part_name_.c_str());
    if (!head_.identity.is_shard) return journal_.remove();
    journal_.add_complete();
    journal_.sync();
}

void FileStream::suspend() {
    if (is_over_) return;
    is_over_ = true;
    try {
        part_->cut(at_.bytes);  // before the checkpoint: makes room for it on a full disk
        checkpoint(true);
    } catch (const OutputError&) {  // the last checkpoint written remains valid
    }
}

void FileStream::discard() noexcept {
    if (is_over_) return;
    is_over_ = true;
    unlink(part_name_.c_str());
    unlink(made_name_.c_str());
    journal_.remove();
}

/// Writes to standard output, a device, a pipe or a NewFile; cannot be resumed.
class DirectStream : public RecordStream {
public:
    DirectStream(int descriptor, const std::string& name, const RecordFormat& format,
                 const RecordLayout& layout, std::uint64_t rows,
                 std::unique_ptr<NewFile> file = nullptr)
        : descriptor_(descriptor),
          name_(name),
          format_(format),
          layout_(layout),
          file_(std::move(file)) {
        if (descriptor_ < 0) fail_to_write(name, errno);
        head_ = format.head(layout, rows, HeadKind::final);
    }
    ~DirectStream() override {
        if (!file_ && descriptor_ > STDERR_FILENO) close(descriptor_);
    }

    std::uint64_t units_done() const override { return units_; }
    std::uint64_t rows_done() const override { return rows_; }
    bool is_complete() const override { return false; }
    void append(const std::string& bytes, std::uint64_t units, std::uint64_t rows) override {
        if (!bytes.empty()) {
            begin();
            if (rows_ > 0) write(format_.separator);
            write(bytes);
        }
        units_ += units;
        rows_ += rows;
    }
    void finish() override {
        begin();
        write(format_.tail);
        if (format_.head(layout_, rows_, HeadKind::final) != head_)
            throw OutputError(name_ +
                              ": incomplete: its header announces a different number of rows");
        if (file_) file_->commit();
    }
    void suspend() override {}
    void discard() noexcept override {}

private:
    /// Writes the head with the first rows, so that an earlier failure writes nothing.
    void begin() {
        if (!std::exchange(has_begun_, true)) write(head_);
    }
    void write(std::string_view bytes) const {
        if (const int error = write_all(descriptor_, bytes)) fail_to_write(name_, error);
    }

    int descriptor_;
    std::string name_;
    const RecordFormat& format_;
    RecordLayout layout_;
    std::unique_ptr<NewFile> file_;  ///< owner of the descriptor, if it is a file
    std::string head_;
    bool has_begun_ = false;
    std::uint64_t units_ = 0, rows_ = 0;
};

}  // namespace

std::unique_ptr<RecordStream> record_file(const std::string& path, const RecordFormat& format,
                                          const RecordLayout& layout,
                                          const StreamIdentity& identity, bool resume,
                                          std::uint64_t rows) {
    const OutputTarget target = output_target(path);
    if (!target.is_file) {
        if (resume) throw OutputError(path + ": must be a regular file for --resume");
        if (format.finish)
            throw OutputError(path + ": must be a regular file for " + std::string(format.name));
        return std::make_unique<DirectStream>(open(path.c_str(), O_WRONLY | O_CLOEXEC), path,
                                              format, layout, rows);
    }
    const std::string part = part_name(target.path);
    for (const std::string& beside : {part, part + kMade, journal_name(target.path)})
        require_no_input(beside);
    auto stream = std::make_unique<FileStream>(path, target, format, layout, identity);
    if (!resume || !stream->resume()) stream->begin();
    return stream;
}

std::unique_ptr<RecordStream> record_output(const RecordFormat& format, const RecordLayout& layout,
                                            std::uint64_t rows) {
    if (format.finish)
        throw OutputError("--format: " + std::string(format.name) + " requires --output FILE");
    if (format.is_binary) check_binary_stdout();
    require_no_input("/dev/stdout");
    return std::make_unique<DirectStream>(STDOUT_FILENO, "standard output", format, layout, rows);
}

std::unique_ptr<RecordStream> counted_output(const std::string& path, const RecordFormat& format,
                                             const RecordLayout& layout, std::uint64_t rows) {
    if (path.empty()) return record_output(format, layout, rows);
    const OutputTarget target = output_target(path);
    if (!target.is_file)
        return std::make_unique<DirectStream>(open(path.c_str(), O_WRONLY | O_CLOEXEC), path,
                                              format, layout, rows);
    auto file = std::make_unique<NewFile>(path, target);
    const int descriptor = file->descriptor();
    return std::make_unique<DirectStream>(descriptor, path, format, layout, rows, std::move(file));
}

}  // namespace irido::tables
