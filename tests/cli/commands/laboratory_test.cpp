#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::WithinAbs;
using Catch::Matchers::Contains;

namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const std::vector<std::string>& arguments, const std::string& input = "") {
    const Outcome outcome = done(arguments, input);
    const auto table = parse_csv(outcome.out);
    std::vector<Row> rows;
    for (std::size_t i = 1; i < table.size(); ++i) {
        rows.emplace_back();
        for (std::size_t c = 0; c < table[0].size(); ++c) rows.back()[table[0][c]] = table[i][c];
    }
    return rows;
}

double number(const Row& row, const std::string& column) {
    return std::stod(row.at(column));
}

const std::string kEllipsometric = "psi_deg,delta_nebraska_deg,N,C,S,depolarization";
const std::string kOxide = "1 | 1.457@25 | 3.882+0.019i";
const std::string kPane = "1 | 1.52@1mm! | 1";

}  // namespace

// Reference values of this file: 40-digit evaluations, rounded to double.
TEST_CASE("what an ellipsometer prints", "[cli][spectrum]") {
    for (const std::string p : {"u", "s", "p"}) {
        const auto rows = rows_of(
            {"spectrum", kOxide, "-w", "632.8", "-a", "70", "-p", p, "--columns", kEllipsometric});
        REQUIRE(rows.size() == 1);
        CHECK_THAT(number(rows[0], "psi_deg"), WithinAbs(15.105711131918168, 1e-10));
        CHECK_THAT(number(rows[0], "delta_nebraska_deg"), WithinAbs(122.37166727824669, 1e-9));
        CHECK_THAT(number(rows[0], "N"), WithinAbs(0.8641745046791867, 1e-12));
        CHECK_THAT(number(rows[0], "C"), WithinAbs(-0.26941375703724435, 1e-12));
        CHECK_THAT(number(rows[0], "S"), WithinAbs(0.4249925328538832, 1e-12));
        CHECK(rows[0].at("depolarization") == "0");
    }
    const auto bare = rows_of(
        {"spectrum", "1 | 3.882+0.019i", "-w", "632.8", "-a", "70", "--columns", kEllipsometric});
    CHECK_THAT(number(bare[0], "psi_deg"), WithinAbs(10.573, 5e-4));
    CHECK_THAT(number(bare[0], "delta_nebraska_deg"), WithinAbs(179.230, 5e-4));
}

TEST_CASE("a pane's back depolarizes", "[cli][spectrum]") {
    const auto rows =
        rows_of({"spectrum", kPane, "-w", "550", "-a", "60", "--columns", kEllipsometric});
    REQUIRE(rows.size() == 1);
    CHECK_THAT(number(rows[0], "psi_deg"), WithinAbs(5.599573512222306, 1e-10));
    CHECK_THAT(number(rows[0], "delta_nebraska_deg"), WithinAbs(0, 1e-9));
    CHECK_THAT(number(rows[0], "N"), WithinAbs(0.9805169896113648, 1e-12));
    CHECK_THAT(number(rows[0], "C"), WithinAbs(0.19413242262969127, 1e-12));
    CHECK_THAT(number(rows[0], "S"), WithinAbs(0, 1e-12));
    CHECK_THAT(number(rows[0], "depolarization"), WithinAbs(0.0008990355673935853, 1e-12));
}

TEST_CASE("what s and p have together is printed once", "[cli][spectrum]") {
    const auto rows = rows_of({"spectrum", kOxide, "-w", "600,632.8", "-a", "70", "-p", "p,s",
                               "--columns", "psi_deg,delta_deg,N,r_re"});
    REQUIRE(rows.size() == 4);
    for (const std::string column : {"psi_deg", "delta_deg", "N"}) {
        CHECK_FALSE(rows[0].at(column).empty());
        CHECK_FALSE(rows[1].at(column).empty());
        CHECK(rows[2].at(column).empty());
        CHECK(rows[3].at(column).empty());
    }
}

