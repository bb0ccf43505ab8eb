#include "tables/records/record_stream.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <random>
#include <sstream>
#include <thread>

#include "tables/files/atomic_file.hpp"
#include "tables/records/csv.hpp"
#include "tables/records/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/sample_records.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Contains;
using Catch::Equals;
using Catch::StartsWith;
namespace fs = std::filesystem;

namespace {

/// Unit u has u % 3 rows.
std::uint64_t rows_before(std::uint64_t unit) {
    return unit / 3 * 3 + (unit % 3 == 2 ? 1 : 0);
}

StreamIdentity identity_of(std::uint64_t total, std::uint64_t shard = 1, std::uint64_t shards = 1) {
    return {
        "request", "avx2",    shard, shards, total * (shard - 1) / shards, total * shard / shards,
        total,     shards > 1};
}

void append_units(RecordStream& stream, const StreamFormat& format, const StreamIdentity& identity,
                  std::uint64_t count) {
    const std::uint64_t first = identity.begin + stream.units_done();
    const std::uint64_t row = rows_before(first), rows = rows_before(first + count) - row;
    stream.append(format.rows(sample_layout(), sample_rows(row, rows)), count, rows);
}

/// Appends blocks of up to so many units until the stream has the first `until` units.
void append_until(RecordStream& stream, const StreamFormat& format, const StreamIdentity& identity,
                  std::uint64_t until, std::mt19937& random, std::uint64_t most = 40) {
    while (stream.units_done() < until)
        append_units(stream, format, identity,
                     std::min(1 + random() % most, until - stream.units_done()));
}

/// The bytes of units [0, total) written in one go.
std::string whole(const StreamFormat& format, std::uint64_t total) {
    const std::uint64_t rows = rows_before(total);
    const Records all = sample_rows(0, rows);
    if (format.name == "csv") return write_csv(all);
    if (format.name == "json") return write_json(all);
    const std::string packed = format.rows(sample_layout(), all);
    if (!format.finish) return format.head(sample_layout(), rows) + packed;
    const TemporaryFolder folder;
    write_text(folder / "part", packed);
    format.finish(sample_layout(), rows, folder / "part", folder / "whole");
    return read_file(folder / "whole");
}

std::unique_ptr<RecordStream> open_stream(const std::string& path, const StreamFormat& format,
                                          const StreamIdentity& identity, bool resume = false) {
    return record_file(path, format, sample_layout(), identity, resume);
}

/// Writes a file of all units.
void write_stream(const std::string& path, const StreamFormat& format,
                  const StreamIdentity& identity, bool resume = false) {
    std::mt19937 random(7);
    const auto stream = open_stream(path, format, identity, resume);
    append_until(*stream, format, identity, identity.end - identity.begin, random);
    stream->finish();
}

/// Runs `work` in a process of its own, which is killed so many microseconds after it began if that
/// is not negative. Its status: 0, or what `work` returns, 99 for an exception, -1 if it was
/// killed.
int in_child(const std::function<int()>& work, int microseconds = -1) {
    int began[2];
    if (pipe(began) != 0) return 98;
    const pid_t child = fork();
    if (child == 0) {
        int status = write(began[1], "", 1) == 1 ? 99 : 98;
        try {
            status = work();
        } catch (...) {
        }
        _exit(status);
    }
    char byte = 0;
    const bool has_begun = read(began[0], &byte, 1) == 1;
    close(began[0]), close(began[1]);
    if (has_begun && microseconds >= 0) {
        usleep(static_cast<useconds_t>(microseconds));
        kill(child, SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& file : fs::directory_iterator(folder))
        names.push_back(file.path().filename().string());
    std::ranges::sort(names);
    return names;
}

/// What the OutputError says.
std::string refusal(const std::function<void()>& run) {
    try {
        run();
    } catch (const OutputError& error) {
        return error.what();
    }
    return "";
}

/// Of each format.
int kills() {
    const char* const text = std::getenv("IRIDO_TEST_KILLS");
    if (text) return std::atoi(text);
#ifdef __SANITIZE_ADDRESS__
    return 20;  // a fork of so large a process takes long
#else
    return 100;
#endif
}

}  // namespace

TEST_CASE("a stream's file does not depend on its blocks", "[tables][stream]") {
    const TemporaryFolder folder;
    for (const StreamFormat* const format : stream_formats())
        for (const std::uint64_t total : {0, 1, 2, 500}) {
            INFO(format->name << " " << total);
            const std::string wanted = whole(*format, total);
            for (const unsigned seed : {1U, 2U}) {
                std::mt19937 random(seed);
                const StreamIdentity identity = identity_of(total);
                const auto stream = open_stream(folder / "out", *format, identity);
                append_until(*stream, *format, identity, total, random);
                CHECK(stream->rows_done() == rows_before(total));
                CHECK_FALSE(stream->is_complete());
                CHECK(fs::exists(folder / "out.part"));
                stream->finish();
                CHECK(stream->is_complete());
                CHECK(read_file(folder / "out") == wanted);
                CHECK(names_in(folder.path()) == std::vector<std::string>{"out"});
            }
        }
}

TEST_CASE("a stream that is killed again and again ends with the same bytes", "[tables][stream]") {
    for (const StreamFormat* const format : stream_formats())
        for (const std::uint64_t shards : {1, 2}) {
            const TemporaryFolder folder;
            const StreamIdentity identity = identity_of(30000, 1, shards);
            const std::string path = folder / "out";
            write_stream(folder / "wanted", *format, identity);
            const std::string wanted = read_file(folder / "wanted");
            std::mt19937 random(static_cast<unsigned>(shards));
            int killed = 0, finished = 0, wrong = 0, failed = 0;
            while (killed < kills() / 2 || finished == 0) {
                // mostly while rows are written, at times while the file is finished
                const int end = static_cast<int>(random() % (random() % 8 == 0 ? 40000 : 4000));
                const unsigned seed = static_cast<unsigned>(random());
                const int status = in_child(
                    [&] {
                        std::mt19937 blocks(seed);
                        const auto stream = open_stream(path, *format, identity, true);
                        if (stream->is_complete()) return 0;
                        append_until(*stream, *format, identity, identity.end, blocks);
                        stream->finish();
                        return 0;
                    },
                    end);
                if (status > 0) ++failed;
                if (status == -1) ++killed;
                if (fs::exists(path) && read_file(path) != wanted) ++wrong;
                if (status != 0) continue;
                ++finished;
                if (!fs::exists(path) || fs::exists(path + ".part") ||
                    fs::exists(path + ".part.tmp") || fs::exists(path + ".sweep") != (shards > 1))
                    ++wrong;
                fs::remove(path);
                fs::remove(path + ".sweep");
            }
            INFO(format->name << " " << shards << " shards, finished " << finished);
            CHECK(failed == 0);
            CHECK(wrong == 0);
        }
}

namespace {

constexpr std::uint64_t kLeft = 18;

/// A stream that was left after some checkpoints, for its part and journal to be damaged.
struct Left {
    TemporaryFolder folder;
    const StreamFormat& format;
    StreamIdentity identity = identity_of(20);
    std::string path = folder / "out", wanted, part, journal;

