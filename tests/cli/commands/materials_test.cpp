#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "tests/support/program.hpp"

using namespace irido::test;

namespace {

using Table = std::vector<std::vector<std::string>>;

/// The first cell of each row.
std::set<std::string> names_in(const std::string& csv) {
    std::set<std::string> names;
    for (const auto& row : parse_csv(csv)) names.insert(row[0]);
    return names;
}

const std::string kSilver =
    "REFERENCES: |\n    Nobody, Synth. Opt. 1, 2 (1972)\nDATA:\n  - type: tabulated nk\n"
    "    data: |\n        0.4 0.05 2.1\n        0.7 0.04 4.8\n";
const std::string kGlass =
    "REFERENCES: |\n    Nobody (2001)\nCOMMENTS: |\n    20 nm thin film\nDATA:\n"
    "  - type: formula 5\n    wavelength_range: 0.3 0.9\n    coefficients: 1.5\n";

void write_page(const std::string& path, const std::string& text) {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    write_text(path, text);
}

/// A copy of a database without a catalogue, with realistic names.
void write_folders(const TemporaryFolder& folder) {
    write_page(folder / "main/Ag/nk/Johnson.yml", kSilver);
    write_page(folder / "main/Ag/about.yml", "NAMES:\n  - Silver\nABOUT: |\n  text\n");
    write_page(folder / "main/Ag/n2/Odd.yml", kSilver);
    write_page(folder / "organic/C2H6O - ethanol/nk/Rheims 20.0C.yml", kGlass);
    write_page(folder / "organic/(C5H8O2)n - poly(methyl methacrylate)/nk/Sultanova.yml", kGlass);
    write_page(folder / "other/mixed crystals/In2O3-SnO2/nk/K\xC3\xB6nig.yml", kGlass);
    write_page(folder / "specs/schott/optical/N-BK7.yml", kGlass);
    write_page(folder / "main/Ag/nk/broken.yml", "DATA:\n  - type: formula 99\n");
}

}  // namespace

TEST_CASE("materials are found by words of names and sources", "[cli][materials]") {
    const Table silver = parse_csv(done({"materials", "find", "silver", "-w", "633"}).out);
    REQUIRE(silver.size() >= 2);
    CHECK(Words(silver[0].begin(), silver[0].begin() + 7) ==
          Words{"name", "n", "k", "first_nm", "last_nm", "year", "film"});
    CHECK(silver[1][0] == "Ag");
    CHECK(std::stod(silver[1][1]) == Approx(0.05626).epsilon(1e-3));
    CHECK(std::stod(silver[1][2]) == Approx(4.2776).epsilon(1e-3));
    CHECK(silver[1][5] == "1972");
    CHECK(silver[1][6] == "true");
    for (const char* name : {"Ag-LD", "Ag-Yang"})
        CHECK(names_in(done({"materials", "find", "silver"}).out).contains(name));
    CHECK(names_in(done({"materials", "find", "johnson christy 1974"}).out).contains("Cr"));
    CHECK_FALSE(names_in(done({"materials", "find", "Ag"}).out).contains("MgF2"));
    CHECK(parse_csv(done({"materials", "find", "unobtainium"}).out).size() == 1);
    const Outcome far = done({"materials", "find", "BK7", "-w", "9000"});
    CHECK(parse_csv(far.out).size() == 1);
    CHECK(far.err.find("not known at that wavelength") != std::string::npos);
    check_refused(run_irido({"materials", "find", " ,"}), "TEXT: must have letters or digits");
    check_refused(run_irido({"materials", "find", "silver", "-w", "0"}), "--wavelength");
}

