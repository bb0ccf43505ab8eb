#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string kFilm = "air | MgF2@100 | BK7";
const std::string kMirror = "1 | (1@125 | 1.5@375)^20 | 1";

/// Command lines that draw pictures, without -o.
std::vector<Words> drawings() {
    return {{"spectrum", kFilm, "-w", "400:700:20", "-a", "0,45", "-p", "s,p"},
            {"color", kFilm, "-a", "0:80:10", "--side", "R,T"},
            {"color", kFilm, "-a", "0:80:10", "--plot", "chromaticity"},
            {"cm", "1 | 1.42@400 | 1.87+1.182i", "-a", "50"},
            {"bands", kMirror, "-a", "0:80:10"},
            {"bands", kMirror, "-a", "20"},
            {"bands", kMirror, "-a", "0:80:10", "--gaps"},
            {"sweep", kFilm, "--vary", "layers.0.thickness_nm=0:100:10", "--compute", "color"},
            {"lut", "color", kFilm, "--vary", "layers.0.thickness_nm=0:100/5", "--cos", "0:1/5"}};
}

}  // namespace

TEST_CASE("every command with rows draws them, the same bytes again", "[cli][pictures][slow]") {
    for (const Words& words : drawings()) {
        CAPTURE(words);
        for (const auto& [format, head] :
             {std::pair{"svg", "<svg "}, {"png", "\x89PNG\r\n"}, {"pdf", "%PDF-1.4\n"}}) {
            const TemporaryFolder folder;
            const std::string file = folder / (std::string("x.") + format);
            const Outcome drawn = run_irido(words + Words{"-o", file, "--quiet"});
            CHECK(drawn.status == 0);
            CHECK(drawn.out + drawn.err == "");
            CHECK_THAT(read_file(file), StartsWith(head));
            if (words[0] == "lut") continue;  // a file's metadata has the error, a stream's not
            const Outcome again = run_irido(words + Words{"-f", format, "--quiet"});
            CHECK((again.out == read_file(file)));
        }
    }
}

TEST_CASE("pictures say what they show", "[cli][pictures]") {
    const auto svg = [](const Words& words) {
        return run_irido(words + Words{"-f", "svg", "--quiet"}).out;
    };
    const std::vector<Words> all = drawings();
    CHECK_THAT(svg(all[0]), Contains(">air | MgF2@100 | BK7</text>") &&
                                Contains(">vacuum wavelength, nm</text>") &&
                                Contains(">reflectance R</text>") &&
                                Contains(">p, 45\u00b0</text>") &&
                                Contains(">A is 0 throughout</text>") && !Contains("absorptance"));
    CHECK_THAT(svg(all[2]), Contains(">spectral locus</text>") && Contains(">CIE 1976</text>") &&
                                Contains(">80\u00b0</text>"));
    CHECK_THAT(svg(all[3]), Contains(">order</text>") && Contains("angle of incidence 50\u00b0"));
    CHECK_THAT(svg({"cm", "1 | 1.5@500 | 2+1i", "-a", "0:80:10"}),
               Contains(">order 5</text>") && Contains(">p</text>"));  // curves in two panels
    CHECK_THAT(svg(all[6]), Contains("s, gap of order 2"));
    CHECK_THAT(svg(all[7]), Contains(">thickness of layer 1, nm</text>"));
    CHECK_THAT(svg(all[8]),
               Contains("<metadata>{&quot;axes&quot;") && Contains("cosine of the angle"));
}

