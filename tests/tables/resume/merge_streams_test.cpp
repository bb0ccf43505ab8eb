#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>

#include "tables/files/atomic_file.hpp"
#include "tables/resume/record_stream.hpp"
#include "tests/support/program.hpp"
#include "tests/support/sample_streams.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;
using Catch::Contains;
using Catch::Equals;
using Catch::StartsWith;
namespace fs = std::filesystem;

namespace {

/// Two rows per unit, but none in the first ten units.
void write_shard(const std::string& path, const RecordFormat& format,
                 const StreamIdentity& identity, const RecordLayout& layout = sample_layout()) {
    const auto stream = record_file(path, format, layout, identity, false);
    for (std::uint64_t unit = identity.begin; unit < identity.end; ++unit) {
        const std::uint64_t rows = unit < 10 ? 0 : 2;
        Records records = sample_rows(2 * unit, rows);
        records.columns.resize(layout.size());
        stream->append(format.rows(layout, records), 1, rows);
    }
    stream->finish();
}

/// The shards of a sweep in a folder, 1.csv and so on.
struct Shards {
    TemporaryFolder folder;
    const RecordFormat& format;
    std::vector<std::string> paths;

    explicit Shards(const RecordFormat& of, std::uint64_t total = 47, std::uint64_t count = 3)
        : format(of) {
        for (std::uint64_t shard = 1; shard <= count; ++shard) {
            paths.push_back(folder / (std::to_string(shard) + "." + std::string(format.name)));
            write_shard(paths.back(), format, identity_of(total, shard, count));
        }
    }
    std::string merged() const {
        merge_streams(paths, folder / "merged", format);
        return read_file(folder / "merged");
    }
    std::string refused() const {
        try {
            merge_streams(paths, folder / "merged", format);
        } catch (const OutputError& error) {
            CHECK_FALSE(fs::exists(folder / "merged"));
            for (const auto& file : fs::directory_iterator(folder.path()))
                CHECK(file.path().string().find("merged") == std::string::npos);
            return error.what();
        }
        return "";
    }
};

}  // namespace

TEST_CASE("merged shards are the bytes of one run", "[tables][stream]") {
    for (const RecordFormat* const format : record_formats())
        for (const std::uint64_t total : {0, 11, 47}) {
            const TemporaryFolder folder;
            write_shard(folder / "one", *format, identity_of(total));
            for (const std::uint64_t count : {2, 3, 7}) {
                INFO(format->name << " " << total << " in " << count);
                Shards shards(*format, total, count);
                std::ranges::reverse(shards.paths);
                std::rotate(shards.paths.begin(), shards.paths.begin() + 1, shards.paths.end());
                CHECK(shards.merged() == read_file(folder / "one"));
            }
        }
}

TEST_CASE("a merging of long HDF5 shards", "[tables][stream][slow]") {
    const TemporaryFolder folder;
    const RecordFormat& h5 = *find_record_format("h5");
    constexpr std::uint64_t rows = 1200000;  // a column of a shard is larger than a buffer
    const RecordLayout layout{sample_layout()[0]};
    Records all = sample_rows(0, rows);
    all.columns.resize(1);
    for (const std::uint64_t shards : {1U, 2U})
        for (std::uint64_t shard = 1; shard <= shards; ++shard) {
            const std::uint64_t count = rows / shards;
            const std::string path =
                folder / (std::to_string(shard) + "of" + std::to_string(shards));
            const auto stream = record_file(path, h5, layout, identity_of(2, shard, shards), false);
            auto& values = std::get<Column::Numbers>(all.columns[0].values);
            Records part = all;
            std::get<Column::Numbers>(part.columns[0].values)
                .assign(values.begin() + static_cast<std::ptrdiff_t>(count * (shard - 1)),
                        values.begin() + static_cast<std::ptrdiff_t>(count * shard));
            stream->append(h5.rows(layout, part), 2 / shards, count);
            stream->finish();
        }
    merge_streams({folder / "2of2", folder / "1of2"}, folder / "merged", h5);
    CHECK(read_file(folder / "merged") == read_file(folder / "1of1"));
}