    explicit Left(const StreamFormat& of) : format(of) {
        wanted = whole(format, identity.total);
        for (const std::uint64_t until :
             {std::uint64_t{2}, std::uint64_t{5}, std::uint64_t{11}, kLeft}) {
            std::mt19937 random(1);
            const auto stream = open_stream(path, format, identity, until > 2);
            append_until(*stream, format, identity, until, random, 4);
            stream->suspend();
        }
        part = read_file(path + ".part");
        journal = read_file(path + ".sweep");
    }

    void put(const std::string& part_bytes, const std::string& journal_bytes) const {
        fs::remove(path + ".part");  // ext4 flushes a file that is emptied and written again
        fs::remove(path + ".sweep");
        write_text(path + ".part", part_bytes);
        write_text(path + ".sweep", journal_bytes);
    }
    /// Goes on; the units from which, having checked the part. Throws OutputError.
    std::uint64_t resumed() const {
        const auto stream = open_stream(path, format, identity, true);
        const std::uint64_t rows = rows_before(stream->units_done());
        std::string kept = format.head(sample_layout(), 0);
        if (rows > 0) kept += format.rows(sample_layout(), sample_rows(0, rows));
        CHECK(stream->rows_done() == rows);
        CHECK(read_file(path + ".part") == kept);
        return stream->units_done();
    }
    void check_end() const {
        write_stream(path, format, identity, true);
        CHECK(read_file(path) == wanted);
        CHECK(names_in(folder.path()) == std::vector<std::string>{"out"});
        fs::remove(path);
    }
};

}  // namespace

TEST_CASE("a journal torn at any byte goes back to a whole block", "[tables][stream]") {
    for (const StreamFormat* const format : stream_formats()) {
        INFO(format->name);
        const Left left(*format);
        const std::size_t head = left.journal.find('\n') + 1;
        std::uint64_t last = 0;
        for (std::size_t bytes = 0; bytes <= left.journal.size(); ++bytes) {
            left.put(left.part, left.journal.substr(0, bytes));
            if (bytes > 0 && left.journal.find(" 0 ", head) + 3 > bytes) {
                // not even a first checkpoint beside a part that has rows
                CHECK_THAT(refusal([&] { left.resumed(); }), Contains("is damaged"));
                continue;
            }
            if (refusal([&] { left.resumed(); }).empty()) {
                left.put(left.part, left.journal.substr(0, bytes));
                const std::uint64_t units = left.resumed();
                CHECK(units >= last);
                last = units;
            }
            if (bytes % 211 == 0 && fs::exists(left.path + ".part")) left.check_end();
        }
        CHECK(last == kLeft);
        left.put(left.part, left.journal + "done 9 9");
        CHECK(left.resumed() == kLeft);
        left.check_end();
    }
}

TEST_CASE("a journal with any byte altered never makes a wrong part", "[tables][stream]") {
    const Left left(*find_stream_format("csv"));
    std::size_t refused = 0;
    for (std::size_t i = 0; i < left.journal.size(); ++i) {
        std::string journal = left.journal;
        journal[i] = static_cast<char>(journal[i] ^ 1);
        left.put(left.part, journal);
        std::uint64_t units = 0;
        if (!refusal([&] { units = left.resumed(); }).empty()) ++refused;
        CHECK(units <= kLeft);
    }
    CHECK(refused >= left.journal.find('\n'));  // whatever the first line is
}

TEST_CASE("a part torn at any byte goes back to a block that fits", "[tables][stream]") {
    for (const StreamFormat* const format : stream_formats()) {
        INFO(format->name);
        const Left left(*format);
        std::uint64_t last = 0;
        for (std::size_t bytes = 0; bytes <= left.part.size(); ++bytes) {
            left.put(left.part.substr(0, bytes), left.journal);
            const std::uint64_t units = left.resumed();
            CHECK(units >= last);
            last = units;
            if (bytes % 997 == 0) {
                left.put(left.part.substr(0, bytes), left.journal);
                left.check_end();
            }
        }
        CHECK(last == kLeft);
        left.put(left.part + "half a row", left.journal);
        CHECK(left.resumed() == kLeft);
        left.check_end();
        left.put(left.part, left.journal);
        fs::remove(left.path + ".part");
        left.check_end();
    }
}

namespace {

/// The journal with other words in its last line of a boot, and that line's checksum (FNV-1a).
std::string on_another_boot(const std::string& journal) {
    const std::size_t at = journal.rfind("boot "), end = journal.find('\n', at);
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : journal.substr(0, journal.find('\n') + 1) + "boot another")
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    std::ostringstream line;
    line << "boot another " << std::hex << std::setw(16) << std::setfill('0') << hash;
    return journal.substr(0, at) + line.str() + journal.substr(end);
}

}  // namespace

