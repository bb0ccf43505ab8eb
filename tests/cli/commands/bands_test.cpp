#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;

namespace {

const std::string kMirror = "1 | (1@200 | 1.5@180)^10 | 1";

double number(const std::string& text) {
    return std::stod(text);
}

std::vector<std::vector<std::string>> bands(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "bands");
    const Outcome outcome = done(arguments);
    return parse_csv(outcome.out);
}

double reflectance(const std::string& stack, const std::string& wavelength,
                   const std::string& angle, const std::string& polarization) {
    const auto rows = parse_csv(
        run_irido({"spectrum", stack, "-w", wavelength, "-a", angle, "-p", polarization}).out);
    return number(rows.at(1).at(3));
}

}  // namespace

// Reference rows: a 60-digit evaluation, rounded to double.
TEST_CASE("landmarks agree with a 60-digit evaluation", "[cli][bands]") {
    const auto want = parse_csv(
        "angle_deg,polarization,kind,order,omega_per_nm,wavelength_nm\n"
        "20,p,edge,1,0.007749966890686788,810.7370516292337\n"
        "20,p,airy,1,0.010505154557619462,598.1049848164631\n"
        "20,p,zero,1,0.011950323931300721,525.7753131463189\n"
        "20,p,edge,2,0.013542203668828396,463.9706698284487\n"
        "20,p,mode,2,0.013937046195943607,450.82618073034115\n"
        "20,p,edge,2,0.014353348439346015,437.75048963180257\n"
        "20,p,airy,2,0.017401762772871036,361.0660247003789\n");
    const auto got = bands({kMirror, "-a", "20", "-p", "p", "--range", "360:830"});
    REQUIRE(got.size() == want.size());
    CHECK(got[0] == want[0]);
    for (std::size_t row = 1; row < want.size(); ++row) {
        CAPTURE(row);
        for (const std::size_t text : {0U, 1U, 2U, 3U}) CHECK(got[row][text] == want[row][text]);
        for (const std::size_t c : {4U, 5U})
            CHECK(std::abs(number(got[row][c]) / number(want[row][c]) - 1) < 1e-15);
    }
}

TEST_CASE("rows run by angle and polarization as asked, then by omega", "[cli][bands]") {
    const auto rows = bands({kMirror, "-a", "40,10", "-p", "p,s"});
    std::string order;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::string key = rows[i][0] + rows[i][1];
        if (!order.ends_with(key + " ")) order += key + " ";
        if (i > 1 && rows[i - 1][0] + rows[i - 1][1] == key)
            CHECK(number(rows[i - 1][4]) <= number(rows[i][4]));
        CHECK(number(rows[i][5]) >= 360);
        CHECK(number(rows[i][5]) <= 830);
    }
    CHECK(order == "40p 40s 10p 10s ");
    CHECK(bands({kMirror}) == bands({kMirror, "-a", "0", "-p", "s,p", "--range", "360:830"}));
}

TEST_CASE("other layers and groups of one do not change the landmarks", "[cli][bands]") {
    const auto plain = bands({kMirror, "-a", "0,30"});
    CHECK(bands({"1 | 2@50 | ((1@200 | 1.5@180)^1)^10 | 1.3+0.5i@70 | 1.7+3i", "-a", "0,30"}) ==
          plain);
    CHECK(bands({"1 | (2@50 | (1@200 | 1.5@180)^10)^1 | 1", "-a", "0,30"}) == plain);
}

TEST_CASE("gaps have their width, the reflectance inside and the periods needed", "[cli][bands]") {
    const auto rows = bands({kMirror, "--gaps", "-a", "0,20"});
    const std::vector<std::string> names{"angle_deg", "polarization", "order", "short_nm",
                                         "long_nm",   "width_nm",     "R_mid", "centre_nm",
                                         "N_95",      "N_99",         "N_999", "omnidirectional"};
    CHECK(rows[0] == names);
    REQUIRE(rows.size() == 7);
    const auto landmarks = bands({kMirror, "-a", "20", "-p", "p"});
    CHECK(rows[6][3] == landmarks[6][5]);
    CHECK(rows[6][4] == landmarks[4][5]);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto& row = rows[i];
        CAPTURE(i);
        CHECK(std::abs(number(row[4]) - number(row[3]) - number(row[5])) < 1e-12);
        const double centre = 2 / (1 / number(row[3]) + 1 / number(row[4]));
        CHECK(std::abs(centre / number(row[7]) - 1) < 1e-15);
        CHECK(std::abs(reflectance(kMirror, row[7], row[0], row[1]) - number(row[6])) < 1e-12);
        CHECK(row[11] == "false");  // a gap between vacuum and 1.5 closes at Brewster's angle
        for (const auto& [column, level] : {std::pair{8U, 0.95}, {9U, 0.99}, {10U, 0.999}}) {
            const int n = std::stoi(row[column]);
            const auto with = [](int repeat) {
                return "1 | (1@200 | 1.5@180)^" + std::to_string(repeat) + " | 1";
            };
            CHECK(reflectance(with(n), row[7], row[0], row[1]) >= level);
            CHECK(reflectance(with(n - 1), row[7], row[0], row[1]) < level);
        }
    }
}

