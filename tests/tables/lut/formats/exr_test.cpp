#include <catch2/catch.hpp>

#include "tests/support/sample_luts.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;

TEST_CASE("exr names its channels as its readers want them", "[tables][lut]") {
    const auto has_channel = [](std::size_t channels, const char* name) {
        const std::string bytes = files_of(sample_lut(LutType::f16, channels, {2, 2}), "exr").bytes;
        // an entry in the list of channels: name, NUL, type 1 (half), ...
        return bytes.find(std::string(name) + std::string("\0\1\0\0\0", 5)) != std::string::npos;
    };
    CHECK(has_channel(1, "Y"));
    CHECK_FALSE(has_channel(1, "R"));
    for (const std::size_t channels : {2, 3, 4, 6})
        for (const char* name : {"R", "G", "B"}) CHECK(has_channel(channels, name));
    CHECK(has_channel(4, "A"));
    CHECK_FALSE(has_channel(3, "A"));
}

TEST_CASE("exr says in attributes what it holds", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f16, 6, {3, 2, 2});
    const std::string bytes = files_of(lut, "exr").bytes;
    CHECK(bytes.find(std::string("irido.kind\0string\0\6\0\0\0sample", 28)) != std::string::npos);
    CHECK(bytes.find("irido.error") != std::string::npos);
    CHECK(bytes.find("\"blocks\":2") != std::string::npos);
    CHECK(bytes.find("\"stacked\":3") != std::string::npos);
    CHECK(bytes.find("chromaticities") != std::string::npos);
    for (const char* space : {"xyz", "other"}) {
        lut.facts["color_space"] = space;
        CHECK(files_of(lut, "exr").bytes.find("chromaticities") == std::string::npos);
    }
    lut.facts.erase("error");
    CHECK(files_of(lut, "exr").bytes.find("irido.error") == std::string::npos);
}

TEST_CASE("one slice is not stacked", "[tables][lut]") {
    const Lut lut = sample_lut(LutType::f16, 1, {1, 4, 8});
    const std::string bytes = files_of(lut, "exr").bytes;
    CHECK(bytes.find("stacked") == std::string::npos);
    CHECK(find_lut_format("exr")->read(bytes, "").values == lut.values);
}