TEST_CASE("after a power cut only what the disk was made to keep counts", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamFormat& format = *find_stream_format("csv");
    const StreamIdentity identity = identity_of(100);
    std::mt19937 random(1);
    {
        const auto stream = open_stream(folder / "out", format, identity);
        append_until(*stream, format, identity, 30, random);
        stream->suspend();
    }
    {
        const auto stream = open_stream(folder / "out", format, identity, true);
        append_until(*stream, format, identity, 40, random);
        usleep(1500);  // so that there is a checkpoint, not a safe one
        append_until(*stream, format, identity, 60, random);
    }
    CHECK(open_stream(folder / "out", format, identity, true)->units_done() > 30);
    // the same journal, had the machine been started again since
    const std::string other = on_another_boot(read_file(folder / "out.sweep"));
    write_text(folder / "out.sweep", other);
    CHECK(open_stream(folder / "out", format, identity, true)->units_done() == 30);
    write_text(folder / "out.sweep", on_another_boot(other.substr(0, other.find("safe "))));
    CHECK(open_stream(folder / "out", format, identity, true)->units_done() == 0);
}

TEST_CASE("a finished file that was killed before its journal went", "[tables][stream]") {
    for (const StreamFormat* const format : stream_formats()) {
        INFO(format->name);
        const TemporaryFolder folder;
        const StreamIdentity identity = identity_of(50, 1, 2);
        const std::string path = folder / "out";
        write_stream(path, *format, identity);
        const std::string wanted = read_file(path), journal = read_file(path + ".sweep");
        const std::string killed = journal.substr(0, journal.rfind("complete"));
        // after the renaming
        write_text(path + ".sweep", killed);
        if (format->finish) write_text(path + ".part", "rows");
        CHECK(open_stream(path, *format, identity, true)->is_complete());
        CHECK(read_file(path + ".sweep") == journal);
        CHECK(names_in(folder.path()) == std::vector<std::string>{"out", "out.sweep"});
        // complete: a copy elsewhere is, too
        fs::copy(path, folder / "copy");
        fs::copy(path + ".sweep", folder / "copy.sweep");
        const auto complete = open_stream(folder / "copy", *format, identity, true);
        CHECK(complete->is_complete());
        CHECK(complete->units_done() == 25);
        CHECK(complete->rows_done() == rows_before(25));
        complete->finish();
        CHECK(read_file(folder / "copy") == wanted);
        // another file has the name, of that size
        write_text(folder / "new", std::string(wanted.size(), 'x'));
        fs::rename(folder / "new", path);
        write_text(path + ".sweep", killed);
        CHECK_FALSE(open_stream(path, *format, identity, true)->is_complete());
        write_stream(path, *format, identity, true);
        CHECK(read_file(path) == wanted);
        // the file of a complete shard is gone
        fs::remove(path);
        write_stream(path, *format, identity, true);
        CHECK(read_file(path) == wanted);
    }
}

