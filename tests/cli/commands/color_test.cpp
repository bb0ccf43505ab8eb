#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::vector<std::string> row_of(const std::vector<std::string>& arguments, std::size_t row = 1) {
    const Outcome outcome = done(arguments);
    const auto rows = parse_csv(outcome.out);
    REQUIRE(rows.size() > row);
    return rows[row];
}

}  // namespace

// Reference values: the spectrum of each stack times D65 and the CIE 1931 observer, both linear
// between their 1 nm rows, integrated cell by cell with Gauss-Legendre rules; accurate to 1e-12.
TEST_CASE("colours agree with an independent integration", "[cli][color]") {
    struct Case {
        std::string stack, angle;
        double xyz[3];
    };
    const Case cases[]{
        {"1 | 1.33@380 | 1", "0", {0.04473156990402, 0.0282067426637, 0.03821696445015}},
        {"1 | 1.33@380 | 1", "60", {0.1285727530246, 0.1632541097414, 0.1541063439653}},
        {"1 | 2.2@150 | 0.2+3.4i", "0", {0.8504900485245, 0.8614220253323, 0.940852004983}},
        {"1 | 2.2@150 | 0.2+3.4i", "60", {0.8611870791143, 0.9121162447083, 0.8873943744331}},
        {"1 | (2.3@60 | 1.46@94)^5 | 1.52",
         "0",
         {0.7837031116025, 0.9436657324433, 0.4483644867849}},
        {"1 | (2.3@60 | 1.46@94)^5 | 1.52",
         "60",
         {0.5350463610846, 0.6829350318341, 0.9489234874667}},
    };
    for (const auto& [stack, angle, xyz] : cases)
        for (const std::string tolerance : {"1e-3", "1e-6", "1e-9"}) {
            const auto row = row_of({"color", stack, "-a", angle, "--tolerance", tolerance});
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(std::abs(std::stod(row[2 + c]) - xyz[c]) <= std::stod(tolerance));
        }
}

TEST_CASE("the columns of a colour", "[cli][color]") {
    const auto rows =
        parse_csv(run_irido({"color", "air | TiO2@35 | Ti", "-a", "0,60", "--side", "T,R"}).out);
    REQUIRE(rows.size() == 5);
    CHECK(rows[0] == std::vector<std::string>{"angle_deg", "side", "X", "Y", "Z", "x", "y", "r",
                                              "g", "b", "hex", "in_gamut"});
    CHECK(rows[1][0] + rows[1][1] == "0T");
    CHECK(rows[2][0] + rows[2][1] == "0R");
    CHECK(rows[4][0] + rows[4][1] == "60R");
    const auto stats = parse_csv(run_irido({"color", "1 | 1.5@300 | 1", "--stats"}).out);
    CHECK(stats[0].back() == "error_estimate");
    CHECK(stats[1][12] == "quadrature");
    CHECK(std::stod(stats[1][13]) > 8);
    CHECK(std::stod(stats[1][14]) <= 1e-6);
}

TEST_CASE("a perfect mirror is exactly 1, black exactly 0", "[cli][color][slow]") {
    for (const std::string illuminant : {"D65", "D50", "A", "E", "FL2", "FL11"})
        for (const std::string space : {"srgb", "rec2020", "display-p3", "acescg", "xyz"})
            for (const std::string observer : {"2", "10"}) {
                const auto row = row_of({"color", "1 | 1.5@300 | 1", "-a", "90", "--illuminant",
                                         illuminant, "--space", space, "--observer", observer});
                INFO(illuminant << " " << space << " " << observer);
                CHECK(row[7] + row[8] + row[9] == "111");
                CHECK(row[10] == "#ffffff");
                CHECK(row[11] == "true");
            }
    const auto black = row_of({"color", "1 | 1@300 | 1"});
    CHECK(black[2] + black[3] + black[4] == "000");
    CHECK(black[7] + black[8] + black[9] == "000");
    CHECK(black[10] == "#000000");
    CHECK_THAT(black[5], StartsWith("0.3127"));  // that of the white, if there is no light
}

TEST_CASE("an illuminant from a file is the same as by its name", "[cli][color]") {
    const TemporaryFolder folder;
    write_text(folder / "flat.csv", "nm,power\n300,7\n830,7\n");
    const auto named = row_of({"color", "1 | 1.33@380 | 1", "--illuminant", "E"});
    const auto file = row_of({"color", "1 | 1.33@380 | 1", "--illuminant", folder / "flat.csv"});
    for (std::size_t c = 2; c < 10; ++c)
        CHECK(std::abs(std::stod(named[c]) - std::stod(file[c])) < 1e-14);
    write_text(folder / "um.csv", "0.3,7\n0.83,7\n");
    check_refused(run_irido({"color", "1 | 1.33@380 | 1", "--illuminant", folder / "um.csv"}),
                  "looks like um or eV (then add a header such as um,power)");
}

