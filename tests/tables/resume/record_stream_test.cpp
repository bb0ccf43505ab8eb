#include "tables/resume/record_stream.hpp"

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

TEST_CASE("a stream's file does not depend on its blocks", "[tables][stream]") {
    const TemporaryFolder folder;
    for (const RecordFormat* const format : record_formats())
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

TEST_CASE("a stream that is killed again and again ends with the same bytes",
          "[tables][stream][slow]") {
    for (const RecordFormat* const format : record_formats())
        for (const std::uint64_t shards : {1, 2}) {
            const TemporaryFolder folder;
            const StreamIdentity identity = identity_of(30000, 1, shards);
            const std::string path = folder / "out";
            write_stream(folder / "wanted", *format, identity);
            const std::string wanted = read_file(folder / "wanted");
            std::mt19937 random(static_cast<unsigned>(shards));
            int killed = 0, finished = 0, wrong = 0, failed = 0;
            while (killed < kills() / 2 || finished == 0) {
                // mostly while rows are written, sometimes while the file is finished
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

TEST_CASE("files that are not the program's are left alone", "[tables][stream]") {
    const TemporaryFolder folder;
    const RecordFormat& csv = *find_record_format("csv");
    for (const bool resume : {false, true}) {
        write_text(folder / "out.sweep", "chimney\n");
        CHECK_THAT(refusal([&] { open_stream(folder / "out", csv, identity_of(9), resume); }),
                   Contains("out.sweep: is not a journal of irido sweep"));
        CHECK(read_file(folder / "out.sweep") == "chimney\n");
        fs::remove(folder / "out.sweep");
        write_text(folder / "out.part", "half");
        CHECK_THAT(refusal([&] { open_stream(folder / "out", csv, identity_of(9), resume); }),
                   Contains("out.part: exists but has no journal"));
        CHECK(read_file(folder / "out.part") == "half");
        CHECK(names_in(folder.path()) == std::vector<std::string>{"out.part"});
        fs::remove(folder / "out.part");
        // a link planted by somebody else is not followed
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
            record_file(folder / "out", *find_record_format(format), layout, identity_of(9), false);
        });
    };
    CHECK_THAT(begun("h5"), StartsWith("h5: a column cannot be named 'R/T'"));
    CHECK(names_in(folder.path()).empty());
    CHECK(begun("csv").empty());  // left, as after a kill, and kept if another cannot begin
    CHECK(!begun("h5").empty());
    CHECK(names_in(folder.path()) == std::vector<std::string>{"out.part", "out.sweep"});
}

TEST_CASE("one process writes a stream, another is refused", "[tables][stream]") {
    const TemporaryFolder folder;
    const RecordFormat& csv = *find_record_format("csv");
    const StreamIdentity identity = identity_of(20);
    fs::create_symlink("out", folder / "link");
    write_text(folder / "out", "old");
    {
        const auto stream = open_stream(folder / "out", csv, identity);
        for (const char* const name : {"out", "link"})
            CHECK_THAT(refusal([&] { open_stream(folder / name, csv, identity, true); }),
                       Equals(folder / name + ": is being written by another irido process"));
        stream->discard();
    }
    CHECK(read_file(folder / "out") == "old");
    CHECK(names_in(folder.path()) == std::vector<std::string>{"link", "out"});
    write_stream(folder / "out", csv, identity);
}

TEST_CASE("processes that want one file at once do no harm", "[tables][stream]") {
    const TemporaryFolder folder;
    const RecordFormat& csv = *find_record_format("csv");
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
    const pid_t other = fork();  // from this thread: a child may inherit locks held by others
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
    const RecordFormat& csv = *find_record_format("csv");
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
    const RecordFormat& csv = *find_record_format("csv");
    const auto refused = [&](const std::string& path, bool resume = false) {
        return refusal([&] { open_stream(path, csv, identity_of(9), resume); });
    };
    write_text(folder / "file", "");
    fs::create_directory(folder / "folder");
    CHECK_THAT(refused(folder / "file/out"), StartsWith(folder / "file/out: cannot be written: "));
    CHECK_THAT(refused("/proc/irido.csv"), StartsWith("/proc/irido.csv: cannot be written: "));
    CHECK_THAT(refused(folder / "folder"), Contains("Is a directory"));
    CHECK_THAT(refused("/dev/null", true), Contains("must be a regular file for --resume"));
    CHECK_THAT(
        refusal([&] { open_stream("/dev/null", *find_record_format("h5"), identity_of(9)); }),
        Contains("must be a regular file for h5"));
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
    for (const RecordFormat* const format : record_formats())
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
    const RecordFormat& h5 = *find_record_format("h5");
    const StreamIdentity identity = identity_of(2000);
    const std::size_t rows_bytes = rows_before(2000) * 48;
    const int status = in_child([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const auto stream = open_stream(folder / "out", h5, identity);
        append_units(*stream, h5, identity, 2000);
        const rlimit most{rows_bytes, rows_bytes};  // its own head no longer fits
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
    for (const RecordFormat* const format : record_formats()) {
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
    CHECK_THAT(refusal([&] { write_stream("/dev/null", *find_record_format("npy"), identity); }),
               Contains("its header announces a different number of rows"));
    write_stream("/dev/null", *find_record_format("csv"), identity);
}

TEST_CASE("standard output gets the same bytes", "[tables][stream]") {
    const TemporaryFolder folder;
    const StreamIdentity identity = identity_of(100);
    for (const RecordFormat* const format : record_formats()) {
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
    CHECK_THAT(refusal([&] { record_output(*find_record_format("h5"), sample_layout(), 0); }),
               Equals("--format: h5 requires --output FILE"));
    const int terminal = in_child([&] {
        const int master = posix_openpt(O_RDWR | O_NOCTTY);
        if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) return 1;
        dup2(open(ptsname(master), O_RDWR | O_NOCTTY), STDOUT_FILENO);
        const std::string said =
            refusal([&] { record_output(*find_record_format("npy"), sample_layout(), 0); });
        return said.find("must not go to a terminal") == std::string::npos ? 2 : 0;
    });
    CHECK(terminal == 0);
    const int closed = in_child([&] {
        std::signal(SIGPIPE, SIG_IGN);
        int ends[2];
        if (pipe(ends) != 0) return 1;
        close(ends[0]);
        dup2(ends[1], STDOUT_FILENO);
        try {
            record_output(*find_record_format("csv"), sample_layout(), 0)->finish();
        } catch (const BrokenPipe&) {
            return 0;
        }
        return 2;
    });
    CHECK(closed == 0);
}