TEST_CASE("a part of something else is not gone on with", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamFormat& csv = *find_stream_format("csv");
    const StreamIdentity identity = identity_of(90, 2, 3);
    const std::string path = folder / "out";
    {
        const auto stream = open_stream(path, csv, identity);
        append_units(*stream, csv, identity, 10);
        stream->suspend();
    }
    const auto refused = [&](const StreamFormat& format, const RecordLayout& layout,
                             const StreamIdentity& other) {
        return refusal([&] { record_file(path, format, layout, other, true); });
    };
    StreamIdentity other = identity;
    other.request = "other";
    CHECK_THAT(refused(csv, sample_layout(), other),
               Equals(path + ": its part is of another request: run without --resume to begin "
                             "anew, or name another file"));
    other = identity;
    other.simd = "baseline";
    CHECK_THAT(refused(csv, sample_layout(), other), Contains("set IRIDO_SIMD=avx2"));
    other = identity;
    other.build.commit = "0123456789ab";
    CHECK_THAT(refused(csv, sample_layout(), other),
               Equals(path + ": its part is of irido " + to_text(this_build()) + ", this is " +
                      this_build().version +
                      " (0123456789ab), whose numbers may differ: run without --resume to begin "
                      "anew, or name another file"));
    CHECK_THAT(refused(csv, sample_layout(), identity_of(90, 3, 3)),
               Contains("its part is shard 2 of 3, not shard 3 of 3"));
    CHECK_THAT(refused(csv, sample_layout(), identity_of(90, 2, 4)), Contains("not shard 2 of 4"));
    CHECK_THAT(refused(csv, sample_layout(), identity_of(91, 2, 3)), Contains("another request"));
    CHECK_THAT(refused(*find_stream_format("json"), sample_layout(), identity),
               Contains("its part is csv, not json"));
    RecordLayout layout = sample_layout();
    layout[1].width += 1;
    CHECK_THAT(refused(csv, layout, identity), Contains("another request"));
    CHECK(open_stream(path, csv, identity, true)->units_done() == 10);
    // begun anew without --resume
    CHECK(open_stream(path, csv, identity_of(91))->units_done() == 0);
}