TEST_CASE("a material that does not reach the ends of the visible range", "[cli][color]") {
    const std::vector<std::string> request{"color", "air | PMMA@300 | BK7"};
    const Outcome held = run_irido(request);
    CHECK(held.status == 0);
    CHECK_THAT(held.err,
               StartsWith("irido: note: ") && Contains("PMMA is known from 400 to 1020 nm"));
    CHECK(std::count(held.err.begin(), held.err.end(), '\n') == 1);
    const Outcome strict = run_irido({"color", "air | PMMA@300 | BK7", "--strict"});
    CHECK(strict.status == 2);
    CHECK_THAT(strict.err, Contains("/layers/0/material: PMMA is known from 400 to 1020 nm"));
    const Outcome refused = run_irido({"color", "air | TiO2-rutile@300 | BK7"});
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err,
               Contains("TiO2-rutile is known from 430 to 1530 nm") && Contains("400 to 700 nm"));
    CHECK(run_irido({"color", "air | PMMA@300 | BK7", "--quiet"}).err.empty());
}

TEST_CASE("a tolerance that cannot be met is exit status 1 with the best value",
          "[cli][color][slow]") {
    const Outcome outcome = run_irido({"color", "1 | 1.5@1e9 | 2@1e9 | 1.7@1e9 | 1"});
    CHECK(outcome.status == 1);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, StartsWith("irido: error: ") &&
                                Contains("the tolerance 1e-06 cannot be met") &&
                                Contains("X, Y, Z = 0.11"));
}

TEST_CASE("what colour refuses", "[cli][refused]") {
    struct Case {
        std::vector<std::string> options;
        std::string error;
    };
    const std::vector<Case> cases{
        {{"--illuminant", "D66"},
         "--illuminant: must be one of D65, D50, A, E, FL2, FL11, a CSV file (got 'D66')"},
        {{"--illuminant", "none.csv"}, "none.csv: cannot be read"},
        {{"--observer", "4"}, "--observer: must be 2 or 10 (got '4')"},
        {{"--space", "lab"}, "--space: must be one of srgb"},
        {{"--side", "R,R"}, "--side: must be R, T or R,T"},
        {{"--method", "guess"}, "--method: must be one of auto, quadrature, fourier"},
        {{"--method", "naive/3"}, "--method: naive takes no number (got 'naive/3')"},
        {{"--method", "equal/1"}, "--method: the number of equal: must be in [2, 1e+06] (got 1)"},
        {{"--method", "fourrier"}, "(did you mean \"fourier\"?)"},
        {{"--method", "equal/x"}, "--method: "},
        {{"--adaptation", "cat02"}, "--adaptation: must be one of bradford, none"},
        {{"--tolerance", "0"}, "--tolerance: must be in [1e-12, 1] (got 0)"},
        {{"--tolerance", "1e-6,1"}, "--tolerance: must be a single number"},
        {{"-a", "91"}, "--angles: must be in [0, 90] (got 91)"},
    };
    for (const auto& [options, error] : cases) {
        std::vector<std::string> arguments{"color", "1 | 1.5@300 | 1"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        check_refused(run_irido(arguments), error);
    }
}

TEST_CASE("methods that are not exact say how far they are off", "[cli][color]") {
    const std::string film = "1 | 1.5@525 | 1.09";
    const auto exact = row_of({"color", film, "--tolerance", "1e-10", "-a", "40"});
    const std::vector<std::string> methods{"fourier/1", "naive", "equal/8", "equal",
                                           "gaussian",  "gltf",  "smits"};
    for (const std::string& method : methods) {
        INFO(method);
        const Outcome outcome =
            run_irido({"color", film, "-a", "40", "--method", method, "--stats"});
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.err, StartsWith("irido: note: ") && Contains(": error up to "));
        const auto row = parse_csv(outcome.out).at(1);
        CHECK(row[12] == (method == "equal" ? "equal/32" : method));
        double distance = 0;
        for (std::size_t c = 2; c < 5; ++c)
            distance = std::max(distance, std::abs(std::stod(row[c]) - std::stod(exact[c])));
        CHECK(distance <= std::stod(row[14]));
        CHECK(distance > 1e-9);
        const Outcome held =
            run_irido({"color", film, "-a", "40", "--method", method, "--tolerance", "1e-9"});
        CHECK(held.status == 1);
        CHECK(held.out.empty());
        CHECK_THAT(held.err, Contains("the tolerance 1e-09 cannot be met"));
    }
    const auto series = row_of({"color", film, "--method", "fourier", "-a", "40", "--stats"});
    CHECK(series[12] == "fourier");
    for (std::size_t c = 2; c < 5; ++c)
        CHECK(std::abs(std::stod(series[c]) - std::stod(exact[c])) < 1e-6);
    CHECK(row_of({"color", film, "--stats"})[12] == "quadrature");
    CHECK(row_of({"color", "1 | 1.5@1e9 | 1", "--stats"})[12] == "fourier");
    check_refused(run_irido({"color", "1.5 | 1@300 | 1.5", "-a", "42", "--method", "fourier"}),
                  "there is no Fourier series at 42 degrees");
    check_refused(run_irido({"color", "1 | TiO2@300 | 1", "--method", "fourier"}),
                  "(got k other than 0)");
    for (const std::string method : {"fourier", "fourier-constant", "gaussian", "gltf", "smits"})
        check_refused(run_irido({"color", "1 | 1.5@525 | 1.3@70 | 1", "--method", method}), "film");
}

