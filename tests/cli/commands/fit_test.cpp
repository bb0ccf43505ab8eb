#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "tests/support/program.hpp"

using namespace irido::test;

namespace {

/// A table of the program's own output with reproducible noise.
std::string measured(const std::string& stack, const std::string& angles, double noise) {
    const Outcome outcome = done({"spectrum", stack, "-w", "400:800:10", "-a", angles, "-p", "s",
                                  "--columns", "psi_deg,delta_deg"});
    const auto rows = parse_csv(outcome.out);
    std::string text = "wavelength_nm,angle_deg,psi_deg,delta_deg\n";
    double phase = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double psi = std::stod(rows[i][6]) + noise * std::sin(phase += 7.3);
        const double delta = std::stod(rows[i][7]) + 5 * noise * std::sin(phase += 3.1);
        text += rows[i][0] + "," + rows[i][1] + "," + irido::to_text(psi) + "," +
                irido::to_text(delta) + "\n";
    }
    return text;
}

std::string oxide_task(const std::string& more) {
    return R"({ "stack": { "incident": 1, "layers": [{ "material": { "cauchy": [1.45, 0.0035] },
        "thickness_nm": 135 }], "substrate": { "n": 3.88, "k": 0.02 } },
        "free": [{ "path": "layers.0.thickness_nm", "bounds": [20, 250], "name": "thickness_nm" },
                 { "path": "layers.0.material.cauchy.0", "bounds": [1.35, 1.6], "name": "A" },
                 { "path": "layers.0.material.cauchy.1", "bounds": [0, 0.02], "name": "B" }],
        "targets": [{ "quantity": "psi_deg", "file": "data.csv", "sigma": 0.02 },
                    { "quantity": "delta_deg", "file": "data.csv", "sigma": 0.1 }])" +
           more + " }";
}

}  // namespace

TEST_CASE("a fit finds thickness and dispersion, and how well they are known", "[cli][fit]") {
    TemporaryFolder folder;
    write_text(folder / "truth.json", R"({ "incident": 1, "layers": [
        { "material": { "cauchy": [1.4478, 0.0038] }, "thickness_nm": 103.7 }],
        "substrate": { "n": 3.88, "k": 0.02 } })");
    write_text(folder / "data.csv", measured(folder / "truth.json", "65,70,75", 0.02));
    write_text(folder / "task.json", oxide_task(""));
    const Outcome outcome =
        done({"fit", "task.json", "--correlation", "-o", "fitted.json", "--plot", "residuals.svg"},
             "", folder.path());
    const auto rows = parse_csv(outcome.out);
    REQUIRE(rows.size() == 6);
    CHECK(rows[0] == std::vector<std::string>{"parameter", "value", "stderr",
                                              "correlation_thickness_nm", "correlation_A",
                                              "correlation_B"});
    const std::vector<double> truth{103.7, 1.4478, 0.0038};
    for (std::size_t i = 0; i < 3; ++i) {
        const double value = std::stod(rows[i + 1][1]), error = std::stod(rows[i + 1][2]);
        CHECK(error > 0);
        CHECK(std::abs(value - truth[i]) < 4 * error);
        CHECK(std::stod(rows[i + 1][3 + i]) == 1);
    }
    CHECK(std::stod(rows[2][5]) == Approx(std::stod(rows[3][4])).epsilon(1e-9));
    CHECK(rows[4][0] == "chi2");
    CHECK(rows[4][2].empty());
    CHECK(rows[5][1] == "243");
    CHECK(outcome.err.find("the next-best minimum") != std::string::npos);
    CHECK(run_irido({"validate", "fitted.json"}, "", folder.path()).status == 0);
}

TEST_CASE("standard errors follow from the stated noise", "[cli][fit]") {
    TemporaryFolder folder;
    // R = r^2 of a single face depends only on n: dR/dn and sigma give the error analytically
    write_text(folder / "data.csv", "wavelength (nm), R (%)\n500, 4.1\n600, 3.9\n700, 4.05\n");
    write_text(folder / "task.json", R"({ "stack": { "incident": 1, "layers": [],
        "substrate": { "n": 1.6 } }, "free": [{ "path": "substrate.n", "name": "n" }],
        "targets": [{ "quantity": "R", "file": "data.csv", "sigma": 0.001 }] })");
    const Outcome outcome = done({"fit", "task.json", "--quiet"}, "", folder.path());
    const auto rows = parse_csv(outcome.out);
    const double r = std::sqrt((0.041 + 0.039 + 0.0405) / 3), n = (1 + r) / (1 - r);
    CHECK(std::stod(rows[1][1]) == Approx(n).epsilon(1e-9));
    const double slope = 2 * r * 2 / std::pow(n + 1, 2);
    CHECK(std::stod(rows[1][2]) == Approx(0.001 / slope / std::sqrt(3)).epsilon(1e-6));
    CHECK(std::stod(rows[3][1]) == 2);
}

