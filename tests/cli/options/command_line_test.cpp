#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string kFilm = "air | 1.5@100 | 1.5";

}  // namespace

TEST_CASE("the first wrong word of a command line is named", "[cli][refused]") {
    const std::string help = " (see irido spectrum --help)\n";
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"spectrum", kFilm, "--wavelenghts", "550", "--bar"},
         "spectrum has no option --wavelenghts (did you mean \"--wavelengths\"?)" + help},
        {{"spectrum", kFilm, "--wavelenghts=550"},
         "spectrum has no option --wavelenghts (did you mean \"--wavelengths\"?)" + help},
        {{"spectrum", kFilm, "--foo", "--bar", "-x"}, "spectrum has no option --foo" + help},
        {{"spectrum", kFilm, "-x"}, "spectrum has no option -x" + help},
        {{"spectrum", kFilm, "-w"}, "--wavelengths: requires a value, LIST" + help},
        {{"spectrum", kFilm, "--set", "--quiet"}, "--set: requires a value, PATH=VALUE" + help},
        {{"spectrum", kFilm, "-w", "550", "-w", "600"},
         "--wavelengths: given more than once" + help},
        {{"spectrum", kFilm, "--quiet=5"}, "--quiet: takes no value (got '5')" + help},
        {{"spectrum", "-w", "550"}, "STACK is required" + help},
        {{"spectrum", "a", "b", "c"}, "unexpected argument 'b'"},
        {{"spectrum", kFilm, "--", "--foo"}, "unexpected argument '--foo'"},
        {{"bake", "x.json"}, "--output is required (see irido bake --help)"},
        {{"validate", "--schema", "stack", "a.json"}, "--schema and FILE cannot be used together"},
        {{"lut", "color", kFilm, "-a"}, "lut color has no option -a (see irido lut color --help)"},
        {{"lut", "color"}, "STACK is required (see irido lut color --help)"},
        {{"lut"}, "a command is required after irido lut (see irido lut --help)"},
        {{}, "a command is required after irido (see irido --help)"},
        {{"--quiet", "spectrum"}, "a command is required after irido, before --quiet"},
        {{"materials", "lst"},
         "unknown command 'lst' (did you mean \"list\"?) (see irido "
         "materials --help)"},
        {{"sweep", kFilm, "-w", "633"},
         "--compute: is required for -w: spectrum, "
         "color, bands or cm (see irido sweep --help)"},
        {{"sweep", kFilm, "--vray", "a=1"}, "(did you mean \"--vary\"?)"},
        {{"sweep", kFilm, "-w", "633", "--compute", "color"}, "sweep has no option -w"},
    };
    for (const auto& [words, error] : cases) check_refused(run_irido(words), error);
}

