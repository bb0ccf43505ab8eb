#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

const json kScratch{
    {"width_um", 2.0}, {"depth_um", 0.14}, {"angle_deg", 30.0}, {"point_um", {10.0, -5.0}}};
const std::string kSphere = R"({"center_mm":[-303.3,-128.2,944.2],"radius_mm":60})";

json vertical(const json& scratch) {
    return {{"depth_phase", "vertical"}, {"scratches", {scratch}}};
}

/// Rows printed by brdf for a document on standard input.
std::vector<std::vector<std::string>> rows_of(const json& document,
                                              std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"brdf", "-"});
    const Outcome outcome = done(arguments, document.dump());
    return parse_csv(outcome.out);
}

void check_close(const std::string& text, double exact, double relative) {
    CHECK(std::abs(std::stod(text) / exact - 1) < relative);
}

const std::vector<std::string> kPair{"--light-theta", "19.704", "--light-phi", "206.496",
                                     "--view-theta",  "20",     "--view-phi",  "40"};

std::vector<std::string> with(std::vector<std::string> first, std::vector<std::string> more) {
    first.insert(first.end(), more.begin(), more.end());
    return first;
}

const std::string kSpoon = "schemas/examples/surfaces/worn-spoon.json";

}  // namespace

// Reference values: a 40-digit evaluation, rounded to double; colours: exact integrals.
TEST_CASE("brdf of a scratch has the values of a 40-digit evaluation", "[cli][brdf][scratch]") {
    const auto rows = rows_of(vertical(kScratch), with(kPair, {"-w", "450,550,650"}));
    REQUIRE(rows.size() == 4);
    CHECK(rows[0] == std::vector<std::string>{"light_theta_deg", "light_phi_deg", "view_theta_deg",
                                              "view_phi_deg", "wavelength_nm", "brdf_per_sr"});
    CHECK(rows[1][1] == "206.496");
    check_close(rows[1][5], 80.8220661071697, 1e-11);
    check_close(rows[2][5], 74.39398546375082, 1e-11);
    check_close(rows[3][5], 55.869563589819904, 1e-11);
    const auto color = rows_of(vertical(kScratch), with(kPair, {"--color", "--space", "xyz"}));
    CHECK(color[0].back() == "hex");
    const std::vector<double> xyz{65.42336721553863, 72.4667544571869, 87.2064058408174};
    for (std::size_t c = 0; c < 3; ++c)
        check_close(color[1][4 + c], xyz[c] * 3.141592653589793, 1e-10);
    const auto density =
        rows_of(vertical(kScratch), {"--quantity", "density", "--footprint", "150,80,20"});
    CHECK(density[0] == std::vector<std::string>{"x_um", "y_um", "density"});
    check_close(density[1][2], 0.012719706554316024, 1e-11);
    check_close(rows_of(vertical(kScratch), {"--quantity", "density"})[1][2], 0.018357019694517623,
                1e-11);
    const auto alone = rows_of(vertical(kScratch), with(kPair, {"-w", "550"}));
    const auto coherent = rows_of(vertical(kScratch), with(kPair, {"-w", "550", "--coherent"}));
    check_close(coherent[1][5], std::stod(alone[1][5]), 1e-12);
}