TEST_CASE("files that are not the program's are left alone", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamFormat& csv = *find_stream_format("csv");
    for (const bool resume : {false, true}) {
        write_text(folder / "out.sweep", "chimney\n");
        CHECK_THAT(refusal([&] { open_stream(folder / "out", csv, identity_of(9), resume); }),
                   Contains("out.sweep: is not a journal of irido sweep"));
        CHECK(read_file(folder / "out.sweep") == "chimney\n");
        fs::remove(folder / "out.sweep");
        write_text(folder / "out.part", "half");
        CHECK_THAT(refusal([&] { open_stream(folder / "out", csv, identity_of(9), resume); }),
                   Contains("out.part: is in the way"));
        CHECK(read_file(folder / "out.part") == "half");
        CHECK(names_in(folder.path()) == std::vector<std::string>{"out.part"});
        fs::remove(folder / "out.part");
        // a link that somebody laid is not followed
        write_text(folder / "precious", "");
        fs::create_symlink("precious", folder / "out.sweep");
        CHECK(!refusal([&] { open_stream(folder / "out", csv, identity_of(9), resume); }).empty());
        fs::remove(folder / "out.sweep");
        fs::remove(folder / "precious");
    }
}

TEST_CASE("a stream that cannot begin leaves nothing", "[tables][stream]") {
    const TemporaryFolder folder;
    const RecordLayout layout{{"R/T", RecordField::Type::number, 0}};
    const auto begun = [&](const char* format) {
        return refusal([&] {
            record_file(folder / "out", *find_stream_format(format), layout, identity_of(9), false);
        });
    };
    CHECK_THAT(begun("h5"), StartsWith("h5: a column cannot be named 'R/T'"));
    CHECK(names_in(folder.path()).empty());
    CHECK(begun("csv").empty());  // left, as by a kill, and not destroyed by what cannot begin
    CHECK(!begun("h5").empty());
    CHECK(names_in(folder.path()) == std::vector<std::string>{"out.part", "out.sweep"});
}

TEST_CASE("one process writes a stream, another is refused", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamFormat& csv = *find_stream_format("csv");
    const StreamIdentity identity = identity_of(20);
    fs::create_symlink("out", folder / "link");
    write_text(folder / "out", "old");
    {
        const auto stream = open_stream(folder / "out", csv, identity);
        for (const char* const name : {"out", "link"})
            CHECK_THAT(refusal([&] { open_stream(folder / name, csv, identity, true); }),
                       Equals(folder / name + ": is being written by another irido"));
        stream->discard();
    }
    CHECK(read_file(folder / "out") == "old");
    CHECK(names_in(folder.path()) == std::vector<std::string>{"link", "out"});
    write_stream(folder / "out", csv, identity);
}

