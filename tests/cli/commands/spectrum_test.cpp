#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// Compares rows: text columns must be equal, numbers within 1e-14 of the larger of 1 and their
/// size, and within a relative 1e-12, which allows for rounding errors and their growth over the
/// stacks below.
void check_same_table(const std::string& actual, const std::string& expected) {
    const auto got = parse_csv(actual), want = parse_csv(expected);
    REQUIRE(got.size() == want.size());
    CHECK(got[0] == want[0]);
    for (std::size_t row = 1; row < want.size(); ++row) {
        REQUIRE(got[row].size() == want[row].size());
        for (std::size_t c = 0; c < want[row].size(); ++c) {
            INFO("row " << row << ", column " << want[0][c] << ": " << got[row][c]);
            if (want[row][c].find_first_not_of("spu") == std::string::npos) {
                CHECK(got[row][c] == want[row][c]);
                continue;
            }
            const double a = std::stod(got[row][c]), b = std::stod(want[row][c]);
            CHECK(std::abs(a - b) <= 1e-14);
            CHECK(std::abs(a - b) <= 1e-12 * std::abs(b));
        }
    }
}

}  // namespace

// Reference rows: 60-digit evaluation of the characteristic matrices in multiprecision arithmetic,
// rounded to double.
TEST_CASE("spectra agree with a 60-digit evaluation", "[cli][spectrum]") {
    check_same_table(
        run_irido({"spectrum", "1 | 1.38@99.6 | 1.52", "-w", "450,550", "-a", "0,45", "-p", "s,p"})
            .out,
        "wavelength_nm,angle_deg,polarization,R,T,A\n"
        "450,0,s,0.016189989513440375,0.9838100104865596,0\n"
        "550,0,s,0.012600801125299144,0.9873991988747008,0\n"
        "450,0,p,0.016189989513440375,0.9838100104865596,0\n"
        "550,0,p,0.012600801125299144,0.9873991988747008,0\n"
        "450,45,s,0.03735149603888593,0.9626485039611141,0\n"
        "550,45,s,0.0400615988418047,0.9599384011581953,0\n"
        "450,45,p,0.000995610542102046,0.9990043894578979,0\n"
        "550,45,p,0.001357597829761058,0.9986424021702389,0\n");
    check_same_table(
        run_irido({"spectrum", "1 | 1.46@120 | 4.08+0.04i", "-w", "550", "-a", "0,60", "-p", "u"})
            .out,
        "wavelength_nm,angle_deg,polarization,R,T,A\n"
        "550,0,u,0.16171958237393327,0.8382804176260668,0\n"
        "550,60,u,0.11229789059384718,0.8877021094061528,0\n");
    check_same_table(run_irido({"spectrum", "1 | (2.3@60 | 1.46@94)^12 | 1.52", "-w", "480,550",
                                "-a", "0,30", "-p", "s,p"})
                         .out,
                     "wavelength_nm,angle_deg,polarization,R,T,A\n"
                     "480,0,s,0.9560945862590081,0.04390541374099184,0\n"
                     "550,0,s,0.9999517685595919,4.823144040809519e-05,0\n"
                     "480,0,p,0.9560945862590081,0.04390541374099184,0\n"
                     "550,0,p,0.9999517685595919,4.823144040809519e-05,0\n"
                     "480,30,s,0.9998330396859327,0.00016696031406729814,0\n"
                     "550,30,s,0.9999746057203627,2.5394279637303244e-05,0\n"
                     "480,30,p,0.9981737041712482,0.0018262958287518028,0\n"
                     "550,30,p,0.9998019662031752,0.00019803379682482758,0\n");
    check_same_table(run_irido({"spectrum", "1 | 2+2i@10000 | 1.5", "-w", "550"}).out,
                     "wavelength_nm,angle_deg,polarization,R,T,A\n"
                     "550,0,u,0.38461538461538464,3.1897903076684135e-199,0.6153846153846154\n");
}

TEST_CASE("a spectrum's rows run by angle, polarization, wavelength", "[cli][spectrum]") {
    const auto rows = parse_csv(
        run_irido({"spectrum", "1 | 1.5@100 | 2", "-w", "500,400", "-a", "30,0", "-p", "p,s"}).out);
    REQUIRE(rows.size() == 9);
    CHECK(rows[1][0] + rows[1][1] + rows[1][2] == "50030p");
    CHECK(rows[2][0] + rows[2][1] + rows[2][2] == "40030p");
    CHECK(rows[3][0] + rows[3][1] + rows[3][2] == "50030s");
    CHECK(rows[5][0] + rows[5][1] + rows[5][2] == "5000p");
}