TEST_CASE("a misspelt value of an option is told from what it may be", "[cli][refused]") {
    const std::string spoon = "schemas/examples/surfaces/worn-spoon.json",
                      pale = "schemas/examples/surfaces/green-on-pale.json";
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"render", kFilm, "-o", "x.png", "--shape", "spher"}, "sphere"},
        {{"render", kFilm, "-o", "x.png", "--environment", "stuido"}, "studio"},
        {{"render", kFilm, "-o", "x.png", "--camera", "perspectiv"}, "perspective"},
        {{"render", kFilm, "-o", "x.png", "--background", "environmnt"}, "environment"},
        {{"render", kFilm, "-o", "x.png", "--paths", "sinlge"}, "single"},
        {{"render", kFilm, "-o", "x.jpng"}, "png"},
        {{"brdf", pale, "--quantity", "albdo"}, "albedo"},
        {{"brdf", spoon, "--quantity", "denstiy"}, "density"},
        {{"brdf", pale, "--paths", "simulaton"}, "simulation"},
        {{"brdf", pale, "--transmission", "multple"}, "multiple"},
        {{"brdf", pale, "--paths", "simulation", "--facets", "fitler"}, "filter"},
        {{"brdf", spoon, "--area-light", "{\"center_mm\": [0, 0, 9], \"radius_mm\": 1}",
          "--light-integral", "exakt"},
         "exact"},
        {{"brdf", spoon, "--energy", "blnd"}, "blend"},
        {{"lut", "shader", "falpah"}, "falpha"},
        {{"lut", "shader", "color", "--language", "glls"}, "glsl"},
        {{"lut", "falpha", "--dtype", "f61"}, "f16"},
        {{"lut", "brdf", pale, "--paths", "al", "-o", "x.csv"}, "all"},
        {{"lut", "brdf", pale, "-o", "x.kxt2"}, "ktx2"},
        {{"color", kFilm, "--space", "sRBG"}, "srgb"},
        {{"color", kFilm, "--illuminant", "d65"}, "D65"},
        {{"color", kFilm, "--adaptation", "bradfrod"}, "bradford"},
        {{"color", kFilm, "--method", "quadratur"}, "quadrature"},
        {{"color", kFilm, "--plot", "stripe", "-o", "x.svg"}, "strip"},
        {{"color", kFilm, "-o", "x.svg", "--gamut", "compres"}, "compress"},
        {{"color", kFilm, "--columns", "whitenes_cie"}, "whiteness_cie"},
        {{"spectrum", kFilm, "--columns", "psi_dge"}, "psi_deg"},
        {{"spectrum", kFilm, "--unit", "cm1"}, "cm-1"},
        {{"spectrum", kFilm, "--average", "photpic"}, "photopic"},
        {{"spectrum", kFilm, "-f", "jsn"}, "json"},
        {{"sweep", kFilm, "--vary", "layers.0.thickness_nm=1,2", "--compute", "spectrm"},
         "spectrum"},
        {{"compare", kFilm, "--engine", "babylonn"}, "babylon"},
        {{"compare", kFilm, "--engine", "gltf", "--white", "comon"}, "common"},
        {{"compare", "--random", "3", "--engine", "gltf", "--base", "dielectic"}, "dielectric"},
        {{"convert", kFilm, "-f", "zmax"}, "zemax"},
        {{"completion", "bassh"}, "bash"},
        {{"plan", "schemas/examples/scenes/beetle.json", "-f", "jsno"}, "json"},
        {{"render", "schemas/examples/scenes/beetle.json", "--show", "gren", "-o", "x.png"},
         "green"},
        {{"design", kFilm, "--free", "layers.0.thickness_nm=1:2", "--target", "R 500 = 0",
          "--method", "globl"},
         "global"},
        {{"bench", "speed", "--cases", "flim"}, "film"}};
    for (const auto& [words, meant] : cases) {
        const Outcome outcome = run_irido(words, "", IRIDO_SOURCE_DIR);
        INFO(words[0] << ": " << outcome.err);
        check_refused(outcome, "(did you mean \"" + meant + "\"?)");
    }
    const Outcome far = run_irido({"render", kFilm, "-o", "x.png", "--shape", "cube"});
    CHECK_THAT(far.err, !Contains("did you mean"));
}

TEST_CASE("help is shown whatever else is typed", "[cli]") {
    CHECK_THAT(run_irido({"spectrum", "--foo", "--help"}).out, Contains("--wavelengths"));
    CHECK(run_irido({"--help"}).status == 0);
    CHECK(run_irido({"lut", "--help"}).status == 0);
}

TEST_CASE("every command takes -j and --quiet", "[cli]") {
    const std::vector<std::vector<std::string>> commands{{"bands", "1 | (1@200 | 1.5@180)^10 | 1"},
                                                         {"cm", "1 | 1.42@400 | 1.87"},
                                                         {"materials", "list"},
                                                         {"materials", "show", "Au"},
                                                         {"validate", kFilm},
                                                         {"convert", kFilm},
                                                         {"lut", "list"},
                                                         {"lut", "shader", "color"},
                                                         {"spectrum", kFilm, "-w", "550"},
                                                         {"color", kFilm}};
    for (std::vector<std::string> command : commands) {
        CAPTURE(command[0]);
        const Outcome before = run_irido(command);
        command.insert(command.end(), {"-j", "2", "--quiet"});
        const Outcome with = run_irido(command);
        CHECK(with.status == 0);
        CHECK(with.err.empty());
        CHECK(with.out == before.out);
    }
    check_refused(run_irido({"materials", "list", "-j", "0"}),
                  "--threads: must be in [1, 4096] (got 0)");
}

