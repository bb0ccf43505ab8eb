#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::StartsWith;

TEST_CASE("a table on standard output is the table, not its companion", "[tables][lut]") {
    const Outcome csv = run_irido({"lut", "cumulative", "-w", "500,600"});
    CHECK(csv.status == 0);
    CHECK_THAT(csv.out, StartsWith("wavelength_nm,X,Y,Z\n500,"));
    CHECK(parse_csv(csv.out).size() == 3);
    const Outcome raw = run_irido({"lut", "cumulative", "-w", "500,600", "--format", "bin"});
    CHECK(raw.out.size() == std::size_t{2} * 3 * 4);
}