TEST_CASE("closed gaps are of no width and cannot be filled", "[cli][bands]") {
    const auto rows = bands({"1 | (1.4@250 | 2@175)^10 | 1", "--gaps", "-p", "s"});
    REQUIRE(rows.size() == 3);
    CHECK(rows[1][2] == "2");
    CHECK(rows[1][3] == rows[1][4]);
    CHECK(rows[1][5] == "0");
    CHECK(rows[1][8] + rows[1][9] + rows[1][10] == "000");
    CHECK(rows[1][11] == "false");
}

TEST_CASE("many periods of little contrast are counted without trying each", "[cli][bands]") {
    const auto row =
        bands({"1.5 | (1.5@100 | 1.5003@100)^10 | 1.5", "--gaps", "-p", "s", "--range", "590:610"})
            .at(1);
    const double n = number(row[10]);
    CHECK(n > 1e4);
    // R = tanh^2(N kappa) at the centre, where kappa is the logarithm of the ratio of the indices
    CHECK(std::abs(n - std::ceil(std::atanh(std::sqrt(0.999)) / std::log(1.5003 / 1.5))) <= 2);
}

TEST_CASE("a mirror of high indices reflects from everywhere", "[cli][bands]") {
    // J. P. Dowling's and Y. Fink's condition: Brewster's angle must lie beyond the air's 90
    // degrees
    for (const auto& row :
         bands({"1 | (4.6@80 | 1.6@160)^10 | 1", "--gaps", "--range", "800:1900"}))
        if (row[2] == "1") CHECK(row[11] == "true");
    for (const auto& row : bands({"1 | (2@80 | 1.5@107)^10 | 1", "--gaps", "--range", "400:900"}))
        if (row[2] == "1") CHECK(row[11] == "false");
}

TEST_CASE("dispersive landmarks have the indices at their own wavelength", "[cli][bands]") {
    const Outcome outcome =
        run_irido({"bands", "air | (TiO2@58.5 | SiO2@94.2)^10 | BK7", "-a", "30", "-p", "s"});
    REQUIRE(outcome.status == 0);
    CHECK_THAT(outcome.err, Contains("absorption of the two layers"));
    const auto rows = parse_csv(outcome.out);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        std::string n[3];
        const std::string media[] = {"air", "TiO2", "SiO2"};
        for (const std::size_t m : {0U, 1U, 2U})
            n[m] =
                parse_csv(run_irido({"materials", "show", media[m], "-w", rows[i][5]}).out)[1][1];
        const auto same = bands({n[0] + " | (" + n[1] + "@58.5 | " + n[2] + "@94.2)^10 | 1.5", "-a",
                                 "30", "-p", "s", "--range", "300:1000"});
        double nearest = 1;
        for (const auto& row : same)
            if (row[2] == rows[i][2] && row[3] == rows[i][3])
                nearest = std::min(nearest, std::abs(number(row[5]) / number(rows[i][5]) - 1));
        CAPTURE(rows[i]);
        CHECK(nearest < 1e-14);
    }
}

TEST_CASE("the band diagram is a picture of all gaps", "[cli][bands]") {
    const TemporaryFolder folder;
    const Outcome outcome = run_irido(
        {"bands", "1 | (1@125 | 1.5@375)^20 | 1", "-a", "0:85:5", "--plot", folder / "bands.svg"});
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("angle_deg,polarization,kind"));
    const std::string svg = read_file(folder / "bands.svg");
    for (const char* text : {"<svg", "</svg>", "s polarization", "p polarization",
                             "vacuum wavelength, nm", "s, gap of order 2", "p, gap of order 3"})
        CHECK_THAT(svg, Contains(text));
    CHECK_THAT(svg, !Contains("nan") && !Contains("inf"));
    write_text(folder / "check.py",
               "import sys, xml.dom.minidom\nxml.dom.minidom.parse(sys.argv[1])\n");
    const std::string check = "command -v python3 >/dev/null || exit 0; python3 check.py bands.svg";
    CHECK(run_shell(check, folder.path()).status == 0);
}