TEST_CASE("delays have no value where nothing is reflected", "[cli][spectrum]") {
    const std::vector<std::string> ask{"spectrum",  "1 | 1@100 | 1",
                                       "-w",        "500",
                                       "-p",        "s",
                                       "--columns", "phase_r_deg,gd_r_fs,gd_t_fs"};
    const auto rows = rows_of(ask);
    CHECK(rows[0].at("phase_r_deg").empty());
    CHECK(rows[0].at("gd_r_fs").empty());
    CHECK_THAT(number(rows[0], "gd_t_fs"), WithinAbs(100 / 299.792458, 1e-13));
    std::vector<std::string> json = ask;
    json.insert(json.end(), {"-f", "json"});
    CHECK_THAT(run_irido(json).out, Contains("\"phase_r_deg\":null,\"gd_r_fs\":null"));
    check_refused(run_irido({"spectrum", kPane, "-p", "s", "--columns", "gd_r_fs"}),
                  "requires coherent layers");
    check_refused(run_irido({"spectrum", kOxide, "--columns", "gd_r_fs"}), "use -p s,p");
    const Outcome tabulated =
        run_irido({"spectrum", "air | Si", "-w", "500,600", "-p", "s", "--columns", "gd_r_fs"});
    CHECK_THAT(tabulated.err, Contains("straight lines between their rows"));
}

TEST_CASE("means over cones", "[cli][spectrum]") {
    const auto tilted = rows_of({"spectrum", "1 | 1.38@99.6 | 1.52", "-w", "550", "-a", "45", "-p",
                                 "u,s,p", "--cone", "10"});
    CHECK_THAT(number(tilted[0], "R"), WithinAbs(0.021713626324774887, 1e-12));
    CHECK_THAT(number(tilted[0], "T"), WithinAbs(0.9782863736752251, 1e-12));
    // reference: 16-point Gauss in v, 48 midpoints in azimuth, each ray with its own transverse
    // vector
    CHECK_THAT(number(tilted[1], "R"), WithinAbs(0.04133431904619384, 1e-12));
    CHECK_THAT(number(tilted[2], "R"), WithinAbs(0.0020929336033558713, 1e-12));
    CHECK_THAT(number(rows_of({"spectrum", "1 | 1.5", "-w", "550", "--cone", "90"})[0], "R"),
               WithinAbs(0.0917780, 1e-7));
    CHECK_THAT(number(rows_of({"spectrum", "1.5 | 1", "-w", "550", "--cone", "90"})[0], "R"),
               WithinAbs(0.5963458, 1e-7));
    const auto lens = rows_of({"spectrum", kOxide, "-w", "550", "-p", "s,p,u", "--f-number", "1"});
    const auto cone = rows_of({"spectrum", kOxide, "-w", "550", "--cone", "30"});
    for (const Row& row : lens)
        CHECK_THAT(number(row, "R"), WithinAbs(number(cone[0], "R"), 1e-12));
    check_refused(run_irido({"spectrum", kOxide, "-a", "0,85", "--cone", "10"}),
                  "together must be at most 90 degrees (got 85 + 10)");
    check_refused(run_irido({"spectrum", kOxide, "-a", "70", "--f-number", "1"}),
                  "90 degrees or before");
    check_refused(run_irido({"spectrum", kOxide, "--cone", "10", "--f-number", "4"}),
                  "mutually exclusive");
    check_refused(run_irido({"spectrum", kOxide, "-p", "s", "--cone", "10", "--columns", "r_re"}),
                  "--cone: cannot be combined with --columns other than A_layers");
}

TEST_CASE("the mean over a narrow cone is the value at its axis", "[cli][spectrum]") {
    const std::vector<std::string> ask{
        "spectrum", "1 | 1.38@99.6 | 1.52", "-w", "550", "-p", "s,p", "-a", "0,45,89"};
    const auto rays = rows_of(ask);
    for (const char* const half_angle :
         {"1e-320", "1e-200", "1e-14", "1e-12", "1e-10", "1e-8", "1e-6"}) {
        std::vector<std::string> with = ask;
        with.insert(with.end(), {"--cone", half_angle});
        const auto means = rows_of(with);
        REQUIRE(means.size() == rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            CAPTURE(half_angle, i);
            if (i < 2) continue;  // along and across the surface are halves of each there
            CHECK_THAT(number(means[i], "R"), WithinAbs(number(rays[i], "R"), 1e-12));
            CHECK_THAT(number(means[i], "R") + number(means[i], "T"), WithinAbs(1, 1e-12));
        }
        CHECK_THAT(number(means[0], "R"), WithinAbs(number(rays[0], "R"), 1e-12));
    }
}

TEST_CASE("a colour over a cone is the mean of its colours", "[cli][color]") {
    const std::vector<std::string> ask{"color", "1 | 1.46@310 | 4.08+0.04i"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> all = ask;
        all.insert(all.end(), more.begin(), more.end());
        return rows_of(all);
    };
    CHECK_THAT(number(with({"--cone", "0.01"})[0], "Y"), WithinAbs(number(with({})[0], "Y"), 1e-6));
    const double s = number(with({"-a", "40", "-p", "s", "--cone", "20"})[0], "Y");
    const double p = number(with({"-a", "40", "-p", "p", "--cone", "20"})[0], "Y");
    CHECK_THAT(number(with({"-a", "40", "--cone", "20"})[0], "Y"), WithinAbs((s + p) / 2, 1e-7));
}