TEST_CASE("every command that clamps materials in colours refuses to with --strict",
          "[cli][slow]") {
    const TemporaryFolder folder;
    write_text(folder / "m.csv", "nm,n\n400,1.5\n700,1.5\n");
    write_text(folder / "surface.json",
               R"({"layers": [{"stack": "1 | m.csv@90 | 1", "alpha": 0.3}]})");
    write_text(
        folder / "scene.json",
        R"({"materials": [{"name": "a", "stack": "1 | m.csv@90 | 2", "shading": "color"}]})");
    const std::string stack = "1 | m.csv@90 | 2";
    const std::vector<std::vector<std::string>> commands{
        {"color", stack},
        {"sweep", stack, "--compute", "color", "--vary", "layers.0.thickness_nm=90"},
        {"lut", "color", stack, "--vary", "layers.0.thickness_nm=0:90/2", "--cos", "0,1"},
        {"lut", "brdf", "surface.json", "--size", "2", "-o", "t.csv"},
        {"lut", "layered", "surface.json", "-o", "l.bin"},
        {"brdf", "surface.json", "--color"},
        {"render", stack, "--size", "8", "-o", "x.png"},
        {"view", stack, "-o", "x.html"},
        {"compare", stack, "--engine", "gltf"},
        {"design", stack, "--free", "layers.0.thickness_nm=80:90", "--target", "lab = 50,0,0",
         "--evaluations", "3"}};
    for (std::vector<std::string> command : commands) {
        CAPTURE(command);
        const Outcome noted = run_irido(command, "", folder.path());
        CHECK(noted.status == 0);
        CHECK_THAT(noted.err, Contains("irido: note: ") && Contains("; clamped to its end values"));
        command.emplace_back("--quiet");
        CHECK_THAT(run_irido(command, "", folder.path()).err, !Contains("note"));
        command.emplace_back("--strict");
        const Outcome strict = run_irido(command, "", folder.path());
        CHECK(strict.status == 2);
        CHECK_THAT(strict.err, StartsWith("irido: error: ") && Contains("m.csv"));
    }
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"plan", "scene.json"}, {"bake", "scene.json", "-o", "tables"}}) {
        std::vector<std::string> strict = command;
        strict.emplace_back("--strict");
        const Outcome refused = run_irido(strict, "", folder.path());
        CHECK(refused.status == 1);  // the other materials are made
        CHECK_THAT(refused.err, Contains("material a: ") && Contains("clamped to its end values"));
        const Outcome noted = run_irido(command, "", folder.path());
        CHECK(noted.status == 0);
        CHECK_THAT(noted.err, Contains("material a: ") && Contains("clamped to its end values"));
    }
}

TEST_CASE("more threads than there can be are fewer, with a note", "[cli]") {
    const Outcome many = run_irido({"spectrum", kFilm, "-w", "550", "-j", "1e5"});
    CHECK(many.status == 0);
    CHECK(many.err == "irido: note: --threads: at most 4096 are started (got 1e5)\n");
    CHECK(run_irido({"spectrum", kFilm, "-w", "550", "-j", "4096"}).err.empty());
    CHECK(run_irido({"spectrum", kFilm, "-w", "550", "-j", "99999", "--quiet"}).err.empty());
}

