#include <catch2/catch.hpp>

#include "tables/lut/lut_values.hpp"
#include "tests/support/sample_luts.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;
using Catch::Matchers::Contains;

TEST_CASE("csv has a line a sample and says each level's samples", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f16, 2, {2, 2, 2}, true);
    lut.values = {1, 2, 3, 4, 5, 6, 7, 0.1, 9, 10};
    lut.axes[1].values = {0, 1};
    lut.axes[2].values = {5, 10};
    const Files files = files_of(lut, "csv");
    CHECK(files.bytes ==
          "a,b_nm,c,v0,v1\n0.1,0,5,1,2\n0.1,0,10,3,4\n0.1,1,5,5,6\n0.1,1,10,7,0.0999755859375\n"
          "0.43333333333333335,0,5,9,10\n");
    CHECK(files.companion.back() == '\n');
}

TEST_CASE("a spreadsheet's line ends and blanks do not matter to csv", "[tables][lut]") {
    const Lut lut = sample_lut(LutType::f32, 2, {3});
    Files files = files_of(lut, "csv");
    std::string changed;
    for (const char c : files.bytes) changed += c == '\n' ? std::string("\r\n") : std::string(1, c);
    CHECK(find_lut_format("csv")->read(changed, files.companion).values == lut.values);
}

TEST_CASE("csv says in which line it is not the table", "[tables][lut]") {
    const Files files = files_of(sample_lut(LutType::f16, 1, {3}), "csv");
    const auto words = [&](const std::string& from, const std::string& to) {
        std::string bytes = files.bytes;
        bytes.replace(bytes.find(from), from.size(), to);
        return refusal([&] { find_lut_format("csv")->read(bytes, files.companion); });
    };
    const std::string last =
        files.bytes.substr(files.bytes.rfind('\n', files.bytes.size() - 2) + 1);
    CHECK_THAT(words("a,v0", "a,v1"), Contains("the first line must match the metadata: a,v0"));
    CHECK_THAT(words(last, ""), Contains("ends after 2 of 3 rows"));
    CHECK_THAT(words(last, last + last), Contains("line 5: is after the last row of the table"));
    CHECK_THAT(words("0.1,-0", "0.2,-0"), Contains("line 2: the value of a"));
    CHECK_THAT(words("0.1,-0", "0.1,nan"), Contains("line 2: 'nan' is not a finite number"));
    CHECK_THAT(words("0.1,-0", "0.1,0.1"),
               Contains("line 2: the value of v0 is not an f16 number"));
    CHECK_THAT(words("0.1,-0", "0.1"), Contains("line 2: has too few numbers"));
    CHECK_THAT(words("0.1,-0", "0.1,-0,1"), Contains("line 2: has too many numbers"));
}