TEST_CASE("gltf takes the base colour that is typed", "[cli][color]") {
    const std::vector<std::string> gold{"color", "1 | 1.3@300 | Au", "--quiet", "--method", "gltf"};
    const auto with = [&](const std::string& base) {
        std::vector<std::string> arguments = gold;
        arguments.insert(arguments.end(), {"--base-color", base});
        return run_irido(arguments);
    };
    CHECK(with("0,0,0").status == 0);
    CHECK(with("0.5,0.6,0.7").out != run_irido(gold).out);
    check_refused(with("1,1.2,0"), "--base-color: must be in [0, 1] (got 1.2)");
    check_refused(with("1,0.5"), "--base-color: must be three numbers R,G,B (got '1,0.5')");
    check_refused(with("0:1:0.5"), "--base-color: must be three numbers R,G,B (got '0:1:0.5')");
    check_refused(run_irido({"color", "1 | 1.3@300 | Au", "--base-color", "1,1,1"}),
                  "--base-color: requires --method gltf (got 'auto')");
}

TEST_CASE("a strip of colours", "[cli][color]") {
    const TemporaryFolder folder;
    CHECK(run_irido({"color", "air | TiO2@35 | Ti", "-a", "0,30,60", "-o", folder / "strip.svg"})
              .status == 0);
    const std::string svg = read_file(folder / "strip.svg");
    CHECK_THAT(svg, StartsWith("<svg ") && Contains("fill=\"#7f3e57\""));
    CHECK_THAT(svg, Contains("angle of incidence"));
}

TEST_CASE("the same stack under every illuminant", "[cli][color]") {
    const std::string stack = "air | TiO2@35 | Ti";
    const auto rows = parse_csv(run_irido({"color", stack, "--compare-illuminants"}).out);
    REQUIRE(rows.size() == 7);
    CHECK(rows[0][12] + "," + rows[0][13] == "illuminant,delta_e_2000");
    CHECK(rows[1][12] == "D65");
    CHECK(rows[1][13] == "0");
    CHECK(std::stod(rows[3][13]) > 1);  // A: a visible shift
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto alone = row_of({"color", stack, "--illuminant", rows[i][12]});
        CHECK(std::vector<std::string>(rows[i].begin(), rows[i].begin() + 12) == alone);
    }
    const auto from_a =
        parse_csv(run_irido({"color", stack, "--compare-illuminants", "--illuminant", "A"}).out);
    CHECK(from_a[1][12] == "A");
    CHECK(from_a[2][12] == "D65");
    CHECK(std::abs(std::stod(from_a[2][13]) - std::stod(rows[3][13])) < 1e-12);
}

TEST_CASE("one polarization, and the mean of both", "[cli][color]") {
    const std::string stack = "air | TiO2@35 | Ti";
    const auto s = row_of({"color", stack, "-a", "60", "-p", "s"});
    const auto p = row_of({"color", stack, "-a", "60", "-p", "p"});
    const auto u = row_of({"color", stack, "-a", "60"});
    CHECK(std::abs(std::stod(s[3]) - std::stod(p[3])) > 0.01);
    for (std::size_t c = 2; c < 5; ++c)  // each is within its own tolerance of 1e-6
        CHECK(std::abs((std::stod(s[c]) + std::stod(p[c])) / 2 - std::stod(u[c])) < 2e-6);
    CHECK(run_irido({"color", stack, "-p", "s,p"}).status == 2);
}

TEST_CASE("a billion periods end soon, in numbers", "[cli][color][slow]") {
    const auto of_periods = [](const std::string& count) {
        return row_of({"color", "air | (TiO2@58 | SiO2@94)^" + count + " | BK7"});
    };
    const auto few = of_periods("10000000"), many = of_periods("1000000000");
    // blue light is absorbed long before the last period, yellow light by all of them
    CHECK(std::abs(std::stod(few[4]) - std::stod(many[4])) < 2e-6);
    CHECK(std::stod(many[3]) < std::stod(few[3]) - 1e-4);
    CHECK(std::stod(many[3]) > 0.9);
}
