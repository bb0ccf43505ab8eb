#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "tables/files/atomic_file.hpp"
#include "tables/lut/lut_values.hpp"
#include "tests/support/program.hpp"
#include "tests/support/sample_luts.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

bool bit_equal(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

struct Shape {
    std::vector<std::size_t> counts;
    bool mips = false;
};

const std::array kShapes{
    Shape{{1}, false},       Shape{{5}, false},   Shape{{40, 8}, false},   Shape{{1, 7}, false},
    Shape{{3, 4, 8}, false}, Shape{{3, 8}, true}, Shape{{4, 16, 8}, true}, Shape{{1, 4, 8}, false},
};

bool holds(const LutFormat& format, LutType type, const Shape& shape) {
    if (shape.mips && (format.name == "npy" || format.name == "exr")) return false;
    return type != LutType::f64 || (format.name != "ktx2" && format.name != "exr");
}

/// Every format with every layout possible for a table with this many axes.
struct Variant {
    const LutFormat* format;
    LutLayout layout;
};

std::vector<Variant> variants(const Shape& shape) {
    std::vector<Variant> result;
    for (const LutFormat* format : lut_formats()) {
        result.push_back({format, {}});
        if (format->name != "ktx2") continue;
        result.push_back({format, {true, false}});
        if (shape.counts.size() == 3 && !shape.mips) {
            result.push_back({format, {false, true}});
            result.push_back({format, {true, true}});
        }
    }
    return result;
}

}  // namespace

TEST_CASE("every format gives back every table that it holds, bit for bit", "[tables][lut]") {
    for (const LutType type : {LutType::f16, LutType::f32, LutType::f64})
        for (const std::size_t channels : {1, 2, 3, 4, 6})
            for (const Shape& shape : kShapes) {
                const Lut lut = sample_lut(type, channels, shape.counts, shape.mips);
                for (const auto& [format, layout] : variants(shape)) {
                    INFO(format->name << " " << name_of(type) << " " << channels << " channels, "
                                      << shape.counts.size() << " axes, mips " << shape.mips
                                      << " zstd " << layout.zstd << " layers " << layout.layers);
                    if (!holds(*format, type, shape)) {
                        CHECK_THROWS_AS(format->write(lut, layout), LutError);
                        continue;
                    }
                    const Files files = files_of(lut, *format, layout);
                    const Files again = files_of(lut, *format, layout);
                    CHECK(files.bytes == again.bytes);
                    CHECK(files.companion == again.companion);
                    const Lut read = format->read(files.bytes, files.companion);
                    CHECK(bit_equal(read.values, lut.values));
                    CHECK(metadata_of(read) == metadata_of(lut));
                    CHECK(lut_problems(read).empty());
                }
            }
}

TEST_CASE("values are stored rounded to the type", "[tables][lut]") {
    for (const LutType type : {LutType::f16, LutType::f32}) {
        Lut lut = sample_lut(type, 1, {3});
        lut.values = {0.1, -1.0 / 3, 60000.1};
        for (const LutFormat* format : lut_formats()) {
            INFO(format->name);
            const Files files = files_of(lut, *format);
            const Lut read = format->read(files.bytes, files.companion);
            for (std::size_t i = 0; i < 3; ++i)
                CHECK(read.values[i] == rounded(lut.values[i], type));
            CHECK(lut_problems(read).empty());
        }
    }
}

TEST_CASE("a value that the type cannot hold is refused with its place", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f16, 3, {4, 3});
    lut.values[3 * (3 * 1 + 2) + 1] = 70000;  // second of a, third of b_nm
    for (const LutFormat* format : lut_formats()) {
        INFO(format->name);
        CHECK(refusal([&] { format->write(lut, {}); }) ==
              "v1 at a = 0.2111111111111111, b_nm = 0.7666666666666666: beyond the range of f16 "
              "(got 70000)");
    }
    lut.type = LutType::f32;
    for (const double value : {1e39, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
        lut.values[0] = value;
        for (const LutFormat* format : lut_formats())
            CHECK_THAT(refusal([&] { format->write(lut, {}); }), Contains("v0 at a = 0.1"));
    }
}

