#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <map>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Contains;
using Catch::WithinAbs;

namespace {

using Rows = std::vector<std::vector<std::string>>;

Outcome compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return run_irido(arguments);
}

Rows compared(const std::vector<std::string>& arguments) {
    const Outcome outcome = compare(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return parse_csv(outcome.out);
}

const std::vector<std::string> kColumns{"engine", "angle_deg", "r",           "g",
                                        "b",      "hex",       "true_r",      "true_g",
                                        "true_b", "true_hex",  "delta_e_2000"};

const std::string kFilms =
    "id,film_n,film_d_nm,angle_deg,base_n_r,base_n_g,base_n_b,base_k_r,base_k_g,base_k_b\n"
    "coating,1.38,99.6,0,1.52,1.52,1.52,0,0,0\n"
    "soap,1.33,380,45,1,1,1,0,0,0\n"
    "titanium,2.3,35,0,2.15,2.15,2.15,2.9,2.9,2.9\n"
    "metal,1.6,250,40,0.18,0.42,1.37,3.42,2.35,1.77\n";

/// Whether a field is empty; a trailing empty field is missing from the row.
bool is_empty(const std::vector<std::string>& row, std::size_t column) {
    return column >= row.size() || row[column].empty();
}

double number(const std::string& text) {
    return std::strtod(text.c_str(), nullptr);
}

}  // namespace

TEST_CASE("compare prints engines beside exact colours", "[cli][compare]") {
    const Rows rows =
        compared({"1 | 1.38@99.6 | 1.52", "--engine", "gltf,materialx,cycles", "-a", "0,45"});
    CHECK(rows[0] == kColumns);
    REQUIRE(rows.size() == 7);
    CHECK(rows[1][0] == "gltf");
    CHECK(rows[2][0] == "gltf");
    CHECK(rows[2][1] == "45");
    CHECK(rows[3][0] == "materialx");
    // from the engines' own sources, compiled in double precision
    CHECK_THAT(number(rows[1][2]), WithinAbs(0.0107145505387536, 1e-12));
    CHECK_THAT(number(rows[1][4]), WithinAbs(0.0177042214165557, 1e-12));
    CHECK_THAT(number(rows[3][3]), WithinAbs(0.0129441078971938, 1e-12));
    CHECK_THAT(number(rows[5][2]), WithinAbs(0.0138334946977521, 5e-8));
    CHECK_THAT(number(rows[1][10]), WithinAbs(3.619342, 1e-4));
    CHECK_THAT(number(rows[3][10]), WithinAbs(1.388939, 1e-4));
    CHECK_THAT(number(rows[5][10]), WithinAbs(0.197657, 1e-4));
    for (std::size_t i = 1; i < rows.size(); ++i) CHECK(rows[i][9] == rows[1 + (i - 1) % 2][9]);
}

TEST_CASE("compare agrees with irido color", "[cli][compare]") {
    const Outcome color =
        run_irido({"color", "1 | 1.3@300 | Au", "-a", "30", "--method", "gltf", "--quiet"});
    const Rows rows = compared({"1 | 1.3@300 | Au", "--engine", "gltf,naive", "-a", "30"});
    const Rows gltf = parse_csv(color.out);
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK_THAT(number(rows[1][2 + c]), WithinAbs(number(gltf[1][7 + c]), 1e-12));
        const Outcome exact = run_irido({"color", "1 | 1.3@300 | Au", "-a", "30"});
        CHECK_THAT(number(rows[1][6 + c]), WithinAbs(number(parse_csv(exact.out)[1][7 + c]), 2e-6));
    }
}

