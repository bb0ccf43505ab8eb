#include "tables/resume/journal.hpp"

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
#include "tables/records/record_format.hpp"
#include "tests/support/program.hpp"
#include "tests/support/sample_records.hpp"
#include "tests/support/sample_streams.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;
using Catch::Contains;
using Catch::Equals;
using Catch::StartsWith;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLeft = 18;

/// A stream abandoned after some checkpoints, whose part and journal can be damaged.
struct Left {
    TemporaryFolder folder;
    const RecordFormat& format;
    StreamIdentity identity = identity_of(20);
    std::string path = folder / "out", wanted, part, journal;

    explicit Left(const RecordFormat& of) : format(of) {
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
        fs::remove(path + ".part");  // ext4 flushes a file that is truncated and rewritten
        fs::remove(path + ".sweep");
        write_text(path + ".part", part_bytes);
        write_text(path + ".sweep", journal_bytes);
    }
    /// Resumes; returns the starting unit after checking the part. Throws OutputError.
    std::uint64_t resumed() const {
        const auto stream = open_stream(path, format, identity, true);
        const std::uint64_t rows = rows_before(stream->units_done());
        std::string kept = format.head(sample_layout(), 0, HeadKind::open);
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
    for (const RecordFormat* const format : record_formats()) {
        INFO(format->name);
        const Left left(*format);
        const std::size_t head = left.journal.find('\n') + 1;
        std::uint64_t last = 0;
        for (std::size_t bytes = 0; bytes <= left.journal.size(); ++bytes) {
            left.put(left.part, left.journal.substr(0, bytes));
            if (bytes > 0 && left.journal.find(" 0 ", head) + 3 > bytes) {
                // not even a first checkpoint with a part that has rows
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
    const Left left(*find_record_format("csv"));
    std::size_t refused = 0;
    for (std::size_t i = 0; i < left.journal.size(); ++i) {
        std::string journal = left.journal;
        journal[i] = static_cast<char>(journal[i] ^ 1);
        left.put(left.part, journal);
        std::uint64_t units = 0;
        if (!refusal([&] { units = left.resumed(); }).empty()) ++refused;
        CHECK(units <= kLeft);
    }
    CHECK(refused >= left.journal.find('\n'));  // for any first line
}

TEST_CASE("a part torn at any byte goes back to a block that fits", "[tables][stream][slow]") {
    for (const RecordFormat* const format : record_formats()) {
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

/// The journal with a different ID in its last boot line, and that line's checksum (FNV-1a).
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
    const RecordFormat& format = *find_record_format("csv");
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
        usleep(1500);  // long enough for a checkpoint, but not a safe one
        append_until(*stream, format, identity, 60, random);
    }
    CHECK(open_stream(folder / "out", format, identity, true)->units_done() > 30);
    // the same journal, as if the machine had been rebooted since
    const std::string other = on_another_boot(read_file(folder / "out.sweep"));
    write_text(folder / "out.sweep", other);
    CHECK(open_stream(folder / "out", format, identity, true)->units_done() == 30);
    write_text(folder / "out.sweep", on_another_boot(other.substr(0, other.find("safe "))));
    CHECK(open_stream(folder / "out", format, identity, true)->units_done() == 0);
}

TEST_CASE("a finished file that was killed before its journal went", "[tables][stream]") {
    for (const RecordFormat* const format : record_formats()) {
        INFO(format->name);
        const TemporaryFolder folder;
        const StreamIdentity identity = identity_of(50, 1, 2);
        const std::string path = folder / "out";
        write_stream(path, *format, identity);
        const std::string wanted = read_file(path), journal = read_file(path + ".sweep");
        const std::string killed = journal.substr(0, journal.rfind("complete"));
        // after the rename
        write_text(path + ".sweep", killed);
        if (format->finish) write_text(path + ".part", "rows");
        CHECK(open_stream(path, *format, identity, true)->is_complete());
        CHECK(read_file(path + ".sweep") == journal);
        CHECK(names_in(folder.path()) == std::vector<std::string>{"out", "out.sweep"});
        // complete, and so is a copy elsewhere
        fs::copy(path, folder / "copy");
        fs::copy(path + ".sweep", folder / "copy.sweep");
        const auto complete = open_stream(folder / "copy", *format, identity, true);
        CHECK(complete->is_complete());
        CHECK(complete->units_done() == 25);
        CHECK(complete->rows_done() == rows_before(25));
        complete->finish();
        CHECK(read_file(folder / "copy") == wanted);
        // another file of the same size took its name
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
    const RecordFormat& csv = *find_record_format("csv");
    const StreamIdentity identity = identity_of(90, 2, 3);
    const std::string path = folder / "out";
    {
        const auto stream = open_stream(path, csv, identity);
        append_units(*stream, csv, identity, 10);
        stream->suspend();
    }
    const auto refused = [&](const RecordFormat& format, const RecordLayout& layout,
                             const StreamIdentity& other) {
        return refusal([&] { record_file(path, format, layout, other, true); });
    };
    StreamIdentity other = identity;
    other.request = "other";
    CHECK_THAT(
        refused(csv, sample_layout(), other),
        Equals(path + ": its .part belongs to another request: rerun without --resume to start "
                      "over, or name another file"));
    other = identity;
    other.simd = "baseline";
    CHECK_THAT(refused(csv, sample_layout(), other), Contains("set IRIDO_SIMD=avx2"));
    other = identity;
    other.build.commit = "0123456789ab";
    CHECK_THAT(refused(csv, sample_layout(), other),
               Equals(path + ": its .part was written by irido " + version_text(this_build()) +
                      ", this is " + this_build().version +
                      " (0123456789ab), whose numbers may differ: rerun without --resume to start "
                      "over, or name another file"));
    CHECK_THAT(refused(csv, sample_layout(), identity_of(90, 3, 3)),
               Contains("its .part is shard 2 of 3, not shard 3 of 3"));
    CHECK_THAT(refused(csv, sample_layout(), identity_of(90, 2, 4)), Contains("not shard 2 of 4"));
    CHECK_THAT(refused(csv, sample_layout(), identity_of(91, 2, 3)), Contains("another request"));
    CHECK_THAT(refused(*find_record_format("json"), sample_layout(), identity),
               Contains("its .part is csv, not json"));
    RecordLayout layout = sample_layout();
    layout[1].width += 1;
    CHECK_THAT(refused(csv, layout, identity), Contains("another request"));
    CHECK(open_stream(path, csv, identity, true)->units_done() == 10);
    // started over without --resume
    CHECK(open_stream(path, csv, identity_of(91))->units_done() == 0);
}
