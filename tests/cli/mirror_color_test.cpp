#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string kMirror = "1 | (1@101 | 1.5@143)^20 | 1";

std::vector<std::string> row_of(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "color");
    const Outcome outcome = done(arguments);
    return parse_csv(outcome.out).at(1);
}

double distance(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    double largest = 0;
    for (std::size_t c = 2; c < 5; ++c)
        largest = std::max(largest, std::abs(std::stod(a[c]) - std::stod(b[c])));
    return largest;
}

void check_refused(const std::vector<std::string>& options, const std::string& error,
                   const std::string& stack = kMirror) {
    std::vector<std::string> arguments{"color", stack};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_irido(arguments);
    CAPTURE(error);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, StartsWith("irido: error: ") && Contains(error));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
}

}  // namespace

TEST_CASE("color --method landmarks and bloch by name", "[cli][color]") {
    const auto exact = row_of({kMirror, "-a", "40", "--tolerance", "1e-9"});
    const auto basic = row_of({kMirror, "-a", "40", "--method", "landmarks", "--stats"});
    const auto fine =
        row_of({kMirror, "-a", "40", "--method", "landmarks", "--subdivide", "3", "--stats"});
    const auto average =
        row_of({kMirror, "-a", "40", "--method", "bloch", "--harmonics", "0", "--stats"});
    const auto bloch = row_of({kMirror, "-a", "40", "--method", "bloch", "--stats"});
    CHECK(basic[12] == "landmarks/1");
    CHECK(fine[12] == "landmarks/3");
    CHECK(average[12] == "bloch/0");
    CHECK(bloch[12] == "bloch");
    CHECK(row_of({kMirror, "-a", "40", "--method", "landmarks/3"})[9] == fine[9]);
    CHECK(row_of({kMirror, "-a", "40", "--method", "bloch/0"})[9] == average[9]);
    for (const auto& row : {basic, fine, average})
        CHECK(distance(row, exact) <= std::stod(row[14]) + 1e-9);
    CHECK(distance(basic, exact) < 0.2);
    CHECK(distance(fine, exact) < 0.2);
    CHECK(distance(average, exact) < 0.01);
    CHECK(distance(bloch, exact) <= 1e-6);
    CHECK(std::stod(bloch[14]) <= 1e-6);
}

TEST_CASE("approximations of mirrors say how far they are off", "[cli][color]") {
    for (const std::string method : {"landmarks", "bloch/0"}) {
        const Outcome outcome = run_irido({"color", kMirror, "--method", method});
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.err, Contains(": error up to "));
        const Outcome held =
            run_irido({"color", kMirror, "--method", method, "--tolerance", "1e-9"});
        CHECK(held.status == 1);
        CHECK(held.out.empty());
    }
}

TEST_CASE("bloch is held to its tolerance", "[cli][color]") {
    CHECK(run_irido({"color", kMirror, "--method", "bloch"}).status == 0);
    const Outcome outcome =
        run_irido({"color", kMirror, "--method", "bloch", "--tolerance", "1e-12", "-a", "70"});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Contains("the tolerance 1e-12 cannot be met"));
}

TEST_CASE("auto says that it took Bloch waves", "[cli][color]") {
    const std::string many = "1 | (1@101 | 1.5@143)^1000000 | 1";
    CHECK(row_of({many, "-a", "20", "--stats"})[12] == "bloch");
    CHECK(row_of({kMirror, "-a", "20", "--stats"})[12] == "quadrature");
}

TEST_CASE("methods for mirrors refuse in one line", "[cli][color][refused]") {
    check_refused({"--method", "landmarks", "--subdivide", "0"},
                  "--subdivide: must be in [1, 1000] (got 0)");
    check_refused({"--method", "bloch", "--harmonics", "-1"},
                  "--harmonics: must be in [0, 1000] (got -1)");
    check_refused({"--method", "bloch", "--harmonics", "1.5"}, "--harmonics: ");
    check_refused({"--subdivide", "2"}, "--subdivide: requires --method landmarks (got 'auto')");
    check_refused({"--method", "landmarks", "--harmonics", "2"},
                  "--harmonics: requires --method bloch (got 'landmarks')");
    check_refused({"--method", "landmarks/2", "--subdivide", "2"},
                  "--subdivide: conflicts with the number in --method");
    check_refused({"--method", "landmarks/0"}, "the number of landmarks: must be in [1, 1000]");
    for (const std::string method : {"landmarks", "bloch"}) {
        check_refused({"--method", method}, "needs one group of two coherent layers",
                      "1 | 1.5@300 | 1");
        check_refused({"--method", method}, "(got an index that varies)",
                      "1 | (1@100 | SiO2@90)^5 | 1");
        check_refused({"--method", method, "-a", "70"}, "critical angle",
                      "1.5 | (1.5@100 | 1.2@90)^5 | 1.5");
    }
}
