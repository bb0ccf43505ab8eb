#include <catch2/catch.hpp>
#include <cmath>

#include "core/math/simd_level.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

Outcome with_level(std::string_view level, const std::string& arguments) {
    return run_shell("IRIDO_SIMD=" + std::string(level) + " \"$IRIDO\" " + arguments,
                     IRIDO_SOURCE_DIR);
}

const std::string kRequest =
    "spectrum \"air | (TiO2@58.5 | Al@2)^3 | SiO2@120 | Au\" -w 400:700:13 -a 0,40,80 -p s,p";

}  // namespace

TEST_CASE("every instruction set gives the same spectrum to rounding", "[cli][simd]") {
    const auto expected = parse_csv(with_level("plain", kRequest).out);
    REQUIRE(expected.size() == 1 + 24 * 3 * 2);
    for (const SimdLevel level : kSimdLevels) {
        if (!is_available(level)) continue;
        CAPTURE(name_of(level));
        const Outcome outcome = with_level(name_of(level), kRequest);
        CHECK(outcome.status == 0);
        const auto rows = parse_csv(outcome.out);
        REQUIRE(rows.size() == expected.size());
        for (std::size_t row = 1; row < rows.size(); ++row)
            for (std::size_t c = 3; c < 6; ++c)
                CHECK(std::abs(std::stod(rows[row][c]) - std::stod(expected[row][c])) < 1e-14);
        CHECK_THAT(with_level(name_of(level), "--version").out,
                   Contains("SIMD " + std::string(name_of(level)) + "\n"));
        if (level != SimdLevel::plain)
            CHECK_THAT(with_level(name_of(level), kRequest + " --stats").err,
                       Contains("vectorized (" + std::string(name_of(level)) + "), 7 layers"));
    }
}

TEST_CASE("without IRIDO_SIMD the widest instruction set is used", "[cli][simd]") {
    const std::string widest(name_of(best_simd_level()));
    CHECK_THAT(run_irido({"--version"}).out, Contains("SIMD " + widest + "\n"));
    CHECK(with_level("", kRequest).out == with_level(widest, kRequest).out);
}

TEST_CASE("an unknown instruction set is refused in one line", "[cli][simd][refused]") {
    const Outcome outcome = with_level("sse9", kRequest);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err ==
          "irido: error: IRIDO_SIMD: must be one of plain, baseline, avx2, avx512 (got 'sse9')\n");
}

TEST_CASE("instructions that the machine lacks are replaced with a note", "[cli][simd]") {
    for (const SimdLevel level : kSimdLevels) {
        CAPTURE(name_of(level));
        const Outcome outcome = with_level(name_of(level), "spectrum \"1 | 1.5@9 | 1\" -w 550");
        CHECK(outcome.status == 0);
        const std::string note =
            "irido: note: IRIDO_SIMD: this machine does not support " + std::string(name_of(level));
        CHECK(outcome.err.starts_with(note) != is_available(level));
    }
}

TEST_CASE("stats say what was skipped and do not touch the answer", "[cli][simd]") {
    const auto stats = [](const std::string& arguments) {
        const std::string request = "\"$IRIDO\" spectrum " + arguments;
        const Outcome plain = run_shell(request, IRIDO_SOURCE_DIR);
        const Outcome outcome = run_shell(request + " --stats", IRIDO_SOURCE_DIR);
        CHECK(outcome.status == 0);
        CHECK(outcome.out == plain.out);
        CHECK(plain.err.empty());
        CHECK_THAT(outcome.err, StartsWith("irido: stats: "));
        return outcome.err;
    };
    const std::string film = stats("\"1 | 1.33@400 | 1.5\" -a 0:60:20");
    CHECK_THAT(film, Contains("1604 points (wavelength, angle)"));
    CHECK_THAT(film, Contains("skipped: p at 1 of 4 angles"));
    CHECK_THAT(film, Contains("skipped: recursion over layers"));
    CHECK_THAT(film, Contains("skipped: complex arithmetic in 1 of 1 layers"));
    CHECK_THAT(film, Contains("reused across wavelengths: angle terms of 2 of 2 media"));
    CHECK_THAT(film, Contains("skipped: absorption"));
    const std::string mirror = stats("\"1 | (2.3@60 | 1.46@94)^500 | Ag\" -p s");
    CHECK_THAT(mirror, Contains("skipped: p (not requested)"));
    CHECK_THAT(mirror, Contains("skipped: repetitions of 1 group ("));
    CHECK_THAT(mirror, !Contains("3 of 3 media"));
    const std::string hosted = stats("\"1.46 | (2.3@60 | 1.46@94)^500 | 1.46\" -a 0,30");
    CHECK_THAT(hosted, Contains("skipped: layer matrices (closed form for a mirror"));
    CHECK_THAT(mirror, !Contains("Yeh"));
    const std::string metal = stats("\"1 | Ag@10 | 1.5@100 | Ag@10 | 1.5@100 | 1.5\" -a 30 -p s,p");
    CHECK_THAT(metal, Contains("skipped: complex arithmetic in 2 of 4 layers"));
    CHECK_THAT(metal, Contains("skipped: matrices of 2 of 4 layers"));
    CHECK_THAT(metal, !Contains("skipped: absorption"));
    CHECK_THAT(stats("\"1 | Ag@10 | 1.5\" -a 30 --columns A_layers"),
               Contains("points (wavelength, angle), vectorized"));
    CHECK_THAT(stats("\"1 | (Ag@1 | 1.5@100)^300 | 1.5\" -a 30"),
               Contains("skipped: repetitions of 1 group"));
    CHECK_THAT(stats("\"1 | ((1.3@5 | 2@6)^90 | Ag@1)^3 | 1.5\" -a 30"),
               Contains("one at a time (groups of many layers in groups"));
}
