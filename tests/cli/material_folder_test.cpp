// A folder of material files as people have them: read, or refused in one line that names the file.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "tests/support/program.hpp"

using namespace irido::test;

namespace {

using Catch::Matchers::Contains;

struct ReadFile {
    std::string name, text;
    double n, k;  ///< at 450 nm
};

struct RefusedFile {
    std::string name, text, said;
};

std::string yaml(const std::string& data) {
    return "DATA:\n  - type: " + data + "\n";
}

/// n^2 = 1 + 1.2 um^2/(um^2 - 0.01^2)
double sellmeier(double um) {
    return std::sqrt(1 + 1.2 * um * um / (um * um - 0.01 * 0.01));
}

const std::vector<ReadFile>& read_files() {
    static const std::vector<ReadFile> all{
        {"swapped.csv", "nm,k,n\n400,0.1,2.5\n500,0.3,2.3\n", 2.4, 0.2},
        {"capitals.csv", "Wavelength (nm),N,K\n400,2.5,0.1\n500,2.3,0.3\n", 2.4, 0.2},
        {"um.csv", "wavelength_um,n\n0.4,1.5\n0.5,1.48\n", 1.49, 0},
        {"micro.csv", "Wavelength (\xC2\xB5m)\tn\tk\n0.4\t1.5\t0.1\n0.5\t1.4\t0.1\n", 1.45, 0.1},
        {"angstrom.dat", "angstrom n k\n4000 1.5 0.1\n5000 1.4 0.1\n", 1.45, 0.1},
        {"loss.csv", "nm,n,-k\n400,1.5,-0.1\n500,1.4,-0.1\n", 1.45, 0.1},
        {"decimal-commas.csv", "wavelength;n;k\n400;1,5;0,1\n500;1,4;0,1\n", 1.45, 0.1},
        {"tabs.tsv", "400\t1.5\n500\t1.4\n", 1.45, 0},
        {"blanks.txt", "  400   1.5  0.1\n  500   1.4  0.1\n", 1.45, 0.1},
        {"descending.csv", "500,1.4\n400,1.5\n", 1.45, 0},
        {"twice.csv", "400,1.4\n400,1.6\n500,1.4\n", 1.45, 0},
        {"trailing.csv", "400,1.5,\n500,1.4,\n", 1.45, 0},
        {"mac.csv", "400,1.5\r500,1.4\r", 1.45, 0},
        {"dos.csv", "nm,n\r\n400,1.5\r\n500,1.4\r\n", 1.45, 0},
        {"marked.csv", "\xEF\xBB\xBFnm,n\n400,1.5\n500,1.4\n", 1.45, 0},
        {"headings.csv", "# comment\nMy glass\nnm,n\n400,1.5\n500,1.4\n", 1.45, 0},
        {"quoted.csv", "\"nm\",\"n\"\n\"400\",\"1.5\"\n\"500\",\"1.4\"\n", 1.45, 0},
        {"site.csv", "wl,n\n0.4,1.50\n0.6,1.48\nwl,k\n0.4,0.001\n0.5,0.0005\n", 1.495, 0.00075},
        {"site.txt", "wl\tn\n0.4\t1.50\n0.6\t1.48\n\nwl\tk\n0.4\t0.001\n0.5\t0.0005\n", 1.495,
         0.00075},
        {"sopra.nk", "4 400 500 2\n1.5 0.1\n1.45 ; 0.2\n1.4 0.3\n", 1.45, 0.2},
        {"sopra.mat",
         "VERSION*1*\nFORMAT*1*\nPOINTS*2*\nDATA1*1*4.0e2*1.6*0.0*\nDATA1*2*5.0e2*1.5*0.002*\n"
         "COMMENT*synthetic*\nEOF*\n",
         1.55, 0.001},
        {"woollam.mat", "Synthetic oxide\nnm\nNK\n400\t1.48\t0.1\n500\t1.46\t0.3\n", 1.47, 0.2},
        {"openfilters.mat",
         "Description: synthetic\nKind: regular\nModel: table\nProperties:\n\t400.0\t2.40-0.01j\n"
         "\t500.0\t2.30-0.01j\nEnd\n",
         2.35, 0.01},
        {"table.yml", yaml("tabulated nk\n    data: |\n      0.4 1.5 0.1\n      0.5 1.4 0.3"), 1.45,
         0.2},
        {"lists.yml", yaml("tabulated nk\n    data: [[0.4, 1.5, 0.1], [0.5, 1.4, 0.3]]"), 1.45,
         0.2},
        {"formula.yml",
         yaml("formula 1\n    wavelength_range: 0.3 1\n    coefficients: 0 1.2 0.01"),
         sellmeier(0.45), 0},
        {"old.yml", yaml("formula 1\n    range: 0.3 1\n    coefficients: 0 1.2 0.01"),
         sellmeier(0.45), 0},
        {"sequence.yml",
         yaml("formula 1\n    wavelength_range: [0.3, 1]\n    coefficients: [0, 1.2, 0.01]"),
         sellmeier(0.45), 0},
    };
    return all;
}

const std::vector<RefusedFile>& refused_files() {
    static const std::vector<RefusedFile> all{
        {"header.csv", "nm,refr,abs\n400,1.5,0.1\n", "must name known columns"},
        {"um-bare.csv", "0.4,1.5\n0.5,1.49\n", "looks like um or eV"},
        {"signs.csv", "400,1.5,0.1\n500,1.5,-0.1\n", "k must have one sign"},
        {"words.txt", "hello world\n", "has no rows of numbers; known columns"},
        {"empty.csv", "", "has no rows of numbers; known columns"},
        {"nan.csv", "400,nan\n500,1.5\n", "must be a number"},
        {"infinite.csv", "400,1.5\n500,inf\n", "must be a number"},
        {"huge.csv", "400,1.5\n500,1e308\n", "n must be in"},
        {"negative.csv", "400,-1.5\n500,-1.4\n", "n must be in"},
        {"before.csv", "-400,1.5\n500,1.5\n", "must be positive"},
        {"ragged.csv", "400,1.5,0\n500,1.5\n", "must have 3 columns"},
        {"mixed.csv", "400;1,5\n500;1.5\n", "decimal points or decimal commas, not both"},
        {"binary.mat", std::string("MATLAB 5.0 MAT-file\0\1\2", 22), "binary MATLAB file"},
        {"utf16.csv",
         std::string("\xFF\xFE"
                     "4\0,\0",
                     6),
         "must be UTF-8 text (got UTF-16)"},
        {"mark.csv", "\xFE\xFF", "must be UTF-8 text (got UTF-16)"},
        {"model.mat", "x\nnm\nCAUCHY\n1.45 0.01 0\n", "must be NK or E1E2"},
        {"pairs.nk", "4 400 500 2\n1.5 0.1\n1.4 0.3\n", "must have 3 pairs n k"},
        {"odd.yml",
         yaml("formula 2\n    wavelength_range: 0.3 1\n    coefficients: 3.6 2.2 0.1 1.8"),
         "coefficients (got 4)"},
        {"eight.yml",
         yaml("formula 4\n    wavelength_range: 0.3 1\n    coefficients: 1 2 3 4 5 6 7 8"),
         "coefficients (got 8)"},
        {"k-only.yml", yaml("tabulated k\n    data: |\n      0.4 0.1\n      0.5 0.1"),
         "must give n (got k only)"},
        {"not.yml", "DATA: [\n", "is not YAML"},
        {"unknown.yml", yaml("tabulated abc\n    data: |\n      0.4 0.1"), "unknown type"},
    };
    return all;
}

}  // namespace

