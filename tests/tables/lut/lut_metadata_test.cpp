#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tables/lut/lut_metadata.hpp"
#include "tables/lut/lut_values.hpp"
#include "tests/support/sample_luts.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

/// The error for a sample's metadata with one value replaced.
std::string refusal_with(const std::string& pointer, const json& value) {
    json metadata = metadata_of(sample_lut(LutType::f32, 3, {4, 3}));
    metadata[json::json_pointer(pointer)] = value;
    return refusal([&] { lut_from_metadata(metadata.dump()); });
}

}  // namespace

TEST_CASE("metadata is one line with sorted keys and reads back the table", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f16, 3, {4, 3, 2}, true);
    lut.axes[0].values = {0, 1, 3, 7};
    const std::string text = metadata_text(lut);
    CHECK(text.find('\n') == std::string::npos);
    CHECK(text == json::parse(text).dump());
    const Lut read = lut_from_metadata(text);
    CHECK(read.kind == "sample");
    CHECK(read.axes == lut.axes);
    CHECK(read.channels == lut.channels);
    CHECK(read.mips);
    CHECK(read.type == LutType::f16);
    CHECK(read.values.empty());
    const json metadata = json::parse(text);
    CHECK(metadata["axes"][0]["values"] == json({0.0, 1.0, 3.0, 7.0}));
    CHECK_FALSE(metadata["axes"][1].contains("values"));
    CHECK(metadata["irido"] == read.facts["irido"]);
    CHECK(metadata["checksum"] == checksum_of(lut));
}

TEST_CASE("what nobody said is null or empty, and mips are named only if there are any",
          "[tables][lut]") {
    Lut lut = sample_lut(LutType::f32, 1, {2});
    lut.facts = nullptr;
    const json metadata = metadata_of(lut);
    CHECK(metadata["error"].is_null());
    CHECK(metadata["notes"] == json::array());
    CHECK_FALSE(metadata.contains("mips"));
    CHECK_FALSE(metadata.contains("color_space"));
}

TEST_CASE("equally spaced axes are written in their canonical form", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f32, 1, {4});
    lut.axes[0].values = {0, 0.1, 0.2, 0.1 + 0.2};  // the last is not 0.3
    const Lut read = lut_from_metadata(metadata_text(lut));
    CHECK(read.axes[0].values == equally_spaced(0, 0.1 + 0.2, 4));
    CHECK(read.axes[0].values == samples_of(lut.axes[0]));
}

TEST_CASE("the checksum is that of the values as little-endian numbers", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f16, 1, {2});
    lut.values = {1, -2};  // 00 3C 00 C0
    CHECK(value_bytes(lut) == std::string("\x00\x3C\x00\xC0", 4));
    // printf '\x00\x3c\x00\xc0' | sha256sum
    CHECK(checksum_of(lut) ==
          "sha256:0c82e2008d4b1c37a2604f1dee0db584daf39b6ab140aaa834d3eac1df0b9458");
}

TEST_CASE("halves are the IEEE 754 binary16 of the value", "[tables][lut]") {
    const auto bits = [](double value) {
        std::string bytes;
        append_bytes(bytes, value, LutType::f16);
        return static_cast<unsigned>(static_cast<unsigned char>(bytes[0])) |
               static_cast<unsigned>(static_cast<unsigned char>(bytes[1])) << 8U;
    };
    CHECK(bits(1) == 0x3C00);
    CHECK(bits(-0.0) == 0x8000);
    CHECK(bits(65504) == 0x7BFF);
    CHECK(bits(65519.9) == 0x7BFF);
    CHECK(bits(65520) == 0x7C00);
    CHECK(bits(std::exp2(-14)) == 0x0400);
    CHECK(bits(std::exp2(-24)) == 0x0001);
    CHECK(bits(std::exp2(-25)) == 0x0000);  // halfway, to even
    CHECK(bits(3 * std::exp2(-25)) == 0x0002);
    CHECK(bits(1 + std::exp2(-11)) == 0x3C00);
    CHECK(bits(1 + 3 * std::exp2(-11)) == 0x3C02);
    for (unsigned half = 0; half < 0x10000; ++half) {
        const char bytes[2] = {static_cast<char>(half & 0xFFU), static_cast<char>(half >> 8U)};
        const double value = number_at(bytes, LutType::f16);
        if (std::isnan(value)) continue;
        if (rounded(value, LutType::f16) != value || bits(value) != half) FAIL(half);
    }
}