TEST_CASE("light from the substrate is transmitted as light to it", "[cli][spectrum]") {
    const auto plate = rows_of({"spectrum", kPane, "-w", "550", "-a", "45", "--reverse"});
    CHECK_THAT(number(plate[0], "R"), WithinAbs(0.09747173783257576, 1e-12));
    CHECK_THAT(number(plate[0], "T"), WithinAbs(0.9025282621674242, 1e-12));
    // at the same n sin(theta): 30 degrees in 1.5 is 48.59 in air
    const std::string stack = "1 | 2.3@80 | (1.4+0.01i@120 | 1.9@55)^4 | 1.6@1mm! | 1.5";
    const auto there =
        rows_of({"spectrum", stack, "-w", "550", "-a", "48.590377890729144", "-p", "s,p"});
    const auto back =
        rows_of({"spectrum", stack, "-w", "550", "-a", "30", "-p", "s,p", "--reverse"});
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK_THAT(number(back[i], "T"), WithinAbs(number(there[i], "T"), 1e-13));
        CHECK(std::abs(number(back[i], "R") - number(there[i], "R")) > 1e-4);
    }
    check_refused(run_irido({"spectrum", "1 | 1.5@100 | 2+3i", "--reverse"}),
                  "/substrate: must be transparent");
    // paths refer to the stack as written
    const auto swept =
        rows_of({"sweep", "1 | 2@100 | 1.4@50 | 1.5", "--vary", "layers.0.thickness_nm=100,130",
                 "--compute", "spectrum", "-w", "550", "--reverse"});
    const auto other = rows_of({"spectrum", "1.5 | 1.4@50 | 2@130 | 1", "-w", "550"});
    CHECK(swept[1].at("R") == other[0].at("R"));
}

TEST_CASE("averages over a range", "[cli][spectrum]") {
    const std::string stack = "1 | 1.46@310 | 4.08+0.04i";
    for (const std::string step : {"400:700:1", "400,700", "700,400"}) {
        const auto rows =
            rows_of({"spectrum", stack, "-w", step, "-a", "20", "--average", "photopic"});
        REQUIRE(rows.size() == 1);
        CHECK(rows[0].at("weight") == "photopic");
        CHECK_THAT(number(rows[0], "R"), WithinAbs(0.15586793952633227, 1e-10));
        CHECK_THAT(number(rows[0], "T"), WithinAbs(0.8441320604736677, 1e-10));
    }
    check_refused(run_irido({"spectrum", stack, "-w", "550", "--average", "flat"}),
                  "must be a range");
    check_refused(run_irido({"spectrum", stack, "--average", "solar"}), "must be one of flat");
    check_refused(run_irido({"sweep", stack, "--vary", "wavelength_nm=500,600", "--compute",
                             "spectrum", "--average", "flat"}),
                  "--average: cannot be combined with a varied wavelength_nm");
    check_refused(run_irido({"spectrum", stack, "-w", "900:1000:1", "--average", "photopic"}),
                  "is 0 from 900 to 1000 nm");
}

TEST_CASE("wavelengths in other units", "[cli][spectrum]") {
    const auto nm = rows_of({"spectrum", kOxide, "-w", "632.8,380"});
    const auto um = rows_of({"spectrum", kOxide, "-w", "0.6328,0.38", "--unit", "um"});
    for (std::size_t i = 0; i < 2; ++i) CHECK(um[i].at("R") == nm[i].at("R"));
    CHECK(um[0].at("wavelength_um") == "0.6328");
    const auto ev = rows_of({"spectrum", kOxide, "-w", "2,1.5", "--unit", "eV"});
    CHECK(ev[0].at("energy_eV") == "2");
    CHECK(ev[1].at("energy_eV") == "1.5");
    const auto wavenumber = rows_of({"spectrum", kOxide, "-w", "20000", "--unit", "cm-1"});
    CHECK(wavenumber[0].at("wavenumber_per_cm") == "20000");
    CHECK(wavenumber[0].at("R") == rows_of({"spectrum", kOxide, "-w", "500"})[0].at("R"));
    check_refused(run_irido({"spectrum", kOxide, "--unit", "furlong"}), "--unit: must be one of");
    check_refused(run_irido({"spectrum", kOxide, "-w", "2000", "--unit", "eV"}),
                  "--wavelengths, eV: must be in [0.000123984, 1239.84] (got 2000)");
    // without -w: the usual range, converted to the unit
    const auto usual = rows_of({"spectrum", kOxide, "--unit", "um"});
    REQUIRE(usual.size() == 401);
    CHECK(usual[0].at("wavelength_um") == "0.38");
    CHECK(usual[0].at("R") == nm[1].at("R"));
    CHECK_THAT(number(rows_of({"spectrum", kOxide, "--unit", "eV"}).back(), "energy_eV"),
               WithinAbs(1239.8419843320026 / 780, 1e-12));
    const auto field = rows_of({"profile", kOxide, "--z", "0", "--unit", "um"});
    CHECK(field[0].at("wavelength_um") == "0.55");
    check_refused(run_irido({"spectrum", kOxide, "--f-number", "0"}),
                  "--f-number: must be at least 1/(2 n), which is 0.5 in air (got 0)");
    check_refused(run_irido({"spectrum", kOxide, "--f-number", "0.4"}),
                  "an f-number must be at least 1/(2 n), here 0.5 (got 0.4)");
}