TEST_CASE("a folder of material files as people have them", "[cli][materials][slow]") {
    const TemporaryFolder folder;
    for (const ReadFile& file : read_files()) {
        CAPTURE(file.name);
        write_text(folder / file.name, file.text);
        const Outcome shown =
            run_irido({"materials", "show", file.name, "-w", "450", "--quiet"}, "", folder.path());
        INFO(shown.err);
        REQUIRE(shown.status == 0);
        const auto rows = parse_csv(shown.out);
        REQUIRE(rows.size() == 2);
        CHECK(std::abs(std::stod(rows[1][1]) - file.n) < 1e-12);
        CHECK(std::abs(std::stod(rows[1][2]) - file.k) < 1e-12);
        CHECK(run_irido({"validate", file.name}, "", folder.path()).out == file.name + ": ok\n");
    }
    for (const RefusedFile& file : refused_files()) {
        CAPTURE(file.name);
        write_text(folder / file.name, file.text);
        const Outcome outcome =
            run_irido({"materials", "show", file.name, "-w", "450"}, "", folder.path());
        check_refused(outcome, file.said);
        CHECK_THAT(outcome.err, Contains(file.name));
        check_refused(run_irido({"spectrum", "air | " + file.name + "@50 | air", "-w", "450"}, "",
                                folder.path()),
                      file.said);
    }
}