TEST_CASE("metadata that breaks a rule is refused by name", "[tables][lut]") {
    CHECK(refusal_with("/kind", "x").empty());
    CHECK_THAT(refusal_with("/kind", 3), Contains("/kind: must be the name"));
    CHECK_THAT(refusal_with("/kid", "x"), Contains("unknown key"));
    CHECK_THAT(refusal_with("/dtype", "f8"), Contains("/dtype: must be one of f16, f32, f64"));
    CHECK_THAT(refusal_with("/axes", json::array()), Contains("/axes: must be an array of 1 to 3"));
    CHECK_THAT(refusal_with("/axes/1/count", 0), Contains("/axes/1/count: must be a whole"));
    CHECK_THAT(refusal_with("/axes/1/count", 1e15), Contains("/axes/1/count: must be a whole"));
    CHECK_THAT(refusal_with("/axes/1/count", 2.5), Contains("/axes/1/count: must be a whole"));
    CHECK_THAT(refusal_with("/axes/1/mapping", "log"), Contains("must be one of linear, list"));
    CHECK_THAT(refusal_with("/axes/1/mapping", "list"),
               Contains("must have values exactly when its mapping is list"));
    CHECK_THAT(refusal_with("/axes/1/values", {1, 2, 3}),
               Contains("must have values exactly when its mapping is list"));
    CHECK_THAT(refusal_with("/axes/1/last", 0.1), Contains("strictly monotonic"));
    CHECK_THAT(refusal_with("/axes/1/name", "a"), Contains("two axes or channels are called 'a'"));
    CHECK_THAT(refusal_with("/axes/1/name", "b c"), Contains("cannot be called 'b c'"));
    CHECK_THAT(refusal_with("/channels/0", "v1"), Contains("two axes or channels"));
    CHECK_THAT(refusal_with("/error", {{"measure", "x"}}), Contains("/error: "));
    CHECK_THAT(refusal_with("/checksum", "sha256:12"), Contains("/checksum: must be"));
    CHECK_THAT(refusal([] { lut_from_metadata("{"); }), StartsWith("the metadata is damaged: 1:"));
    CHECK_THAT(refusal([] { lut_from_metadata("[]"); }), Contains("must be an object"));
}

TEST_CASE("facts that the schema forbids are refused before anything is written", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f32, 3, {4, 3});
    lut.facts["path"] = "/home";
    for (const LutFormat* format : lut_formats()) {
        INFO(format->name);
        CHECK_THAT(refusal([&] { format->write(lut, {}); }), Contains("path"));
    }
    lut.facts.erase("path");
    lut.facts["error"]["value"] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(refusal([&] { metadata_text(lut); }), Contains("/error/value"));
}

TEST_CASE("tables that no file could hold are refused", "[tables][lut]") {
    const auto refusal_of = [](auto change) {
        Lut lut = sample_lut(LutType::f32, 3, {4, 3});
        change(lut);
        return refusal([&] { check_values(lut); });
    };
    CHECK(refusal_of([](Lut&) {}).empty());
    CHECK_THAT(refusal_of([](Lut& l) { l.axes.clear(); }), Contains("1 to 3 axes"));
    CHECK_THAT(refusal_of([](Lut& l) { l.axes[0].values.clear(); }), Contains("samples (got 0)"));
    CHECK_THAT(refusal_of([](Lut& l) { l.channels.clear(); }), Contains("channels"));
    CHECK_THAT(refusal_of([](Lut& l) { l.axes[0].values[1] = 7; }),
               Contains("axis a must be finite and strictly monotonic"));
    CHECK_THAT(refusal_of([](Lut& l) { l.values.pop_back(); }), Contains("has 35 values"));
    CHECK_THAT(refusal_of([](Lut& l) {
                   l.mips = true;
                   l.axes.pop_back();
               }),
               Contains("mip levels need an axis"));
    CHECK_THAT(refusal_of([](Lut& l) {
                   l.mips = true;
                   l.axes[1].values[1] += 0.01;
               }),
               Contains("mip levels need equally spaced samples along b_nm"));
}