TEST_CASE("compare names what engines cannot take", "[cli][compare]") {
    const std::vector<std::string> stack{"water | TiO2@40 | (1.5@80 | 2@60)^3 | BK7", "--engine",
                                         "gltf"};
    const Outcome outcome = compare(stack);
    CHECK(outcome.status == 0);
    for (const char* const what :
         {"an incident medium other than air", "its dispersion", "dispersion of the film",
          "all layers but the first (6 more)", "dispersion of the base",
          "indices divided and the thickness multiplied by 1.33"})
        CHECK_THAT(outcome.err, Contains(what));
    std::vector<std::string> strict = stack;
    strict.push_back("--strict");
    check_refused(compare(strict),
                  "engines cannot take an incident medium other than air, its dispersion");
    // engines assume air
    CHECK(compare({"air | 1.3@100 | 1.5", "--strict", "--engine", "gltf", "--quiet"}).status == 0);
    // an absorbing film
    CHECK_THAT(compare({"1 | 1.5+0.1i@300 | 2", "--engine", "gltf"}).err,
               Contains("engines cannot take absorption of the film"));
    check_refused(compare({"1 | 1.5+0.1i@300 | 2", "--engine", "gltf", "--strict"}),
                  "engines cannot take absorption of the film");
    // methods that use the stack itself
    const Outcome whole =
        compare({"water | TiO2@40 | BK7", "--engine", "naive,equal/8", "--strict"});
    CHECK(whole.status == 0);
    CHECK(whole.err.empty());
}

TEST_CASE("compare varies values of the stack", "[cli][compare]") {
    const Rows rows = compared({"air | SiO2@100 | Si", "--engine", "cycles,three", "-a", "0,60",
                                "--vary", "layers.0.thickness_nm=100:300:100", "--quiet"});
    CHECK(rows[0][0] == "layers.0.thickness_nm");
    REQUIRE(rows.size() == 1 + 3 * 2 * 2);
    CHECK(rows[5][0] == "200");
    CHECK(rows[5][1] == "cycles");
    const Rows one = compared({"air | SiO2@200 | Si", "--engine", "cycles,three", "-a", "0,60"});
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t c = 2; c < 11; ++c)
            if (c != 5 && c != 9)
                CHECK_THAT(number(rows[5 + i][1 + c]), WithinAbs(number(one[1 + i][c]), 1e-7));
    const Rows angles = compared({"air | SiO2@100 | Si", "--engine", "cycles", "--vary",
                                  "substrate=Si,Ag", "--vary", "angle_deg=0,30", "--quiet"});
    CHECK(angles[0][1] == "angle_deg");
    CHECK(angles[0][2] == "engine");
    CHECK(angles.size() == 5);
}

TEST_CASE("compare reads tables of films", "[cli][compare]") {
    const TemporaryFolder folder;
    write_text(folder / "films.csv", kFilms);
    const Rows rows =
        compared({"--films", folder / "films.csv", "--rows", "--engine", "gltf,cycles,equal/16"});
    CHECK(rows[0].front() == "id");
    CHECK(std::vector<std::string>(rows[0].begin() + 1, rows[0].end()) == kColumns);
    REQUIRE(rows.size() == 13);
    CHECK(rows[4][0] == "soap");
    CHECK_THAT(number(rows[4][3]), WithinAbs(0.0776185882937332, 1e-12));
    CHECK_THAT(number(rows[4][11]), WithinAbs(4.745796, 1e-4));
    CHECK_THAT(number(rows[8][3]), WithinAbs(0.113871393234369, 5e-8));
    // indices that differ by channel do not define a spectrum
    CHECK(rows[10][0] == "metal");
    CHECK_THAT(number(rows[10][3]), WithinAbs(0.957997124373907, 1e-12));
    for (const std::size_t column : {7, 8, 9, 10, 11}) CHECK(is_empty(rows[10], column));
    for (const std::size_t column : {3, 4, 5, 6, 11}) CHECK(is_empty(rows[12], column));

    const Rows statistics = compared({"--films", folder / "films.csv", "--engine", "gltf,cycles"});
    CHECK(statistics[0] == std::vector<std::string>{"engine", "base", "count", "mean", "median",
                                                    "p95", "max", "worst"});
    REQUIRE(statistics.size() == 9);
    CHECK(statistics[1][1] == "dielectric");
    CHECK(statistics[1][2] == "2");
    CHECK_THAT(number(statistics[1][3]), WithinAbs((3.619342 + 4.745796) / 2, 1e-4));
    CHECK(statistics[1][7] == "soap");
    CHECK(statistics[3][1] == "colored");
    CHECK(is_empty(statistics[3], 3));
    CHECK(statistics[4][1] == "all");
    CHECK(statistics[4][7] == "titanium");

    // grey bases given in two columns
    write_text(folder / "gray.csv",
               "id,film_n,film_d_nm,angle_deg,base_n,base_k\n"
               "coating,1.38,99.6,0,1.52,0\n");
    const Rows gray = compared({"--films", folder / "gray.csv", "--rows", "--engine", "gltf"});
    CHECK(std::vector<std::string>(gray[1].begin(), gray[1].end()) == rows[1]);
}