TEST_CASE("the default is 380 to 780 nm at 1 nm, normal incidence, unpolarized",
          "[cli][spectrum]") {
    const auto rows = parse_csv(run_irido({"spectrum", "air | SiO2@100 | Si"}).out);
    REQUIRE(rows.size() == 402);
    CHECK(rows[1][0] == "380");
    CHECK(rows[401][0] == "780");
    CHECK(rows[1][1] == "0");
    CHECK(rows[1][2] == "u");
}

TEST_CASE("a stack comes from a file, an expression or standard input alike", "[cli][spectrum]") {
    const TemporaryFolder folder;
    const std::string text =
        R"({"incident": 1, "layers": [{"material": 1.38, "thickness_nm": 99.6}], "substrate": 1.52})";
    write_text(folder / "stack.json", text);
    const std::string expected = run_irido({"spectrum", "1 | 1.38@99.6 | 1.52"}).out;
    CHECK(expected.size() > 1000);
    CHECK(run_irido({"spectrum", folder / "stack.json"}).out == expected);
    CHECK(run_irido({"spectrum", "-"}, text).out == expected);
    CHECK(run_irido(
              {"spectrum", "-", "--set", "layers.0.thickness_nm=99.6", "--set", "substrate=1.52"},
              R"({"incident": 1, "layers": [{"material": 1.38, "thickness_nm": 5}],
                        "substrate": 2})")
              .out == expected);
}

TEST_CASE("the same bytes for every number of threads", "[cli][spectrum]") {
    const std::vector<std::string> request{
        "spectrum", "air | TiO2@50 | Ag@20 | BK7", "-a", "0:89:1", "-p", "s,p,u"};
    const std::string one = [&] {
        auto arguments = request;
        arguments.insert(arguments.end(), {"-j", "1"});
        return run_irido(arguments).out;
    }();
    auto arguments = request;
    arguments.insert(arguments.end(), {"-j", "7"});
    CHECK(run_irido(arguments).out == one);
    CHECK(one.size() > 1000000);
}

TEST_CASE("JSON has the CSV's names", "[cli][spectrum]") {
    CHECK(run_irido({"spectrum", "1 | 1 | 1", "-f", "json"}).status == 2);
    CHECK(run_irido({"spectrum", "1 | 1", "-w", "500", "-f", "json"}).out ==
          "[\n{\"wavelength_nm\":500,\"angle_deg\":0,\"polarization\":\"u\",\"R\":0,\"T\":1,"
          "\"A\":0}\n]\n");
}

TEST_CASE("more columns come in the order asked for", "[cli][spectrum]") {
    const std::string out =
        run_irido({"spectrum", "1 | 1.5@100 | 2+1i", "-w", "500,600", "-a", "0,60", "-p", "p,s",
                   "--columns", "A_layers,delta_deg,psi_deg,t_im,t_re,r_im,r_re"})
            .out;
    const auto table = parse_csv(out);
    REQUIRE(table.size() == 9);
    const std::vector<std::string> header{
        "wavelength_nm", "angle_deg", "polarization", "R",    "T",    "A",   "A_1",
        "delta_deg",     "psi_deg",   "t_im",         "t_re", "r_im", "r_re"};
    CHECK(table[0] == header);
    for (std::size_t row = 1; row < table.size(); ++row) {
        const auto at = [&](std::size_t column) { return std::stod(table[row][column]); };
        CHECK(std::abs(at(11) * at(11) + at(12) * at(12) - at(3)) < 1e-14);
        CHECK(at(6) == 0);
    }
    // both polarizations of an angle share psi and delta, printed in the rows of the first: 45 and
    // 0 at normal incidence
    CHECK(table[1][7] == "0");
    CHECK(std::abs(std::stod(table[1][8]) - 45) < 1e-12);
    CHECK_FALSE(table[5][7].empty());
    CHECK_FALSE(table[5][8].empty());
    CHECK(table[7][7].empty());
    CHECK(table[7][8].empty());
}

