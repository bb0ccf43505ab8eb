#include "schemas/readers/materials/refractiveindex_info.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "core/material/air.hpp"
#include "schemas/input_error.hpp"

using namespace irido;
using namespace irido::schemas;
using Catch::Matchers::WithinAbs;

namespace {

MaterialFile read(const std::string& text) {
    return read_refractiveindex_info(text, "m.yml");
}

RefractiveIndex index_of(const std::string& text) {
    return std::get<RefractiveIndex>(read(text).material.model);
}

std::string error_of(const std::string& text) {
    try {
        read(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

std::string table(const std::string& type, const std::string& rows) {
    return "  - type: tabulated " + type + "\n    data: |\n" + rows;
}

bool has_note(const MaterialFile& file, const std::string& note) {
    return std::find(file.notes.begin(), file.notes.end(), note) != file.notes.end();
}

const std::string kFormulaN =
    "  - type: formula 5\n    wavelength_range: 0.38 0.78\n    coefficients: 1.5 0.004 -2\n";

}  // namespace

TEST_CASE("a table of n and k, its source and its name", "[rii]") {
    const auto file = read(
        "# comment\n\nREFERENCES: |\n    P. Johnson and R. Christy, 1) n < 2.\n"
        "    <a href=\"https://doi.org/x\"><i>Phys. Rev. B</i> <b>6</b>, 4370 (1972)</a><br>\n"
        "COMMENTS: |\n    tab\there, type: formula 9\nDATA:\n" +
        table("nk", "        0.5486 0.06 3.586\n        0.5821 .05 3.858\n"));
    CHECK(file.material.name == "m.yml");
    CHECK(file.source == "P. Johnson and R. Christy, 1) n < 2. Phys. Rev. B 6, 4370 (1972)");
    CHECK(file.notes.empty());
    CHECK(range_of(file.material) == WavelengthRange{548.6, 582.1});
    CHECK(index_at(file.material, 548.6) == Complex(0.06, 3.586));
    CHECK(index_at(file.material, 582.1) == Complex(0.05, 3.858));
}

TEST_CASE("a formula with its range, k absent", "[rii]") {
    const auto file = read("DATA:\n" + kFormulaN);
    CHECK(range_of(file.material) == WavelengthRange{380, 780});
    CHECK_THAT(index_at(file.material, 500).real(), WithinAbs(1.516, 1e-15));
    CHECK(index_at(file.material, 500).imag() == 0);
    CHECK(has_note(file, "no k in the file: k = 0"));
    CHECK(file.source.empty());
}

TEST_CASE("wavelengths in um become the exact decimals in nm", "[rii]") {
    const auto index = index_of("DATA:\n" + table("n",
                                                  "        8e-5 1\n        0.57 1\n"
                                                  "        4.35 1\n        1e5 1\n"));
    CHECK(index.n == Dispersion{Table{{0.08, 570, 4350, 1e8}, {1, 1, 1, 1}}});
}

TEST_CASE("types inside PROPERTIES do not count", "[rii]") {
    const auto index = index_of(
        "PROPERTIES:\n  nd: 1.5\n  thermal_dispersion:\n    - type: formula A\n"
        "      coefficients: 1e-6 2e-6\nCONDITIONS:\n  temperature: 293\nDATA:\n" +
        kFormulaN);
    CHECK(index.n == Dispersion{Formula{5, {1.5, 0.004, -2}, {380, 780}}});
}

TEST_CASE("n and k from separate grids", "[rii]") {
    const auto file = read("DATA:\n" + table("n", "        0.4 1.5\n        0.8 1.4\n") +
                           table("k", "        0.3 0\n        0.5 0.2\n        0.9 0.4\n"));
    CHECK_THAT(index_at(file.material, 600).real(), WithinAbs(1.45, 1e-15));
    CHECK_THAT(index_at(file.material, 600).imag(), WithinAbs(0.25, 1e-15));
    CHECK(range_of(file.material) == WavelengthRange{400, 800});
    CHECK(file.notes.empty());
}

TEST_CASE("n given twice must agree, k comes from the table", "[rii]") {
    const auto both = [&](double apart) {
        return "DATA:\n" + kFormulaN +
               table("nk", "        0.4 " + std::to_string(1.525 + apart) + " 0.1\n        0.7 " +
                               std::to_string(1.5 + 0.004 / 0.49) + " 0.2\n");
    };
    const auto index = index_of(both(0.001));
    CHECK(std::holds_alternative<Formula>(index.n));
    CHECK(index.k == Dispersion{Table{{400, 700}, {0.1, 0.2}}});
    bool told = false;
    for (const std::string& note : read(both(0.001)).notes)
        told |= note.starts_with("DATA/1: n given twice, at most 0.001") &&
                note.ends_with(" apart: the first is used");
    CHECK(told);
    CHECK(error_of(both(0.01)) == "m.yml: DATA/1: n is given twice with different values");
    CHECK(error_of("DATA:\n" + kFormulaN + kFormulaN) ==
          "m.yml: DATA/1: n is given twice with different values");
    CHECK(error_of("DATA:\n" + kFormulaN + table("n", "        0.9 1.5\n        1.1 1.5\n")) ==
          "m.yml: DATA/1: n is given twice with different values");
}

TEST_CASE("blocks that do not overlap are joined", "[rii]") {
    const std::string low = table("k", "        0.38 0.1\n        0.5 0.2\n");
    const std::string high = table("k", "        0.6 0.3\n        0.78 0.4\n");
    for (const std::string& blocks : {low + high, high + low}) {
        const auto file = read("DATA:\n" + kFormulaN + blocks);
        CHECK(std::get<RefractiveIndex>(file.material.model).k ==
              Dispersion{Table{{380, 500, 600, 780}, {0.1, 0.2, 0.3, 0.4}}});
        CHECK(has_note(file,
                       "DATA/2: k joined to the table before, interpolated from 500 to 600 nm"));
    }
    CHECK(error_of("DATA:\n" + kFormulaN + low + low).find("apart") == std::string::npos);
    CHECK(error_of("DATA:\n" + kFormulaN + low + table("k", "        0.4 0.3\n")) ==
          "m.yml: DATA/2: k is given twice with different values");
}

TEST_CASE("k before n", "[rii]") {
    const auto index =
        index_of("DATA:\n" + table("k", "        0.38 0.1\n        0.78 0.2\n") + kFormulaN);
    CHECK(std::holds_alternative<Formula>(index.n));
    CHECK(std::holds_alternative<Table>(index.k));
}

TEST_CASE("where k is not known the material is not, unless k is very small", "[rii]") {
    const auto glass =
        read("DATA:\n" + kFormulaN + table("k", "        0.28 1e-6\n        0.29 1e-7\n"));
    CHECK(range_of(glass.material) == WavelengthRange{380, 780});
    CHECK(index_at(glass.material, 400).imag() == 1e-7);
    CHECK(
        has_note(glass,
                 "k is known from 280 to 290 nm only, n from 380 to 780 nm: k = 1e-07 is extended "
                 "above 290 nm"));

    const auto shorter =
        read("DATA:\n" + kFormulaN + table("k", "        0.4 1e-5\n        0.6 0.1\n"));
    CHECK(range_of(shorter.material) == WavelengthRange{380, 600});
    CHECK(index_at(shorter.material, 399).imag() == 1e-5);
    CHECK(index_at(shorter.material, 600).imag() == 0.1);
    CHECK_THROWS_WITH(index_at(shorter.material, 601),
                      "k of m.yml is known from 380 to 600 nm (asked for 601)");
    CHECK_THROWS_WITH(index_at(shorter.material, 781),
                      "m.yml is known from 380 to 780 nm (asked for 781)");
    CHECK(
        has_note(shorter,
                 "k is known from 400 to 600 nm only, n from 380 to 780 nm: k = 1e-05 is extended "
                 "below 400 nm"));
    CHECK(
        has_note(shorter,
                 "k is known from 400 to 600 nm only, n from 380 to 780 nm: k = 0.1 is not small, "
                 "so the material is not known above 600 nm"));
    CHECK(error_of("DATA:\n" + kFormulaN + table("k", "        0.9 0.1\n        1.1 0.1\n")) ==
          "m.yml: n is known from 380 to 780 nm and k from 900 to 1100 nm: they do not overlap");
}

TEST_CASE("what is relative to air is converted to vacuum", "[rii]") {
    const std::string formula = "DATA:\n" + kFormulaN;
    const double plain = 1.5 + 0.004 / 0.25, air = index_of_air(vacuum_wavelength(500, 20), 20);
    const double vacuum_500 = vacuum_wavelength(500, 20);
    const auto n_at = [](const std::string& text, double nm) {
        return index_at(read(text).material, nm).real();
    };
    const auto in_air = GENERATE(
        as<std::string>{},
        "SPECS:\n    n_is_absolute: false\n    wavelength_is_vacuum: false\n    temperature: 20.0 "
        "\xC2\xB0"
        "C\n",
        "SPECS:\n    n_absolute: false\n    wavelength_vacuum: false\n",
        "CONDITIONS:\n    n_is_absolute: false\n    \xCE\xBB_is_vacuum: false\n    temperature: "
        "293.15\n",
        "CONDITIONS:\n    temperature: 293\nPROPERTIES:\n    glass_code: 517642.251\n",
        "REFERENCES: |\n    <a href=\"x\">MAKER Zemax catalog 2017-11</a>\n");
    CAPTURE(in_air);
    CHECK_THAT(n_at(formula + in_air, vacuum_500), WithinAbs(plain * air, 1e-15));
    CHECK(range_of(read(formula + in_air).material) == WavelengthRange{380, 780});
    bool told = false;
    for (const std::string& note : read(formula + in_air).notes)
        told |= note.starts_with("n relative to air and wavelengths in air (20 C") &&
                note.ends_with("converted to vacuum");
    CHECK(told);
    CHECK_THAT(
        n_at("DATA:\n" + table("n", "        0.5 1.5\n        0.6 1.5\n") + in_air, vacuum_500),
        WithinAbs(1.5 * air, 1e-15));
}

TEST_CASE("what says that it is absolute is not converted", "[rii]") {
    const std::string absolute =
        "SPECS:\n    n_is_absolute: true\n    wavelength_is_vacuum: true\n    glass_code: 1\n"
        "PROPERTIES:\n    glass_code: 517642.251\n";
    CHECK(index_at(read("DATA:\n" + kFormulaN + absolute).material, 500) ==
          index_at(read("DATA:\n" + kFormulaN).material, 500));
    // each on its own: at 22 C
    const std::string index_only = "SPECS:\n    n_is_absolute: false\n    temperature: 22 C\n";
    CHECK_THAT(index_at(read("DATA:\n" + kFormulaN + index_only).material, 500).real(),
               WithinAbs((1.5 + 0.004 / 0.25) * index_of_air(500, 22), 1e-15));
}

TEST_CASE("files of before 2018 and lists of YAML are read", "[rii]") {
    const auto expected = index_of("DATA:\n" + kFormulaN);
    CHECK(index_of("DATA:\n  - type: formula 5\n    range: 0.38 0.78\n    coefficients: 1.5 0.004 "
                   "-2\n") == expected);
    CHECK(index_of("DATA:\n  - type: formula 5\n    wavelength_range: [0.38, 0.78]\n"
                   "    coefficients: [1.5, 0.004, -2]\n") == expected);
    CHECK(index_of("DATA:\n  - type: tabulated nk\n    data:\n      - [0.4, 1.5, 0.1]\n"
                   "      - 0.5 1.4 0.2\n") ==
          index_of("DATA:\n" + table("nk", "        0.4 1.5 0.1\n        0.5 1.4 0.2\n")));
    CHECK(error_of("DATA:\n  - type: formula 5\n    coefficients: [1, [2, 3]]\n    range: 1 2\n") ==
          "m.yml: DATA/0: must be a list of numbers only");
}

TEST_CASE("a formula whose last coefficient is missing is refused", "[rii]") {
    struct Whole {
        int formula;
        std::vector<std::size_t> counts;
        std::size_t most;
    };
    const std::vector<std::size_t> odd{1, 3, 5, 7, 9, 11, 13, 15, 17}, to_11{1, 3, 5, 7, 9, 11};
    for (const auto& [formula, counts, most] : {Whole{1, odd, 17},
                                                {2, odd, 17},
                                                {3, odd, 17},
                                                {4, {1, 5, 9, 11, 13, 15, 17}, 17},
                                                {5, to_11, 11},
                                                {6, to_11, 11},
                                                {7, {1, 2, 3, 4, 5, 6}, 6},
                                                {8, {1, 3, 4}, 4},
                                                {9, {1, 3, 6}, 6}})
        for (std::size_t count = 0; count <= most + 1; ++count) {
            std::string text = "DATA:\n  - type: formula " + std::to_string(formula) +
                               "\n    wavelength_range: 0.4 0.8\n    coefficients:";
            for (std::size_t i = 0; i < count; ++i) text += " 0.1";
            CAPTURE(formula, count);
            const bool whole = std::ranges::find(counts, count) != counts.end();
            CHECK((error_of(text + "\n") == "no error") == whole);
        }
    CHECK(
        error_of("DATA:\n  - type: formula 2\n    wavelength_range: 0.4 0.8\n"
                 "    coefficients: 3.6453 2.2057 0.1879 1.8377\n") ==
        "m.yml: DATA/0: formula 2 must have 1, 3, 5, 7, 9, 11, 13, 15 or 17 coefficients (got 4)");
}

TEST_CASE("rows out of order are sorted, equal wavelengths averaged", "[rii]") {
    const auto file = read("DATA:\n" + table("nk",
                                             "        0.5 1.5 0.1\n        0.4 1.6 0.2\n"
                                             "        0.5 1.7 0.3\n        0.6 1.4 0\n"));
    const auto& index = std::get<RefractiveIndex>(file.material.model);
    CHECK(index.n == Dispersion{Table{{400, 500, 600}, {1.6, 1.6, 1.4}}});
    CHECK(index.k == Dispersion{Table{{400, 500, 600}, {0.2, 0.2, 0}}});
    CHECK(has_note(file, "DATA/0: rows sorted by wavelength"));
    CHECK(has_note(file, "DATA/0: rows at equal wavelengths averaged, 1 row fewer"));
}

TEST_CASE("negative k is noise and becomes 0", "[rii]") {
    const auto file = read("DATA:\n" + table("nk",
                                             "        0.4 1.5 -1e-3\n        0.5 1.5 -1\n"
                                             "        0.6 1.5 0.1\n"));
    CHECK(std::get<RefractiveIndex>(file.material.model).k ==
          Dispersion{Table{{400, 500, 600}, {0, 0, 0.1}}});
    CHECK(has_note(file, "DATA/0: k < 0 set to 0 in 2 rows"));
}

TEST_CASE("a negative n is read, and refused where it is used", "[rii]") {
    const auto file = read("DATA:\n" + table("n", "        1.2 1.5\n        1.5 -0.3\n"));
    CHECK(index_at(file.material, 1200) == Complex(1.5, 0));
    CHECK_THROWS(index_at(file.material, 1500));
}

TEST_CASE("a wavelength_range on a table and unknown keys are ignored", "[rii]") {
    const auto index = index_of(
        "FUTURE: [1, 2]\nDATA:\n  - type: tabulated n\n    wavelength_range: 0.1 9\n    x: y\n"
        "    data: |\n        0.4 1.5\n        0.8 1.4\n");
    CHECK(index.n == Dispersion{Table{{400, 800}, {1.5, 1.4}}});
}

TEST_CASE("a single row", "[rii]") {
    const auto file = read("DATA:\n" + table("n", "        0.5876 1.473\n"));
    CHECK(range_of(file.material) == WavelengthRange{587.6, 587.6});
    CHECK(index_at(file.material, 587.6) == Complex(1.473, 0));
}

TEST_CASE("number forms, blank lines, trailing blanks, no newline at the end", "[rii]") {
    const auto index = index_of("DATA:\n" + table("n",
                                                  "\n        .4 1E-03   \n\n"
                                                  "        5e-1\t+2\n        2.5e+2 4"));
    CHECK(index.n == Dispersion{Table{{400, 500, 250000}, {1e-3, 2, 4}}});
}

TEST_CASE("a coefficient alone is still a number", "[rii]") {
    const auto index = index_of(
        "DATA:\n  - type: formula 3\n    coefficients: 2.25\n    wavelength_range: .4 1\n");
    CHECK(index.n == Dispersion{Formula{3, {2.25}, {400, 1000}}});
}

TEST_CASE("formula 4 with unused poles is finite at 1 um", "[rii]") {
    // J. Walling et al. (1980), alexandrite, has c6 = c8 = c9 = 0.
    const auto file = read(
        "DATA:\n  - type: formula 4\n    wavelength_range: 0.25 2.6\n"
        "    coefficients: 2 1 2 0.01 1 0 0 0 0 -0.01 2\n");
    CHECK_THAT(index_at(file.material, 1000).real(),
               WithinAbs(std::sqrt(2 + 1 / 0.99 - 0.01), 1e-15));
}

TEST_CASE("what is no linear index is refused", "[rii]") {
    CHECK(error_of("DATA:\n" + table("n2", "        1.55 1.80-17\n")) ==
          "m.yml: DATA/0: tabulated n2 is a nonlinear index in m^2/W, not a refractive index");
    CHECK(error_of("DATA:\n" + table("k", "        0.4 1\n")) ==
          "m.yml: DATA: must give n (got k only)");
    CHECK(error_of("DATA:\n" + table("q", "        0.4 1\n")) ==
          "m.yml: DATA/0: unknown type 'tabulated q'");
    CHECK(error_of("DATA:\n  - type: spline 3\n") == "m.yml: DATA/0: unknown type 'spline 3'");
    CHECK(error_of("NAMES:\n  - a\nABOUT: b\n") ==
          "m.yml: DATA: must be a list of formulas and tables");
    CHECK(error_of("DATA: []\n") == "m.yml: DATA: must be a list of formulas and tables");
    CHECK(error_of("DATA: 5\n") == "m.yml: DATA: must be a list of formulas and tables");
    CHECK(error_of("") == "m.yml: DATA: must be a list of formulas and tables");
    CHECK(error_of("- 1\n- 2\n") == "m.yml: DATA: must be a list of formulas and tables");
    CHECK(error_of("DATA:\n  - 7\n") == "m.yml: DATA/0: must be a map with a type");
    CHECK(error_of("DATA:\n  - x: 7\n") == "m.yml: DATA/0: must have the text 'type'");
}

TEST_CASE("faults in tables and formulas are told", "[rii]") {
    CHECK(error_of("DATA:\n" + table("n", "        0.4 1.80-17\n")) ==
          "m.yml: DATA/0: must be a number (got '1.80-17')");
    CHECK(error_of("DATA:\n" + table("n", "        0.4 nan\n")) ==
          "m.yml: DATA/0: must be a number (got 'nan')");
    CHECK(error_of("DATA:\n" + table("n", "        0.4 1,5\n")) ==
          "m.yml: DATA/0: must be a number (got '1,5')");
    CHECK(error_of("DATA:\n" + kFormulaN + table("k", "        0.4 1 2\n")) ==
          "m.yml: DATA/1: row 1 must have 2 columns (got 3)");
    CHECK(error_of("DATA:\n" + table("nk", "        0.4 1 2\n        0.5 1\n")) ==
          "m.yml: DATA/0: row 2 must have 3 columns (got 2)");
    CHECK(error_of("DATA:\n" + table("n", "        0 1\n")) ==
          "m.yml: DATA/0: row 1: the wavelength must be positive (got 0)");
    CHECK(error_of("DATA:\n  - type: tabulated n\n    data: |\nX: 1\n") ==
          "m.yml: DATA/0: the table has no rows");
    CHECK(error_of("DATA:\n  - type: tabulated n\n") == "m.yml: DATA/0: must have the text 'data'");
    CHECK(error_of("DATA:\n  - type: formula 10\n") ==
          "m.yml: DATA/0: formula must be 1 to 9 (got '10')");
    CHECK(error_of("DATA:\n  - type: formula\n") ==
          "m.yml: DATA/0: formula must be 1 to 9 (got '')");
    CHECK(error_of("DATA:\n  - type: formula 5\n    coefficients: 1\n") ==
          "m.yml: DATA/0: must have the text 'wavelength_range'");
    CHECK(error_of("DATA:\n  - type: formula 8\n    coefficients: 1 2 3 4 5\n"
                   "    wavelength_range: 0.4 1\n") ==
          "m.yml: DATA/0: formula 8 must have 1, 3 or 4 coefficients (got 5)");
    for (const char* range : {"1", "1 0.4", "0 1", "-1 1", "0.4 1 2"})
        CHECK(error_of("DATA:\n  - type: formula 5\n    coefficients: 1\n    wavelength_range: " +
                       std::string(range) + "\n") ==
              "m.yml: DATA/0: wavelength_range must be two increasing wavelengths in um");
}

TEST_CASE("broken YAML is an InputError with line and column", "[rii]") {
    try {
        read("DATA:\n  - type: [tabulated\n");
        FAIL("not refused");
    } catch (const InputError& error) {
        CHECK(error.file == "m.yml");
        CHECK_FALSE(error.where.empty());
        CHECK(error.message.find('\n') == std::string::npos);
    }
    for (const std::string& text :
         {std::string("a: b: c\n"), std::string("\t- x"), std::string("{{{{"), std::string("*x"),
          std::string("DATA: &a [*a]"), std::string(100000, '['), std::string("\0\xFF\xFE", 3)})
        CHECK_THROWS_AS(read(text), InputError);
}

TEST_CASE("sixty thousand rows are read in linear time", "[rii]") {
    std::string rows;
    for (int i = 0; i < 60000; ++i)
        rows += "        " + std::to_string(1000000 + 7 * i) + "e-6 1.5 0.1\n";
    const auto start = std::chrono::steady_clock::now();
    const auto index = index_of("DATA:\n" + table("nk", rows));
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    CHECK(std::get<Table>(index.n).value.size() == 60000);
    CHECK(elapsed.count() < 10);  // quadratic time would take minutes
}
