#include "core/color/color_tables.hpp"

#include <catch2/catch.hpp>

#include "core/colorimetry/illuminant.hpp"

using namespace irido;

TEST_CASE("rules are cached after others have filled the cache", "[color][regression]") {
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    const std::size_t degree = kDegrees.back();
    double last_nm = 400;
    for (std::size_t numbers = 0; numbers <= 2 * ColorTables::kMostNumbers; last_nm += 0.01)
        numbers += 4 * tables.rule({last_nm, last_nm + 1}, degree)->weights.size();
    const auto rule = tables.rule({400, 780}, 16);
    CHECK(tables.rule({400, 780}, 16) == rule);
}