TEST_CASE("The output - is standard output", "[cli][output]") {
    const TemporaryFolder folder;
    const std::vector<std::vector<std::string>> commands{
        {"spectrum", kFilm, "-w", "550"},
        {"color", kFilm, "-f", "json"},
        {"sweep", kFilm, "--vary", "layers.0.thickness_nm=1,2", "--compute", "spectrum", "-w",
         "550"},
        {"materials", "list"},
        {"lut", "falpha", "--alpha", "0.1", "--theta-i", "20", "--theta-d", "15"},
        {"convert", kFilm},
        {"design", kFilm, "--free", "layers.0.thickness_nm=50:150", "--target", "R 500 = 0",
         "--evaluations", "5", "--quiet"}};
    for (std::vector<std::string> command : commands) {
        CAPTURE(command[0]);
        const Outcome plain = run_irido(command, "", folder.path());
        command.insert(command.end(), {"-o", "-"});
        const Outcome dash = run_irido(command, "", folder.path());
        CHECK(dash.status == 0);
        CHECK(dash.out == plain.out);
        CHECK_FALSE(dash.out.empty());
    }
    check_refused(run_irido({"bake", "scene.json", "-o", "-"}, "", folder.path()),
                  "--output: must name a folder");
    check_refused(
        run_irido({"lut", "brdf", kFilm, "--alpha", "0.1", "-f", "merl"}, "", folder.path()),
        "--output: is required");
    CHECK(run_shell("ls -A | wc -l", folder.path()).out == "0\n");
}

TEST_CASE("help and version are written, or it is said why not", "[cli][output]") {
    for (const std::string& words : std::vector<std::string>{"--help", "--version", "lut --help"}) {
        INFO(words);
        check_refused(run_shell("\"$IRIDO\" " + words + " > /dev/full", "."),
                      "standard output: cannot be written: No space left on device");
        check_refused(run_shell("\"$IRIDO\" " + words + " >&-", "."),
                      "standard output: cannot be written: Bad file descriptor");
        CHECK(run_shell("\"$IRIDO\" " + words + " | head -c 1", ".").err.empty());
    }
}

TEST_CASE("ranges and several values are shown as they are written", "[cli][refused]") {
    for (const auto& [typed, said] : std::vector<std::pair<std::string, std::string>>{
             {"380-780", "(got '380-780'); a range is written 380:780:STEP or 380:780/COUNT"},
             {"380..780", "(got '380..780'); a range is written 380:780:STEP or 380:780/COUNT"},
             {"380 - 780.5", "a range is written 380:780.5:STEP"},
             {"380 780", "several values are written 380,780"},
             {"-5", "must be in [1, 1e+07] (got -5)"},
             {"3e-x", "must be a number (got '3e-x') "},
             {"550nm", "must be a number (got '550nm')"}}) {
        INFO(typed);
        const Outcome outcome = run_irido({"spectrum", kFilm, "--wavelengths=" + typed});
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err + " ", Contains(said.substr(0, said.find_last_not_of(' ') + 1)));
        CHECK((said.back() != ' ' || outcome.err.find("written") == std::string::npos));
    }
}

TEST_CASE("wavelengths that look like um are told apart", "[cli][refused]") {
    check_refused(run_irido({"spectrum", kFilm, "-w", "0.55"}),
                  "--wavelengths: must be in [1, 1e+07] (got 0.55); wavelengths are in nm, 0.55 um "
                  "is 550");
    check_refused(run_irido({"cm", kFilm, "--at", "0.6328"}), "0.6328 um is 632.8");
}

TEST_CASE("messages show names as they are, on one short line", "[cli][refused]") {
    const Outcome controls = run_irido({"spectrum", "a\x1B[31m\n\x7F.json"});
    CHECK(controls.err ==
          "irido: error: a\\x1B[31m\\n\\x7F.json: cannot be read: No such file or directory\n");
    check_refused(run_irido({"spectrum", "\xE2\x80\xAEx\xFF\xC3\xA9.json"}),
                  "\\u202Ex\\xFF\xC3\xA9.json: cannot be read");
    std::string layers;
    for (int i = 0; i < 1000; ++i) layers += "1.5@100 | ";
    const Outcome expression = run_irido({"spectrum", "air | " + layers + "1.5@x | air"});
    CHECK(expression.err.size() < 450);
    CHECK_THAT(expression.err, StartsWith("irido: error: \"air | 1.5@100") &&
                                   Contains("expected a thickness in nm, found \"x\"\n"));
    const Outcome option = run_irido({"spectrum", kFilm, "--" + std::string(5000, 'x')});
    CHECK(option.err.size() < 450);
    CHECK_THAT(option.err, Contains("(see irido spectrum --help)"));
}

