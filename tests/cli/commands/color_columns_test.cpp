#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::WithinAbs;
using Catch::Matchers::Contains;

namespace {

using Row = std::map<std::string, std::string>;

const std::string kFilm = "1 | 2.2@150 | 0.2+3.4i";
const std::string kTerms =
    "L,a,b,C_ab,h_ab_deg,u,v,C_uv,h_uv_deg,dominant_nm,excitation_purity,whiteness_cie,tint_cie";

std::vector<Row> colored(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "color");
    const Outcome outcome = done(arguments);
    const auto table = parse_csv(outcome.out);
    std::vector<Row> rows;
    for (std::size_t i = 1; i < table.size(); ++i)
        for (std::size_t c = 0; c < table[0].size(); ++c) {
            if (c == 0) rows.emplace_back();
            rows.back()[table[0][c]] = table[i][c];
        }
    return rows;
}

double number(const Row& row, const std::string& column) {
    INFO(column);
    return std::stod(row.at(column));
}

}  // namespace

// Reference: the spectrum integrated cell by cell to 1e-13, then the definitions of CIE 15.
TEST_CASE("colour columns of a film", "[cli][color]") {
    const std::map<std::string, double> expected{
        {"L", 95.0255158343081},
        {"a", 4.294786742673185},
        {"b", 2.4299710511515777},
        {"C_ab", 4.934567101020722},
        {"h_ab_deg", 29.50098656808114},
        {"u", 7.912848156167295},
        {"v", 2.9352104943568027},
        {"C_uv", 8.43970536148878},
        {"h_uv_deg", 20.351950305626197},
        {"dominant_nm", 598.5555357029377},
        {"excitation_purity", 0.032835463604343564},
        {"whiteness_cie", 76.80081827611711},
        {"tint_cie", -9.03224570599646},
        {"delta_e_76", 22.65055178885665},
        {"delta_e_2000", 20.688688783825505},
        {"delta_e_cmc_2_1", 15.362954569681389},
        {"delta_e_cmc_1_1", 15.362962084291448},
    };
    for (const std::string tolerance : {"1e-2", "1e-6"}) {
        const auto rows = colored({kFilm, "-a", "30", "--columns", kTerms, "--target", "95,-10,20",
                                   "--tolerance", tolerance});
        REQUIRE(rows.size() == 1);
        for (const auto& [column, value] : expected) {
            INFO(column << " " << tolerance);
            CHECK_THAT(
                number(rows[0], column),
                WithinAbs(value, column == "dominant_nm" || column == "h_ab_deg" ? 1e-3 : 2e-5));
        }
    }
}

TEST_CASE("columns stand after in_gamut, in the order typed", "[cli][color]") {
    const Outcome outcome = run_irido(
        {"color", kFilm, "--columns", "b,L", "--target", "#808080", "--stats", "--side", "R,T"});
    const auto rows = parse_csv(outcome.out);
    REQUIRE(rows.size() == 3);
    CHECK(std::vector<std::string>(rows[0].begin() + 11, rows[0].begin() + 19) ==
          std::vector<std::string>{"in_gamut", "b", "L", "delta_e_76", "delta_e_2000",
                                   "delta_e_cmc_2_1", "delta_e_cmc_1_1", "method"});
    const auto named = colored({kFilm, "--columns", "delta_e_2000,L", "--target", "#808080"});
    CHECK(named[0].count("delta_e_76") == 0);
    CHECK(number(named[0], "delta_e_2000") == std::stod(rows[1][15]));
}

TEST_CASE("the printed hex is its own target, whatever the space", "[cli][color]") {
    for (const std::string space : {"srgb", "rec2020", "display-p3", "acescg"})
        for (const std::string illuminant : {"D65", "A"}) {
            const std::vector<std::string> request{"1 | 1.5@200 | 3", "--space", space,
                                                   "--illuminant", illuminant};
            auto again = request;
            again.insert(again.end(), {"--target", colored(request)[0].at("hex")});
            INFO(space << " " << illuminant);
            // Half of one level in 255; in acescg levels are linear.
            CHECK(number(colored(again)[0], "delta_e_2000") < (space == "acescg" ? 1 : 0.6));
        }
}