TEST_CASE("brdf of a scratch under area lights has the values of a 40-digit evaluation",
          "[cli][brdf][scratch]") {
    const std::vector<std::string> sphere{"--area-light", kSphere, "--view-theta", "20",
                                          "--view-phi",   "40",    "-w",           "450,550,650"};
    const auto exact = rows_of(vertical(kScratch), sphere);
    CHECK(exact[0] == std::vector<std::string>{"view_theta_deg", "view_phi_deg", "wavelength_nm",
                                               "radiance_ratio"});
    const std::vector<double> ratio{0.016671015090111742, 0.01967407608237355,
                                    0.018075927066806746};
    const std::vector<double> on_band{0.01667303597734873, 0.01967749166835642,
                                      0.018080278593172173};
    const auto band = rows_of(vertical(kScratch), with(sphere, {"--light-integral", "band"}));
    const auto gauss = rows_of(vertical(kScratch), with(sphere, {"--light-integral", "gauss/32"}));
    for (std::size_t i = 0; i < 3; ++i) {
        check_close(exact[1 + i][3], ratio[i], 1e-8);
        check_close(band[1 + i][3], on_band[i], 1e-10);
        check_close(gauss[1 + i][3], ratio[i], 1e-4);
    }
    json wide = kScratch;
    wide["width_um"] = 1.0;
    wide["angle_deg"] = 100.0;
    const std::string quad =
        R"({"vertices_mm":[[-300,-200,-80],[-320,100,-60],[-300,120,250],[-280,-180,260]]})";
    const auto polygon = rows_of(vertical(wide), {"--area-light", quad, "--view-theta", "55",
                                                  "--view-phi", "20", "-w", "450"});
    check_close(polygon[1][3], 0.014718458278368356, 1e-8);
    const auto color =
        rows_of(vertical(kScratch), {"--area-light", kSphere, "--view-theta", "20", "--view-phi",
                                     "40", "--light-integral", "band", "--color"});
    CHECK(color[0] == std::vector<std::string>{"view_theta_deg", "view_phi_deg", "X", "Y", "Z", "r",
                                               "g", "b", "hex"});
    check_close(color[1][2], 0.01771093295481027, 1e-9);
    check_close(color[1][3], 0.019305930860964205, 1e-9);
    check_close(color[1][4], 0.018300180568327586, 1e-9);
    // a file is equivalent to its text, and an array of one light to the light
    const TemporaryFolder folder;
    write_text(folder / "light.json", "[" + kSphere + "]");
    CHECK(rows_of(vertical(kScratch), {"--area-light", folder / "light.json", "--view-theta", "20",
                                       "--view-phi", "40", "-w", "450,550,650"}) == exact);
}

TEST_CASE("slanted depth follows the directions", "[cli][brdf][scratch]") {
    json slanted = vertical(kScratch);
    slanted.erase("depth_phase");
    const auto rows = rows_of(slanted, with(kPair, {"-w", "550"}));
    // sin^2 of the path D (cos theta_i + cos theta_o) instead of 2 D
    const double pi = 3.141592653589793;
    const double path = 0.14 * (std::cos(19.704 * pi / 180) + std::cos(20 * pi / 180));
    const double factor = std::pow(std::sin(pi * path / 0.55) / std::sin(pi * 0.28 / 0.55), 2);
    check_close(rows[1][5], 74.39398546375082 * factor, 1e-10);
}

TEST_CASE("the worn spoon is the same from run to run and on any number of threads",
          "[cli][brdf][scratch]") {
    const std::vector<std::string> asked{
        "brdf",         kSpoon,  "--light-theta", "19.7", "--light-phi", "206.5",
        "--view-theta", "20,30", "--view-phi",    "40",   "-w",          "450,550"};
    const Outcome one = run_irido(with(asked, {"-j", "1"}));
    CHECK(one.status == 0);
    CHECK(one.out == run_irido(with(asked, {"-j", "3"})).out);
    const Outcome other = run_irido(with(asked, {"--set", "seed=2"}));
    CHECK(other.status == 0);
    CHECK(other.out != one.out);
    CHECK(run_irido({"validate", kSpoon}).out == kSpoon + ": ok\n");
    CHECK(run_irido(with(asked, {"--coherent", "--energy", "blend"})).status == 0);
    const Outcome mean = run_irido(with(asked, {"--ensemble"}));
    CHECK(mean.status == 0);
    CHECK(mean.err.empty());
    const Outcome density =
        run_irido({"brdf", kSpoon, "--quantity", "density", "--ensemble", "--quiet"});
    check_close(parse_csv(density.out)[1][2], 40e-6 * 1600 * 3.4, 1e-12);
}

