#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "core/truth/regimes.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

const std::string kColumns =
    "regime,count,worst_R,p99_R,condition_R,roundings_R,worst_T,p99_T,condition_T,roundings_T,"
    "worst_T_relative,p99_T_relative,condition_T_relative,roundings_T_relative,worst_A,p99_A,"
    "condition_A,roundings_A,worst_A_relative,p99_A_relative,condition_A_relative,"
    "roundings_A_relative,not_finite,negative,above_one,beyond_bound,thresholds\n";

}  // namespace

TEST_CASE("bench stability reports one row for each regime", "[cli][bench]") {
    const Outcome outcome = run_irido({"bench", "stability", "--count", "1"});
    CHECK_THAT(outcome.out, StartsWith(kColumns));
    const auto rows = parse_csv(outcome.out);
    REQUIRE(rows.size() == regimes().size() + 1);
    for (std::size_t i = 0; i < regimes().size(); ++i) {
        CHECK(rows[i + 1][0] == regimes()[i].name);
        CHECK(rows[i + 1].size() == rows[0].size());
        for (std::size_t c = 1; c < rows[i + 1].size(); ++c)
            CHECK(std::isfinite(std::stod(rows[i + 1][c])));
    }
}

TEST_CASE("bench stability finds ordinary stacks within their bounds", "[cli][bench]") {
    const Outcome outcome =
        run_irido({"bench", "stability", "--regime", "ordinary,grazing", "-n", "30", "-s", "9"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    const auto rows = parse_csv(outcome.out);
    REQUIRE(rows.size() == 3);
    CHECK(rows[1][1] == "60");
    CHECK(std::stod(rows[1][2]) < 1e-13);
    CHECK(std::stod(rows[1][2]) >= std::stod(rows[1][3]));
}

TEST_CASE("bench stability is the same for every number of threads", "[cli][bench]") {
    const std::vector<std::string> request{"bench", "stability", "-r", "critical,band_edge,gain",
                                           "-n",    "12",        "-j"};
    const auto with = [&](const std::string& threads) {
        auto arguments = request;
        arguments.push_back(threads);
        return run_irido(arguments);
    };
    const Outcome one = with("1"), five = with("5");
    CHECK(one.out == five.out);
    CHECK(one.status == five.status);
    CHECK(one.out !=
          run_irido({"bench", "stability", "-r", "critical,band_edge,gain", "-n", "12", "-s", "2"})
              .out);
}

TEST_CASE("bench stability writes files and JSON", "[cli][bench]") {
    const TemporaryFolder folder;
    const std::vector<std::string> request{"bench", "stability", "-r", "ordinary", "-n", "2"};
    auto to_file = request, as_json = request;
    to_file.insert(to_file.end(), {"-o", folder / "out.csv"});
    as_json.insert(as_json.end(), {"-f", "json"});
    CHECK(run_irido(to_file).out.empty());
    CHECK(read_file(folder / "out.csv") == run_irido(request).out);
    CHECK_THAT(run_irido(as_json).out, StartsWith("[\n{\"regime\":\"ordinary\",\"count\":4,"));
}

TEST_CASE("bench refuses what it does not know in one line", "[cli][bench][refused]") {
    struct Case {
        std::vector<std::string> arguments;
        std::string error;
    };
    const std::vector<Case> cases{
        {{"stability", "--count", "0"}, "--count: must be in [1, 1e+06] (got 0)"},
        {{"stability", "--count", "1000001"}, "--count: must be in [1, 1e+06]"},
        {{"stability", "--count", "2.5"}, "--count: must be a single whole number (got '2.5')"},
        {{"stability", "--count", "1,2"}, "--count: must be a single whole number (got '1,2')"},
        {{"stability", "--count", "many"}, "--count: must be a number (got 'many')"},
        {{"stability", "--seed", "-1"}, "--seed: must be in [0, "},
        {{"stability", "--seed", "nan"}, "--seed: must be a number (got 'nan')"},
        {{"stability", "--regime", "grasing"},
         "--regime: there is no regime 'grasing' (did you mean \"grazing\"?)"},
        {{"stability", "--regime", ""}, "--regime: must not be empty"},
        {{"stability", "-f", "xml"}, "--format: must be one of csv, json, npy (got 'xml')"},
        {{"stability", "-j", "0"}, "--threads: must be in [1, 4096] (got 0)"},
        {{"stability", "-o", "/no/such/folder/x.csv", "-n", "1", "-r", "thin"}, "/no/such/folder"},
        {{"stability", "extra"}, "extra"},
        {{}, "a command is required after irido bench"},
        {{"sped"}, "unknown command 'sped' (did you mean \"speed\"?)"},
    };
    for (const auto& [arguments, error] : cases) {
        std::vector<std::string> all{"bench"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        check_refused(run_irido(all), error);
    }
}

TEST_CASE("the help of bench has units, defaults and two examples", "[cli][bench]") {
    const Outcome outcome = run_irido({"bench", "stability", "--help"});
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("[1, 1e6] [80]") && Contains("[csv]"));
    const std::string examples = outcome.out.substr(outcome.out.find("Examples:"));
    CHECK(std::count(examples.begin(), examples.end(), '\n') >= 3);
    for (const Regime& regime : regimes())
        CHECK_THAT(outcome.out, Contains(std::string(regime.name) + ": "));
}

TEST_CASE("bench speed reports every kernel beside the machine's limit", "[cli][bench]") {
    const Outcome outcome =
        run_irido({"bench", "speed", "--cases", "film,20_periods", "--time", "0.002", "-j", "2"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out,
               StartsWith("case,method,threads,layers,points,points_per_s,ns_per_point,worst_R,"
                          "operations_per_point,limit_per_s,fraction_of_limit,worst_F,"
                          "thread_efficiency\n"));
    const auto rows = parse_csv(outcome.out);
    std::set<std::string> cases, methods;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        cases.insert(rows[i][0]);
        methods.insert(rows[i][1]);
        const double rate = std::stod(rows[i][5]), ns = std::stod(rows[i][6]);
        const double operations = std::stod(rows[i][8]), limit = std::stod(rows[i][9]);
        CHECK(rate > 0);
        CHECK(std::abs(rate * ns - 1e9) < 1);
        CHECK(limit > 1e6);
        CHECK(std::abs(std::stod(rows[i][10]) - rate * operations / limit) < 1e-9);
        CHECK(std::stod(rows[i][7]) < 1e-12);
    }
    CHECK(cases == std::set<std::string>{"20_periods", "film", "landmarks", "sin_cos"});
    for (const std::string method : {"plain", "baseline", "long_double", "newton", "dichotomy"})
        CHECK(methods.contains(method));
}

TEST_CASE("bench speed compares the closed form of the filter with its sum", "[cli][bench]") {
    const Outcome outcome =
        run_irido({"bench", "speed", "--cases", "falpha_0.1", "--time", "0.002"});
    CHECK(outcome.status == 0);
    const auto rows = parse_csv(outcome.out);
    double sum = 0, closed = 1e300;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (rows[i][0] != "falpha_0.1") continue;
        const double ns = std::stod(rows[i][6]), worst = std::stod(rows[i][11]);
        if (rows[i][1] == "sum_1000") {
            sum = ns;
            CHECK(worst < 1e-3);
        } else {
            closed = std::min(closed, ns);
            CHECK(worst < 1e-14);
        }
    }
    CHECK(sum > 10 * closed);
}

TEST_CASE("bench speed refuses what it does not know in one line", "[cli][bench][refused]") {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"--cases", "41"}, "--cases: unknown case '41'"},
        {{"--time", "0"}, "--time: must be in [0.001, 60] (got 0)"},
        {{"--time", "1,2"}, "--time: must be a single number (got '1,2')"},
        {{"-f", "xml"}, "--format: must be one of csv, json, npy (got 'xml')"},
    };
    for (const auto& [arguments, error] : cases) {
        std::vector<std::string> all{"bench", "speed"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run_irido(all);
        CHECK(outcome.status == 2);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, StartsWith("irido: error: ") && Contains(error));
    }
    CHECK_THAT(run_irido({"bench", "speed", "--help"}).out,
               Contains("40_absorbing: 40 absorbing films") && Contains("[0.1]"));
}