TEST_CASE("compare draws the same films everywhere", "[cli][compare]") {
    const Outcome one = compare({"--random", "40", "--seed", "3", "-j", "1"});
    CHECK(one.status == 0);
    CHECK(one.out == compare({"--random", "40", "--seed", "3", "-j", "2"}).out);
    CHECK(one.out != compare({"--random", "40", "--seed", "4"}).out);
    const Rows rows = parse_csv(one.out);
    CHECK(rows.size() == 1 + 13 * 4);
    const Rows metals =
        compared({"--random", "5", "--base", "conductor", "--rows", "--engine", "unity"});
    REQUIRE(metals.size() == 6);
    CHECK_THAT(metals[1][0], Contains("i; "));
}

TEST_CASE("compare list names engines, versions and inputs", "[cli][compare]") {
    const Outcome outcome = compare({"list", "-f", "json"});
    CHECK(outcome.status == 0);
    for (const char* const text : {"\"gltf\"", "\"cycles-principled\"", "\"equal/N\"",
                                   "thin_film_thickness in um", "0.187.0", "CIE RGB", "\"white\""})
        CHECK_THAT(outcome.out, Contains(text));
}

TEST_CASE("compare takes the whites that are asked for", "[cli][compare]") {
    const auto difference = [](std::vector<std::string> more) {
        more.insert(more.begin(), {"1 | 1.33@380 | 1", "-a", "45", "--engine", "materialx"});
        return number(compared(more)[1][10]);
    };
    CHECK_THAT(difference({}), WithinAbs(4.310253, 1e-4));
    CHECK_THAT(difference({"--illuminant", "E", "--white", "common"}), WithinAbs(4.688649, 1e-4));
    CHECK_THAT(difference({"--illuminant", "E", "--as-cie-rgb"}), WithinAbs(0.843971, 1e-4));
}

TEST_CASE("compare fits engines and writes their materials", "[cli][compare][slow]") {
    const std::string stack = "schemas/examples/oxidized-silicon.json";
    const Rows rows = compared({stack, "--engine", "gltf,cycles-principled", "--fit", "--quiet"});
    CHECK(rows[0] == std::vector<std::string>{"engine", "parameter", "value"});
    std::map<std::string, double> gltf;
    for (const auto& row : rows)
        if (row[0] == "gltf") gltf[row[1]] = number(row[2]);
    CHECK(gltf.size() == 8);
    CHECK(gltf["delta_e_mean"] < 1.21);
    CHECK(gltf["delta_e_max"] >= gltf["delta_e_mean"]);
    CHECK(rows[rows.size() - 2][1] == "delta_e_mean");
    CHECK(rows.back()[1] == "delta_e_max");

    const auto material = [&](const char* engine, const char* format) {
        const Outcome outcome = compare({stack, "--engine", engine, "--fit", "-f", format});
        INFO(outcome.err);
        CHECK(outcome.status == 0);
        return outcome.out;
    };
    const std::string asset = material("gltf", "gltf");
    CHECK_THAT(asset, Contains("\"KHR_materials_iridescence\""));
    CHECK_THAT(asset, Contains("\"Oxidized silicon wafer\""));
    CHECK_THAT(material("openpbr", "mtlx"), Contains("<open_pbr_surface name="));
    CHECK_THAT(material("materialx", "mtlx"), Contains("<conductor_bsdf name="));
    CHECK_THAT(material("materialx-gltf", "mtlx"), Contains("<gltf_pbr name="));
    CHECK_THAT(material("cycles", "py"), Contains("\"PHYSICAL_CONDUCTOR\""));
    CHECK_THAT(material("cycles-principled", "py"), Contains("nodes[\"Principled BSDF\"]"));
    // a failure to match is reported: a beetle's mirror seen from inside its cuticle
    const std::string beetle = "schemas/examples/jewel-beetle-green.json";
    const Outcome inside = compare({beetle, "--set", "incident=1.59", "--engine", "gltf", "--fit"});
    CHECK(inside.status == 0);
    CHECK_THAT(inside.err, Contains("no match exists: the mean difference of gltf stays at 17"));
    const Outcome outside = compare({beetle, "--engine", "gltf", "--fit"});
    CHECK_THAT(outside.err, !Contains("no match exists"));
    // weights: a single angle can be matched
    const Rows one = compared(
        {stack, "--engine", "gltf", "--fit", "-a", "0,20,80", "--weights", "0,1,0", "--quiet"});
    CHECK(number(one[one.size() - 2][2]) < 0.1);
}