TEST_CASE("brdf of scratches refuses what it cannot do", "[cli][brdf][scratch]") {
    const auto refused = [](const json& document, std::vector<std::string> arguments,
                            const std::string& error) {
        arguments.insert(arguments.begin(), {"brdf", "-"});
        check_refused(run_irido(arguments, document.dump()), error);
    };
    const auto changed = [](const std::string& pointer, const json& value) {
        json document = vertical(kScratch);
        document["fields"] = {
            {{"count_per_mm2", 1}, {"length_um", 10}, {"width_um", {1, 2}}, {"depth_um", 0.1}}};
        document[json::json_pointer(pointer)] = value;
        return document;
    };
    refused(changed("/scratches/0/width_um", 0), {}, "/scratches/0/width_um: must be in (0, 100]");
    refused(changed("/scratches/0/depth_um", -1), {}, "/scratches/0/depth_um: must be in [0, 100]");
    refused(changed("/scratches/0/start_um", 1), {}, "/scratches/0");
    refused(changed("/fields/0/length_um", {3, 2}), {}, "/fields/0");
    refused(changed("/fields/0/angle_deg", {0, 400}), {}, "/fields/0/angle_deg/1");
    refused(changed("/coherence_radius_um", 0), {}, "/coherence_radius_um: must be in (0, 1e4]");
    refused(changed("/depth_phase", "flat"), {}, "/depth_phase: must be one of");
    refused(changed("/seed", 1.5), {}, "/seed");
    refused(changed("/base", "1 | 2"), {"--alpha", "0.1"}, "--alpha");
    refused(changed("/base", "1 | 2@-3 | 2"), {}, "/base");
    refused(changed("/alpha", 0.1), {"--set", "base=null"}, "/base");
    refused(changed("/widths", 1), {}, "widths");
    const json plain = vertical(kScratch);
    refused(plain, {"--footprint", "1,2"}, "--footprint: must be A1,A2,ANGLE");
    refused(plain, {"--footprint", "0,2,3"}, "--footprint: a1_um");
    refused(plain, {"--at", "1"}, "--at: must be X,Y");
    refused(plain, {"--light-integral", "band"}, "--light-integral: requires --area-light");
    refused(plain, {"--area-light", kSphere, "--light-integral", "gauss/0"}, "--light-integral");
    refused(plain, {"--area-light", kSphere, "--light-theta", "3"}, "--area-light");
    refused(plain, {"--area-light", kSphere, "--coherent"}, "added one by one");
    refused(plain, {"--area-light", R"({"center_mm":[0,0,1],"radius_mm":2})"}, "radius_mm");
    refused(plain, {"--area-light", R"({"center_mm":[0,0,1]})"}, "radius_mm");
    refused(plain, {"--area-light", R"({"vertice_mm":[[0,0,1]]})"},
            "light: /vertice_mm: unknown key (did you mean \"vertices_mm\"?)");
    refused(plain, {"--area-light", "no-such-file.json"}, "no-such-file.json");
    refused(plain, {"--ensemble"}, "--ensemble: requires fields");
    refused(plain, {"--energy", "half"}, "--energy: must be one of");
    refused(plain, {"--quantity", "albedo"}, "--quantity");
    refused(plain, {"--paths", "all"}, "--paths");
    check_refused(run_irido({"brdf", "1 | 1.5@100 | 2", "--alpha", "0.1", "--at", "1,1"}), "--at");
}

TEST_CASE("colours of scratches say that materials of the base are clamped",
          "[cli][brdf][scratch]") {
    json document = vertical(kScratch);
    document["base"] = {{"incident", 1},
                        {"layers", json::array()},
                        {"substrate", {{"table", {{390, 2, 0}, {720, 2.1, 0}}}}}};
    const std::string known = "/base: /substrate is known from 390 to 720 nm; clamped";
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"brdf", "-", "--color"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_irido(arguments, document.dump());
    };
    for (const std::vector<std::string>& light :
         {std::vector<std::string>{}, {"--area-light", kSphere}}) {
        const Outcome noted = run(light);
        CHECK(noted.status == 0);
        CHECK_THAT(noted.err, Contains(known));
        std::vector<std::string> strict = light;
        strict.emplace_back("--strict");
        check_refused(run(strict), known);
    }
    document["base"]["substrate"] = {{"table", {{450, 2, 0}, {720, 2.1, 0}}}};
    check_refused(run({}), "a colour needs data from 400 to 700 nm");
}

TEST_CASE("scratches that the model does not suit are noted", "[cli][brdf][scratch]") {
    json document = vertical(kScratch);
    document["scratches"][0]["width_um"] = 13;
    document["scratches"].push_back(kScratch);
    document["scratches"][1]["depth_um"] = 3;
    document["scratches"][1]["start_um"] = -50;
    document["scratches"][1]["end_um"] = 50;
    const Outcome outcome =
        run_irido({"brdf", "-", "-w", "550", "--area-light", kSphere, "--light-integral", "band"},
                  document.dump());
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.err, Contains("/scratches/0: width 13 um exceeds a fifth"));
    CHECK_THAT(outcome.err, Contains("/scratches/1: depth 3 um exceeds the width"));
    CHECK_THAT(outcome.err, Contains("ends of scratches"));
}