TEST_CASE("processes that want one file at once do no harm", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamFormat& csv = *find_stream_format("csv");
    const StreamIdentity identity = identity_of(300);
    const std::string wanted = whole(csv, identity.total);
    const auto work = [&] {
        int done = 0;
        for (int i = 0; done < 5; ++i) {
            if (i > 100000) return 97;
            usleep(100);
            const std::string said = refusal([&] {
                std::mt19937 random(static_cast<unsigned>(i));
                const auto stream = open_stream(folder / "out", csv, identity, i % 2 == 0);
                append_until(*stream, csv, identity, identity.total / (1 + i % 3), random);
                if (i % 3 == 1) return stream->discard();
                if (i % 3 == 2) return;
                stream->finish();
                ++done;
            });
            if (!said.empty() && said.find("another irido") == std::string::npos) return 98;
        }
        return 0;
    };
    const pid_t other = fork();  // from this thread: of others, a child may inherit held locks
    REQUIRE(other >= 0);
    if (other == 0) {
        int status = 98;
        try {
            status = work();
        } catch (...) {
        }
        _exit(status);
    }
    CHECK(in_child(work) == 0);
    int status = -1;
    waitpid(other, &status, 0);
    CHECK(status == 0);
    CHECK(read_file(folder / "out") == wanted);
}

TEST_CASE("a stream keeps permissions, follows links and replaces at the end", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamFormat& csv = *find_stream_format("csv");
    const StreamIdentity identity = identity_of(20);
    write_text(folder / "real", "old");
    fs::permissions(folder / "real", fs::perms(0640));
    fs::create_symlink("real", folder / "link");
    const auto stream = open_stream(folder / "link", csv, identity);
    append_units(*stream, csv, identity, 20);
    CHECK(read_file(folder / "real") == "old");
    stream->finish();
    CHECK(read_file(folder / "real") == whole(csv, 20));
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(fs::status(folder / "real").permissions() == fs::perms(0640));
    const mode_t mask = umask(027);
    write_stream(folder / "new", csv, identity_of(20, 1, 2));
    umask(mask);
    CHECK(fs::status(folder / "new").permissions() == fs::perms(0640));
    CHECK(fs::status(folder / "new.sweep").permissions() == fs::perms(0640));
}

TEST_CASE("places that cannot be written are refused", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamFormat& csv = *find_stream_format("csv");
    const auto refused = [&](const std::string& path, bool resume = false) {
        return refusal([&] { open_stream(path, csv, identity_of(9), resume); });
    };
    write_text(folder / "file", "");
    fs::create_directory(folder / "folder");
    CHECK_THAT(refused(folder / "file/out"), StartsWith(folder / "file/out: cannot be written: "));
    CHECK_THAT(refused("/proc/irido.csv"), StartsWith("/proc/irido.csv: cannot be written: "));
    CHECK_THAT(refused(folder / "folder"), Contains("Is a directory"));
    CHECK_THAT(refused("/dev/null", true), Contains("is not a file: --resume"));
    CHECK_THAT(
        refusal([&] { open_stream("/dev/null", *find_stream_format("h5"), identity_of(9)); }),
        Contains("is not a file, as h5 needs"));
    fs::create_directory(folder / "folder.part");
    fs::remove(folder / "folder");
    CHECK(!refused(folder / "folder").empty());
    CHECK(names_in(folder.path()) == std::vector<std::string>{"file", "folder.part"});
    if (geteuid() == 0) return;  // root may write everywhere
    fs::permissions(folder.path(), fs::perms(0500));
    CHECK_THAT(refused(folder / "out"), Contains("Permission denied"));
    fs::permissions(folder.path(), fs::perms(0700));
}

TEST_CASE("a file that grows too large is an error, and goes on later", "[tables][stream]") {
    for (const StreamFormat* const format : stream_formats())
        for (const std::size_t limit : {500U, 3000U, 20011U, 40960U}) {
            INFO(format->name << " " << limit);
            const TemporaryFolder folder;
            const std::string path = folder / "out";
            const StreamIdentity identity = identity_of(2000);
            const int status = in_child([&] {
                std::signal(SIGXFSZ, SIG_IGN);
                const rlimit most{limit, limit};
                setrlimit(RLIMIT_FSIZE, &most);
                std::unique_ptr<RecordStream> stream;
                const std::string said = refusal([&] {
                    stream = open_stream(path, *format, identity);
                    std::mt19937 random(1);
                    append_until(*stream, *format, identity, 2000, random);
                    stream->finish();
                });
                if (said.find("File too large") == std::string::npos) return 1;
                if (said.find(path) != 0) return 2;
                if (stream) stream->suspend();
                return 0;
            });
            CHECK(status == 0);
            CHECK_FALSE(fs::exists(path));
            write_stream(path, *format, identity, true);
            CHECK(read_file(path) == whole(*format, 2000));
            CHECK(names_in(folder.path()) == std::vector<std::string>{"out"});
        }
}