TEST_CASE("compare reads materials of glTF assets", "[cli][compare]") {
    const TemporaryFolder folder;
    write_text(folder / "asset.gltf", R"({"asset": {"version": "2.0"}, "materials": [
        {"name": "glass", "pbrMetallicRoughness": {"metallicFactor": 0},
         "extensions": {"KHR_materials_ior": {"ior": 1.52}, "KHR_materials_iridescence":
            {"iridescenceFactor": 1, "iridescenceIor": 1.38, "iridescenceThicknessMaximum": 99.6}}},
        {"name": "gold", "pbrMetallicRoughness": {"baseColorFactor": [1, 0.77, 0.34, 1]},
         "extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 0.5,
            "iridescenceThicknessTexture": {"index": 0}}}}]})");
    const Rows rows = compared({"--gltf", folder / "asset.gltf"});
    CHECK(rows[0][0] == "material");
    CHECK(rows[0][1] == "thickness_nm");
    CHECK(std::vector<std::string>(rows[0].begin() + 2, rows[0].end()) == kColumns);
    REQUIRE(rows.size() == 1 + 4 + 2 * 4);
    CHECK(rows[1][0] == "glass");
    CHECK_THAT(number(rows[1][4]), WithinAbs(0.0107145505387536, 1e-9));
    CHECK_THAT(number(rows[1][12]), WithinAbs(3.619342, 1e-4));
    CHECK(rows[5][1] == "100");
    CHECK(rows[9][1] == "400");
    CHECK(is_empty(rows[5], 12));  // coloured: no exact colour
    // the factor blends with the bare base, in the exact colour as well
    write_text(folder / "half.gltf", R"({"asset": {"version": "2.0"}, "materials": [
        {"pbrMetallicRoughness": {"metallicFactor": 0},
         "extensions": {"KHR_materials_ior": {"ior": 1.52}, "KHR_materials_iridescence":
            {"iridescenceFactor": 0, "iridescenceIor": 1.38}}}]})");
    const Rows bare = compared({"--gltf", folder / "half.gltf", "--engine", "gltf"});
    CHECK_THAT(number(bare[1][4]), WithinAbs(0.042579994960947345, 1e-12));
    CHECK(number(bare[1][12]) < 0.01);
    check_refused(compare({"--gltf", folder / "half.gltf", "--engine", "cycles"}),
                  "--engine: cycles does not take the inputs of glTF");
    check_refused(compare({"--gltf", folder / "half.gltf", "--fit"}), "--gltf: cannot be combined");
    write_text(folder / "plain.gltf", R"({"asset": {"version": "2.0"}})");
    check_refused(compare({"--gltf", folder / "plain.gltf"}),
                  "no material has KHR_materials_iridescence");
    write_text(folder / "broken.gltf", "{\"asset\": ");
    check_refused(compare({"--gltf", folder / "broken.gltf"}), "broken.gltf: 1:");
    write_text(folder / "broken.glb", "glTF");
    check_refused(compare({"--gltf", folder / "broken.glb"}), "not a binary glTF file: truncated");
}

TEST_CASE("compare reads back the asset of a fit", "[cli][compare][slow]") {
    const TemporaryFolder folder;
    const std::string stack = "1 | 1.47@400 | 1.33";
    const std::string asset = folder / "fit.gltf";
    const Rows fit = compared({stack, "--engine", "gltf", "--fit"});
    CHECK(compare({stack, "--engine", "gltf", "--fit", "-o", asset}).status == 0);
    const Rows rows = compared({"--gltf", asset, "--engine", "gltf", "-a", "40"});
    REQUIRE(rows.size() == 2);
    CHECK(rows[1][0] == stack);
    CHECK(rows[1][1] == fit[5][2]);
}

