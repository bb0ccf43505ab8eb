#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

using namespace irido::test;
using nlohmann::json;

namespace {

json converted(const Words& arguments) {
    return json::parse(done(Words{"convert"} + arguments).out);
}

/// Reflectances of a stack, by row.
std::vector<double> reflectance_of(const Words& stack) {
    const auto rows = parse_csv(
        done(Words{"spectrum"} + stack + Words{"-w", "400,470,550,633,700", "-a", "0,40"}).out);
    std::vector<double> values;
    for (std::size_t row = 1; row < rows.size(); ++row) values.push_back(std::stod(rows[row][3]));
    return values;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

bool has_line(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

const std::string kCoatings =
    "! synthetic\n"
    "MATE HIGH\n0.40 2.40 -0.0010\n0.55 2.30 0.0\n0.80 2.25 0.0\n\n"
    "MATE LOW\n0.55 1.46 0.0\n\n"
    "MATE METAL\n0.55 0.9 -6.0\n\n"
    "COAT TWO\nHIGH 0.25\nLOW 0.0945 1\n\n"
    "COAT ONE\nLOW 0.1 1 0\nMETAL 1 1\n\n"
    "COAT LOOP\nLOW 0.1 1 2\nCOAT TAPERED\nLOW 0.1 1 0 T1\nCOAT GLASS\nN-BK7 0.1 1\n\n"
    "TABLE T1\nANGL 0\nWAVE 0.55 0.04 0.04 0.96 0.96\nIDEAL I 0.5 0.5\n";

const std::string kProject =
    "Version: 1.1\nComment:\n\tany text:\nEnd\n"
    "Filter:\n\tDescription: synthetic\n\tSubstrate: FusedSilica 1000000.000000\n"
    "\tFrontMedium: void\n\tBackMedium: void\n\tCenterWavelength: 550.000000\n"
    "\tConsiderBackside: 0\n"
    "\tFrontLayer: Oxide 60.000000\n\tRefineThickness: 1\n\tAddNeedles: 0\n"
    "\tFrontLayer: SiO2 90.000000\n\tRefineThickness: 1\n\tAddNeedles: 0\n"
    "\tLayerDescription:\n"
    "\tBackLayer: SiO2 30.000000\n\tBackLayer: Oxide 40.000000\n"
    "End\nTarget:\n\tKind: Reflection\nend\n";

const std::string kOxide =
    "Description: synthetic\nKind: regular\nModel: table\nProperties:\n"
    "\t380.0\t2.40-0.01j\n\t600.0\t2.30\n\t800.0\t2.20\nEnd\n";

}  // namespace

TEST_CASE("COATING.DAT: k is negative there, the first layer lies outside, waves need a wavelength",
          "[cli][convert]") {
    const TemporaryFolder folder;
    const std::string file = folder / "COATING.DAT";
    write_text(file, kCoatings);
    const json two =
        converted({file, "--coating", "two", "--primary", "550", "--set", "substrate=1.52"});
    CHECK(two["incident"] == "air");
    CHECK(two["substrate"] == 1.52);
    REQUIRE(two["layers"].size() == 2);
    CHECK(two["layers"][0]["material"] == "HIGH");
    CHECK(two["layers"][0]["thickness_nm"].get<double>() == Approx(0.25 * 550 / 2.30));
    CHECK(two["layers"][1] == json({{"material", "LOW"}, {"thickness_nm", 94.5}}));
    CHECK(two["materials"]["LOW"] == json({{"name", "LOW"}, {"n", 1.46}}));
    CHECK(two["materials"]["HIGH"]["extrapolate"] == "clamp");
    CHECK(two["materials"]["HIGH"]["table"] ==
          json::parse("[[400, 2.4, 0.001], [550, 2.3, 0], [800, 2.25, 0]]"));
    // interpolated between its rows: 2.3 + (633 - 550)/250 (2.25 - 2.3)
    const json red = converted({file, "--coating", "TWO", "--primary", "633"});
    CHECK(red["layers"][0]["thickness_nm"].get<double>() == Approx(0.25 * 633 / 2.2834));
    const Outcome mirror = done({"convert", file, "--coating", "ONE", "--mirror"});
    const json metal = json::parse(mirror.out);
    CHECK(metal["substrate"] == "METAL");
    CHECK(metal["materials"]["METAL"] == json({{"name", "METAL"}, {"n", 0.9}, {"k", 6}}));
    CHECK(metal["layers"].size() == 1);
    CHECK(has_line(mirror.err, "TABLE T1 is left out"));
    CHECK(has_line(mirror.err, "IDEAL I is left out"));
    const Outcome plain = done({"convert", file, "--coating", "ONE"});
    CHECK(has_line(plain.err, "the media around the coating are not in the file: air and BK7"));
    CHECK(json::parse(plain.out)["substrate"] == "BK7");
    const json glass = converted({file, "--coating", "GLASS", "--material", "N-BK7=BK7"});
    CHECK(glass["layers"][0]["material"] == "N-BK7");
    const auto refused = [&](const Words& more, const std::string& error) {
        check_refused(run_irido(Words{"convert", file} + more), error);
    };
    refused({}, "has several coatings; choose one of TWO, ONE, LOOP, TAPERED, GLASS");
    refused({"--coating", "NONE"}, "has no COAT NONE");
    refused({"--coating", "TWO"}, "--primary NM gives the primary wavelength");
    refused({"--coating", "LOOP"}, "loops are not read");
    refused({"--coating", "TAPERED"}, "tapers are not read");
    refused({"--coating", "GLASS"}, "material N-BK7 has no MATE");
}

TEST_CASE("COATING.DAT is refused line by line", "[cli][convert]") {
    const TemporaryFolder folder;
    const std::string file = folder / "COATING.DAT";
    const auto refused = [&](const std::string& text, const std::string& error) {
        write_text(file, text);
        check_refused(run_irido({"convert", file}), error);
    };
    refused("", "has no COAT");
    refused("HIGH 0.25\n", "1:1: must be MATE, COAT");
    refused("MATE A\n0.5 2\nMATE A\n0.5 2\nCOAT C\n", "3:6: duplicate MATE A");
    refused("MATE A\n0.5 2 0\n0.5 2 0\nCOAT C\n", "3:1: wavelengths must ascend");
    refused("MATE A\n0.5 x 0\nCOAT C\n", "2:5: must be a number");
    refused("MATE A\nCOAT C\n", "MATE A has no rows");
    refused("MATE A\n0.5 2\nCOAT C\nA\n", "4:1: a layer must be material, thickness");
    refused("MATE A\n0.5 2\nCOAT C\nA -1 1\n", "4:3: the thickness must be 0 or more");
    refused("COAT\n", "COAT must be followed by a name");
}

TEST_CASE("a stack goes to COATING.DAT and back", "[cli][convert]") {
    const TemporaryFolder folder;
    const std::string file = folder / "COATING.DAT";
    const std::string stack = "air | (2.3+0.001i@60.1 | MgF2@94.2)^3 | TiO2@33.33 | BK7";
    const Outcome written = done({"convert", stack, "-o", file});
    for (const std::string loss :
         {"the incident medium air", "the substrate BK7", "groups (their layers are written out)",
          "the name 2.3+0.001i, which becomes N2_3_0_001i"})
        CHECK(has_line(written.err, "COATING.DAT cannot hold: " + loss));
    const std::string text = read_file(file);
    CHECK(has_line(text, "COAT IRIDO\nN2_3_0_001i 0.0601 1\nMgF2 0.0942 1\n"));
    CHECK(has_line(text, "MATE N2_3_0_001i\n0.55 2.3 -0.001\n"));
    const json back = converted({file});
    REQUIRE(back["layers"].size() == 7);
    CHECK(back["layers"][1]["thickness_nm"] == 94.2);
    CHECK(back["layers"][6]["thickness_nm"] == 33.33);
    const std::string document = folder / "back.json";
    done({"convert", file, "-o", document});
    CHECK(largest_difference(reflectance_of({stack}), reflectance_of({document})) < 2e-5);
    // converting again changes nothing
    const std::string again = folder / "again.dat";
    done({"convert", document, "-o", again});
    CHECK(read_file(again) == text);
    // an opaque substrate becomes the last layer
    const Outcome mirror = done({"convert", "air | SiO2@100 | Ag", "-o", folder / "m.dat"});
    CHECK(has_line(mirror.err, "it is the last layer, and the coating is for mirrors"));
    done({"convert", folder / "m.dat", "--mirror", "-o", folder / "m.json"});
    CHECK(largest_difference(reflectance_of({"air | SiO2@100 | Ag"}),
                             reflectance_of({folder / "m.json"})) < 2e-5);
    CHECK(has_line(done({"convert", "1 | 1.5@1mm! | 1", "-f", "zemax"}).err,
                   "cannot hold: \"coherent\": false"));
    check_refused(run_irido({"convert", "1 | (2@1 | 1.5@1)^6000 | 1", "-f", "zemax"}),
                  "\"1 | (2@1 | 1.5@1)^6000 | 1\": must have at most 10000 layers");
    for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{
             {"--primary", "550"}, {"--coating", "AR"}, {"--mirror"}}) {
        std::vector<std::string> arguments{"convert", "1 | 1.5@100 | 2"};
        arguments.insert(arguments.end(), option.begin(), option.end());
        check_refused(run_irido(arguments), option[0] + ": applies to files of other programs");
    }
}

TEST_CASE("an OpenFilters project runs from the substrate outwards", "[cli][convert]") {
    const TemporaryFolder folder;
    const std::string file = folder / "filter.ofp";
    write_text(file, kProject);
    write_text(folder / "Oxide.mat", kOxide);
    const Outcome read = done({"convert", file, "-o", folder / "filter.json"});
    CHECK(has_line(read.err, "the back layers are left out"));
    CHECK(has_line(read.err, "the built-in SiO2 is taken"));
    CHECK(has_line(read.err, "the built-in fused-silica is taken"));
    CHECK(has_line(read.err, "targets are left out"));
    const json filter = json::parse(read_file(folder / "filter.json"));
    CHECK(filter["name"] == "synthetic");
    CHECK(filter["incident"] == "vacuum");
    CHECK(filter["substrate"] == "fused-silica");
    CHECK(filter["layers"] == json::parse(R"([{"material": "SiO2", "thickness_nm": 90},
                          {"material": "Oxide", "thickness_nm": 60}])"));
    CHECK(filter["materials"]["Oxide"]["file"] == "Oxide.mat");
    const auto oxide =
        parse_csv(done({"materials", "show", folder / "Oxide.mat", "-w", "380,490,600"}).out);
    CHECK(oxide[1] == Words{"380", "2.4", "0.01"});
    CHECK(std::stod(oxide[2][1]) == Approx(2.35));
    CHECK(std::stod(oxide[2][2]) == Approx(0.005));
    CHECK(oxide[3] == Words{"600", "2.3", "0"});
    // with its back: the last layer touches the medium behind it
    std::string text = kProject;
    text.replace(text.find("ConsiderBackside: 0"), 19, "ConsiderBackside: 1");
    write_text(file, text);
    const json both = converted({file, "--material-folder", folder.path()});
    REQUIRE(both["layers"].size() == 5);
    CHECK(
        both["layers"][2] ==
        json::parse(R"({"material": "fused-silica", "thickness_nm": 1000000, "coherent": false})"));
    CHECK(both["layers"][3]["material"] == "SiO2");
    CHECK(both["layers"][4]["material"] == "Oxide");
    CHECK(both["substrate"] == "vacuum");
}

TEST_CASE("a stack goes to OpenFilters and back", "[cli][convert]") {
    const TemporaryFolder folder;
    const std::string file = folder / "out.ofp";
    const std::string stack =
        "air | MgF2@94.2 | 2.3+0.01i@60.1 | 1.7@20 | BK7@2mm! | TiO2@33.5 | 1";
    const Outcome written = done({"convert", stack, "-o", file});
    CHECK(has_line(read_file(file), "\tSubstrate: BK7 2000000\n"));
    CHECK(has_line(read_file(file), "\tBackMedium: void\n"));
    CHECK(has_line(read_file(folder / "N2_3_0_01i.mat"), "Properties: 2.3-0.01j\n"));
    CHECK(has_line(read_file(folder / "MgF2.mat"), "Model: Sellmeier\n"));
    CHECK(has_line(written.err, "an OpenFilters project cannot hold: the range of MgF2"));
    const json back = converted({file});
    REQUIRE(back["layers"].size() == 5);
    CHECK(back["layers"][0]["thickness_nm"] == 94.2);
    CHECK(back["layers"][2]["thickness_nm"] == 20);
    CHECK(back["layers"][3]["coherent"] == false);
    CHECK(back["layers"][4]["thickness_nm"] == 33.5);
    done({"convert", file, "-o", folder / "back.json"});
    CHECK(largest_difference(reflectance_of({stack}), reflectance_of({folder / "back.json"})) <
          3e-5);
    // a project of the same materials beside it: their files are inputs, and stay as they are
    std::filesystem::create_directory(folder / "sub");
    done({"convert", file, "-o", folder / "sub/a.ofp"});
    done({"convert", folder / "sub/a.ofp", "-o", folder / "sub/b.ofp"});
    CHECK(read_file(folder / "sub/a.ofp") == read_file(folder / "sub/b.ofp"));
    // a name is one line, whatever is in it
    const Outcome odd =
        done({"convert", "1 | 1.5@10 | 1.6", "--set", "name=\"a\\nEnd\\nb\"", "-f", "openfilters"});
    CHECK(has_line(odd.out, "\tDescription: a End b\n"));
    // the same again, in the same folder, but nothing else
    const std::string before = read_file(file);
    done({"convert", stack, "-o", file});
    CHECK(read_file(file) == before);
    const Outcome other = run_irido(
        {"convert", "1 | MgF2-e@10 | 1.5", "--material", "MgF2-e=1.3", "-o", folder / "other.ofp"});
    CHECK(other.status == 0);
    write_text(folder / "MgF2.mat", "mine");
    check_refused(run_irido({"convert", stack, "-o", file}), "exists and differs");
    CHECK(read_file(folder / "MgF2.mat") == "mine");
    CHECK(has_line(done({"convert", stack, "-f", "openfilters"}).err, "MgF2.mat is not written"));
}

TEST_CASE("OpenFilters projects and materials are refused where they cannot be read",
          "[cli][convert]") {
    const TemporaryFolder folder;
    const std::string file = folder / "filter.ofp";
    const auto refused = [&](const std::string& from, const std::string& to,
                             const std::string& error) {
        std::string text = kProject;
        text.replace(text.find(from), from.size(), to);
        write_text(file, text);
        check_refused(run_irido({"convert", file}), error);
    };
    write_text(folder / "Oxide.mat", kOxide);
    refused("FrontLayer: Oxide 60.000000", "FrontLayer: Unknown 60",
            "there is no file " + (folder / "Unknown.mat"));
    refused("FrontLayer: Oxide 60.000000", "FrontLayer: Oxide 60 2.1",
            "layers of mixtures are not read");
    refused("FrontLayer: Oxide 60.000000", "FrontGradedLayer:\n1 2\nEnd",
            "graded layers are not read");
    refused("FrontLayer: Oxide 60.000000", "FrontLayer: Oxide", "must be a material and its");
    refused("Substrate: FusedSilica 1000000.000000", "StepSpacing: 1", "has no Substrate");
    refused("Filter:", "Other:", "has no Filter");
    refused("end\n", "", "has no End");
    const auto material = [&](const std::string& text, const std::string& error) {
        write_text(folder / "x.mat", text);
        check_refused(run_irido({"materials", "show", folder / "x.mat"}), error);
    };
    material("Kind: mixture\nModel: table\nProperties: 1\n", "Kind must be regular");
    material("Kind: regular\nModel: spline\nProperties: 1\n", "Model must be constant, table");
    material("Kind: regular\nModel: constant\n", "must have Properties");
    material("Kind: regular\nModel: constant\nProperties: 2.4-x\n", "must be an index such as");
    material("Kind: regular\nModel: Cauchy\nProperties: 1.5 0.1\n", "Cauchy must have 3 or 6");
    material("Kind: regular\nModel: table\nProperties:\n400 1.5\n", "has no End");
    // dispersion models of n, and a tail of k
    write_text(folder / "x.mat",
               "Kind: regular\nModel: Cauchy\nProperties: 1.45 0.004 0.0001 0.01 1.5 4000\n");
    const auto rows = parse_csv(done({"materials", "show", folder / "x.mat", "-w", "500"}).out);
    CHECK(std::stod(rows[1][1]) == Approx(1.45 + 0.004 / 0.25 + 0.0001 / 0.0625));
    CHECK(std::stod(rows[1][2]) ==
          Approx(0.01 * std::exp(12400 * 1.5 * (1 / 5000.0 - 1 / 4000.0))).epsilon(1e-5));
}

TEST_CASE("a stack goes to a list of layers and back", "[cli][convert]") {
    const TemporaryFolder folder;
    const std::string file = folder / "layers.csv";
    const std::string stack = "air | (TiO2@58.5 | 1.9-1.5i@94.2)^2 | SiO2@1mm! | 1.52";
    const Outcome written =
        done({"convert", stack, "--set", "layers.1.thickness_sigma_nm=5", "-o", file});
    CHECK(read_file(file) ==
          "layer,material,thickness_nm,thickness_sigma_nm,coherent\n0,air,,,\n"
          "1,TiO2,58.5,0,true\n2,1.9-1.5i,94.2,0,true\n3,TiO2,58.5,0,true\n"
          "4,1.9-1.5i,94.2,0,true\n5,fused-silica,1000000,5,false\n6,1.52,,,\n");
    CHECK(has_line(written.err, "a list of layers cannot hold: groups"));
    const json back = converted({file});
    CHECK(back["incident"] == "air");
    CHECK(back["substrate"] == 1.52);
    REQUIRE(back["layers"].size() == 5);
    CHECK(back["layers"][1]["material"] == json({{"n", 1.9}, {"k", -1.5}}));
    CHECK(back["layers"][4] == json({{"material", "fused-silica"},
                                     {"thickness_nm", 1e6},
                                     {"thickness_sigma_nm", 5},
                                     {"coherent", false}}));
    // in the form that other programs write
    write_text(file, "Layer;Material;QWOT\r\n1;\"TiO2\";1,5\r\n2;1.46;2\r\n");
    const Outcome other = done({"convert", file, "--primary", "550"});
    CHECK(has_line(other.err, "the media around are not in the list: air and BK7"));
    const json quarter = json::parse(other.out);
    CHECK(quarter["layers"][1]["thickness_nm"].get<double>() == Approx(2 * 550 / (4 * 1.46)));
    const double n =
        std::stod(parse_csv(done({"materials", "show", "TiO2", "-w", "550"}).out)[1][1]);
    CHECK(quarter["layers"][0]["thickness_nm"].get<double>() == Approx(1.5 * 550 / (4 * n)));
    write_text(file, "material,thickness_um\n1.46,0.0942\n");
    CHECK(converted({file})["layers"][0]["thickness_nm"] == 94.2);
    const auto refused = [&](const std::string& text, const std::string& error) {
        write_text(file, text);
        check_refused(run_irido({"convert", file}), error);
    };
    refused("", "must have a header");
    refused("material,color\n", "columns must be layer, material");
    refused("material,layer\n", "must have a header with material and thickness_nm");
    refused("material,thickness_nm,d_um\n", "has two thicknesses");
    refused("material,thickness_nm\n1.5,x\n", "2:1: must be a number, at least 0");
    refused("material,thickness_nm\n1,1\n2,\n3,1\n4,\n", "3:1: the layer has no thickness");
    refused("material,thickness_nm\n,1\n", "2:1: the row has no material");
    refused("material,thickness_nm\n\"a,1\n", "the quote is never closed");
    refused("material,qwot\n1.5,1\n", "--primary NM gives their wavelength");
}

TEST_CASE("formats of stacks go into each other", "[cli][convert]") {
    const TemporaryFolder folder;
    write_text(folder / "a.ofp", kProject);
    write_text(folder / "Oxide.mat", kOxide);
    done({"convert", folder / "a.ofp", "-o", folder / "COATING.DAT"});
    const json coating = converted({folder / "COATING.DAT"});
    CHECK(coating["layers"][0]["material"] == "fused_silica");
    CHECK(coating["layers"][1]["material"] == "Oxide");
    CHECK(coating["materials"]["Oxide"]["table"][0] == json::parse("[380, 2.4, 0.01]"));
    check_refused(run_irido({"convert", folder / "a.ofp", "-o", folder / "a.xyz"}),
                  "the extension must be json");
    check_refused(run_irido({"convert", folder / "a.ofp", "-f", "xyz"}),
                  "must be one of json, expression, zemax, openfilters, csv");
}
