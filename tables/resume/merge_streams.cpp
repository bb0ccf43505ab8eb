#include <unistd.h>

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <optional>

#include "tables/files/atomic_file.hpp"
#include "tables/files/hash.hpp"
#include "tables/files/plain_file.hpp"
#include "tables/resume/journal.hpp"
#include "tables/resume/record_stream.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kBufferBytes = 4U << 20U;

/// A finished shard to be merged.
struct Shard {
    std::string path;
    JournalHead head;
    Checkpoint counts;

    const StreamIdentity& identity() const { return head.identity; }
    std::string name() const { return std::to_string(identity().shard); }
};

Shard read_shard(const std::string& path, const RecordFormat& format) {
    const std::string target = resolved_path(path), journal = journal_name(target);
    std::error_code ignored;
    if (!std::filesystem::exists(journal, ignored))
        throw OutputError(path + ": is not a shard of irido sweep: it has no journal " + journal);
    const JournalContent content = read_journal(read_whole(journal), journal);
    if (content.is_empty || !content.head || !content.is_complete || content.checkpoints.empty())
        throw OutputError(path + ": is incomplete: rerun it with --resume");
    if (content.head->format != format.name)
        throw OutputError(path + ": must be " + std::string(format.name) + " as the output (got " +
                          content.head->format + ")");
    if (std::filesystem::file_size(target, ignored) != content.file->bytes || ignored ||
        sha256_of_file(target) != content.checksum)
        throw OutputError(path + ": does not match its journal: rerun it");
    return {path, *content.head, content.checkpoints.back()};
}

/// Throws OutputError unless the shards are parts of one whole.
void require_same(const Shard& shard, const Shard& first) {
    const StreamIdentity &a = shard.identity(), &b = first.identity();
    const std::string than = " than " + first.path;
    if (a.build != b.build)
        throw OutputError(shard.path + ": was written by irido " + version_text(a.build) + ", " +
                          first.path + " by " + version_text(b.build) +
                          ", whose numbers may differ: run all shards with the same build");
    if (a.request != b.request || a.total != b.total || shard.head.layout != first.head.layout)
        throw OutputError(shard.path + ": belongs to another request" + than);
    if (a.shards != b.shards)
        throw OutputError(shard.path + ": is one of " + std::to_string(a.shards) + " shards, " +
                          first.path + " one of " + std::to_string(b.shards));
    if (a.simd != b.simd)
        throw OutputError(shard.path + ": was computed at SIMD level " + a.simd + ", " +
                          first.path + " at " + b.simd +
                          ", whose last digits differ: run all shards at one level (set the "
                          "environment variable IRIDO_SIMD)");
}

/// Throws OutputError unless each of the sorted shards is present exactly once.
void require_all(const std::vector<Shard>& shards) {
    const std::string of = " of " + std::to_string(shards[0].identity().shards);
    std::uint64_t wanted = 1;
    for (std::size_t i = 0; i < shards.size(); ++i, ++wanted) {
        if (i > 0 && shards[i].identity().shard == shards[i - 1].identity().shard)
            throw OutputError(shards[i - 1].path + " and " + shards[i].path + ": are both shard " +
                              shards[i].name() + of);
        if (shards[i].identity().shard != wanted) break;
    }
    if (wanted <= shards[0].identity().shards)
        throw OutputError("shard " + std::to_string(wanted) + of + " is missing");
}

/// Throws OutputError unless each of the sorted shards begins where the previous one ends.
void require_contiguous(const std::vector<Shard>& shards) {
    std::uint64_t begin = 0;
    for (const Shard& shard : shards) {
        if (shard.identity().begin != begin)
            throw OutputError(shard.path + ": begins at unit " +
                              std::to_string(shard.identity().begin) + ", expected " +
                              std::to_string(begin));
        begin = shard.identity().end;
        if (shard.counts.units != begin - shard.identity().begin)
            throw OutputError(shard.path + ": is incomplete: rerun it with --resume");
    }
    if (begin != shards[0].identity().total)
        throw OutputError(shards.back().path + ": ends at unit " + std::to_string(begin) +
                          ", expected " + std::to_string(shards[0].identity().total));
}

void require_other(const std::vector<Shard>& shards, const std::string& path) {
    std::error_code ignored;
    for (const Shard& shard : shards) {
        const std::string journal = journal_name(resolved_path(shard.path));
        if (std::filesystem::equivalent(shard.path, path, ignored))
            throw OutputError(path + ": is one of the shards: name another file");
        if (std::filesystem::equivalent(journal, path, ignored))
            throw OutputError(path + ": is the journal of " + shard.path + ": name another file");
    }
}

void write_to(int descriptor, std::string_view bytes, const std::string& path) {
    if (const int error = write_all(descriptor, bytes)) fail_to_write(path, error);
}

/// Copies the rows of a shard, without its head and tail, which must match the format's.
void copy_rows(const Shard& shard, const RecordFormat& format, int to, const std::string& path) {
    const PlainFile file(shard.path, PlainFile::Use::read);
    const std::string head = format.head(shard.head.layout, shard.counts.rows, HeadKind::open);
    std::string buffer(head.size(), '\0'), tail(format.tail.size(), '\0');
    const std::uint64_t end = shard.counts.bytes;
    file.read_at(0, buffer);
    file.read_at(end, tail);
    if (buffer != head || tail != format.tail || file.size() != end + tail.size())
        throw OutputError(shard.path + ": does not match its journal: rerun it");
    for (std::uint64_t at = head.size(); at < end; at += buffer.size()) {
        buffer.resize(std::min<std::uint64_t>(kBufferBytes, end - at));
        file.read_at(at, buffer);
        write_to(to, buffer, path);
    }
}

void copy_all(const std::vector<Shard>& shards, const RecordFormat& format, int to,
              const std::string& path) {
    std::uint64_t rows = 0;
    for (const Shard& shard : shards) rows += shard.counts.rows;
    write_to(to, format.head(shards[0].head.layout, rows, HeadKind::open), path);
    std::uint64_t done = 0;
    for (const Shard& shard : shards) {
        if (done > 0 && shard.counts.rows > 0) write_to(to, format.separator, path);
        copy_rows(shard, format, to, path);
        done += shard.counts.rows;
    }
    write_to(to, format.tail, path);
}

void write_merged(const std::vector<Shard>& shards, const RecordFormat& format,
                  const std::string& path) {
    const OutputTarget target = output_target(path);
    if (!target.is_file) {
        if (format.join)
            throw OutputError(path + ": must be a regular file for " + std::string(format.name));
        const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor < 0) fail_to_write(path, errno);
        copy_all(shards, format, descriptor, path);
        close(descriptor);
        return;
    }
    NewFile file(path, target);
    if (format.join) {
        std::vector<StreamPiece> pieces;
        for (const Shard& shard : shards) pieces.push_back({shard.path, shard.counts.rows});
        format.join(shards[0].head.layout, pieces, file.name());
    } else {
        copy_all(shards, format, file.descriptor(), path);
    }
    file.commit();
}

}  // namespace

void merge_streams(const std::vector<std::string>& paths, const std::string& path,
                   const RecordFormat& format) {
    if (paths.empty()) throw OutputError(path + ": no shards to merge");
    std::vector<Shard> shards;
    for (const std::string& shard : paths) shards.push_back(read_shard(shard, format));
    for (const Shard& shard : shards) require_same(shard, shards[0]);
    std::ranges::stable_sort(shards, {}, [](const Shard& s) { return s.identity().shard; });
    require_all(shards);
    require_contiguous(shards);
    require_other(shards, path);
    write_merged(shards, format, path);
}

}  // namespace irido::tables