TEST_CASE("absorption layer by layer, u being the mean", "[cli][spectrum]") {
    const std::string stack = "1 | (1.5+0.001i@100 | 2.2@50)^2 | 0.2+3i@10 | 1.5";
    const auto rows = parse_csv(run_irido({"spectrum", stack, "-w", "500", "-a", "50", "-p",
                                           "s,p,u", "--columns", "A_layers"})
                                    .out);
    REQUIRE(rows.size() == 4);
    REQUIRE(rows[0].size() == 11);
    CHECK(rows[0][10] == "A_5");
    for (std::size_t column = 6; column < 11; ++column)
        CHECK(std::abs((std::stod(rows[1][column]) + std::stod(rows[2][column])) / 2 -
                       std::stod(rows[3][column])) < 1e-16);
    double sum = 0;
    for (std::size_t column = 6; column < 11; ++column) sum += std::stod(rows[3][column]);
    CHECK(std::abs(sum - std::stod(rows[3][5])) < 1e-15);
    CHECK(parse_csv(run_irido({"spectrum", "1 | 2", "-w", "500", "--columns", "A_layers"}).out)[0]
              .size() == 6);
}

TEST_CASE("all columns are in JSON and numpy arrays too", "[cli][spectrum]") {
    CHECK_THAT(run_irido({"spectrum", "1 | 1.5", "-w", "500", "-p", "s", "-f", "json", "--columns",
                          "r_re,psi_deg"})
                   .out,
               Contains("\"A\":0,\"r_re\":-0.2") && Contains("\"psi_deg\":45"));
    const TemporaryFolder folder;
    const Outcome done = run_shell(
        "\"$IRIDO\" spectrum '1 | Au@20 | 1.5' -p s -a 30 --columns A_layers,t_re -o s.npy && "
        "/usr/bin/python3 -c 'import numpy; a = numpy.load(\"s.npy\"); "
        "assert a.dtype.names[-2:] == (\"A_1\", \"t_re\"); "
        "assert abs(a[\"A\"] - a[\"A_1\"]).max() < 1e-14; "
        "assert set(a[\"polarization\"]) == {\"s\"}; assert a[\"wavelength_nm\"][3] == 383'",
        folder.path());
    INFO(done.err);
    CHECK(done.status == 0);
}

TEST_CASE("numpy reads the array", "[cli][spectrum]") {
    const TemporaryFolder folder;
    const std::string request = "\"$IRIDO\" spectrum 'air | Au@20 | BK7' -a 0,60 -p s,u ";
    const Outcome done = run_shell(
        request + "-o s.npy && " + request +
            "-o s.csv && /usr/bin/python3 -c '\n"
            "import numpy, csv\n"
            "a = numpy.load(\"s.npy\")\n"
            "rows = list(csv.DictReader(open(\"s.csv\")))\n"
            "assert a.shape == (len(rows),) == (1604,), a.shape\n"
            "assert list(a.dtype.names) == list(rows[0]), a.dtype\n"
            "for name in a.dtype.names:\n"
            "    column = [row[name] for row in rows]\n"
            "    text = a[name].dtype.kind == \"U\"\n"
            "    assert all(a[name] == (column if text else numpy.array(column, float))), name\n"
            "'",
        folder.path());
    INFO(done.err);
    CHECK(done.status == 0);
}

TEST_CASE("lists: values, steps that end on the grid or before it, counts", "[cli][list]") {
    const auto wavelengths = [](const std::string& list) {
        std::string text;
        const auto rows = parse_csv(run_irido({"spectrum", "1 | 2", "-w", list}).out);
        for (std::size_t i = 1; i < rows.size(); ++i) text += rows[i][0] + " ";
        return text;
    };
    CHECK(wavelengths("500") == "500 ");
    CHECK(wavelengths("500,400.5") == "500 400.5 ");
    CHECK(wavelengths("400:410:5") == "400 405 410 ");
    CHECK(wavelengths("400:409:5") == "400 405 ");
    CHECK(wavelengths("400:400.5:0.1") == "400 400.1 400.2 400.3 400.4 400.5 ");
    CHECK(wavelengths("410:400:-5") == "410 405 400 ");
    CHECK(wavelengths("400:500/3") == "400 450 500 ");
    CHECK(wavelengths("1e3:2e3:5e2,7") == "1000 1500 2000 7 ");
    CHECK(wavelengths("500:500:1") == "500 ");
}