TEST_CASE("formats refuse what they cannot hold, by name", "[tables][lut]") {
    const auto words = [](const char* format, const Lut& lut, LutLayout layout = {}) {
        return refusal([&] { files_of(lut, format, layout); });
    };
    const Lut plain = sample_lut(LutType::f32, 3, {4, 3});
    const Lut mips = sample_lut(LutType::f32, 3, {3, 8, 8}, true);
    CHECK_THAT(words("npy", mips), Contains("npy has no mip levels"));
    CHECK_THAT(words("exr", mips), Contains("exr has no mip levels"));
    CHECK_THAT(words("ktx2", sample_lut(LutType::f64, 3, {4})), Contains("not f64"));
    CHECK_THAT(words("exr", sample_lut(LutType::f64, 3, {4})), Contains("not f64"));
    for (const char* format : {"csv", "npy", "bin", "exr"}) {
        CHECK_THAT(words(format, plain, {true, false}),
                   Contains("does not support Zstandard compression"));
        CHECK_THAT(words(format, plain, {false, true}), Contains("does not support array layers"));
    }
    CHECK_THAT(words("ktx2", plain, {false, true}), Contains("array layers need"));
    CHECK_THAT(words("ktx2", sample_lut(LutType::f32, 5, {4})), Contains("a multiple of 3, not 5"));
    CHECK_THAT(words("exr", sample_lut(LutType::f32, 7, {4})), Contains("a multiple of 3, not 7"));
    CHECK_THAT(words("ktx2", sample_lut(LutType::f32, 1, {5, 8, 8}, true)),
               Contains("has no 5 mip levels"));
    CHECK_THAT(words("ktx2", sample_lut(LutType::f32, 6, {3, 8, 6}, true)),
               Contains("can be halved 2 times"));
    CHECK(words("ktx2", sample_lut(LutType::f32, 3, {3, 8, 6}, true)).empty());
}

TEST_CASE("truncated files are refused", "[tables][lut]") {
    for (const Shape& shape : {Shape{{40, 8}, false}, Shape{{3, 4, 8}, true}})
        for (const auto& [format, layout] : variants(shape)) {
            if (!holds(*format, LutType::f16, shape)) continue;
            const Files files =
                files_of(sample_lut(LutType::f16, 3, shape.counts, shape.mips), *format, layout);
            const std::size_t step = 1 + files.bytes.size() / 97;
            for (std::size_t length = 0; length < files.bytes.size() - 1; length += step) {
                INFO(format->name << " " << length);
                const std::string bytes = files.bytes.substr(0, length);
                CHECK_THROWS_AS(format->read(bytes, files.companion), LutError);
            }
            if (files.companion.empty()) continue;
            CHECK_THROWS_AS(format->read(files.bytes, ""), LutError);
            for (std::size_t length = 1; length < files.companion.size() - 2; length += 13)
                CHECK_THROWS_AS(format->read(files.bytes, files.companion.substr(0, length)),
                                LutError);
        }
}

TEST_CASE("files with altered bytes are refused or found by the checksum", "[tables][lut]") {
    std::mt19937_64 random(7);
    const auto below = [&](std::size_t limit) {
        return static_cast<std::size_t>(random() % limit);
    };
    for (const Shape& shape : {Shape{{20, 8}, false}, Shape{{3, 4, 8}, true}})
        for (const auto& [format, layout] : variants(shape)) {
            if (!holds(*format, LutType::f16, shape)) continue;
            const Lut lut = sample_lut(LutType::f16, 3, shape.counts, shape.mips);
            const Files files = files_of(lut, *format, layout);
            for (int round = 0; round < 300; ++round) {
                Files altered = files;
                const bool is_companion = !files.companion.empty() && round % 3 == 0;
                std::string& bytes = is_companion ? altered.companion : altered.bytes;
                const std::size_t reach =
                    round % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 400);
                for (std::size_t flips = 1 + below(3); flips > 0; --flips)
                    bytes[below(reach)] = static_cast<char>(random());
                INFO(format->name << " round " << round);
                try {
                    const Lut read = format->read(altered.bytes, altered.companion);
                    // a file that is read without complaint must have the values that were written
                    if (lut_problems(read).empty()) CHECK(value_bytes(read) == value_bytes(lut));
                } catch (const LutError& error) {
                    CHECK_FALSE(std::string(error.what()).empty());
                }
            }
        }
}