TEST_CASE("plots have words for the columns of every command", "[cli][pictures]") {
    const TemporaryFolder folder;
    const auto drawn = [&](const Words& words, bool has_output = true) {
        CAPTURE(words);
        const Outcome outcome = run_irido(words + (has_output ? Words{"-f", "svg"} : Words{}));
        CHECK(outcome.status == 0);
        const std::string svg = has_output ? outcome.out : read_file(folder / "x.svg");
        CHECK_THAT(svg, !Contains("_deg") && !Contains("_nm") && !Contains("_um") &&
                            !Contains("_per_") && !Contains(" deg"));
        return svg;
    };
    const std::string spoon = "schemas/examples/surfaces/worn-spoon.json";
    CHECK_THAT(drawn({"brdf", kFilm, "--alpha", "0.1", "--view-theta", "0:60:10", "-w", "450,550"}),
               Contains(">angle of the view, \u00b0</text>") && Contains(">BRDF, 1/sr</text>"));
    drawn({"brdf", kFilm, "--alpha", "0.1", "--quantity", "albedo", "--light-theta", "0:60:20"});
    drawn({"brdf", kFilm, "--alpha", "0.1", "--light-theta", "0:60:20", "--color"});
    CHECK_THAT(drawn({"brdf", kMirror, "--alpha", "0.1", "--quantity", "transmissivity",
                      "--light-theta", "0:60:20", "-w", "550"}),
               Contains(">probability of passing</text>"));
    drawn({"brdf", spoon, "--area-light", R"({"center_mm": [0, 0, 900], "radius_mm": 90})",
           "--view-theta", "0:20:10", "-w", "550"});
    CHECK_THAT(drawn({"scratches", spoon, "--extent", "900,600"}),
               Contains(">x, \u00b5m</text>") && Contains(" scratches</text>"));
    CHECK_THAT(drawn({"design", kFilm, "--free", "layers.0.thickness_nm=50:150", "--target",
                      "R 500,550,600 @0,45 = 0", "--evaluations", "5", "--quiet", "--plot",
                      folder / "x.svg"},
                     false),
               Contains(">45\u00b0</text>") && Contains(">target</text>"));
}

TEST_CASE("a title says which values vary, and those that are set", "[cli][pictures]") {
    const auto title = [](const Words& words) {
        const std::string svg = run_irido(words + Words{"-f", "svg"}).out;
        const std::size_t at = svg.find("<title>") + 7;
        return svg.substr(at, svg.find("</title>") - at);
    };
    const std::string film = "air | MgF2 @ 100nm | (H@1Q | 1.46@94)^2 | BK7";
    const Words spectrum{"-w", "500,600", "--material", "H=2.3", "--reference", "550"};
    const Words sweep{"sweep", film, "--compute", "spectrum"};
    CHECK(title(sweep + spectrum + Words{"--vary", "layers.0.thickness_nm=90:110:10"}) ==
          "air | MgF2 @ \u2026 | (H@1Q | 1.46@94)^2 | BK7");
    CHECK(title(sweep + spectrum +
                Words{"--vary", "layers.1.repeat=2,3", "--set", "layers.1.layers.1.material=1.5",
                      "--set", "substrate=Si"}) ==
          "air | MgF2 @ 100nm | (H@1Q | 1.5@94)^\u2026 | Si");
    CHECK(title(Words{"spectrum", film, "--set", "layers.1.layers.0.qwot=2"} + spectrum) ==
          "air | MgF2 @ 100nm | (H@2Q | 1.46@94)^2 | BK7");
    CHECK(title({"color", kFilm, "--set", "name=mine"}) == "mine");
}

TEST_CASE("a name of any characters is drawn well formed", "[cli][pictures]") {
    const std::string svg = run_irido({"spectrum", kFilm, "-w", "400:500:50", "--set",
                                       "name=\"<&]]>\u6f22\u0431\"", "-f", "svg"})
                                .out;
    CHECK_THAT(svg, Contains("&lt;&amp;]]&gt;\u6f22\u0431"));
}

TEST_CASE("colours outside of sRGB are counted", "[cli][pictures]") {
    const Words green{
        "color", "schemas/examples/jewel-beetle-green.json", "--set", "incident=1.59", "-f", "svg"};
    const Outcome clipped = run_irido(green);
    CHECK_THAT(clipped.err, Contains("100 % of the colours lie outside sRGB and are clipped"));
    CHECK_THAT(clipped.out, Contains("fill=\"#00570f\""));  // the hex value of the rows
    const Outcome compressed = run_irido(green + Words{"--gamut", "compress"});
    CHECK_THAT(compressed.err, Contains("mixed with the grey of their luminance"));
    CHECK_THAT(compressed.out, !Contains("fill=\"#00570f\""));
}

TEST_CASE("colours that are only too bright are counted on their own", "[cli][pictures]") {
    const Outcome bright = run_irido({"brdf", "1 | 1@100 | 0.05+9i", "--alpha", "0.1", "--color",
                                      "--light-theta", "0:10:5", "-f", "svg"});
    CHECK_THAT(bright.err,
               Contains("100 % of the colours are brighter than white and are clipped"));
    CHECK_THAT(bright.err, !Contains("outside"));
}

