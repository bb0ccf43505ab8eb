#include "tables/resume/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tables/files/atomic_file.hpp"

namespace irido::tables {

namespace {

using nlohmann::json;

/// The beginning of every journal; keys are sorted.
constexpr std::string_view kStart = R"({"a_journal_of":"irido sweep",)";
constexpr std::array kTypeNames{"number", "text", "flag"};

std::string head_line(const JournalHead& head) {
    json layout = json::array();
    for (const RecordField& field : head.layout)
        layout.push_back(
            {field.name, kTypeNames[static_cast<std::size_t>(field.type)], field.width});
    const StreamIdentity& id = head.identity;
    const json line = {{"a_journal_of", "irido sweep"},
                       {"begin", id.begin},
                       {"commit", id.build.commit},
                       {"end", id.end},
                       {"format", head.format},
                       {"irido", id.build.version},
                       {"layout", layout},
                       {"request", id.request},
                       {"shard", id.shard},
                       {"shards", id.shards},
                       {"simd", id.simd},
                       {"total", id.total}};
    return line.dump() + "\n";
}

/// Throws json::exception.
JournalHead head_of(const std::string& text) {
    const json line = json::parse(text);
    JournalHead head;
    line.at("format").get_to(head.format);
    for (const json& field : line.at("layout")) {
        RecordField to{field.at(0).get<std::string>(), RecordField::Type::number,
                       field.at(2).get<std::size_t>()};
        for (std::size_t type = 0; type < kTypeNames.size(); ++type)
            if (field.at(1) == kTypeNames[type]) to.type = static_cast<RecordField::Type>(type);
        head.layout.push_back(to);
    }
    StreamIdentity& id = head.identity;
    line.at("begin").get_to(id.begin);
    line.at("end").get_to(id.end);
    line.at("request").get_to(id.request);
    line.at("shard").get_to(id.shard);
    line.at("shards").get_to(id.shards);
    line.at("simd").get_to(id.simd);
    line.at("total").get_to(id.total);
    id.build = {line.at("irido").get<std::string>(), line.value("commit", "")};
    return head;
}

/// FNV-1a hash of both texts, as 16 hexadecimal digits.
std::string checksum(const std::string& head, std::string_view line) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const std::string_view text : {std::string_view(head), line})
        for (const char c : text) {
            hash ^= static_cast<unsigned char>(c);
            hash *= 0x100000001b3;
        }
    std::string digits(16, '0');
    for (std::size_t i = digits.size(); i-- > 0; hash >>= 4U)
        digits[i] = "0123456789abcdef"[hash & 15U];
    return digits;
}

/// Applies a complete line to the content.
void take_line(JournalContent& content, const std::string& line, std::uint64_t end) {
    content.whole_bytes = end;
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "complete") {
        content.is_complete = content.file.has_value();
        return;
    }
    content.file.reset();
    if (word == "boot") {
        content.boot.clear();
        words >> content.boot;
    } else if (word == "file") {
        content.file.emplace();
        words >> content.file->bytes >> content.file->inode >> content.file->changed_ns;
        content.checksum.clear();
        words >> content.checksum;
    } else {
        Checkpoint point{0, 0, 0, word == "safe", end};
        words >> point.units >> point.rows >> point.bytes;
        content.checkpoints.push_back(point);
    }
}

/// Opens and locks the journal, even if others remove it in between; null if another process holds
/// it.
std::unique_ptr<PlainFile> open_locked(const std::string& path, const std::string& shown,
                                       bool& was_there) {
    for (;;) {
        struct stat before {};
        was_there = lstat(path.c_str(), &before) == 0;
        auto file = std::make_unique<PlainFile>(path, PlainFile::Use::create, shown);
        if (flock(file->descriptor(), LOCK_EX | LOCK_NB) != 0) {
            if (errno == EWOULDBLOCK) return nullptr;
            throw OutputError(shown + ": cannot be locked: " + std::strerror(errno));
        }
        struct stat ours {
        }, named{};
        if (fstat(file->descriptor(), &ours) == 0 && stat(path.c_str(), &named) == 0 &&
            ours.st_ino == named.st_ino && ours.st_dev == named.st_dev)
            return file;
    }
}

}  // namespace

JournalContent read_journal(const std::string& text, const std::string& journal) {
    JournalContent content;
    content.is_empty = text.empty();
    if (std::string_view(text).substr(0, kStart.size()) != kStart.substr(0, text.size()))
        throw OutputError(journal + ": is not a journal of irido sweep; move it away");
    std::size_t at = text.find('\n');
    if (at == std::string::npos) return content;
    const std::string head = text.substr(0, ++at);
    try {
        content.head = head_of(head);
    } catch (const json::exception&) {
        return content;
    }
    for (std::size_t end; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
        const std::size_t space = text.rfind(' ', end);
        if (space == std::string::npos || space < at) break;
        const std::string line = text.substr(at, space - at);
        if (text.substr(space + 1, end - space - 1) != checksum(head, line)) break;
        take_line(content, line, end + 1);
    }
    return content;
}

std::string read_whole(const std::string& path) {
    const PlainFile file(path, PlainFile::Use::read);
    std::string text(file.size(), '\0');
    file.read_at(0, text);
    return text;
}

Journal::Journal(const std::string& target, const std::string& shown)
    : path_(journal_name(target)), shown_(shown), file_(open_locked(path_, shown, was_there_)) {
    if (!file_) throw OutputError(shown + ": is being written by another irido process");
    std::string text(file_->size(), '\0');
    was_there_ |= !text.empty();
    file_->read_at(0, text);
    found_ = read_journal(text, path_);
    head_ = text.substr(0, text.find('\n') + 1);
    bytes_ = found_.whole_bytes;
}

void Journal::clear() {
    file_->cut(0);
    bytes_ = 0;
}

void Journal::begin(const JournalHead& head, mode_t mode) {
    if (fchmod(file_->descriptor(), mode | 0600) != 0) fail_to_write(shown_, errno);
    head_ = head_line(head);
    file_->write_at(0, head_);
    bytes_ = head_.size();
    add_boot();
}

void Journal::go_back(const Checkpoint& checkpoint) {
    file_->cut(checkpoint.journal_bytes);
    bytes_ = checkpoint.journal_bytes;
}

void Journal::add_boot() {
    add("boot " + boot_id());
}

void Journal::add_checkpoint(const Checkpoint& point) {
    add((point.is_safe ? "safe " : "done ") + std::to_string(point.units) + " " +
        std::to_string(point.rows) + " " + std::to_string(point.bytes));
}

void Journal::add_file(const FileMark& mark, const std::string& checksum) {
    add("file " + std::to_string(mark.bytes) + " " + std::to_string(mark.inode) + " " +
        std::to_string(mark.changed_ns) + (checksum.empty() ? "" : " " + checksum));
}

void Journal::add_complete() {
    add("complete");
}

/// Writes at a fixed offset, so that a line torn by a full disk is overwritten by the next.
void Journal::add(const std::string& line) {
    const std::string whole = line + " " + checksum(head_, line) + "\n";
    file_->write_at(bytes_, whole);
    bytes_ += whole.size();
}

void Journal::remove() noexcept {
    unlink(path_.c_str());
}

std::string boot_id() {
    std::ifstream file("/proc/sys/kernel/random/boot_id");
    std::string id;
    file >> id;
    return id;
}

std::string journal_name(const std::string& target) {
    return target + ".sweep";
}

std::string part_name(const std::string& target) {
    return target + ".part";
}

}  // namespace irido::tables