TEST_CASE("what was typed wrong is one line and exit status 2", "[cli][refused]") {
    struct Case {
        std::vector<std::string> arguments;
        std::string error;
    };
    const std::string stack = "1 | 1.5@100 | 1";
    const std::vector<Case> cases{
        {{"spectrum", stack, "-w", "0"}, "--wavelengths: must be in [1, 1e+07] (got 0)"},
        {{"spectrum", stack, "-w", "nan"}, "--wavelengths: must be a number (got 'nan')"},
        {{"spectrum", stack, "-w", ""}, "--wavelengths: must not be empty"},
        {{"spectrum", stack, "-w", "400:500"}, "--wavelengths: must be start:stop:step or"},
        {{"spectrum", stack, "-w", "400:500:0"}, "--wavelengths: the step must lead"},
        {{"spectrum", stack, "-w", "400:500:-1"}, "--wavelengths: the step must lead"},
        {{"spectrum", stack, "-w", "400:500/0"},
         "--wavelengths: the count after '/' must be a whole number"},
        {{"spectrum", stack, "-w", "1:1e7:1e-3"}, "--wavelengths: must have at most 10000000"},
        {{"spectrum", stack, "-a", "90.0001"}, "--angles: must be in [0, 90] (got 90.0001)"},
        {{"spectrum", stack, "-a", "-1"}, "--angles: must be in [0, 90] (got -1)"},
        {{"spectrum", stack, "-p", "x"}, "--polarization: must be s, p, u"},
        {{"spectrum", stack, "-p", "s,"}, "--polarization: must be s, p, u"},
        {{"spectrum", stack, "-f", "xml"},
         "--format: must be one of csv, json, npy, pdf, png, svg (got 'xml')"},
        {{"spectrum", stack, "-o", "x.xml"},
         "--output: the extension must be one of csv, json, npy, pdf, png, svg (got 'xml')"},
        {{"spectrum", stack, "-o", "x"}, "--output: must have an extension"},
        {{"spectrum", stack, "-j", "0"}, "--threads: must be in [1, 4096] (got 0)"},
        {{"spectrum", stack, "-j", "1.5"}, "--threads: must be a single whole number"},
        {{"spectrum", stack, "--columns", "r_re"},
         "--columns: r_re is undefined for unpolarized light"},
        {{"spectrum", stack, "-p", "s,u", "--columns", "delta_deg"}, "use -p s,p"},
        {{"spectrum", stack, "--columns", "A_layer"},
         "(got 'A_layer') (did you mean \"A_layers\"?)"},
        {{"spectrum", stack, "--columns", "A_layers,A_layers"}, "A_layers twice"},
        {{"spectrum", stack, "--columns", "A_layers,"}, "--columns: must be one of"},
        {{"spectrum", "1 | (1.5@1 | 2@1)^501 | 1", "--columns", "A_layers"},
         "--columns: A_layers requires a stack of at most 1000 layers (got 1002"},
        {{"spectrum", stack, "--what"}, "--what"},
        {{"spectrum"}, "STACK"},
        {{"spectra", stack}, "unknown command 'spectra' (did you mean \"spectrum\"?)"},
        {{"spectrum", "no-such-file.json"},
         "no-such-file.json: cannot be read: No such file or directory"},
        {{"spectrum", "1 | TiO2-rutile@10 | 1"},
         "/layers/0/material: TiO2-rutile is known from 430 to 1530 nm (asked for 380)"},
        {{"spectrum", "1 | TiO2-rutile@10 | 1", "-w", "500", "--unit", "um"},
         "(asked for 5e+05); --wavelengths are in um"},
        {{"spectrum", "schemas/examples/scenes/vehicle.json"},
         "vehicle.json: is a scene; irido plan, bake and render read it"},
        {{"color", "schemas/examples/surfaces/haze.json"},
         "haze.json: is a surface; irido brdf, lut, render and scenes read it"},
        {{"color", stack, "--tolerance", "0,5"},
         "--tolerance: must be a single number (got '0,5'); the decimal mark is a point: 0.5"},
        {{"bake", "schemas/examples/soap-bubble.json", "-o", "/tmp"},
         "soap-bubble.json: is a stack; irido spectrum, color and scenes read it"},
        {{"plan", stack}, "is a stack; SCENE must be a file"},
        {{"sweep", "schemas/examples/scenes/vehicle.json", "--vary", "layers.0.thickness_nm=1,2",
          "--compute", "color"},
         "vehicle.json: is a scene"},
        {{"brdf", "schemas/examples/surfaces/worn-spoon.json", "--at", "1e300,0"},
         "--at: must be in [-1e+09, 1e+09] (got 1e+300)\n"},
        {{"spectrum", stack, "-o", "."}, "--output: must name a file, not a folder (got '.')"},
        {{"spectrum", "1 | gold@10 | Agg"}, "/substrate: "},
        {{"spectrum", "1+0.1i | 1"}, "/incident: "},
        {{"spectrum", "Au | 1"},
         "/incident: the incident medium must be transparent, |k| below 1e-3 (got n = "},
        {{"spectrum", stack, "-o", "/no/such/folder/x.csv"},
         "/no/such/folder/x.csv: cannot be written: No such file or directory"},
    };
    for (const auto& [arguments, error] : cases) {
        check_refused(run_irido(arguments), error);
    }
}