TEST_CASE("Lab of dark colours holds 1e-4", "[cli][color]") {
    // A film that reflects 1e-5: there Lab has slopes of 4000.
    const std::string stack = "1.5 | 1.51@700 | 1.5";
    const auto coarse = colored({stack, "-a", "0,30", "--columns", "L,a,b", "--tolerance", "1e-2"});
    const auto fine = colored({stack, "-a", "0,30", "--columns", "L,a,b", "--tolerance", "1e-12"});
    for (std::size_t i = 0; i < 2; ++i)
        for (const std::string column : {"L", "a", "b"})
            CHECK_THAT(number(coarse[i], column), WithinAbs(number(fine[i], column), 1e-4));
}

TEST_CASE("fields of a colour that has no hue are empty", "[cli][color]") {
    const auto black = colored({"1 | 1@300 | 1", "--columns", kTerms});
    for (const std::string column : {"h_ab_deg", "h_uv_deg", "dominant_nm"})
        CHECK(black[0].at(column).empty());
    CHECK(black[0].at("L") == "0");
    CHECK(black[0].at("excitation_purity") == "0");
    const auto mirror = colored({"1 | 1.5@300 | 1", "-a", "90", "--columns", kTerms});
    CHECK(mirror[0].at("L") == "100");
    CHECK(mirror[0].at("dominant_nm").empty());
    CHECK_THAT(number(mirror[0], "whiteness_cie"), WithinAbs(100, 1e-9));
    const Outcome json =
        run_irido({"color", "1 | 1@300 | 1", "--columns", "h_ab_deg", "-f", "json"});
    CHECK_THAT(json.out, Contains("\"h_ab_deg\":null") || Contains("\"h_ab_deg\": null"));
}

TEST_CASE("whiteness belongs to D65", "[cli][color]") {
    const Outcome outcome =
        run_irido({"color", kFilm, "--columns", "whiteness_cie,L", "--illuminant", "A"});
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.err, Contains("defined for D65") && Contains("under A"));
    const auto rows = parse_csv(outcome.out);
    CHECK(rows[1][12].empty());
    const auto all =
        colored({kFilm, "--columns", "whiteness_cie,L", "--compare-illuminants", "--quiet"});
    CHECK_FALSE(all[0].at("whiteness_cie").empty());
    CHECK(all[1].at("whiteness_cie").empty());
}

TEST_CASE("columns of a sweep and of a cone are those of a colour", "[cli][color][sweep]") {
    const Outcome swept =
        run_irido({"sweep", kFilm, "--vary", "layers.0.thickness_nm=150,160", "--compute", "color",
                   "-a", "30", "--columns", "L,dominant_nm", "--target", "60,0,0", "--quiet"});
    INFO(swept.err);
    const auto rows = parse_csv(swept.out);
    REQUIRE(rows.size() == 3);
    const auto alone =
        colored({kFilm, "-a", "30", "--columns", "L,dominant_nm", "--target", "60,0,0"});
    CHECK(rows[0][13] == "L");
    CHECK_THAT(std::stod(rows[1][13]), WithinAbs(number(alone[0], "L"), 1e-6));
    CHECK_THAT(std::stod(rows[1][16]), WithinAbs(number(alone[0], "delta_e_2000"), 1e-4));
    const auto narrow = colored({kFilm, "-a", "30", "--columns", "L", "--cone", "0.01", "--quiet"});
    CHECK_THAT(number(narrow[0], "L"), WithinAbs(number(alone[0], "L"), 1e-4));
}

TEST_CASE("colour columns that are refused", "[cli][refused]") {
    struct Case {
        std::vector<std::string> options;
        std::string error;
    };
    const std::vector<Case> cases{
        {{"--columns", "Lab"}, "--columns: must be one of L, a, b"},
        {{"--columns", "L,L"}, "--columns: each column must be named once (got L twice)"},
        {{"--columns", "delta_e_76"}, "--columns: delta_e_76 requires --target"},
        {{"--columns", "dominant"}, "(did you mean \"dominant_nm\"?)"},
        {{"--target", "#12345"}, "--target: must be #rrggbb (got '#12345')"},
        {{"--target", "1,2"}, "--target: must be #rrggbb or L,a,b (got '1,2')"},
        {{"--target", "-1,2,3"}, "--target: L: must be in [0, 1000] (got -1)"},
        {{"--target", "1,x,3"}, "--target: a: "},
        {{"--target", "#808080", "--compare-illuminants"},
         "--target: cannot be combined with --compare-illuminants"},
    };
    for (const auto& [options, error] : cases) {
        std::vector<std::string> arguments{"color", kFilm};
        arguments.insert(arguments.end(), options.begin(), options.end());
        check_refused(run_irido(arguments), error);
    }
}
