#include "schemas/material_csv.hpp"

#include <catch2/catch.hpp>

#include "schemas/input_error.hpp"
#include "schemas/spectrum_csv.hpp"

using namespace irido;

namespace {

std::string material_error(std::string_view text) {
    try {
        read_material_csv(text, "a.csv");
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
    return std::get<RefractiveIndex>(read_material_csv(text, "a.csv").material.model);
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
    const auto file = read_material_csv("nm,n,k\n400,1.5,0.1\n500,1.4,0.2\n", "a.csv");
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
    CHECK(material_error("") == "a.csv: has no rows");
    CHECK(material_error("nm,n\n# nothing\n") == "a.csv: has no rows");
    CHECK(material_error("400,1.5\n500,abc\n") == "a.csv: 2:5: must be a number (got 'abc')");
    CHECK(material_error("400,1.5\nnm,n\n") == "a.csv: 2:1: must be a number (got 'nm')");
    CHECK(material_error("nm,n\nnm,n\n400,1.5") == "a.csv: 2:1: must be a number (got 'nm')");
    CHECK(material_error("400,1.80-17\n") == "a.csv: 1:5: must be a number (got '1.80-17')");
    CHECK(material_error("400, nan\n") == "a.csv: 1:6: must be a number (got 'nan')");
    CHECK(material_error("400,inf\n") == "a.csv: 1:5: must be a number (got 'inf')");
    CHECK(material_error("400,1e999\n") == "a.csv: 1:5: must be a number (got '1e999')");
    CHECK(material_error("400,1;5\n") == "a.csv: 1:5: must be a number (got '1;5')");
    CHECK(material_error("400,\n") == "a.csv: 1:5: must be a number (got '')");
    CHECK(material_error("400\n") == "a.csv: 1:1: must have 2 to 3 columns (got 1)");
    CHECK(material_error("400,1,2,3\n") == "a.csv: 1:1: must have 2 to 3 columns (got 4)");
    CHECK(material_error("400,1,0\n500,1\n") == "a.csv: 2:1: must have 3 columns (got 2)");
    CHECK(material_error("500,1\n400,1\n") ==
          "a.csv: 2:1: wavelengths must increase strictly (got 400 after 500)");
    CHECK(material_error("500,1\n500,1\n") ==
          "a.csv: 2:1: wavelengths must increase strictly (got 500 after 500)");
    CHECK(material_error("0.5,1\n") == "a.csv: 1:1: wavelength_nm must be in [1, 1e+07] (got 0.5)");
    CHECK(material_error("-5,1\n") == "a.csv: 1:1: wavelength_nm must be in [1, 1e+07] (got -5)");
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
    CHECK(spectrum_error("400,1,1\n500,1,1\n") == "s.csv: 1:1: must have 2 columns (got 3)");
}