TEST_CASE("percentages without a percent sign are not taken as fractions", "[cli][fit]") {
    TemporaryFolder folder;
    write_text(folder / "task.json", R"({ "stack": { "incident": 1, "layers": [],
        "substrate": { "n": 1.6 } }, "free": [{ "path": "substrate.n", "name": "n" }],
        "targets": [{ "quantity": "R", "file": "data.csv", "sigma": 0.001 }] })");
    const auto fit = [&](const std::string& data) {
        write_text(folder / "data.csv", data);
        return run_irido({"fit", "task.json", "--quiet"}, "", folder.path());
    };
    check_refused(fit("wavelength_nm,R\n500,0.9\n600,12.3\n"),
                  "data.csv: 3:5: R must be a fraction in [-0.02, 1.02] (got 12.3); name the "
                  "column \"R [%]\"");
    const Outcome percent = fit("wavelength_nm,R [%]\n500,4.1\n600,3.9\n");
    CHECK(percent.status == 0);
    const auto index = [](const Outcome& of) { return std::stod(parse_csv(of.out)[1][1]); };
    CHECK(index(percent) ==
          Approx(index(fit("wavelength_nm,R\n500,0.041\n600,0.039\n"))).epsilon(1e-9));
    CHECK(percent.out == fit("wavelength_nm,R_percent\n500,4.1\n600,3.9\n").out);
    CHECK(fit("wavelength_nm,R_fraction\n500,1.5\n600,1.5\n").status == 0);
    const Outcome design = run_irido({"design", "1 | 1.38@100 | 1.5", "--free",
                                      "layers.0.thickness_nm=50:150", "--target", "R 500 = 50"},
                                     "", folder.path());
    CHECK(design.err.find("R, T and A are fractions; the target is 50") != std::string::npos);
    check_refused(run_irido({"fit", "1 | 1.38@100 | 1.5", "--free", "layers.0.thickness_nm=50:150",
                             "--target", "R 500 = 1e308"}),
                  "/targets/0/target: must be in [-1e100, 1e100] (got 1e+308)");
}

TEST_CASE("measured tables that contradict themselves or the physics are refused", "[cli][fit]") {
    TemporaryFolder folder;
    const auto fit = [&](const std::string& quantity, const std::string& data,
                         const std::string& more = "") {
        write_text(folder / "task.json",
                   R"({ "stack": "1 | 1.5@100 | 3.88+0.02i",
                   "free": [{ "path": "layers.0.thickness_nm", "bounds": [50, 150] }],
                   "targets": [{ "quantity": ")" +
                       quantity + R"(", "file": "data.csv", "sigma": 0.01, "angle_deg": 0)" + more +
                       "}] }");
        write_text(folder / "data.csv", data);
        return run_irido({"fit", "task.json", "--quiet"}, "", folder.path());
    };
    const auto refuse = [&](const std::string& quantity, const std::string& data,
                            const std::string& error) {
        check_refused(fit(quantity, data), error);
    };
    refuse("R", "nm,R\n500,-0.5\n",
           "data.csv: 2:5: R must be a fraction in [-0.02, 1.02] (got -0.5)\n");
    refuse("T", "nm,T [%]\n500,-50\n", "2:5: T [%] must be in [-20, 150] (got -50)");
    refuse("T", "nm,T_fraction\n500,1.6\n", "2:5: T_fraction must be in [-0.2, 1.5] (got 1.6)");
    refuse("psi_deg", "nm,psi_deg\n500,250\n", "psi_deg must be in [-1, 91] (got 250)");
    CHECK(fit("R", "nm,R\n500,-0.015\n600,1.015\n").status == 0);  // noise
    refuse("R", "nm,R [%] fraction\n500,4\n",
           "data.csv: the column 'R [%] fraction' states both percent and fraction");
    refuse("psi_deg", "nm,psi_deg [rad]\n500,0.5\n",
           "the column 'psi_deg [rad]' states both degrees and radians");
    refuse("R", "nm,R,R\n500,0.1,0.2\n", "has two columns for one purpose, 'R' and 'R'");
    refuse("R", "nm,R_s,R_p\n500,0.1,0.2\n",
           "has two columns for one purpose, 'R_s' and 'R_p'; \"column\" of a target names one");
    CHECK(fit("R", "nm,R_s,R_p\n500,0.1,0.2\n", R"(, "column": "R_p")").status == 0);
    refuse("R", "nm,R,sigma_R,R_error\n500,0.1,0.01,0.02\n", "'sigma_R' and 'R_error'");
    refuse("R", "nm,nm,R\n500,600,0.1\n", "'nm' and 'nm'");
    refuse("R", "nm,aoi,angle_deg,R\n500,0,10,0.1\n", "'aoi' and 'angle_deg'");
    CHECK(fit("R", "nm,energy_eV,R\n500,2.48,0.1\n").status == 0);
}

TEST_CASE("angles of a table may be in radians", "[cli][fit]") {
    TemporaryFolder folder;
    write_text(folder / "task.json", R"({ "stack": "1 | 1.5@100 | 3.88+0.02i",
        "free": [{ "path": "layers.0.thickness_nm", "bounds": [50, 150], "name": "d" }],
        "targets": [{ "quantity": "psi_deg", "file": "data.csv", "sigma": 0.01 }] })");
    const auto thickness = [&](const std::string& data) {
        write_text(folder / "data.csv", data);
        return std::stod(
            parse_csv(done({"fit", "task.json", "--quiet"}, "", folder.path()).out)[1][1]);
    };
    CHECK(thickness("nm,angle (rad),psi (rad)\n500,1.2217304763960306,0.5235987755982989\n") ==
          Approx(thickness("nm,angle_deg,psi_deg\n500,70,30\n")).epsilon(1e-9));
}

