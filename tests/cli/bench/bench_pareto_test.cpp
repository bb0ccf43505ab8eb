#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "core/truth/color_cases.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

using Fields = std::map<std::string, std::string>;

std::vector<Fields> rows_of(const std::string& csv) {
    const auto lines = parse_csv(csv);
    std::vector<Fields> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        REQUIRE(lines[i].size() == lines[0].size());
        Fields& fields = rows.emplace_back();
        for (std::size_t c = 0; c < lines[0].size(); ++c) fields[lines[0][c]] = lines[i][c];
    }
    return rows;
}

Outcome pareto(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"bench", "pareto", "--time", "0.0001", "--count", "3"});
    return run_irido(arguments);
}

}  // namespace

TEST_CASE("bench pareto has every method of a case with time and error", "[cli][bench]") {
    const Outcome outcome = pareto({"--cases", "leather,bragg"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out,
               StartsWith("case,method,parameter,tolerance,colors,evaluations,ns_per_color,"
                          "max_dXYZ,dE2000_mean,dE2000_p95,dE2000_max,equal_wavelengths,"
                          "equal_ns_per_color,times_faster,worst_stack,worst_angle_deg,worst_hex,"
                          "exact_hex\n"));
    std::map<std::string, std::set<std::string>> methods;
    std::map<std::string, double> equal_error;
    for (const Fields& row : rows_of(outcome.out)) {
        const auto number = [&](const std::string& name) { return std::stod(row.at(name)); };
        const std::string& method = row.at("method");
        CAPTURE(row.at("case"), method, row.at("parameter"), row.at("tolerance"));
        methods[row.at("case")].insert(method);
        CHECK(number("colors") == (row.at("case") == "leather" ? 18 : 3));
        CHECK(number("ns_per_color") > 0);
        CHECK(number("dE2000_mean") <= number("dE2000_max"));
        CHECK(number("dE2000_p95") <= number("dE2000_max"));
        CHECK(row.at("exact_hex").size() == 7);
        if (number("tolerance") > 0 && method == "quadrature")
            CHECK(number("max_dXYZ") <= number("tolerance"));
        if (number("equal_wavelengths") > 0) {
            CHECK(number("tolerance") > 0);
            CHECK_THAT(
                number("times_faster"),
                Catch::WithinRel(number("equal_ns_per_color") / number("ns_per_color"), 1e-12));
        }
        if (method != "equal") continue;
        CHECK(number("evaluations") == Approx(number("parameter")));
        double& before = equal_error.try_emplace(row.at("case"), 10).first->second;
        if (number("parameter") >= 512) CHECK(number("max_dXYZ") < before);
        before = number("max_dXYZ");
    }
    for (const std::string method : {"quadrature", "auto", "equal", "naive"})
        for (const std::string of : {"leather", "bragg"}) CHECK(methods[of].contains(method));
    for (const std::string method : {"gaussian", "gltf", "smits"}) {
        CHECK(methods["leather"].contains(method));
        CHECK_FALSE(methods["bragg"].contains(method));
    }
}

TEST_CASE("bench pareto names the worst stack so that color shows it again", "[cli][bench][slow]") {
    for (const Fields& row : rows_of(pareto({"--cases", "dispersive,bragg,conductor"}).out)) {
        if (row.at("method") != "naive" && row.at("parameter") != "8") continue;
        const Outcome again =
            run_irido({"color", row.at("worst_stack"), "-a", row.at("worst_angle_deg"), "--quiet"});
        CAPTURE(row.at("worst_stack"));
        CHECK_THAT(again.out, Contains("," + row.at("exact_hex") + ","));
        CHECK(row.at("worst_hex") != row.at("exact_hex"));
    }
}

TEST_CASE("bench pareto's errors depend on the seed, its times do not matter",
          "[cli][bench][slow]") {
    const auto errors = [](const std::string& seed) {
        std::vector<std::string> result;
        for (const Fields& row : rows_of(pareto({"--cases", "multilayer", "--seed", seed}).out))
            result.push_back(row.at("method") + row.at("max_dXYZ") + row.at("worst_stack") +
                             row.at("equal_wavelengths"));
        return result;
    };
    CHECK(errors("7") == errors("7"));
    CHECK(errors("7") != errors("8"));
}

TEST_CASE("bench pareto draws its rows", "[cli][bench][slow]") {
    const TemporaryFolder folder;
    CHECK(pareto({"--cases", "leather,bragg", "--plot", folder / "front.svg", "-o",
                  folder / "front.json"})
              .status == 0);
    CHECK_THAT(read_file(folder / "front.json"), StartsWith("[\n{\"case\":\"leather\","));
    const Outcome counts = run_shell(
        "python3 -c \"import xml.etree.ElementTree as t; r = t.parse('front.svg').getroot(); "
        "c = [e.get('class') for e in r.iter()]; "
        "print(c.count('frame'), c.count('series'), c.count('highlight'), c.count('legend'))\"",
        folder.path());
    // quadrature, auto, equal, naive on both; gaussian, gltf, smits on the film
    std::istringstream numbers(counts.out);
    int panels = 0, series = 0, highlights = 0, legends = 0;
    numbers >> panels >> series >> highlights >> legends;
    CHECK(panels == 2);
    CHECK(highlights == 2);
    CHECK(legends == 1);
    CHECK(series >= 11);
    CHECK_THAT(read_file(folder / "front.svg"), Contains(">time per colour, ns</text>"));
}

TEST_CASE("bench pareto refuses what it does not know in one line", "[cli][bench][refused]") {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"--cases", "leader"},
         "--cases: unknown case 'leader' (did you mean \"leather\"?) (see irido bench pareto "
         "--help)"},
        {{"--count", "0"}, "--count: must be in [1, 1e+05] (got 0)"},
        {{"--count", "1.5"}, "--count: must be a single whole number (got '1.5')"},
        {{"--seed", "-1"}, "--seed: must be in [0, "},
        {{"--time", "0"}, "--time: must be in [1e-04, 60] (got 0)"},
        {{"--plot", "front.gif"}, "--plot: must end in .pdf, .png or .svg (got 'front.gif')"},
        {{"--plot", ""}, "--plot: must name a file"},
        {{"-o", "x.svg", "-f", "csv", "--plot", "x.svg"}, "x.svg: is the same file as"},
        {{"-o", "/no/such/folder/x.csv"}, "/no/such/folder/x.csv: cannot be written"},
        {{"-f", "xml"}, "--format: must be one of csv, json, npy (got 'xml')"},
        {{"--plot", "/no/such/folder/x.svg"}, "/no/such/folder/x.svg: cannot be written"},
    };
    for (const auto& [arguments, error] : cases) {
        std::vector<std::string> all{"bench", "pareto"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        check_refused(run_irido(all), error);
    }
}

TEST_CASE("the help of bench pareto explains cases and columns", "[cli][bench]") {
    const std::string help = run_irido({"bench", "pareto", "--help"}).out;
    for (const ColorCase& one : color_cases())
        CHECK_THAT(help, Contains(std::string(one.name) + ": "));
    CHECK_THAT(help,
               Contains("[1, 1e5] [50]") && Contains("times_faster") && Contains("Examples:"));
}