TEST_CASE("compare holds a table of colours against the exact ones", "[cli][compare][slow]") {
    const TemporaryFolder folder;
    const std::string stack = "air | 1.33@400 | 1.9+1.5i", file = folder / "film.ktx2";
    const auto make = [&](const std::string& size) {
        REQUIRE(run_irido({"lut", "color", stack, "--vary", "layers.0.thickness_nm=0:800/64",
                           "--size", size, "-o", file, "--quiet"})
                    .status == 0);
        return compared({"--lut", file, stack, "--random", "100", "--seed", "2"});
    };
    const Rows coarse = make("16,32"), fine = make("64,256");
    CHECK(fine[0] == std::vector<std::string>{"count", "mean", "median", "p95", "max", "worst"});
    CHECK(fine[1][0] == "100");
    CHECK(number(fine[1][1]) < 0.1 * number(coarse[1][1]));
    CHECK(number(fine[1][4]) < 0.5);
    CHECK_THAT(fine[1][5], Contains("cos_theta=") && Contains("; layers.0.thickness_nm="));
    // for the table's own stack, point by point
    const Rows points = compared({"--lut", file, "--random", "100", "--seed", "2", "--rows"});
    CHECK(points[0] == std::vector<std::string>{"cos_theta", "layers.0.thickness_nm", "r", "g", "b",
                                                "hex", "true_r", "true_g", "true_b", "true_hex",
                                                "delta_e_2000"});
    REQUIRE(points.size() == 101);
    double most = 0;
    for (std::size_t i = 1; i < points.size(); ++i) most = std::max(most, number(points[i][10]));
    CHECK(most == number(fine[1][4]));
    const double angle = 90 - std::asin(number(points[1][0])) * 180 / M_PI;
    const Outcome exact =
        run_irido({"color", stack, "--set", "layers.0.thickness_nm=" + points[1][1], "-a",
                   std::to_string(angle)});
    CHECK_THAT(number(points[1][6]), WithinAbs(number(parse_csv(exact.out)[1][7]), 1e-5));
    // for a different stack
    CHECK(number(compared({"--lut", file, "air | 1.5@400 | 1.9+1.5i", "--random", "50"})[1][1]) >
          2);
    check_refused(compare({"--lut", file, "--fit"}), "--lut: can be combined with STACK");
    const std::string other = folder / "other.csv";
    REQUIRE(run_irido({"lut", "cumulative", "-o", other, "--quiet"}).status == 0);
    check_refused(compare({"--lut", other}), "must be a table of kind color");
    check_refused(compare({"--lut", folder / "none.ktx2"}), "none.ktx2");
}

TEST_CASE("compare draws strips, maps and histograms", "[cli][compare]") {
    const auto svg = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), {"-f", "svg", "--quiet"});
        const Outcome outcome = compare(arguments);
        INFO(outcome.err);
        CHECK(outcome.status == 0);
        CHECK(outcome.out.starts_with("<"));
        return outcome.out;
    };
    const std::string stack = "1 | 1.3@300 | Au";
    const std::string strips = svg({stack, "--engine", "gltf,cycles", "-a", "0:80:5"});
    for (const char* const text : {"exact", "gltf", "cycles", "CIEDE2000"})
        CHECK_THAT(strips, Contains(text));
    CHECK_THAT(svg({stack, "--engine", "gltf,cycles"}), Contains("exact"));
    svg({stack, "--engine", "gltf,cycles", "-a", "0:80:5", "--vary",
         "layers.0.thickness_nm=0:500:20"});
    const std::string histogram = svg({"--random", "50", "--engine", "gltf,cycles"});
    CHECK_THAT(histogram, Contains("films, %"));
    CHECK_THAT(histogram, Contains("50 random films"));
}

TEST_CASE("compare ends where the exact colour cannot be had", "[cli][compare][slow]") {
    const std::string mirror = "(2.3@58 | 1.46@94)^1000000000";
    const Outcome resonator = compare(
        {"1 | " + mirror + " | 1.5@300 | " + mirror + " | 1.5", "--engine", "naive", "--quiet"});
    CHECK(resonator.status == 1);
    CHECK(resonator.out.empty());
    CHECK_THAT(resonator.err, Contains("the exact colour cannot be had"));
}