TEST_CASE("the output - of a fit is the stack instead of the table", "[cli][fit]") {
    TemporaryFolder folder;
    write_text(folder / "data.csv", "wavelength_nm,R\n500,0.02\n600,0.03\n");
    const std::vector<std::string> ask{"fit",      "1 | 1.38@100 | 1.5",
                                       "--free",   "layers.0.thickness_nm=50:150",
                                       "--target", "R 500,600 = 0.02"};
    std::vector<std::string> printed = ask, written = ask;
    printed.insert(printed.end(), {"-o", "-"});
    written.insert(written.end(), {"-o", "stack.json"});
    const Outcome dash = run_irido(printed, "", folder.path());
    INFO(dash.err);
    CHECK(dash.status == 0);
    CHECK(run_irido(written, "", folder.path()).out == run_irido(ask, "", folder.path()).out);
    CHECK(dash.out == read_file(folder / "stack.json"));
    CHECK(run_shell("ls", folder.path()).out == "data.csv\nstack.json\n");
}

TEST_CASE("what the data do not tell is said", "[cli][fit]") {
    TemporaryFolder folder;
    write_text(folder / "data.csv", "wavelength_nm,R\n500,0.04\n600,0.04\n");
    write_text(folder / "task.json", R"({ "stack": "1 | 1.5@100 | 1.5@50 | 1.5",
        "free": [{ "path": "layers.*.thickness_nm", "bounds": [0, 300] }],
        "targets": [{ "quantity": "R", "file": "data.csv" }] })");
    const Outcome outcome = done({"fit", "task.json"}, "", folder.path());
    CHECK(outcome.out.find("nan") == std::string::npos);
    CHECK(outcome.out.find("inf") == std::string::npos);
    CHECK(outcome.err.find("the data do not determine layers.0.thickness_nm") != std::string::npos);
    CHECK(outcome.err.find("no target states its noise") != std::string::npos);
}

TEST_CASE("tables without units or with gaps are refused", "[cli][fit]") {
    TemporaryFolder folder;
    const auto refuse = [&](const std::string& data, const std::string& error) {
        write_text(folder / "data.csv", data);
        write_text(folder / "task.json", oxide_task(""));
        check_refused(run_irido({"fit", "task.json"}, "", folder.path()), error);
    };
    refuse("500,70,30\n600,70,31\n", "must have a heading");
    refuse("wavelength,angle_deg,psi_deg,delta_deg\n500,70,30,100\n", "must name its unit");
    refuse("wavelength_nm,angle_deg,psi_deg,delta_deg\n500,70,nan,100\n", "data.csv");
    refuse("wavelength_nm,angle_deg,psi_deg\n500,70,30\n", "has no column delta_deg");
    refuse("wavelength_nm,angle_deg,psi_deg,delta_deg\n500,95,30,100\n", "[0, 90) degrees");
    refuse("wavelength_nm,angle_deg,psi_deg,delta_deg\n0.5,70,30,100\n", "[1, 1e+07]");
}