TEST_CASE("amplitudes of averaged powers are refused", "[cli][refused]") {
    for (const std::string layer : {R"("coherent": false)", R"("thickness_sigma_nm": 1)"}) {
        const Outcome outcome =
            run_irido({"spectrum", "-", "-p", "s", "--columns", "delta_deg"},
                      R"({"incident": 1, "layers": [{"material": 1.5, "thickness_nm": 9, )" +
                          layer + R"(}], "substrate": 1})");
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err,
                   StartsWith("irido: error: --columns: delta_deg requires coherent layers"));
    }
}

TEST_CASE("a failed request leaves an existing file as it was", "[cli][output]") {
    const TemporaryFolder folder;
    write_text(folder / "out.csv", "precious");
    CHECK(run_irido({"spectrum", "1 | 1.5@-1 | 1", "-o", folder / "out.csv"}).status == 2);
    CHECK(read_file(folder / "out.csv") == "precious");
    // a file size limit makes the write itself fail midway
    const Outcome limited = run_shell(
        "trap '' XFSZ; ulimit -f 8; \"$IRIDO\" spectrum '1 | 1.5@100 | 1' -w 400:700:0.1 -o "
        "out.csv",
        folder.path());
    CHECK(limited.status == 2);
    CHECK_THAT(limited.err, Contains("out.csv: cannot be written: File too large"));
    CHECK(read_file(folder / "out.csv") == "precious");
    CHECK(run_shell("ls -A | wc -l", folder.path()).out == "1\n");
    CHECK(run_irido({"spectrum", "1 | 1.5@1 | 1", "-o", folder / "out.csv"}).status == 0);
    CHECK_THAT(read_file(folder / "out.csv"), StartsWith("wavelength_nm,"));
    CHECK(run_shell("ls -A | wc -l", folder.path()).out == "1\n");
}

TEST_CASE("a closed pipe is quiet, a full device is not", "[cli][output]") {
    const Outcome closed = run_shell(
        "\"$IRIDO\" spectrum '1 | 1.5@100 | 1' -w 400:700:0.001 | head -n 1", IRIDO_SOURCE_DIR);
    CHECK(closed.out == "wavelength_nm,angle_deg,polarization,R,T,A\n");
    CHECK(closed.err.empty());
    const Outcome full =
        run_shell("\"$IRIDO\" spectrum '1 | 1.5@100 | 1' > /dev/full", IRIDO_SOURCE_DIR);
    CHECK(full.status == 2);
    CHECK_THAT(full.err, Contains("standard output: cannot be written: No space left"));
}

TEST_CASE("an interrupted program exits 130 and leaves nothing behind", "[cli][output]") {
    const TemporaryFolder folder;
    const Outcome stopped = run_shell(
        "timeout --preserve-status -s INT 0.3 \"$IRIDO\" spectrum '1 | (1.5@100 | 1.2@70)^9 | 1' "
        "-w 400:700:0.001 -a 0:80:2 -o out.csv",
        folder.path());
    CHECK(stopped.status == 130);
    CHECK(run_shell("ls -A | wc -l", folder.path()).out == "0\n");
}

TEST_CASE("a negative zero that is typed is printed as 0", "[cli][spectrum]") {
    const TemporaryFolder folder;
    write_text(folder / "points.csv", "layers.0.thickness_nm\n-0\n");
    CHECK_THAT(done({"spectrum", "1 | 1.5", "-w", "500", "-a", "-0"}).out, Contains("\n500,0,u,"));
    CHECK_THAT(done({"sweep", "1 | 2@1 | 1", "--points", folder / "points.csv", "--compute",
                     "spectrum", "-w", "500", "--vary", "angle_deg=-0.0"})
                   .out,
               Contains("\n0,0,500,u,"));
    CHECK(done({"convert", "1 | 1.5@-0 | 2", "-f", "expression"}).out == "1 | 1.5@0 | 2\n");
}

TEST_CASE("the incident medium is judged at the wavelengths asked for", "[spectrum]") {
    const Outcome taken = run_irido({"spectrum", "Si | air@100 | Si", "-w", "1090"});
    CHECK(taken.status == 0);
    CHECK(taken.err ==
          "irido: note: \"Si | air@100 | Si\": /incident: the incident medium is taken as "
          "transparent: its k of up to 4.0768e-05 is ignored\n");
    check_refused(run_irido({"spectrum", "Si | air@100 | Si", "-w", "550"}),
                  "k = 0.027968 at 550 nm");
}