TEST_CASE("bench scene compares a bake with tables of everything", "[cli][bench]") {
    const TemporaryFolder folder;
    write_text(folder / "one.json", R"({"materials": [
        {"name": "a", "stack": "1 | 1.33@300 | 1.5+3i", "angles_deg": [0, 70],
         "vary": {"layers.0.thickness_nm": [280, 300]}, "shading": "color"}]})");
    const Outcome outcome = done({"bench", "scene", folder / "one.json", "-n", "200"});
    const auto rows = parse_csv(outcome.out);
    REQUIRE(rows.size() == 4);
    CHECK(rows[0] == std::vector<std::string>{"case", "method", "tables", "bytes", "seconds",
                                              "worst_delta_e", "files_written",
                                              "worst_delta_e_levels"});
    CHECK(rows[1][1] == "irido");
    CHECK(rows[2][1] == "irido again");
    CHECK(rows[3][1] == "fixed 256");
    for (const auto& row : rows) CHECK(row[0] == (&row == &rows[0] ? "case" : "one"));
    CHECK(rows[1][2] == "1");
    CHECK(rows[1][6] == "2");  // the table and the manifest
    CHECK(rows[2][6] == "0");
    CHECK(std::stod(rows[1][5]) <= 0.5);
    CHECK(std::stod(rows[1][3]) < 0.01 * std::stod(rows[3][3]));
    check_refused(run_irido({"bench", "scene", "-n", "0"}), "--count");
    check_refused(run_irido({"bench", "scene", "missing.json"}), "missing.json");
}

TEST_CASE("bench layered measures ways to evaluate mirrors and films", "[cli][bench][slow]") {
    const Outcome outcome =
        run_irido({"bench", "layered", "--cases", "A", "--samples", "500", "--budget", "0"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto rows = parse_csv(outcome.out);
    REQUIRE(rows.size() == 8);
    CHECK(rows[0] == std::vector<std::string>{"case", "method", "prepare_s", "evaluate_s",
                                              "smape_percent", "efficiency", "per_second",
                                              "delta_e_mean", "delta_e_max"});
    // all paths have no bias, unlike single reflections
    CHECK(rows[3][1] == "model");
    CHECK(rows[5][1] == "all");
    CHECK(std::stod(rows[5][4]) < std::stod(rows[3][4]));
    CHECK(rows[7][1] == "prepared-rgb");
    CHECK(std::stod(rows[7][8]) < 0.1);

    const Outcome films =
        run_irido({"bench", "layered", "--cases", "film-dielectric,film-spread", "--budget", "0"});
    REQUIRE(films.status == 0);
    for (const auto& row : parse_csv(films.out)) {
        if (row[1] == "fourier" || row[1] == "spectral") CHECK(std::stod(row[8]) < 1e-2);
        if (row[1] == "gaussian/3") CHECK(std::stod(row[7]) > 0.01);
        if (row[1] == "levels") CHECK(std::stod(row[7]) < 3);
    }
}