TEST_CASE("convert writes stacks as JSON and as expressions", "[cli][convert]") {
    const TemporaryFolder folder;
    const std::string mirror = "air | (TiO2@58.5 | 1.46+0.1j@94.2)^10 | BK7@1mm! | air";
    const Outcome json = run_irido({"convert", mirror, "-o", "mirror.json"}, "", folder.path());
    CHECK(json.status == 0);
    const std::string written = read_file(folder / "mirror.json");
    CHECK_THAT(written, Contains("\"thickness_nm\": 1000000\n") &&
                            Contains("\"coherent\": false") && Contains("\"repeat\": 10\n"));
    CHECK(run_irido({"validate", "mirror.json"}, "", folder.path()).out == "mirror.json: ok\n");
    CHECK(run_irido({"convert", mirror}).out == written);
    CHECK(run_irido({"convert", "mirror.json", "-o", "-"}, "", folder.path()).out == written);
    const Outcome words = run_irido({"convert", "-", "-f", "expression"}, written);
    CHECK(words.out == "air | (TiO2@58.5 | 1.46+0.1i@94.2)^10 | BK7@1e+06! | air\n");
    CHECK(words.err.empty());
    const std::vector<std::string> light{"-w", "400:700:50", "-a", "0,40"};
    std::vector<std::string> ask{"spectrum", mirror}, again{"spectrum", folder / "mirror.json"};
    ask.insert(ask.end(), light.begin(), light.end());
    again.insert(again.end(), light.begin(), light.end());
    CHECK(run_irido(ask).out == run_irido(again).out);

    const Outcome lossy = run_irido({"convert", "-", "-f", "expression"},
                                    R"({"incident": 1, "substrate": 1.5, "layers": [{"material": 2,
                      "thickness_nm": 5, "thickness_sigma_nm": 1}]})");
    CHECK(lossy.out == "1 | 2@5 | 1.5\n");
    CHECK(lossy.err == "irido: note: an expression cannot hold: thickness_sigma_nm\n");
    check_refused(run_irido({"convert", mirror, "-f", "yaml"}), "--format: must be one of json");
    check_refused(run_irido({"convert", "air | 1.5@-1 | air"}), "must be in [0, 1e9]");
}

TEST_CASE("own files and named media are taken everywhere", "[cli]") {
    const TemporaryFolder folder;
    write_text(folder / "glass.csv", "nm,n\n300,1.5\n900,1.5\n");
    const auto run = [&](const std::vector<std::string>& words) {
        const Outcome outcome = run_irido(words, "", folder.path());
        CAPTURE(outcome.err);
        CHECK(outcome.status == 0);
        return outcome.out;
    };
    const std::string expected = run({"spectrum", "1 | 2@78 | 1.5", "-w", "550"});
    CHECK(run({"spectrum", "1 | 2@78 | glass.csv", "-w", "550"}) == expected);
    CHECK(run({"spectrum", "1 | 2@78 | 1", "--set", "substrate=glass.csv", "-w", "550"}) ==
          expected);
    CHECK(run({"spectrum", "1 | H@0.078um | G", "--material", "H=2", "--material", "G=glass.csv",
               "-w", "550"}) == expected);
    const std::string swept = run({"sweep", "1 | 2@78 | 1", "--vary", "substrate=glass.csv,1.5",
                                   "--compute", "spectrum", "-w", "550"});
    const auto rows = parse_csv(swept);
    REQUIRE(rows.size() == 3);
    CHECK(rows[1][4] == rows[2][4]);
    // relative file names stay valid when a stack moves to another folder
    run_shell("mkdir in out", folder.path());
    write_text(folder / "in/stack.json",
               R"({"incident": 1, "layers": [], "substrate": {"file": "../glass.csv"}})");
    run({"convert", "in/stack.json", "-o", "moved.json"});
    CHECK_THAT(read_file(folder / "moved.json"), Contains("\"file\": \"glass.csv\""));
    CHECK(run({"validate", "moved.json"}) == "moved.json: ok\n");
}
