#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;

namespace {

const std::string kFilm = "1 | 1.42@400 | 1.87+1.182i";

double number(const std::string& text) {
    return std::stod(text);
}

}  // namespace

// Reference rows: a 60-digit evaluation, rounded to double. phi_rad is defined modulo 2 pi.
TEST_CASE("coefficients agree with a 60-digit evaluation", "[cli][cm]") {
    const auto want = parse_csv(
        "angle_deg,polarization,side,order,C,opd_nm,phi_rad\n"
        "0,s,R,0,0.15373100603517206,1136.0,-2.2794738207093266\n"
        "0,s,R,1,-0.0531366238706228,1136.0,-2.2794738207093266\n"
        "0,s,R,2,-0.0033364105461784047,1136.0,-2.2794738207093266\n"
        "0,p,R,0,0.15373100603517206,1136.0,-2.2794738207093266\n"
        "0,p,R,1,-0.0531366238706228,1136.0,-2.2794738207093266\n"
        "0,p,R,2,-0.0033364105461784047,1136.0,-2.2794738207093266\n"
        "50,s,R,0,0.2452435712339465,956.5189925697148,-2.394150591849068\n"
        "50,s,R,1,-0.09736311002575154,956.5189925697148,-2.394150591849068\n"
        "50,s,R,2,-0.01255978065583979,956.5189925697148,-2.394150591849068\n"
        "50,p,R,0,0.08967803599272907,956.5189925697148,-2.1226243621638194\n"
        "50,p,R,1,-0.010908430541934086,956.5189925697148,-2.1226243621638194\n"
        "50,p,R,2,-0.00013071623183119193,956.5189925697148,-2.1226243621638194\n");
    const auto got = parse_csv(run_irido({"cm", kFilm, "-a", "0,50", "--orders", "0:2:1"}).out);
    REQUIRE(got.size() == want.size());
    CHECK(got[0] == want[0]);
    for (std::size_t row = 1; row < want.size(); ++row) {
        CAPTURE(row);
        for (const std::size_t text : {0U, 1U, 2U, 3U}) CHECK(got[row][text] == want[row][text]);
        for (const std::size_t c : {4U, 5U})
            CHECK(std::abs(number(got[row][c]) / number(want[row][c]) - 1) < 1e-13);
        CHECK(std::abs(std::remainder(number(got[row][6]) - number(want[row][6]),
                                      2 * std::numbers::pi)) < 1e-13);
    }
}

TEST_CASE("by default orders 0 to 5 of R at 0 degrees, s and p", "[cli][cm]") {
    const auto rows = parse_csv(run_irido({"cm", kFilm}).out);
    REQUIRE(rows.size() == 13);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        CHECK(rows[i][0] == "0");
        CHECK(rows[i][1] == (i <= 6 ? "s" : "p"));
        CHECK(rows[i][2] == "R");
        CHECK(rows[i][3] == std::to_string((i - 1) % 6));
    }
}

TEST_CASE("rows run by angle, polarization, side and order as asked", "[cli][cm]") {
    const auto rows = parse_csv(
        run_irido({"cm", kFilm, "-a", "30,10", "-p", "p,s", "--side", "T,R", "--orders", "2,0"})
            .out);
    REQUIRE(rows.size() == 17);
    std::string order;
    for (std::size_t i = 1; i < rows.size(); ++i)
        order += rows[i][0] + rows[i][1] + rows[i][2] + rows[i][3] + " ";
    CHECK(order ==
          "30pT2 30pT0 30pR2 30pR0 30sT2 30sT0 30sR2 30sR0 "
          "10pT2 10pT0 10pR2 10pR0 10sT2 10sT0 10sR2 10sR0 ");
}

TEST_CASE("the series is the spectrum, with dispersion at the wavelength asked for", "[cli][cm]") {
    const std::string stack = "air | SiO2@300 | Si";
    const auto rows = parse_csv(
        run_irido({"cm", stack, "-a", "60", "--orders", "0:60:1", "--at", "600", "--side", "R,T"})
            .out);
    const auto spectrum =
        parse_csv(run_irido({"spectrum", stack, "-a", "60", "-p", "s,p", "-w", "600"}).out);
    for (const std::size_t p : {0U, 1U}) {
        for (const std::size_t side : {0U, 1U}) {
            double sum = 0;
            for (std::size_t m = 0; m <= 60; ++m) {
                const auto& row = rows[1 + 122 * p + 61 * side + m];
                const double phase = 2 * std::numbers::pi * number(row[5]) / 600 + number(row[6]);
                sum += (m == 0 ? 1 : 2) * number(row[4]) * std::cos(static_cast<double>(m) * phase);
            }
            CHECK(std::abs(sum - number(spectrum[1 + p][3 + side])) < 1e-13);
        }
    }
}

TEST_CASE("the answer comes as csv, json and npy", "[cli][cm]") {
    const TemporaryFolder folder;
    CHECK_THAT(run_irido({"cm", kFilm, "-f", "json"}).out,
               Contains("\"polarization\": \"s\"") || Contains("\"polarization\":\"s\""));
    CHECK(run_irido({"cm", kFilm, "-o", folder / "cm.npy"}).status == 0);
    CHECK(read_file(folder / "cm.npy").substr(1, 5) == "NUMPY");
}

TEST_CASE("what cm cannot answer is refused", "[cli][cm]") {
    check_refused(run_irido({"cm", "1 | 1.5@100 | 1.4@100 | 1"}), "one coherent film");
    check_refused(run_irido({"cm", "1 | 1.5+0.1i@100 | 1"}), "one coherent film");
    check_refused(run_irido({"cm", "1 | 1.5"}), "one coherent film");
    check_refused(run_irido({"cm", "1.5 | 1.2@100 | 2", "-a", "0,70"}), "at 70 degrees");
    check_refused(run_irido({"cm", kFilm, "-p", "u"}), "--polarization: must be s, p or s,p");
    check_refused(run_irido({"cm", kFilm, "--side", "A"}), "--side: must be R, T or R,T");
    check_refused(run_irido({"cm", kFilm, "--orders", "0:1:0.5"}), "--orders: must be whole");
    check_refused(run_irido({"cm", kFilm, "--orders", "-1"}), "--orders");
    check_refused(run_irido({"cm", kFilm, "--orders", "0:1000000:1", "-a", "0:90:1"}), "1e+07");
    check_refused(run_irido({"cm", kFilm, "--at", "0"}), "--at");
    check_refused(run_irido({"cm", kFilm, "-a", "91"}), "--angles");
    check_refused(run_irido({"cm", "air | SiO2@300 | Si", "--at", "100000"}), "SiO2");
    check_refused(run_irido({"cm", "1+0.1i | 1.5@100 | 2"}), "/incident: must be transparent");
    check_refused(run_irido({"cm", kFilm, "-f", "gif"}), "--format");
}

TEST_CASE("help of cm says what it is for, with examples that work", "[cli][cm]") {
    const std::string help = run_irido({"cm", "--help"}).out;
    for (const char* text : {"--orders", "[0:5:1]", "[550]", "[s,p]", "Examples:"})
        CHECK_THAT(help, Contains(text));
    CHECK(run_shell("\"$IRIDO\" cm \"air | 1.42@400 | 1.87+1.182i\" -a 0,50 --orders 0:2:1", ".")
              .status == 0);
    CHECK(
        run_shell("\"$IRIDO\" cm \"air | SiO2@300 | Si\" -a 0:80:20 -p s --side R,T --at 600", ".")
            .status == 0);
}
