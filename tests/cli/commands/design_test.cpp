#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

using namespace irido::test;
using nlohmann::json;

namespace {

const std::string kCoating = "1 | 1.45@96.1 | 2.35@115.7 | 1.45@49.5 | 2.35@24.6 | 1.52";

json designed(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"design"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = done(arguments);
    return json::parse(outcome.out);
}

/// Root mean square of the values that the spectrum command prints.
double rms_of_spectrum(const std::string& stack, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"spectrum", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = done(arguments, stack);
    const auto rows = parse_csv(outcome.out);
    double sum = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) sum += std::pow(std::stod(rows[i][3]), 2);
    return std::sqrt(sum / static_cast<double>(rows.size() - 1));
}

}  // namespace

TEST_CASE("a design is a stack that is as good as it says", "[cli][design]") {
    const json result =
        designed({kCoating, "--method", "refine", "--free", "layers.*.thickness_nm=0:250",
                  "--target", "R 400:700:5 @0,45 = 0"});
    const double merit = result["design"]["merit"].get<double>();
    CHECK(merit < result["design"]["start_merit"].get<double>());
    const double printed = rms_of_spectrum(result.dump(), {"-w", "400:700:5", "-a", "0,45"});
    CHECK(std::abs(printed - merit) < 1e-14);
    for (const json& layer : result["layers"]) {
        CHECK(layer["thickness_nm"].get<double>() >= 0);
        CHECK(layer["thickness_nm"].get<double>() <= 250);
    }
    CHECK(result["design"]["sensitivity"].size() == 4);
    for (const json& one : result["design"]["sensitivity"])
        CHECK(one["merit_1_percent_more"].get<double>() >= merit * (1 - 1e-9));
}

TEST_CASE("a global design depends on its seed and evaluations, not on the threads",
          "[cli][design]") {
    const std::vector<std::string> task{
        kCoating,   "--method",         "global",        "--free", "layers.*.thickness_nm=0:250",
        "--target", "R 450:650:10 = 0", "--evaluations", "4000"};
    const auto run = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"design"};
        arguments.insert(arguments.end(), task.begin(), task.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_irido(arguments).out;
    };
    const std::string first = run({"-j", "1"});
    CHECK(first == run({"-j", "3"}));
    const json result = json::parse(first);
    CHECK(result["design"]["seed"] == 1);
    CHECK(result["design"]["runs"] == 8);
    CHECK(result["design"]["reproducibility"].get<int>() >= 1);
    CHECK(json::parse(run({"--seed", "2"}))["design"]["merit"].get<double>() <
          1.5 * result["design"]["merit"].get<double>());
}

TEST_CASE("links move together, fixed values stay", "[cli][design]") {
    TemporaryFolder folder;
    write_text(folder / "task.json", R"({
        "stack": "1 | 1.45@90 | 2.35@50 | 1.45@70 | 2.35@50 | 1.52",
        "free": [{ "path": "layers.0.thickness_nm", "bounds": [0, 200], "link": "low" },
                 { "path": "layers.2.thickness_nm", "bounds": [10, 300], "link": "low" },
                 { "path": "layers.1.material.n", "bounds": [2, 2.5], "name": "index" }],
        "targets": [{ "quantity": "R", "wavelengths_nm": [450, 550, 650], "target": 0.1 }] })");
    const Outcome outcome = done(
        {"design", "task.json", "-o", "out.json", "--report", "report.csv", "--plot", "plot.svg"},
        "", folder.path());
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("to which it is linked") != std::string::npos);
    const json result = json::parse(read_file(folder / "out.json"));
    CHECK(result["layers"][0]["thickness_nm"] == result["layers"][2]["thickness_nm"]);
    CHECK(result["layers"][1]["thickness_nm"] == 50);
    CHECK(result["layers"][3]["material"] == 2.35);
    const double n = result["layers"][1]["material"]["n"].get<double>();
    CHECK((n >= 2 && n <= 2.5));
    const auto report = parse_csv(read_file(folder / "report.csv"));
    CHECK(report[0] == std::vector<std::string>{"target", "quantity", "angle_deg", "polarization",
                                                "wavelength_nm", "value", "target_value",
                                                "difference", "weight", "met"});
    CHECK(report.size() == 4);
    CHECK(read_file(folder / "plot.svg").find("<svg") != std::string::npos);
    // refining the result starts from where it is
    const json again =
        json::parse(run_irido({"design", "--refine", "out.json", "--free",
                               "layers.*.thickness_nm=0:300", "--target", "R 450:650:100 = 0.1"},
                              "", folder.path())
                        .out);
    CHECK(again["design"]["start_merit"].get<double>() ==
          Approx(result["design"]["merit"].get<double>()).epsilon(1e-12));
    CHECK(run_irido({"validate", "task.json", "out.json"}, "", folder.path()).status == 0);
}