TEST_CASE("sixteen bits", "[cli][pictures]") {
    const TemporaryFolder folder;
    for (const auto& [bits, depth] : {std::pair{"8", 8}, {"16", 16}}) {
        CHECK(run_irido({"color", kFilm, "-a", "0:40:10", "-o", folder / "x.png", "--bits", bits,
                         "--quiet"})
                  .status == 0);
        CHECK(static_cast<int>(read_file(folder / "x.png")[24]) == depth);
    }
}

TEST_CASE("what cannot be drawn leaves nothing behind", "[cli][pictures][refused][slow]") {
    const TemporaryFolder folder;
    const std::string file = folder / "x.svg", png = folder / "x.png";
    const auto refused = [&](const Words& words, const std::string& error) {
        CAPTURE(words);
        check_refused(run_irido(words), error);
        CHECK(std::filesystem::is_empty(folder.path()));
    };
    refused({"bands", kMirror, "-a", "0:10:1", "--range", "735:740", "-p", "s", "-o", file},
            "x.svg: there are no rows to draw");
    refused({"spectrum", kFilm, "-a", "0:80:1", "-w", "500", "-o", folder / "x.gif"},
            "--output: the extension must be one of csv, json, npy, pdf, png, svg");
    refused({"color", kFilm, "-o", file, "--bits", "16"}, "--bits: requires a picture as .png");
    refused({"color", kFilm, "-o", png, "--bits", "12"}, "--bits: must be 8 or 16 (got '12')");
    refused({"color", kFilm, "-o", png, "--gamut", "x"}, "--gamut: must be one of clip, compress");
    refused({"color", kFilm, "--gamut", "clip"}, "--gamut: requires a picture");
    refused({"color", kFilm, "--plot", "chromaticity"}, "--plot: requires a picture");
    refused({"color", kFilm, "--plot", "x", "-o", file},
            "--plot: must be one of strip, chromaticity");
    const Words sweep{"sweep", kFilm, "--vary", "layers.0.thickness_nm=0:100:1", "-o", file};
    refused(sweep + Words{"--compute", "color", "--resume"}, "--resume: a picture is drawn in one");
    refused(sweep + Words{"--compute", "color", "--shard", "1/2"}, "--shard: a picture needs all");
    refused(sweep + Words{"--compute", "spectrum", "-a", "0:80:1", "-w", "400:700:2"},
            "x.svg: too much varies for one picture");
    refused({"cm", "1 | 1.42@400 | 1.87+1.182i", "-o", folder / "no/x.svg"}, "x.svg");
}

TEST_CASE("a merged table of a sweep is no picture", "[cli][pictures][refused]") {
    check_refused(run_irido({"sweep", "--merge", "a.csv", "-o", "/tmp/x.svg"}), "--output");
}

TEST_CASE("help lists the formats of pictures", "[cli][pictures]") {
    for (const char* command : {"spectrum", "color", "cm", "bands", "sweep"})
        CHECK_THAT(run_irido({command, "--help"}).out, Contains("pdf, png or svg"));
    CHECK_THAT(run_irido({"lut", "color", "--help"}).out, Contains("pdf, png, svg"));
}

TEST_CASE("the commands of docs/pictures.md draw", "[cli][pictures][slow]") {
    const TemporaryFolder folder;
    std::istringstream lines(read_file(IRIDO_SOURCE_DIR "/docs/pictures.md"));
    std::size_t drawn = 0;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("    irido ")) continue;
        const std::size_t file = line.rfind(" -o ");
        REQUIRE(file != std::string::npos);
        const std::string words =
            line.substr(10, file - 6) + (folder / line.substr(file + 4)) + " --quiet";
        CAPTURE(words);
        const Outcome outcome = run_shell("\"$IRIDO\" " + words, IRIDO_SOURCE_DIR);
        CHECK(outcome.status == 0);
        CHECK(outcome.err.empty());
        CHECK(std::filesystem::file_size(folder / line.substr(file + 4)) > 1000);
        ++drawn;
    }
    CHECK(drawn >= 8);
}
