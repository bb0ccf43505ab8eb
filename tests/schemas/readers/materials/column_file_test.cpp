#include "schemas/readers/materials/column_file.hpp"

#include <catch2/catch.hpp>

#include "schemas/input_error.hpp"
#include "schemas/readers/spectrum_csv.hpp"

using namespace irido;
using namespace irido::schemas;

namespace {

constexpr auto npos = std::string::npos;

std::string material_error(std::string_view text) {
    try {
        read_column_file(text, "a.csv");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

std::string spectrum_error(std::string_view text) {
    try {
        read_spectrum_csv(text, "s.csv");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

RefractiveIndex index_of(std::string_view text) {
    return std::get<RefractiveIndex>(read_column_file(text, "a.csv").material.model);
}

}  // namespace

TEST_CASE("InputError joins what it knows", "[csv]") {
    const InputError full("f.json", "/layers/0", "must be positive");
    CHECK(std::string(full.what()) == "f.json: /layers/0: must be positive");
    CHECK(full.file == "f.json");
    CHECK(full.where == "/layers/0");
    CHECK(full.message == "must be positive");
    CHECK(std::string(InputError("", "", "no").what()) == "no");
    CHECK(std::string(InputError("f", "", "no").what()) == "f: no");
    CHECK(std::string(InputError("", "1:2", "no").what()) == "1:2: no");
}

TEST_CASE("CSV material with and without k", "[csv]") {
    const auto file = read_column_file("nm,n,k\n400,1.5,0.1\n500,1.4,0.2\n", "a.csv");
    CHECK(file.material.name == "a.csv");
    CHECK(index_at(file.material, 450) == Complex(1.45, 0.15000000000000002));
    CHECK(range_of(file.material) == WavelengthRange{400, 500});
    CHECK(index_of("400,1.5\n500,1.4").k == Dispersion{Constant{0}});
    CHECK(index_of("587.6,1.5").n == Dispersion{Table{{587.6}, {1.5}}});
}

TEST_CASE("CSV dress: header, comments, blanks, CRLF, byte-order mark, number forms", "[csv]") {
    const Dispersion expected = Table{{400, 500}, {0.5, 1.4}};
    for (const char* text :
         {"400,.5\n500,1.4\n", "400,.5\r\n500,1.4\r\n",
          "# source\n\nwavelength_nm,n\n400,0.5\n500,1.4", "  400 ,\t+0.5 # first\n\n500,14e-1",
          "\xEF\xBB\xBFnm,n\n4e2,5E-01\n500,1.4\n\n"})
        CHECK(index_of(text).n == expected);
}

TEST_CASE("CSV faults are told by line and column", "[csv]") {
    const std::string none = "a.csv: has no rows of numbers; known columns: " + known_columns();
    CHECK(material_error("").starts_with(none));
    CHECK(material_error("nm,n\n# nothing\n").ends_with("Woollam (.mat)"));
    CHECK(material_error("400,1.5\n500,abc\n") == "a.csv: 2:5: must be a number (got 'abc')");
    CHECK(material_error("400,1.5\nnm,n\n") == "a.csv: 2:1: must be a number (got 'nm')");
    CHECK(material_error("400,1.80-17\n") == "a.csv: 1:5: must be a number (got '1.80-17')");
    CHECK(material_error("400, nan\n") == "a.csv: 1:6: must be a number (got 'nan')");
    CHECK(material_error("400,inf\n") == "a.csv: 1:5: must be a number (got 'inf')");
    CHECK(material_error("400,1e999\n") == "a.csv: 1:5: must be a number (got '1e999')");
    CHECK(material_error("400,\n") == "a.csv: 1:1: must have 2 to 3 columns (got 1)");
    CHECK(material_error("400\n") == "a.csv: 1:1: must have 2 to 3 columns (got 1)");
    CHECK(material_error("400,1,2,3\n") == "a.csv: 1:1: must have 2 to 3 columns (got 4)");
    CHECK(material_error("400,1,0\n500,1\n") == "a.csv: 2:1: must have 3 columns (got 2)");
    // of uneven rows, those are wrong that differ from the heading, or from most rows
    CHECK(material_error("nm,n,k\n400,1\n500,1,0\n600,1,0\n") ==
          "a.csv: 2:1: must have 3 columns (got 2)");
    CHECK(material_error("nm,n\n400,1,0\n500,1\n") == "a.csv: 2:1: must have 2 columns (got 3)");
    CHECK(material_error("400,1\n500,1,0\n600,1,0\n") == "a.csv: 1:1: must have 3 columns (got 2)");
    CHECK(material_error("-5,1\n600,1\n") ==
          "a.csv: 1:1: the wavelength must be positive (got -5)");
}

TEST_CASE("a message holds no control characters and no long text", "[csv]") {
    const std::string message = material_error("400,\x01" + std::string(500, 'x'));
    CHECK(message == "a.csv: 1:5: must be a number (got '?" + std::string(39, 'x') + "...')");
}

TEST_CASE("CSV spectrum", "[csv]") {
    CHECK(read_spectrum_csv("nm,value\n400,0\n500,2.5\n", "s.csv") == Table{{400, 500}, {0, 2.5}});
    CHECK(spectrum_error("400,1\n") == "s.csv: must have at least 2 rows (got 1)");
    CHECK(spectrum_error("400,1\n500,-1\n") ==
          "s.csv: 2:5: the value must be in [0, 1e+30] (got -1)");
    CHECK(spectrum_error("400,0\n500,0\n") ==
          "s.csv: the largest value must be at least 1e-30 (got 0)");
    // the header's unit, any order, and tables that are not spectra over wavelength
    CHECK(read_spectrum_csv("um,value\n0.5,2.5\n0.4,1\n", "s.csv") == Table{{400, 500}, {1, 2.5}});
    CHECK(read_spectrum_csv("Wavelength (A);W/m2\n4000;2,5\n5000;1,5\n", "s.csv") ==
          Table{{400, 500}, {2.5, 1.5}});
    CHECK(spectrum_error("value,nm\n1,400\n1,500\n").find("must name known columns") != npos);
    CHECK(spectrum_error("energy_eV,value\n2,1\n3,1\n").find("must name known columns") != npos);
    CHECK(spectrum_error("0.4,1\n0.5,1\n").find("looks like um") != npos);
    CHECK(spectrum_error("400,1\n400,2\n") ==
          "s.csv: must have one row per wavelength (got two at 400 nm)");
    CHECK(spectrum_error("400,1,1\n500,1,1\n") == "s.csv: 1:1: must have 2 columns (got 3)");
}

namespace {

struct Reading {
    std::string_view text;
    double nm, n, k;
};

}  // namespace

TEST_CASE("columns go by name and unit", "[csv]") {
    const auto [text, nm, n, k] = GENERATE(
        Reading{"nm,k,n\n400,0.1,2.5\n500,0.2,2.4\n", 400, 2.5, 0.1},
        Reading{"n,k,nm\n2.5,0.1,400\n2.4,0.2,500\n", 400, 2.5, 0.1},
        Reading{"wavelength_um,n\n0.4,1.5\n0.57,1.4\n", 570, 1.4, 0},
        Reading{"\"Wavelength, \xC2\xB5m\",\"n\"\n0.4,1.5\n0.57,1.4\n", 570, 1.4, 0},
        Reading{"Wavelength [nm]\tn\tk\n400\t1.5\t0.25\n500\t1.4\t0.25\n", 450, 1.45, 0.25},
        Reading{"lambda (\xC3\x85) n k\n4000 1.5 0.1\n5000 1.4 0.1\n", 500, 1.4, 0.1},
        Reading{"energy_eV,n,k\n2,1.5,0.1\n4,1.7,0.3\n", 1239.8419843320026 / 2, 1.5, 0.1},
        Reading{"Energy (eV);n;k\n4;1,7;0,3\n2;1,5;0,1\n", 1239.8419843320026 / 4, 1.7, 0.3},
        Reading{"wavenumber (cm-1),n\n10000,1.5\n20000,1.6\n", 500, 1.6, 0},
        Reading{"1/cm,n\n10000,1.5\n20000,1.6\n", 1000, 1.5, 0},
        Reading{"nm,eps1,eps2\n400,3,4\n500,3,4\n", 450, 2, 1},
        Reading{"nm,e1,e2\n400,-4,0\n500,-4,0\n", 450, 0, 2},
        Reading{"nm,\xCE\xB5_1\n400,2.25\n500,2.25\n", 450, 1.5, 0},
        Reading{"nm,n,-k\n400,1.5,-0.25\n500,1.5,-0.25\n", 450, 1.5, 0.25},
        Reading{"nm,n,loss\n400,1.5,0.25\n500,1.5,0.25\n", 450, 1.5, 0.25},
        Reading{"nm,eps1,loss\n400,3,4\n500,3,4\n", 450, 2, 1},
        Reading{"nm,n,k\n10,0.9,0.5\n20,0.8,0.25\n", 20, 0.8, 0.25},
        Reading{"Sample 7\nmeasured today\nwavelength,n,k\nnm,-,-\n400,1.5,0\n500,1.5,0.5\n", 500,
                1.5, 0.5},
        Reading{"wavelength n\n(um)\n0.4 1.5\n0.5 1.4\n", 500, 1.4, 0},
        Reading{"# um n k\n0.4 1.5 0\n0.5 1.4 0.5\n", 500, 1.4, 0.5});
    CAPTURE(text);
    const Complex index = index_at(read_column_file(text, "a.csv").material, nm);
    CHECK_THAT(index.real(), Catch::Matchers::WithinAbs(n, 1e-14));
    CHECK_THAT(index.imag(), Catch::Matchers::WithinAbs(k, 1e-14));
}

TEST_CASE("columns come apart at semicolons, tabs, commas and blanks", "[csv]") {
    const Dispersion n = Table{{400, 500}, {1.5, 1.25}};
    const auto text =
        GENERATE("400;1.5\n500;1.25\n", "400;1,5\n500;1,25\n", "400\t1,5\n500\t1,25\n",
                 "400\t1.5\n500\t1.25\n", "400 1.5\n500   1.25\n", "  400 1,5\n  500 1,25\n",
                 "\"400\",\"1,5\"\n\"500\",\"1,25\"\n", "400,1.5,\n500,1.25,\n",
                 "400,1.5\r500,1.25\r", "500,1.25\n400,1.5\n",
                 "! text\n% text\n// text\n400 1.5 # here\n\n500 1.25", "500,1.25\n400,1\n400,2\n");
    CAPTURE(text);
    CHECK(index_of(text).n == n);
}

TEST_CASE("what was done to rows is told", "[csv]") {
    const auto notes = [](std::string_view text) { return read_column_file(text, "a").notes; };
    using Notes = std::vector<std::string>;
    CHECK(notes("nm,n\n500,1\n400,1\n") == Notes{"rows sorted by wavelength"});
    CHECK(notes("nm,n\n400,1\n400,1\n") ==
          Notes{"rows at equal wavelengths averaged, 1 row fewer"});
    CHECK(notes("eV,n\n2,1\n3,1\n").empty());
    CHECK(notes("nm,n,k\n400,1,-0.5\n500,1,0\n") ==
          Notes{"k is nowhere positive: read as n - ik, which absorbs"});
    CHECK(notes("1500,1\n5000,1\n") ==
          Notes{"no header: wavelengths taken as 1500 to 5000 nm (if they are in angstroms, add a "
                "header angstrom,n,k)"});
    CHECK(notes("nm,n\n1500,1\n5000,1\n").empty());
}

TEST_CASE("tables that could be misread are refused by name", "[csv]") {
    const auto [text, part] = GENERATE(table<std::string, std::string>({
        {"0.4,1.5\n0.8,1.4\n", "0.4 to 0.8 looks like um or eV"},
        {"wavelength,n\n0.4,1.5\n0.8,1.4\n", "looks like um or eV"},
        {"nm,R\n400,0.5\n500,0.5\n", "1:1: must name known columns"},
        {"nm,k\n400,0.5\n500,0.5\n", "must name known columns"},
        {"nm,n,n\n400,1,1\n500,1,1\n", "must name known columns"},
        {"nm,eV,n\n400,3,1\n500,2,1\n", "must name known columns"},
        {"nm,n,eps2\n400,1,1\n500,1,1\n", "must name known columns"},
        {"nm,-n\n400,1\n500,1\n", "must name known columns"},
        {"THz,n\n400,1\n500,1\n", "must name known columns"},
        {"energy,n\n2,1\n3,1\n", "must name known columns"},
        {"nm,n\n400,1,0\n500,1,0\n", "must name known columns"},
        {"gold\n400,1,0\n500,1,0\n", "other lines must begin with #"},
        {"nm,n,k\n400,1,0.5\n500,1,-0.5\n", "k must have one sign (got 0.5 at 400 nm and -0.5 at"},
        {"400;1,5\n500.5;1,25\n", "decimal points or decimal commas, not both"},
        {"; gold\n4000 1.5 0\n5000 1.5 0\n", "add a header such as angstrom,n,k"},
        {"400,1.5\nthe end\n", "2:1: must be a number (got 'the end')"},
        {"nm,n\n1e8,1.5\n2e8,1.5\n", "must be known somewhere from 1 to 1e7 nm"},
    }));
    CAPTURE(text);
    const std::string error = material_error(text);
    CAPTURE(error);
    CHECK(error.find(part) != npos);
    CHECK(error.find('\n') == npos);
}