TEST_CASE("delays at 90 degrees are the limits of those before", "[cli][spectrum]") {
    const auto rows = rows_of({"spectrum", "1 | 1.5@200 | 3", "-w", "550", "-a", "89.9999,90", "-p",
                               "s,p", "--columns", "phase_r_deg,gd_r_fs,phase_t_deg,gd_t_fs"});
    REQUIRE(rows.size() == 4);
    for (const std::string column : {"phase_r_deg", "gd_r_fs", "phase_t_deg", "gd_t_fs"})
        for (std::size_t p = 0; p < 2; ++p)
            CHECK_THAT(number(rows[2 + p], column), WithinAbs(number(rows[p], column), 1e-3));
}

// Reference values: 40-digit evaluations.
TEST_CASE("a rough face of silicon", "[cli][spectrum]") {
    const std::vector<std::string> request{
        "spectrum", "1 | 1.457@100 | 3.88+0.019i", "-w", "632.8", "-a", "70", "-p", "s",
        "--set",    "substrate_roughness_nm=3"};
    const auto added = rows_of(request);
    CHECK_THAT(number(added[0], "R"), WithinAbs(0.2933708200673089, 1e-12));
    CHECK_THAT(number(added[0], "T"), WithinAbs(0.7063802760179255, 1e-12));
    auto other = request;
    other.insert(other.end(), {"--set", "roughness_placement=centred", "--columns", "A_layers"});
    const auto centred = rows_of(other);
    CHECK(std::abs(number(centred[0], "R") - number(added[0], "R")) > 1e-4);
    CHECK(centred[0].at("A_1") == "0");
    CHECK(number(centred[0], "A_2") > 0);
}

TEST_CASE("a graded layer is one layer everywhere", "[cli][spectrum]") {
    const std::string graded = R"({"incident": 1.5, "layers": [{"graded": {"from": 1.5, "to": 2.5,
        "profile": "inverse-n"}, "thickness_nm": 150}], "substrate": 2.5})";
    const auto closed = rows_of({"spectrum", "-", "-w", "550", "-p", "s,p"}, graded);
    for (const Row& row : closed)
        CHECK_THAT(number(row, "R"), WithinAbs(0.00010394353233271342, 1e-10));
    std::string lossy = graded;
    lossy.replace(lossy.find("\"to\": 2.5"), 9, "\"to\": {\"n\": 2.5, \"k\": 0.2}");
    const auto by_layer =
        rows_of({"spectrum", "-", "-w", "550", "-a", "30", "--columns", "A_layers"}, lossy);
    CHECK(by_layer[0].size() == 7);
    CHECK_THAT(number(by_layer[0], "A_1"), WithinAbs(number(by_layer[0], "A"), 1e-12));
    const auto summary = rows_of({"profile", "-", "-p", "p", "-a", "30", "--summary"}, lossy);
    REQUIRE(summary.size() == 2);
    CHECK(summary[1].at("medium") == "2");
    const auto absorbed = rows_of({"spectrum", "-", "-w", "550", "-a", "30", "-p", "p"}, lossy);
    CHECK_THAT(number(summary[0], "absorbed"), WithinAbs(number(absorbed[0], "A"), 1e-12));
    const auto field = rows_of({"profile", "-", "--z", "75,149.9,150"}, lossy);
    CHECK(field[0].at("medium") == "1");
    CHECK(field[1].at("medium") == "1");
    CHECK(field[2].at("medium") == "2");
    // a varied thickness reads the document again
    const Outcome swept = run_irido({"sweep", "-", "--vary", "layers.0.thickness_nm=150,200",
                                     "--compute", "spectrum", "-w", "550", "--quiet"},
                                    graded);
    const auto rows = parse_csv(swept.out);
    REQUIRE(rows.size() == 3);
    CHECK_THAT(std::stod(rows[1][4]), WithinAbs(0.00010394353233271342, 1e-10));
    CHECK(rows[2][4] != rows[1][4]);
}

