#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace {

std::vector<std::vector<double>> profile(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"profile"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = done(arguments);
    const auto table = parse_csv(outcome.out);
    CHECK(table[0] == std::vector<std::string>{"wavelength_nm", "angle_deg", "polarization", "z_nm",
                                               "medium", "E2", "Ex2", "Ey2", "Ez2",
                                               "absorbed_per_nm", "flux"});
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 1; i < table.size(); ++i) {
        rows.emplace_back();
        for (std::size_t c = 3; c < table[i].size(); ++c)
            rows.back().push_back(std::stod(table[i][c]));
    }
    return rows;
}

enum Quantity { z, medium, E2, Ex2, Ey2, Ez2, absorbed, flux };

}  // namespace

// Reference: a 40-digit evaluation, rounded to double.
TEST_CASE("a surface plasmon's field", "[cli][profile]") {
    const auto rows = profile({"1.515 | 0.06+4.2i@50 | 1", "-w", "633", "-a", "42.95", "-p", "p",
                               "--z", "-100,0,49,50,1000"});
    REQUIRE(rows.size() == 5);
    const auto check = [](double got, double want) { CHECK_THAT(got, WithinRel(want, 1e-11)); };
    check(rows[0][E2], 1.3386601154487752);
    check(rows[0][flux], 0.6933536758933423);
    CHECK(rows[1][medium] == 1);
    check(rows[1][E2], 1.002818275545551);
    check(rows[1][absorbed], 0.004524136815316249);
    check(rows[2][Ez2], 0.5230118716939186);
    check(rows[2][flux], 0.04993309726373362);
    CHECK(rows[3][medium] == 2);
    check(rows[3][E2], 189.07078888291653);
    CHECK(rows[3][flux] == 0);
    check(rows[4][Ez2], 1.4239852302582652);
}

TEST_CASE("a film's field is what it is between its waves", "[cli][profile]") {
    // a half-wave film: a standing wave inside, and no reflection at all
    const auto rows = profile({"1 | 2@137.5 | 1", "-w", "550", "--z", "-50,0,68.75,137.5,500"});
    for (const auto& row : rows) CHECK_THAT(row[flux], WithinAbs(1, 1e-14));
    CHECK_THAT(rows[0][E2], WithinAbs(1, 1e-14));
    CHECK_THAT(rows[2][E2], WithinAbs(0.25, 1e-14));  // |E| is 1/n in the middle
    CHECK_THAT(rows[4][E2], WithinAbs(1, 1e-14));
}

TEST_CASE("the summary has the layers' absorptance", "[cli][profile]") {
    const std::string stack = "1 | 1.38@90 | 0.05+3.3i@20 | 1.52";
    const auto summary =
        parse_csv(run_irido({"profile", stack, "-w", "550", "-a", "30", "--summary"}).out);
    REQUIRE(summary.size() == 4);
    CHECK(summary[0][3] == "medium");
    const auto spectrum = parse_csv(
        run_irido({"spectrum", stack, "-w", "550", "-a", "30", "--columns", "A_layers"}).out);
    CHECK_THAT(std::stod(summary[2][4]), WithinAbs(std::stod(spectrum[1][7]), 1e-14));
    CHECK(summary[1][4] == "0");
    CHECK(summary[1][5].empty());  // lossless
    // the integral over the metal, by Simpson's rule
    std::string depths = "90";
    constexpr int kParts = 40;
    for (int i = 1; i <= kParts; ++i)
        depths += "," + std::to_string(90 + 20.0 * i / kParts - (i == kParts ? 1e-6 : 0));
    const auto rows = profile({stack, "-w", "550", "-a", "30", "--z", depths});
    double sum = 0;
    for (int i = 0; i <= kParts; ++i)
        sum += (i == 0 || i == kParts ? 1
                : i % 2 == 1          ? 4
                                      : 2) *
               rows[static_cast<std::size_t>(i)][absorbed] * 20 / kParts / 3;
    CHECK_THAT(sum, WithinRel(std::stod(summary[2][4]), 1e-6));
}

TEST_CASE("profiles that are refused", "[cli][profile]") {
    check_refused(run_irido({"profile", "1 | 1.5@1mm! | 1"}), "requires coherent layers");
    check_refused(run_irido({"profile", "1 | 1.5@100 | 1", "-a", "90"}), "no light arrives");
    check_refused(run_irido({"profile", "1 | 1.5@100 | 1", "--points", "5", "--z", "1"}),
                  "mutually exclusive");
    check_refused(run_irido({"profile", "1 | (1.5@100 | 2@50)^1000000 | 1"}), "at most 100000");
}

TEST_CASE("a profile's picture has its layers", "[cli][profile]") {
    const Outcome picture = run_irido({"profile", "BK7 | Ag@50 | air", "-w", "633", "-a", "42.82",
                                       "-p", "p", "--points", "100", "-f", "svg"});
    CHECK(picture.status == 0);
    CHECK(picture.out.find("Ag") != std::string::npos);
}

TEST_CASE("a field that jumps at a face is drawn as a jump", "[cli][profile]") {
    // few depths, none of them near the faces at 0 and 50 nm
    const std::string svg = run_irido({"profile", "BK7 | Ag@50 | air", "-w", "633", "-a", "42.82",
                                       "-p", "p", "--z", "-300,-20,25,70,300", "-f", "svg"})
                                .out;
    const std::size_t at = svg.find("<path d=\"M", svg.find("<g class=\"series\""));
    REQUIRE(at != std::string::npos);
    std::string path = svg.substr(at + 10, svg.find('"', at + 10) - at - 10);
    for (char& c : path)
        if (c == 'L') c = ' ';
    std::istringstream numbers(path);
    std::vector<std::pair<double, double>> points;
    for (double x = 0, y = 0; numbers >> x >> y;) points.emplace_back(x, y);
    REQUIRE(points.size() == 5 + 2 * 2);
    std::size_t jumps = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        if (points[i].first == points[i - 1].first &&
            std::abs(points[i].second - points[i - 1].second) > 1)
            ++jumps;
    CHECK(jumps >= 1);
    // rows are those asked for
    CHECK(profile({"BK7 | Ag@50 | air", "-w", "633", "--z", "-20,25"}).size() == 2);
}

TEST_CASE("layers that no light reaches have no field", "[cli][profile]") {
    const Outcome outcome =
        run_irido({"profile", "1.6 | (1.83@178.8 | 1.07+1.6i@147.9)^500 | 2.7+0.01i@71.5 | 2.66",
                   "-w", "427.8", "-a", "35", "-p", "s", "--summary"});
    REQUIRE(outcome.status == 0);
    const auto table = parse_csv(outcome.out);
    REQUIRE(table.size() == 1 + 1002);
    double begin = 0;
    for (std::size_t i = 1; i < table.size(); ++i) {
        // std::stod rejects subnormal numbers
        const double largest = std::strtod(table[i][6].c_str(), nullptr);
        const double at = std::strtod(table[i][7].c_str(), nullptr);
        const double thickness = i > 1001 ? 0 : i == 1001 ? 71.5 : i % 2 == 1 ? 178.8 : 147.9;
        CAPTURE(i);
        CHECK((largest >= 0 && largest < 4));
        CHECK((at > begin - 1e-6 && at < begin + thickness + 1e-6));
        begin += thickness;
    }
}