TEST_CASE("compare refuses what it cannot do", "[cli][compare][slow]") {
    const TemporaryFolder folder;
    const std::string stack = "1 | 1.3@300 | 2";
    check_refused(compare({}), "STACK is required (see irido compare --help)");
    check_refused(compare({stack, "--engine", "glft"}),
                  "--engine: must be one of gltf, three, babylon, unity, materialx, "
                  "materialx-gltf, openpbr, cycles, cycles-principled, gaussian, smits, naive, "
                  "equal/N (got 'glft') (did you mean \"gltf\"?)");
    check_refused(compare({stack, "--engine", "gltf,gltf"}), "--engine: gltf is named twice");
    check_refused(compare({stack, "--engine", "equal/1"}), "--engine: the number of equal");
    check_refused(compare({stack, "-a", "95"}), "--angles");
    check_refused(compare({stack, "--white", "e"}),
                  "--white: must be one of own, common (got 'e')");
    check_refused(compare({stack, "--rows"}), "--rows: requires --films or --random");
    check_refused(compare({stack, "--seed", "1"}), "--seed and --base require --random");
    check_refused(compare({stack, "--random", "5"}),
                  "--films and --random cannot be combined with a STACK");
    check_refused(compare({"--random", "0"}), "--random");
    check_refused(compare({"--random", "5", "--base", "glass"}),
                  "--base: must be one of dielectric, conductor, colored, all (got 'glass')");
    check_refused(compare({"--random", "5", "--films", "x.csv"}), "mutually exclusive");
    check_refused(compare({"--random", "5", "-a", "5"}), "--angles and --vary require a STACK");
    check_refused(compare({"--random", "5", "--fit"}), "--fit and --weights require a STACK");
    check_refused(compare({stack, "--weights", "1"}), "--weights: requires --fit");
    check_refused(compare({stack, "--fit", "--weights", "1,2"}),
                  "--weights: must have one value per angle, 17 (got 2)");
    check_refused(compare({stack, "--fit", "-a", "0,1", "--weights", "0,0"}),
                  "--weights: must not all be 0");
    check_refused(compare({stack, "--fit", "--engine", "naive"}),
                  "--engine: naive has no parameters to fit");
    check_refused(compare({stack, "--fit", "--engine", "gltf", "-f", "mtlx"}),
                  "--format: mtlx requires --engine materialx or materialx-gltf or openpbr");
    check_refused(compare({stack, "--fit", "--engine", "gltf,three", "-f", "gltf"}),
                  "--format: gltf requires one --engine");
    check_refused(compare({stack, "--vary", "layers.3.thickness_nm=1,2"}), "layers.3");
    check_refused(compare({"1 | 1e-5@300 | 2"}), "film index must be in [0.001, 10000]");
    const auto table = [&](const std::string& text) {
        write_text(folder / "bad.csv", text);
        return compare({"--films", folder / "bad.csv"});
    };
    check_refused(table("id,film_n,film_d_nm,angle_deg,base_n\na,1.3,x,0,2\n"),
                  "film_d_nm: row 1: must be a number (got 'x')");
    check_refused(table("id,film_n,angle_deg,base_n\na,1.3,0,2\n"),
                  "the column 'film_d_nm' is missing");
    check_refused(table("film_n,film_d_nm,angle_deg,base_n\n1.3,2,0,2\n"),
                  "the column 'id' is missing");
    check_refused(table("id,film_n,film_d_nm,angle_deg,base_n,base_l\na,1.3,2,0,2,1\n"),
                  "unknown column 'base_l' (did you mean \"base_n\"?)");
    check_refused(table("id,film_n,film_d_nm,angle_deg,base_n,base_k_r\na,1.3,2,0,2,1\n"),
                  "base_n and base_k cannot be combined with base_n_r, base_k_r, ...");
    check_refused(table("id,film_n,film_d_nm,angle_deg,base_n\na,1.3,-2,0,2\n"),
                  "film a: thickness_nm must be in [0, 1e+09] (got -2)");
    check_refused(table("id,film_n,film_d_nm,angle_deg,base_n\na,1.3,2,91,2\n"), "film a: angle");
}