TEST_CASE("colours are targets, as numbers and as hex", "[cli][design]") {
    const json lab = designed({"1 | 2.45@60 | 2.6+3.6i", "--method", "global", "--free",
                               "layers.0.thickness_nm=5:100", "--target", "lab @0 = 40,30,-45",
                               "--merit", "delta_e_2000"});
    CHECK(lab["design"]["merit"].get<double>() < lab["design"]["start_merit"].get<double>());
    const Outcome far = run_irido({"design", "1 | 1.5@60 | 1.4", "--free",
                                   "layers.0.thickness_nm=5:100", "--target", "lab = 90,0,0"});
    CHECK(far.status == 0);
    CHECK(far.err.find("the colour at 0 degrees was not reached") != std::string::npos);
    // the colour that irido prints for a stack leads back to that stack
    const auto printed = parse_csv(run_irido({"color", "1 | 2.45@31 | 2.6+3.6i", "-a", "0"}).out);
    std::string hex;
    for (std::size_t c = 0; c < printed[0].size(); ++c)
        if (printed[0][c] == "hex") hex = printed[1][c];
    const json back = designed({"1 | 2.45@40 | 2.6+3.6i", "--method", "global", "--free",
                                "layers.0.thickness_nm=5:100", "--target", "hex = " + hex,
                                "--merit", "delta_e_76"});
    CHECK(back["design"]["merit"].get<double>() < 0.6);  // 8-bit colour
    CHECK(back["layers"][0]["thickness_nm"].get<double>() == Approx(31).margin(0.3));
}

