#include <catch2/catch.hpp>

#include "schemas/input_error.hpp"
#include "schemas/readers/material_file.hpp"

using namespace irido;
using namespace irido::schemas;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kEvNm = 1239.8419843320026;  // h c / e

std::string error_of(std::string_view text, const std::string& name = "m.txt") {
    try {
        read_material_file(text, name);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

void check_index(std::string_view text, double nm, double n, double k) {
    CAPTURE(text, nm);
    const Complex index = index_at(read_material_file(text, "m").material, nm);
    CHECK_THAT(index.real(), WithinAbs(n, 1e-14));
    CHECK_THAT(index.imag(), WithinAbs(k, 1e-14));
}

}  // namespace

TEST_CASE("SOPRA's pairs stand in equal steps of their unit", "[formats]") {
    const std::string ev =
        "1  1.0  3.0  4\n 1.50 0.000\n 1.52 0.001\n 1.55 ; .010\n 1.60 .050\n"
        " 1.70 0.200\nfrom a model\n";
    check_index(ev, kEvNm / 1.0, 1.5, 0);
    check_index(ev, kEvNm / 2.0, 1.55, 0.01);
    check_index(ev, kEvNm / 2.5, 1.6, 0.05);
    check_index(ev, kEvNm / 3.0, 1.7, 0.2);
    check_index("4 400 800 2\n1.5 0\n1.4 0.1\n1.3 0.2\n", 600, 1.4, 0.1);
    check_index("2 .4 .8 2\n1.5;0\n1.4;0.1\n1.3;0.2\n", 600, 1.4, 0.1);
    check_index("3 10000 20000 1\n1.5 0 1.6 0.1\n", 500, 1.6, 0.1);
    CHECK(error_of("1 1.0 3.0 4\n1.5 0\n1.5 0\n1.5 0\n1.5 0\n") ==
          "m.txt: must have 5 pairs n k for 4 intervals (got 4)");
    CHECK(error_of("1 1.0 3.0 1\n1.5 0\n1.5 0\n1.5 0\n") ==
          "m.txt: must have 2 pairs n k for 1 intervals (got 3)");
}

TEST_CASE("SOPRA's exchange text", "[formats]") {
    const std::string text =
        "VERSION*1*\nFORMAT*1*\nPOINTS*2*\nDATA1*1*4.00000000e2*1.6*0.0*\n"
        "DATA1*2*5.00000000e2*1.58*0.001*\nCOMMENT*synthetic*\nEOF*\n";
    check_index(text, 400, 1.6, 0);
    check_index(text, 500, 1.58, 0.001);
    CHECK(error_of("VERSION*1*\nPOINTS*3*\nDATA1*1*400*1.6*0*\n") ==
          "m.txt: must have as many lines DATA1 as POINTS says, 3 (got 1)");
    CHECK(error_of("VERSION*1*\nPOINTS*1*\nDATA2*1*400*1.6*0*\n").find("3:1: must be DATA1*") !=
          std::string::npos);
    CHECK(error_of("VERSION*1*\n") == "m.txt: has no lines DATA1*number*nm*n*k*");
}

TEST_CASE("Woollam's tables", "[formats]") {
    check_index("Synthetic oxide\neV\nNK\n3.0\t1.48\t0.000\n2.0\t1.46\t0.25\n", kEvNm / 2, 1.46,
                0.25);
    check_index("x\nANGSTROMS\nNK\n4000 1.5 0.1\n5000 1.4 0.2\n", 500, 1.4, 0.2);
    check_index("400 nm\nnm\nE1E2\n400 3 4\n500 3 4\n", 450, 2, 1);
    check_index("x\num\nnk\n0.4 1.5 0.1\n0.5 1.4 0.2\n", 500, 1.4, 0.2);
    CHECK(error_of("x\nnm\nCAUCHY\n1.45 0.01 0\n") ==
          "m.txt: 3:1: must be NK or E1E2 (got 'CAUCHY', parameters of a model)");
    CHECK(error_of("x\nnm\nNK\n400 1.5\n").find("must have 3 columns") != std::string::npos);
}

TEST_CASE("the CSV of the refractiveindex.info site has a block of n and one of k", "[formats]") {
    const std::string text = "wl,n\n0.4,1.5\n0.6,1.48\n\nwl,k\n0.3,0.3\n0.5,0.1\n0.7,0.2\n";
    check_index(text, 500, 1.49, 0.1);
    check_index(text, 400, 1.5, 0.2);
    check_index("wl\tn\n0.4\t1.5\n0.6\t1.48\nwl\tk\n0.4\t0.1\n0.6\t0.1\n", 600, 1.48, 0.1);
    check_index("wl,n,k\n0.4,1.5,0.1\n0.6,1.48,0.1\n", 600, 1.48, 0.1);
    const MaterialFile part =
        read_material_file("wl,n\n0.4,1.50\n0.6,1.48\nwl,k\n0.4,0.001\n0.5,0.0005\n", "m.csv");
    CHECK(range_of(part.material) == WavelengthRange{400, 500});
    REQUIRE(part.notes.size() == 1);
    CHECK(part.notes[0] ==
          "k is known from 400 to 500 nm only, n from 400 to 600 nm: k = 5e-04 is not small, so "
          "the material is not known above 500 nm");
    CHECK(read_material_file("wl,n\n0.4,1.5\n", "m.csv").notes ==
          std::vector<std::string>{"no k in the file: k = 0"});
    CHECK(error_of("wl,k\n0.4,1.5\n") == "m.txt: must give n (got k only)");
    CHECK(error_of("wl,n\n0.4,1.5\nwl,n\n0.5,1.5\n") == "m.txt: 3:1: n is given twice");
    CHECK(error_of("wl,n\n400,1.5\n500,1.5\n").find("looks like nm") != std::string::npos);
}

TEST_CASE("formats are told by the content, whatever the name", "[formats]") {
    for (const char* name : {"a.csv", "a.nk", "a.mat", "a.yml", "a.txt"}) {
        CAPTURE(name);
        const auto n_at_500 = [&](std::string_view text) {
            return index_at(read_material_file(text, name).material, 500).real();
        };
        CHECK(n_at_500("DATA:\n  - type: tabulated n\n    data: |\n      0.5 1.25\n") == 1.25);
        CHECK(n_at_500("wl,n\n0.5,1.25\n") == 1.25);
        CHECK(n_at_500("4 400 500 1\n1.5 0\n1.25 0\n") == 1.25);
        CHECK(n_at_500("x\nnm\nNK\n500 1.25 0\n") == 1.25);
    }
    CHECK(is_material_file("x/GOLD.MAT"));
    CHECK_FALSE(is_material_file("x.csv/gold"));
    CHECK(error_of(std::string_view("MATLAB 5.0 MAT-file, \0\0", 23)) ==
          "m.txt: must be text (got a binary MATLAB file)");
    CHECK(error_of(std::string_view("\xFF\xFEn\0m\0", 6)) ==
          "m.txt: must be UTF-8 text (got UTF-16)");
    CHECK(error_of(std::string_view("\x7F"
                                    "ELF\0\1",
                                    6)) == "m.txt: must be text (got binary data)");
}
