#include "core/math/simd_level.hpp"

#include <catch2/catch.hpp>

#include "tests/support/simd_levels.hpp"

using namespace irido;

TEST_CASE("tests name the levels that their machine lacks") {
    CHECK(lacking_levels([](SimdLevel) { return true; }) == "");
    CHECK(lacking_levels([](SimdLevel level) { return level <= SimdLevel::baseline; }) ==
          "not run: avx2, avx512 (instructions that this machine lacks)");
}

TEST_CASE("every machine runs the plain kernel and the baseline") {
    CHECK(is_available(SimdLevel::plain));
    CHECK(is_available(SimdLevel::baseline));
    CHECK(is_available(best_simd_level()));
    const std::vector<SimdLevel> all = tested_levels(), vector = tested_vector_levels();
    CHECK(all.size() == vector.size() + 1);
    CHECK(vector.back() == best_simd_level());
}
