#include <catch2/catch.hpp>

#include "tests/support/sample_luts.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;

TEST_CASE("bin is the levels one after the other", "[tables][lut]") {
    Lut lut = sample_lut(LutType::f32, 1, {2, 2}, true);
    lut.values = {1, 2, 3};
    CHECK(files_of(lut, "bin").bytes == std::string("\0\0\x80\x3F\0\0\0\x40\0\0\x40\x40", 12));
}