TEST_CASE("sizes in headers do not make memory", "[tables][lut]") {
    const Lut lut = sample_lut(LutType::f16, 1, {8, 8});
    for (const auto& [format, layout] : variants(Shape{{8, 8}})) {
        Files files = files_of(lut, *format, layout);
        const auto replace = [&](const std::string& from, const std::string& to) {
            for (std::string* bytes : {&files.bytes, &files.companion})
                for (std::size_t at = bytes->find(from); at != std::string::npos;
                     at = bytes->find(from))
                    bytes->replace(at, from.size(), to);
        };
        replace("\"count\":8,", "\"count\":999999,");  // 2 TB, if taken at face value
        replace("made by a test", "made");             // the same length as before
        INFO(format->name);
        CHECK_THROWS_AS(format->read(files.bytes, files.companion), LutError);
    }
}

TEST_CASE("foreign files are refused", "[tables][lut]") {
    const Files files = files_of(sample_lut(LutType::f16, 3, {4, 3}), "csv");
    for (const LutFormat* format : lut_formats())
        for (const std::string& bytes : {std::string("GIF89a"), std::string(1000, '\0'),
                                         std::string("\xABKTX 20\xBB\r\n\x1A\n"),
                                         std::string("\x76\x2F\x31\x01\x02\0\0\0", 8)}) {
            INFO(format->name);
            CHECK_THROWS_AS(format->read(bytes, files.companion), LutError);
        }
}

TEST_CASE("files are written with their companion and read by their extension", "[tables][lut]") {
    const TemporaryFolder folder;
    const Lut lut = sample_lut(LutType::f32, 3, {4, 3});
    for (const LutFormat* format : lut_formats()) {
        const std::string file = folder / "t." + std::string(format->name);
        write_lut(lut, file, *format, {});
        const Lut read = read_lut(file);
        CHECK(bit_equal(read.values, lut.values));
        CHECK(lut_problems(read).empty());
    }
    CHECK(std::filesystem::exists(folder / "t.bin.json"));
    CHECK_FALSE(std::filesystem::exists(folder / "t.exr.json"));
    std::filesystem::remove(folder / "t.npy.json");
    CHECK_THAT(refusal([&] { read_lut(folder / "t.npy"); }),
               Contains("t.npy: its companion file with the metadata"));
    CHECK_THAT(refusal([&] { read_lut(folder / "t.png"); }),
               Contains("must be one of .bin, .csv, .exr, .ktx2, .npy"));
}

TEST_CASE("a table that cannot be written leaves nothing", "[tables][lut]") {
    const TemporaryFolder folder;
    Lut lut = sample_lut(LutType::f32, 3, {4, 3});
    std::filesystem::create_directory(folder / "d.bin");
    CHECK_THROWS_AS(write_lut(lut, folder / "d.bin", *find_lut_format("bin"), {}), OutputError);
    CHECK_FALSE(std::filesystem::exists(folder / "d.bin.json"));
    lut.values[0] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(write_lut(lut, folder / "n.bin", *find_lut_format("bin"), {}), LutError);
    CHECK_FALSE(std::filesystem::exists(folder / "n.bin"));
    CHECK_FALSE(std::filesystem::exists(folder / "n.bin.json"));
}

TEST_CASE("problems of a table that was read are named", "[tables][lut]") {
    const Lut lut = sample_lut(LutType::f32, 1, {4});
    Files files = files_of(lut, "bin");
    files.bytes[0] = 1;
    const LutFormat& bin = *find_lut_format("bin");
    std::vector<std::string> problems = lut_problems(bin.read(files.bytes, files.companion));
    REQUIRE(problems.size() == 1);
    CHECK_THAT(problems[0], Contains("the checksum does not match the values"));
    files.bytes.replace(4, 4, std::string("\0\0\xC0\x7F", 4));
    problems = lut_problems(bin.read(files.bytes, files.companion));
    REQUIRE(problems.size() == 2);
    CHECK_THAT(problems[0], Contains("1 of the values must be finite, the first is v0 at a = "));
    CHECK_THAT(problems[0], Contains("(got nan)"));
}