TEST_CASE("a merging replaces a file and writes to a device", "[tables][stream]") {
    const Shards shards(*find_record_format("csv"));
    write_text(shards.folder / "merged", "old");
    fs::permissions(shards.folder / "merged", fs::perms(0600));
    const std::string bytes = shards.merged();
    CHECK(fs::status(shards.folder / "merged").permissions() == fs::perms(0600));
    merge_streams(shards.paths, "/dev/null", shards.format);
    CHECK_THROWS_WITH(merge_streams(shards.paths, "/dev/full", shards.format),
                      Equals("/dev/full: cannot be written: No space left on device"));
    const Shards h5(*find_record_format("h5"));
    CHECK_THROWS_WITH(merge_streams(h5.paths, "/dev/null", h5.format),
                      Contains("must be a regular file"));
}

TEST_CASE("shards of different numbers are refused", "[tables][stream][refused]") {
    const Shards shards(*find_record_format("json"));
    const std::string &first = shards.paths[0], &second = shards.paths[1];
    StreamIdentity identity = identity_of(47, 2, 3);
    identity.simd = "baseline";
    write_shard(second, shards.format, identity);
    CHECK_THAT(shards.refused(), StartsWith(second + ": was computed at SIMD level baseline, " +
                                            first + " at avx2") &&
                                     Contains("IRIDO_SIMD"));
    for (const Build& build :
         {Build{"0.0.9", this_build().commit}, Build{this_build().version, "0123456789ab"},
          Build{this_build().version, "0123456789ab-dirty-01234567"}}) {
        identity = identity_of(47, 2, 3);
        identity.build = build;
        write_shard(second, shards.format, identity);
        CHECK_THAT(shards.refused(),
                   Equals(second + ": was written by irido " + version_text(build) + ", " + first +
                          " by " + version_text(this_build()) +
                          ", whose numbers may differ: run all shards with the same build"));
    }
}

TEST_CASE("shards that were edited are refused", "[tables][stream][refused]") {
    for (const RecordFormat* const format : record_formats()) {
        INFO(format->name);
        const Shards shards(*format);
        const std::string& path = shards.paths[2];
        const std::string bytes = read_file(path);
        const std::string said = path + ": does not match its journal: rerun it";
        std::string digit = bytes;
        digit[bytes.size() - 12] ^= 1;
        write_text(path, digit);
        CHECK_THAT(shards.refused(), Equals(said));
        if (format->name == "csv") {  // two lines swapped
            const std::size_t second = bytes.find('\n') + 1, third = bytes.find('\n', second) + 1;
            const std::size_t end = bytes.find('\n', third) + 1;
            write_text(path, bytes.substr(0, second) + bytes.substr(third, end - third) +
                                 bytes.substr(second, third - second) + bytes.substr(end));
            CHECK_THAT(shards.refused(), Equals(said));
        }
        // the run repeated, from scratch or resumed
        const StreamIdentity identity = identity_of(47, 3, 3);
        CHECK_FALSE(record_file(path, *format, sample_layout(), identity, true)->is_complete());
        write_shard(path, *format, identity);
        CHECK(read_file(path) == bytes);
        CHECK(record_file(path, *format, sample_layout(), identity, true)->is_complete());
        CHECK(!shards.merged().empty());
    }
}

TEST_CASE("a single shard is merged, too", "[tables][stream]") {
    for (const RecordFormat* const format : record_formats()) {
        INFO(format->name);
        Shards shards(*format, 47, 1);
        CHECK_THAT(shards.refused(), Contains("it has no journal"));
        StreamIdentity identity = identity_of(47);
        identity.is_shard = true;
        write_shard(shards.paths[0], *format, identity);
        CHECK(shards.merged() == read_file(shards.paths[0]));
    }
}