TEST_CASE("what bands cannot answer is refused", "[cli][bands]") {
    const auto refused = [](const std::vector<std::string>& arguments, const std::string& error) {
        std::vector<std::string> all{"bands"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        CAPTURE(error);
        check_refused(run_irido(all), error);
    };
    const std::string needs = "a Bragg mirror needs one repeated group of two coherent layers";
    refused({"1 | 1.5@100 | 1"}, needs);
    refused({"1 | 1.5"}, needs);
    refused({"1 | (1.5@100 | 1@100)^1 | 1"}, needs);
    refused({"1 | (1.5@100 | 1@100 | 2@50)^5 | 1"}, needs);
    refused({"1 | (1.5@100)^5 | 1"}, needs);
    refused({"1 | (1.5@100 | 1@100)^5 | (1.5@90 | 1@90)^5 | 1"}, needs);
    refused({"1 | ((1.5@100 | 1@100)^5 | 2@50)^2 | 1"}, needs);
    refused({"1 | (1.5+0.2i@100 | 1@100)^5 | 1"}, "must be transparent");
    refused({"1.5 | (1.5@100 | 1@100)^5 | 1", "-a", "0,60"}, "critical angle of a layer (n = 1)");
    refused({"1 | (1.5@0 | 1@0)^5 | 1"}, "must have a thickness");
    refused({"1 | (1.5@1e9 | 1@100)^5 | 1"}, "orders of landmarks");
    refused({"air | (ZnS@60 | SiO2@90)^5 | 1"}, "ZnS");
    refused({kMirror, "-p", "u"}, "--polarization: must be s, p or s,p");
    for (const char* range : {"500", "800:400", "400:400", "400:500:1", "0:500", "a:b"})
        refused({kMirror, "--range", range}, "--range");
    refused({kMirror, "-a", "91"}, "--angles");
    refused({kMirror, "--plot", "x.svg"}, "--plot: requires several angles");
    refused({kMirror, "-a", "0,1", "--plot", "x.gif"}, "--plot: must end in .pdf, .png or .svg");
    refused({kMirror, "-a", "0,1", "--plot", "x.svg", "-o", "x.svg", "-f", "csv"}, "another file");
    refused({kMirror, "-f", "gif"}, "--format");
}

TEST_CASE("landmarks that are not unique are refused", "[cli][bands][refused]") {
    // n rises from 1.5 to 2.5 between 450 and 500 nm: there the phase decreases with 1/wavelength
    const std::string stack = R"({"incident": 1, "layers": [{"repeat": 8, "layers": [
        {"material": 1.3, "thickness_nm": 150},
        {"material": {"table": [[300, 1.5, 0], [450, 1.5, 0], [500, 2.5, 0], [900, 2.5, 0]]},
         "thickness_nm": 300}]}], "substrate": 1})";
    for (const std::string what : {"--quiet", "--gaps"})
        check_refused(run_irido({"bands", "-", "-p", "s", what}, stack),
                      "the phase of a layer must grow with 1/wavelength (it falls near 500 nm)");
    CHECK(run_irido({"bands", "-", "--range", "800:880"}, stack).status == 0);
}

TEST_CASE("periods of spread thicknesses are counted as far as they can be", "[cli][bands][slow]") {
    const Outcome outcome = done({"bands", "-", "-p", "s", "--gaps"}, R"({"incident": 1,
        "layers": [{"repeat": 5, "layers": [
            {"material": 1, "thickness_nm": 200, "thickness_sigma_nm": 5},
            {"material": 1.5, "thickness_nm": 180}]}], "substrate": 1})");
    const auto rows = parse_csv(outcome.out);
    const auto column = static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), "N_95") -
                                                 rows[0].begin());
    CHECK(std::stod(rows.at(1).at(column)) > 5);
    CHECK(std::stod(rows.at(1).at(column + 2)) == 0);
}

TEST_CASE("help of bands says what it is for, with examples that work", "[cli][bands]") {
    const std::string help = run_irido({"bands", "--help"}).out;
    for (const char* text : {"--range", "[360:830]", "--gaps", "--plot", "N_999", "Examples:"})
        CHECK_THAT(help, Contains(text));
    const TemporaryFolder folder;
    CHECK(run_shell("\"$IRIDO\" bands \"1 | (1@200 | 1.5@180)^10 | 1\" -a 20 -p p", ".").status ==
          0);
    CHECK(run_shell("\"$IRIDO\" bands \"air | (TiO2@58.5 | SiO2@94.2)^10 | BK7\" -a 0:85:1 --gaps "
                    "--plot bands.svg",
                    folder.path())
              .status == 0);
}
