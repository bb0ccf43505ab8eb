#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <random>
#include <sstream>

#include "tables/files/atomic_file.hpp"
#include "tables/resume/record_stream.hpp"
#include "tests/support/program.hpp"
#include "tests/support/sample_records.hpp"

namespace irido::test {

using namespace tables;

/// Unit u has u % 3 rows.
inline std::uint64_t rows_before(std::uint64_t unit) {
    return unit / 3 * 3 + (unit % 3 == 2 ? 1 : 0);
}

inline StreamIdentity identity_of(std::uint64_t total, std::uint64_t shard = 1,
                                  std::uint64_t shards = 1) {
    return {
        "request", "avx2",    shard, shards, total * (shard - 1) / shards, total * shard / shards,
        total,     shards > 1};
}

/// Appends one block.
/// stream    the stream
/// format    format of its rows
/// identity  identity of the stream
/// count     number of units in the block
inline void append_units(RecordStream& stream, const RecordFormat& format,
                         const StreamIdentity& identity, std::uint64_t count) {
    const std::uint64_t first = identity.begin + stream.units_done();
    const std::uint64_t row = rows_before(first), rows = rows_before(first + count) - row;
    stream.append(format.rows(sample_layout(), sample_rows(row, rows)), count, rows);
}

/// Appends blocks of up to `most` units until the stream has the first `until` units.
/// stream    the stream
/// format    format of its rows
/// identity  identity of the stream
/// until     unit to stop at
/// random    source of block sizes
/// most      largest number of units per block
inline void append_until(RecordStream& stream, const RecordFormat& format,
                         const StreamIdentity& identity, std::uint64_t until, std::mt19937& random,
                         std::uint64_t most = 40) {
    while (stream.units_done() < until)
        append_units(stream, format, identity,
                     std::min(1 + random() % most, until - stream.units_done()));
}

/// The bytes of units [0, total) written at once.
inline std::string whole(const RecordFormat& format, std::uint64_t total) {
    const std::uint64_t rows = rows_before(total);
    const Records all = sample_rows(0, rows);
    if (!format.is_binary) return written(format, all);
    const std::string packed = format.rows(sample_layout(), all);
    if (!format.finish) return format.head(sample_layout(), rows, HeadKind::open) + packed;
    const TemporaryFolder folder;
    write_text(folder / "part", packed);
    format.finish(sample_layout(), rows, folder / "part", folder / "whole");
    return read_file(folder / "whole");
}

/// Opens a file for sample rows.
/// path      the file
/// format    format of the rows
/// identity  identity of the stream
/// resume    continue an unfinished part
inline std::unique_ptr<RecordStream> open_stream(const std::string& path,
                                                 const RecordFormat& format,
                                                 const StreamIdentity& identity,
                                                 bool resume = false) {
    return record_file(path, format, sample_layout(), identity, resume);
}

/// Writes a file with all units.
/// path      the file
/// format    format of the rows
/// identity  identity of the stream
/// resume    continue an unfinished part
inline void write_stream(const std::string& path, const RecordFormat& format,
                         const StreamIdentity& identity, bool resume = false) {
    std::mt19937 random(7);
    const auto stream = open_stream(path, format, identity, resume);
    append_until(*stream, format, identity, identity.end - identity.begin, random);
    stream->finish();
}

/// Runs `work` in a child process; if `microseconds` is not negative, the child is killed that long
/// after its start. Returns its status: 0, or the result of `work`, 99 for an exception, -1 if it
/// was killed.
inline int in_child(const std::function<int()>& work, int microseconds = -1) {
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

inline std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(folder))
        names.push_back(file.path().filename().string());
    std::ranges::sort(names);
    return names;
}

/// The message of the OutputError thrown by `run`, "" if none.
inline std::string refusal(const std::function<void()>& run) {
    try {
        run();
    } catch (const OutputError& error) {
        return error.what();
    }
    return "";
}

/// Number of kills per format.
inline int kills() {
    const char* const text = std::getenv("IRIDO_TEST_KILLS");
    if (text) return std::atoi(text);
#ifdef __SANITIZE_ADDRESS__
    return 20;  // forking such a large process is slow
#else
    return 100;
#endif
}

}  // namespace irido::test