TEST_CASE("a database without a catalogue is read by its folders", "[cli][materials]") {
    const TemporaryFolder folder;
    write_folders(folder);
    const Words database{"--database", folder.path()};
    const auto n_of = [&](const std::string& name) {
        return parse_csv(done(Words{"materials", "show", name, "-w", "550"} + database).out)[1][1];
    };
    CHECK(n_of("rii:main/Ag/Johnson") == "0.045");
    for (const std::string name :
         {"rii:organic/C2H6O - ethanol/Rheims 20.0C", "rii:organic/ethanol/Rheims 20.0C",
          "rii:organic/poly(methyl methacrylate)/Sultanova",
          "rii:other/mixed crystals/In2O3-SnO2/K\xC3\xB6nig", "rii:specs/schott/optical/N-BK7",
          "rii:specs/schott/N-BK7"})
        CHECK(n_of(name) == "1.5");
    // also in stacks
    const Words at550{"-w", "550"};
    const std::string direct =
        done(Words{"spectrum", "1 | 0.045+3.45i@20 | 1.5@100 | 1"} + at550).out;
    CHECK(done(Words{"spectrum",
                     "1 | rii:main/Ag/Johnson@20 | "
                     "\"rii:organic/poly(methyl methacrylate)/Sultanova\"@100 | 1"} +
               at550 + database)
              .out == direct);
    CHECK(run_shell("IRIDO_MATERIALS='" + folder.path() +
                        "' \"$IRIDO\" spectrum '1 | rii:main/Ag/Johnson@20 | 1.5@100 | 1' -w 550",
                    folder.path())
              .out == direct);
    CHECK(done(Words{"convert", "1 | rii:main/Ag/Johnson@20 | 1", "-f", "expression"} + database)
              .out == "1 | rii:main/Ag/Johnson@20 | 1\n");
    const std::string found =
        done(Words{"materials", "find", "silver", "-w", "550"} + database).out;
    CHECK(names_in(found).contains("rii:main/Ag/Johnson"));
    CHECK_FALSE(names_in(found).contains("rii:main/Ag/broken"));
    for (const auto& row : parse_csv(found))
        if (row[0] == "rii:main/Ag/Johnson") {
            CHECK(row[1] == "0.045");
            CHECK(row[5] == "1972");
            CHECK(row[6] == "false");
        }
    const Table film =
        parse_csv(done(Words{"materials", "find", "methacrylate sultanova"} + database).out);
    REQUIRE(film.size() == 2);
    CHECK(film[1][3] == "2001");
    CHECK(film[1][4] == "true");
}

TEST_CASE("a catalogue names the pages of a database", "[cli][materials]") {
    const TemporaryFolder folder;
    write_page(folder / "database/data/main/Ag/nk/Johnson.yml", kSilver);
    write_page(folder / "database/data/glass/x y/plain.yml", kGlass);
    write_text(folder / "database/catalog-nk.yml",
               "- SHELF: main\n  name: \"MAIN - simple\"\n  content:\n"
               "    - DIVIDER: \"Ag\"\n    - BOOK: Ag\n      name: \"Ag (Silver)\"\n"
               "      content:\n        - PAGE: Johnson\n"
               "          name: \"Johnson and Christy 1972: n,k 0.188-1.94 <sub>\xC2\xB5m</sub>\"\n"
               "          data: main/Ag//nk/Johnson.yml\n"
               "- SHELF: 'glass'\n  name: Glasses\n  content:\n    - BOOK: BK7\n"
               "      name: BK7\n      content:\n        - PAGE: SCHOTT # best\n"
               "          name: SCHOTT\n          data: \"glass/x y/plain.yml\"\n");
    const Words database{"--database", folder.path()};
    const auto n_of = [&](const std::string& name) {
        return parse_csv(done(Words{"materials", "show", name, "-w", "550"} + database).out)[1][1];
    };
    CHECK(n_of("rii:main/Ag/Johnson") == "0.045");
    CHECK(n_of("rii:glass/BK7/SCHOTT") == "1.5");
    CHECK(n_of("rii:glass/x y/plain") == "1.5");  // not under that name in any catalogue
    CHECK(names_in(done(Words{"materials", "find", "silver christy"} + database).out)
              .contains("rii:main/Ag/Johnson"));
}

TEST_CASE("what a database does not have is refused", "[cli][materials]") {
    const TemporaryFolder folder;
    write_folders(folder);
    const Words database{"--database", folder.path()};
    const auto refused = [&](const std::string& name, const std::string& error) {
        check_refused(run_irido(Words{"spectrum", "1 | \"" + name + "\"@20 | 1"} + database),
                      error);
    };
    refused("rii:main/Ag/Jonson", "did you mean \"rii:main/Ag/Johnson\"?");
    refused("rii:Ag", "must be rii:SHELF/BOOK/PAGE");
    refused("rii:main/../main/Ag/Johnson", "must be rii:SHELF/BOOK/PAGE");
    refused("rii:main/Ag/broken", "formula must be 1 to 9");
    check_refused(run_shell("env -u IRIDO_MATERIALS \"$IRIDO\" spectrum '1 | rii:main/Ag/J@2 | 1'",
                            folder.path()),
                  "there is no database");
    check_refused(
        run_irido({"spectrum", "1 | rii:main/Ag/J@2 | 1", "--database", folder / "nowhere"}),
        "the material database must be a folder");
}