TEST_CASE("shards that are not one whole are refused", "[tables][stream]") {
    for (const RecordFormat* const format : record_formats()) {
        INFO(format->name);
        Shards shards(*format);
        const auto path = [&](std::size_t i) { return shards.paths[i - 1]; };
        const auto with = [&](std::size_t i, StreamIdentity identity) {
            write_shard(path(i), *format, identity);
            const std::string said = shards.refused();
            write_shard(path(i), *format, identity_of(47, i, 3));
            return said;
        };
        StreamIdentity other = identity_of(47, 3, 3);
        other.request = "other";
        CHECK_THAT(with(3, other),
                   Equals(path(3) + ": belongs to another request than " + path(1)));
        CHECK_THAT(with(2, identity_of(48, 2, 3)), Contains("belongs to another request"));
        CHECK_THAT(with(2, identity_of(47, 2, 4)),
                   Equals(path(2) + ": is one of 4 shards, " + path(1) + " one of 3"));
        CHECK_THAT(with(3, identity_of(47, 2, 3)),
                   Equals(path(2) + " and " + path(3) + ": are both shard 2 of 3"));
        other = identity_of(47, 2, 3);
        ++other.begin;
        CHECK_THAT(with(2, other), Equals(path(2) + ": begins at unit 16, expected 15"));
        other = identity_of(47, 3, 3);
        --other.end;
        CHECK_THAT(with(3, other), Equals(path(3) + ": ends at unit 46, expected 47"));
        const std::vector<std::string> all = shards.paths;
        shards.paths = {path(1), path(3)};
        CHECK_THAT(shards.refused(), Equals("shard 2 of 3 is missing"));
        shards.paths = {all[1], all[0]};
        CHECK_THAT(shards.refused(), Equals("shard 3 of 3 is missing"));
        shards.paths = {};
        CHECK_THAT(shards.refused(), Contains("no shards"));
        shards.paths = all;
        for (const RecordFormat* const another : record_formats())
            if (another != format)
                CHECK_THROWS_WITH(merge_streams(all, shards.folder / "merged", *another),
                                  Equals(path(1) + ": must be " + std::string(another->name) +
                                         " as the output (got " + std::string(format->name) + ")"));
        for (const std::string& target :
             {all[1], shards.folder / "." + "/" + fs::path(all[2]).filename().string()})
            CHECK_THROWS_WITH(merge_streams(all, target, *format),
                              Equals(target + ": is one of the shards: name another file"));
        CHECK(!shards.merged().empty());
    }
}

TEST_CASE("shards that are not finished or not their own are refused", "[tables][stream]") {
    for (const RecordFormat* const format : record_formats()) {
        INFO(format->name);
        const Shards shards(*format);
        const std::string& path = shards.paths[1];
        const std::string bytes = read_file(path), journal = read_file(path + ".sweep");
        const std::string not_finished = path + ": is incomplete: rerun it with --resume";
        for (const std::string& less :
             {std::string(), journal.substr(0, 20), journal.substr(0, journal.find('\n') + 1),
              journal.substr(0, journal.rfind("complete")),
              journal.substr(0, journal.size() - 1)}) {
            write_text(path + ".sweep", less);
            CHECK_THAT(shards.refused(), Equals(not_finished));
        }
        {
            const auto stream =
                record_file(path, *format, sample_layout(), identity_of(47, 2, 3), false);
            CHECK_THAT(shards.refused(), Equals(not_finished));
            stream->discard();
        }
        CHECK_THAT(shards.refused(), Contains("is not a shard of irido sweep"));
        write_text(path + ".sweep", "chimney");
        CHECK_THAT(shards.refused(), Contains("is not a journal of irido sweep"));
        write_text(path + ".sweep", journal);
        const std::string not_itself = path + ": does not match its journal";
        for (const std::string& other :
             {bytes + "x", bytes.substr(1), std::string(bytes.size(), 'x')}) {
            write_text(path, other);
            CHECK_THAT(shards.refused(), Contains(not_itself));
        }
        fs::remove(path);
        CHECK_THAT(shards.refused(), Contains(not_itself));
        write_text(path, bytes);
        CHECK(!shards.merged().empty());
    }
}