TEST_CASE("an HDF5 file that grows too large when it is finished", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamFormat& h5 = *find_stream_format("h5");
    const StreamIdentity identity = identity_of(2000);
    const std::size_t rows_bytes = rows_before(2000) * 48;
    const int status = in_child([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const auto stream = open_stream(folder / "out", h5, identity);
        append_units(*stream, h5, identity, 2000);
        const rlimit most{rows_bytes, rows_bytes};  // its own head does not fit any more
        setrlimit(RLIMIT_FSIZE, &most);
        const std::string said = refusal([&] { stream->finish(); });
        if (said.find("File too large") == std::string::npos) return 1;
        if (fs::exists(folder / "out.part.tmp")) return 2;
        stream->suspend();
        return 0;
    });
    CHECK(status == 0);
    const auto stream = open_stream(folder / "out", h5, identity, true);
    CHECK(stream->units_done() == 2000);
    stream->finish();
    CHECK(read_file(folder / "out") == whole(h5, 2000));
}

TEST_CASE("devices and pipes are written to directly", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamIdentity identity = identity_of(3000);
    for (const StreamFormat* const format : stream_formats()) {
        if (format->finish) continue;
        INFO(format->name);
        CHECK_THAT(refusal([&] { write_stream("/dev/full", *format, identity); }),
                   Equals("/dev/full: cannot be written: No space left on device"));
        const std::string fifo = folder / std::string(format->name);
        REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
        std::string got;
        std::thread reader([&] { got = read_file(fifo); });
        {
            std::mt19937 random(3);
            const auto stream =
                record_file(fifo, *format, sample_layout(), identity, false, rows_before(3000));
            append_until(*stream, *format, identity, 3000, random);
            stream->finish();
        }
        reader.join();
        CHECK(got == whole(*format, 3000));
    }
    CHECK_THAT(refusal([&] { write_stream("/dev/null", *find_stream_format("npy"), identity); }),
               Contains("its head says another number of rows"));
    write_stream("/dev/null", *find_stream_format("csv"), identity);
}

TEST_CASE("standard output gets the same bytes", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamIdentity identity = identity_of(100);
    for (const StreamFormat* const format : stream_formats()) {
        INFO(format->name);
        const int status = in_child([&] {
            dup2(open((folder / "out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
            std::mt19937 random(4);
            const auto stream = record_output(*format, sample_layout(), rows_before(100));
            append_until(*stream, *format, identity, 100, random);
            stream->finish();
            return 0;
        });
        CHECK(status == (format->finish ? 99 : 0));
        if (status == 0) CHECK(read_file(folder / "out") == whole(*format, 100));
    }
    CHECK_THAT(refusal([&] { record_output(*find_stream_format("h5"), sample_layout(), 0); }),
               Equals("--format: h5 needs --output FILE"));
    const int terminal = in_child([&] {
        const int master = posix_openpt(O_RDWR | O_NOCTTY);
        if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) return 1;
        dup2(open(ptsname(master), O_RDWR | O_NOCTTY), STDOUT_FILENO);
        const std::string said =
            refusal([&] { record_output(*find_stream_format("npy"), sample_layout(), 0); });
        return said.find("does not go to a terminal") == std::string::npos ? 2 : 0;
    });
    CHECK(terminal == 0);
    const int closed = in_child([&] {
        std::signal(SIGPIPE, SIG_IGN);
        int ends[2];
        if (pipe(ends) != 0) return 1;
        close(ends[0]);
        dup2(ends[1], STDOUT_FILENO);
        try {
            record_output(*find_stream_format("csv"), sample_layout(), 0)->finish();
        } catch (const BrokenPipe&) {
            return 0;
        }
        return 2;
    });
    CHECK(closed == 0);
}