TEST_CASE("delays and colours of graded layers and crystals", "[cli][spectrum]") {
    const std::string crystal = R"({"incident": 1, "layers": [{"material": {"ordinary": 1.658,
        "extraordinary": 1.486}, "thickness_nm": 1000}], "substrate": 1.5})";
    const auto delays = rows_of({"spectrum", "-", "-w", "550,551", "-a", "60", "-p", "s,p",
                                 "--columns", "phase_t_deg,gd_t_fs"},
                                crystal);
    // the same media without dispersion: the phase is proportional to frequency except in r
    CHECK(number(delays[0], "gd_t_fs") > 4);
    CHECK(delays[0].at("gd_t_fs") != delays[2].at("gd_t_fs"));
    const Outcome color = run_irido({"color", "-", "-a", "0,60", "--stats"}, crystal);
    CHECK(color.status == 0);
    CHECK_THAT(color.out, Contains("quadrature"));
    const auto psi =
        rows_of({"spectrum", "-", "-w", "550", "-a", "60", "--columns", "psi_deg"}, crystal);
    CHECK(number(psi[0], "psi_deg") > 0);
    for (const auto& [command, error] :
         {std::pair{"cm", "a uniaxial medium"}, std::pair{"bands", "isotropic media"}}) {
        const std::string mirror = R"({"incident": 1, "layers": [{"repeat": 4, "layers": [
            {"material": {"ordinary": 1.6, "extraordinary": 1.5}, "thickness_nm": 100},
            {"material": 2, "thickness_nm": 80}]}], "substrate": 1.5})";
        check_refused(run_irido({command, "-"}, command == std::string("cm") ? crystal : mirror),
                      error);
    }
    check_refused(run_irido({"color", "-", "--method", "fourier"}, crystal), "uniaxial");
    const auto back = rows_of({"spectrum", "-", "-w", "550", "--reverse"}, crystal);
    CHECK_THAT(number(back[0], "T"),
               WithinAbs(number(rows_of({"spectrum", "-", "-w", "550"}, crystal)[0], "T"), 1e-12));
}

TEST_CASE("quarter waves and mixtures on the command line", "[cli][spectrum]") {
    const auto quarter = rows_of({"spectrum", "1 | (H@1Q | L@1Q)^8 | 1.52", "--reference", "550",
                                  "--material", "H=2.35", "--material", "L=1.46", "-w", "550"});
    // H^16 on L^16: (n0/ns) (H/L)^16 at the centre
    const double y = std::pow(2.35 / 1.46, 16) * 1.52;
    CHECK_THAT(number(quarter[0], "R"), WithinAbs(std::pow((1 - y) / (1 + y), 2), 1e-12));
    check_refused(run_irido({"spectrum", "air | 2@1Q | 1.5", "-w", "550"}),
                  "/layers/0/qwot: requires the stack's reference_nm (or --reference NM)");
    const auto mixed = rows_of(
        {"spectrum", "air | M@100 | 1.5", "-w", "550", "--material",
         R"(M={"mixture": {"inclusion": "air", "host": 2, "fraction": 0.5, "model": "linear"}})"});
    const auto plain = rows_of({"spectrum", "1 | M@100 | 1.5", "-w", "550", "--material",
                                "M=" + std::to_string(std::sqrt((1.0002 * 1.0002 + 4) / 2))});
    CHECK_THAT(number(mixed[0], "R"), WithinAbs(number(plain[0], "R"), 1e-3));
    const Outcome varied = run_irido(
        {"sweep", "air | M@100 | 1.5", "--material",
         R"(M={"mixture": {"inclusion": 1, "host": 2, "fraction": 0.5}})", "--vary",
         "materials.M.mixture.fraction=0,1", "--compute", "spectrum", "-w", "550", "--quiet"});
    const auto rows = parse_csv(varied.out);
    REQUIRE(rows.size() == 3);
    CHECK_THAT(
        std::stod(rows[2][4]),
        WithinAbs(number(rows_of({"spectrum", "air | 1@100 | 1.5", "-w", "550"})[0], "R"), 1e-13));
}