TEST_CASE("tasks that cannot be are refused in one line", "[cli][design]") {
    const std::vector<std::string> free{"--free", "layers.*.thickness_nm=0:250"};
    const auto refuse = [&](std::vector<std::string> more, const std::string& error) {
        std::vector<std::string> arguments{"design"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        check_refused(run_irido(arguments), error);
    };
    refuse({kCoating, "--target", "R 500 = 0"}, "must have the key \"free\", or come with --free");
    refuse({kCoating, "--free", "layers.*.thickness_nm"},
           "must have the key \"targets\", or come with --target");
    refuse({kCoating, "--free", "layers.9.thickness_nm=0:1", "--target", "R 500 = 0"},
           "/free/0/path: matches no number in the stack");
    refuse({kCoating, "--free", "layers.0.thickness_nm=9:1", "--target", "R 500 = 0"},
           "/free/0/bounds: the first must not be above the second");
    refuse({kCoating, "--free", "layers.0.thickness_nm=-9:1", "--target", "R 500 = 0"},
           "/free/0/bounds: must be in [0, 1e+09]");
    refuse({kCoating, "--free", "layers.0.thickness_nm", "--free", "layers.0.thickness_nm",
            "--target", "R 500 = 0"},
           "is already free");
    refuse({kCoating, "--free", "layers.0.thickness_nm", "--method", "global", "--target",
            "R 500 = 0"},
           "method global requires bounds");
    refuse({kCoating, free[0], free[1], "--target", "R 500"}, "must be QUANTITY");
    refuse({kCoating, free[0], free[1], "--target", "Q 500 = 1"},
           "/targets/0/quantity: must be one of R, T, A");
    refuse({kCoating, free[0], free[1], "--target", "phase_r_deg 500 = 1"},
           "unpolarized light has no phase");
    refuse({kCoating, free[0], free[1], "--target", "hex = #12345"},
           "/targets/0/target: must be #rrggbb");
    refuse({"1 | SiO2@100 | Si", free[0], free[1], "--target", "R 100:200:50 = 1"},
           "/targets/0/wavelengths_nm");
    refuse({"design.json"}, "design.json");
    const Outcome contradiction = run_irido(
        {"design", kCoating, free[0], free[1], "--target", "R 500 = 0", "--target", "R 500 = 1"});
    CHECK(contradiction.status == 0);
    CHECK(contradiction.err.find("contradict each other at 500 nm") != std::string::npos);
}

TEST_CASE("a search that is interrupted writes its best", "[cli][design][slow]") {
    TemporaryFolder folder;
    std::string layers;
    for (int i = 0; i < 16; ++i) layers += "1.45@94 | 2.35@58 | ";
    const Outcome outcome = run_shell(
        "\"$IRIDO\" design \"1 | " + layers +
            "1.52\" --method global --free 'layers.*.thickness_nm=0:250' --target "
            "'R 500:580:2 = 1' --target 'R 600:700:2 = 0' "
            "--time 60 --evaluations 1000000000 -o best.json & pid=$!; sleep 1; kill -TERM $pid; "
            "wait $pid; echo $?",
        folder.path());
    CHECK(outcome.out == "143\n");
    const json result = json::parse(read_file(folder / "best.json"));
    CHECK(result["design"]["end"] == "stopped");
    CHECK(result["design"]["merit"].get<double>() < result["design"]["start_merit"].get<double>());
}

TEST_CASE("shards are other runs, and the best of them is kept", "[cli][design]") {
    TemporaryFolder folder;
    const auto shard = [&](const std::string& which, const std::string& file) {
        return run_irido({"design", kCoating, "--method", "global", "--free",
                          "layers.*.thickness_nm=0:250", "--target", "R 450:650:10 = 0",
                          "--evaluations", "2000", "--shard", which, "-o", file},
                         "", folder.path())
            .status;
    };
    REQUIRE(shard("1/2", "one.json") == 0);
    REQUIRE(shard("2/2", "two.json") == 0);
    const json one = json::parse(read_file(folder / "one.json")),
               two = json::parse(read_file(folder / "two.json"));
    CHECK(one["design"]["best_of_runs"] != two["design"]["best_of_runs"]);
    const Outcome merged =
        run_irido({"design", "--merge", "one.json", "two.json"}, "", folder.path());
    INFO(merged.err);
    REQUIRE(merged.status == 0);
    const json best = json::parse(merged.out);
    CHECK(best["design"]["merit"].get<double>() ==
          std::min(one["design"]["merit"].get<double>(), two["design"]["merit"].get<double>()));
    CHECK(best["design"]["runs"] == 16);
    check_refused(run_irido({"design", "--merge", "schemas/examples/soap-bubble.json"}),
                  "must be the result of a search");
    for (const char* const design :
         {R"({"merit": "x", "best_of_runs": [1]})", R"({"merit": 1, "best_of_runs": ["x"]})",
          R"({"merit": 1, "best_of_runs": [1], "runs": "x"})", "5"}) {
        INFO(design);
        write_text(folder / "odd.json", std::string(R"({"design": )") + design + "}");
        check_refused(run_irido({"design", "--merge", folder / "odd.json"}),
                      "odd.json: /design: must be the result of a search");
    }
    check_refused(run_irido({"design", kCoating, "--free", "layers.0.thickness_nm=1:900",
                             "--target", "R 500 = 0", "--report", "-"}),
                  "--report: must have an extension");
}

TEST_CASE("a file name's extension says what a design or a fit can write there",
          "[cli][design][refused]") {
    const TemporaryFolder folder;
    write_text(folder / "mine.csv", "kept");
    for (const Words& command : {Words{"design", kCoating, "--free", "layers.0.thickness_nm=1:900",
                                       "--target", "R 500 = 0"},
                                 Words{"fit", "schemas/examples/designs/oxide-fit.json"}}) {
        check_refused(run_irido(command + Words{"-o", folder / "mine.csv"}),
                      "--output: a stack is written as .json (got '" + folder / "mine.csv'");
        check_refused(run_irido(command + Words{"--report", folder / "report.txt"}),
                      "--report: the extension must be one of csv, json");
    }
    CHECK(read_file(folder / "mine.csv") == "kept");
}
