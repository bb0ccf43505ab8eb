#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tables/pictures/rendered.hpp"
#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Contains;
using Catch::Matchers::WithinAbs;

namespace {

const std::string kFilm = "air | 1.38@420 | 1.9+1.5i";

Outcome render(std::vector<std::string> more, const std::string& stack = kFilm) {
    more.insert(more.begin(), {"render", stack});
    return run_irido(more);
}

irido::EnvironmentImage exr(const std::string& path) {
    return irido::tables::environment_from_exr(read_file(path));
}

}  // namespace

TEST_CASE("a pixel is the colour that irido color prints", "[cli][render]") {
    TemporaryFolder folder;
    const auto check = [&](const std::vector<std::string>& more, double tolerance) {
        std::vector<std::string> words{"--environment", "white", "--size",
                                       "80,40",         "-o",    folder / "x.exr"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = render(words);
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        const auto image = exr(folder / "x.exr");
        for (const std::size_t x : {24U, 30U, 38U, 50U, 54U}) {
            const double r = std::hypot(static_cast<double>(x) + 0.5 - 40, 12.5 - 20) / 18;
            const std::string angle = std::to_string(std::asin(r) * 180 / std::numbers::pi);
            const auto rows = parse_csv(run_irido({"color", kFilm, "-a", angle}).out);
            for (std::size_t c = 0; c < 3; ++c)
                CHECK_THAT(static_cast<double>(image.rgb[(12 * 80 + x) * 3 + c]),
                           WithinAbs(std::stod(rows[1][7 + c]), tolerance));
        }
    };
    check({"--exact"}, 2e-6);
    check({}, 1e-4);
    check({"--thickness-noise", "420:420,3,1"}, 1e-4);
}

TEST_CASE("a tilted plane has one colour; exposure doubles it", "[cli][render]") {
    TemporaryFolder folder;
    REQUIRE(render({"--shape", "plane", "--tilt", "40", "--environment", "white", "--size", "16,8",
                    "--exposure", "1", "-o", folder / "x.exr"})
                .status == 0);
    const auto image = exr(folder / "x.exr");
    const auto rows = parse_csv(run_irido({"color", kFilm, "-a", "40"}).out);
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
        REQUIRE_THAT(static_cast<double>(image.rgb[i]),
                     WithinAbs(2 * std::stod(rows[1][7 + i % 3]), 2e-5));
}

TEST_CASE("an environment from a file lights the picture", "[cli][render]") {
    TemporaryFolder folder;
    irido::Picture light{64, 32, {}};
    for (std::size_t i = 0; i < 64 * 32; ++i) light.rgba.insert(light.rgba.end(), {2, 1, 0.5F, 1});
    write_text(folder / "light.exr", irido::tables::exr_file(light, "{}"));
    const std::vector<std::string> common{"--size", "32,16", "--shape", "plane"};
    const auto draw = [&](const std::string& environment, const std::string& file) {
        std::vector<std::string> words = common;
        words.insert(words.end(), {"--environment", environment, "-o", file});
        REQUIRE(render(words).status == 0);
        return exr(file);
    };
    const auto lit = draw(folder / "light.exr", folder / "a.exr");
    const auto white = draw("white", folder / "b.exr");
    for (std::size_t i = 0; i < white.rgb.size(); i += 3)
        for (std::size_t c = 0; c < 3; ++c)
            REQUIRE(lit.rgb[i + c] == Approx(white.rgb[i + c] * (c == 0 ? 2 : c == 1 ? 1 : 0.5)));
    CHECK_THAT(read_file(folder / "a.exr"), Contains("sha256:") && !Contains("light.exr"));
    check_refused(
        render({"--environment", folder / "b.exr", "--size", "8", "-o", folder / "b.exr"}),
        "b.exr");
}

TEST_CASE("pictures have the same bytes for every number of threads", "[cli][render]") {
    TemporaryFolder folder;
    const auto bytes = [&](const std::string& threads, const std::string& name) {
        REQUIRE(run_irido({"render", "air | 1.33@400 | air", "--shape", "bubble", "--size", "64",
                           "--thickness-noise", "100:800,3,1", "--samples", "3", "--seed", "9",
                           "-j", threads, "-o", folder / name})
                    .status == 0);
        return read_file(folder / name);
    };
    const std::string one = bytes("1", "a.png");
    CHECK(one == bytes("5", "b.png"));
    CHECK(bytes("1", "c.exr") == bytes("4", "d.exr"));
    CHECK_THAT(one, Contains("irido.metadata"));
}

TEST_CASE("statistics say how colours were computed, and what was skipped", "[cli][render]") {
    TemporaryFolder folder;
    const auto stats = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--size", "64", "--stats", "-o", folder / "x.png"});
        return render(more).err;
    };
    CHECK_THAT(stats({}), Contains("places where light meets the stack, angles ") &&
                              Contains("colours from a table of ") &&
                              Contains("skipped: what the stack transmits") &&
                              Contains("skipped: the axis of thickness"));
    CHECK_THAT(stats({"--exact"}), Contains("colours computed one by one: asked for"));
    CHECK_THAT(stats({"--thickness-noise", "100:5000,3,1"}),
               Contains("a table would have more colours than the picture"));
}

TEST_CASE("a contact sheet has a labelled picture for every value", "[cli][render]") {
    TemporaryFolder folder;
    const Outcome outcome =
        render({"--vary", "layers.0.thickness_nm=100,200,300", "--vary", "substrate=Si,Au",
                "--size", "40", "--bits", "16", "-o", folder / "sheet.png"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const std::string png = read_file(folder / "sheet.png");
    const auto number = [&](std::size_t at) {
        unsigned value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = 256 * value + static_cast<unsigned char>(png[at + i]);
        return value;
    };
    CHECK(number(16) == 8 + 2 * 48);  // width: two columns of the last varied value
    CHECK(number(20) == 8 + 3 * 70);  // height: three rows, each with its label
    CHECK(png[24] == 16);
    check_refused(render({"--vary", "layers.0.thickness_nm=1,2", "-o", folder / "x.exr"}),
                  "--vary: a contact sheet must be .png");
    check_refused(render({"--vary", "alpha=0.05,2", "-o", folder / "x.png"}),
                  "--vary alpha: must be in [0.0001, 1] (got 2)");
    check_refused(render({"--vary", "alpha=0.05,0.1", "--shape", "bubble", "-o", folder / "x.png"}),
                  "--vary alpha: only spheres, planes and rings can be rough");
    check_refused(render({"--vary", "angle_deg=0,10", "-o", folder / "x.png"}),
                  "angle_deg is not a value of the stack");
    CHECK(render({"--vary", "alpha=0.05,0.1", "--samples", "4", "--size", "16", "-o",
                  folder / "rough.png"})
              .status == 0);
    check_refused(render({"--vary", "layers.7.thickness_nm=1,2", "-o", folder / "x.png"}),
                  "layers.7");
}

TEST_CASE("render refuses what it cannot draw, and writes nothing", "[cli][render][slow]") {
    TemporaryFolder folder;
    const std::string file = folder / "x.png";
    const auto refused = [&](std::vector<std::string> more, const std::string& error,
                             const std::string& stack = kFilm) {
        more.insert(more.end(), {"-o", file});
        check_refused(render(more, stack), error);
        CHECK_FALSE(std::filesystem::exists(file));
    };
    check_refused(render({}), "--output: must name a picture, .png or .exr");
    check_refused(render({"-o", folder / "x.jpg"}), "must be one of png, exr (got 'jpg')");
    check_refused(render({"-o", folder / "no/x.png"}), "cannot be written");
    refused({"--size", "0"}, "--size: must be in [1, 8192] (got 0)");
    refused({"--size", "100,1e6"}, "--size: must be in [1, 8192] (got 1e+06)");
    refused({"--size", "1,2,3"}, "--size: must be W,H");
    refused({"--shape", "cube"}, "--shape: must be one of sphere, bubble, plane, ring, gem");
    refused({"--shape", "gem"}, "a gem must be transparent, |k| of the substrate below 1e-3");
    refused({"--shape", "bubble"}, "a bubble has the same medium inside as outside");
    refused({"--environment", "cave"}, "--environment: must be one of studio, sky, white");
    refused({"--environment", folder / "none.exr"}, "none.exr");
    refused({"--camera", "fisheye"}, "--camera: must be one of orthographic, perspective");
    refused({"--background", "red"}, "--background: must be one of none, environment, #rrggbb");
    refused({"--background", "#12345g"}, "--background");
    refused({"--thickness-noise", "800:100,3,1"},
            "--thickness-noise: must be LO:HI, LO not above HI");
    refused({"--thickness-noise", "1:2,3,4,5"}, "--thickness-noise: must be LO:HI,SCALE,SEED");
    refused({"--thickness-noise", "1:nan"}, "--thickness-noise");
    refused({"--thickness-noise", "1:2", "--noise-layer", "2"}, "the stack has no layer 2");
    refused({"--samples", "0"}, "--samples: must be in [1, 65536]");
    refused({"--alpha", "0"}, "--alpha: must be in [1e-04, 1] (got 0)");
    refused({"--alpha", "0.1", "--shape", "gem"}, "--alpha: a rough gem cannot be drawn");
    refused({"--environment", "none"}, "--environment none: requires a --light");
    refused({"--floor", "2"}, "--floor: must be in [0, 1] (got 2)");
    refused({"--floor", "#12"}, "--floor: must be an albedo or #rrggbb");
    refused({"--floor", "1", "--shape", "plane"}, "--floor: a plane fills the picture");
    refused({"--floor", "1", "--exact"}, "--exact: light that is scattered, lamps and floors");
    refused({"--paths", "simulation"}, "--paths: must be one of single, all (got 'simulation')");
    refused({"--light", "{"}, "light: 1:2");
    refused({"--light", "{}"}, "center");
    refused({"--light", R"({"directoin": [0, 0, 1]})"},
            "light: /directoin: unknown key (did you mean \"direction\"?)");
    refused({"--light", R"([{"center": [0, 0, 3], "radius": 1}, {"vertice": []}])"},
            "light: /1/vertice: unknown key (did you mean \"vertices\"?)");
    refused({"--light", R"({"direction": [0, 0, 1], "iradiance": 1})"},
            "/iradiance: unknown key (did you mean \"irradiance\"?)");
    refused({"--light", folder / "none.json"}, "none.json");
    refused({"--light", R"({"direction": [0, 0, 0]})"}, "direction must not be zero");
    refused({"--light", R"({"direction": [0, 0, 1], "radiance": 1})"}, "/radiance");
    refused({"--light", R"({"center": [0, 0, 3], "radius": -1})"}, "/radius: must be in");
    refused({"--light", R"({"vertices": [[0, 0, 1], [1, 0, 1], [2, 0, 1]]})"}, "one line");
    refused({"--light", R"({"direction": [0, 0, 1], "illuminant": "D66"})"}, "D66");
    const std::string inside = R"({"center": [0.1, 0, 0], "radius": 0.5})",
                      below = R"({"center": [0, -3, 0], "radius": 1})",
                      behind = R"({"vertices": [[0, 0, -1], [1, 0, -1], [0, 1, -1]]})",
                      tube = R"({"center": [0.7, 0, 0], "radius": 0.2})";
    const std::string bright = R"({"direction": [0, 0, 1]})";
    refused({"--light", bright, "--light", inside},
            "--light: lamp 2 lies inside the sphere, which");
    refused({"--light", tube, "--shape", "ring"}, "--light: lamp 1 lies inside the ring, which");
    refused({"--light", behind, "--shape", "plane"},
            "--light: lamp 1 lies behind the plane, which");
    refused({"--light", below, "--floor", "1"}, "--light: lamp 1 lies below the floor, which");
    refused({"--show", "beetle"}, "--show: takes a scene");
    refused({"--exposure", "nan"}, "--exposure");
    refused({"--tolerance", "0"}, "--tolerance: must be in [0.001, 10]");
    refused({"--bits", "12"}, "--bits: must be 8 or 16");
    refused({"--illuminant", "D66"}, "D66");
    const auto document = [&](const std::string& text, const std::string& error) {
        write_text(folder / "document.json", text);
        refused({}, error, folder / "document.json");
    };
    document(R"({"inside": 1.35, "layers": [{"stack": "1 | 2@3 | 1", "alpha": 0.1}]})",
             "/layers/0/stack");
    document(
        R"({"scratches": [{"width_um": 1, "depth_um": 0.1, "angle_deg": 0, "point_um": [0, 0]}]})",
        "scratches are drawn as fields");
    document(R"({"materials": {"a": {"stack": "s.json"}}})",
             "/materials: must be an array of 1 to 10000 materials");
    document(R"({"materials": []})", "/materials: must be an array of 1 to 10000 materials");
    const std::string coated =
        R"({"inside": 1.35, "layers": [{"stack": "1.35 | 1.5@300 | 1.35", "alpha": 0.1}],
            "base": {"albedo": 0.5}})";
    write_text(folder / "coated.json", coated);
    refused({"--shape", "gem"}, "drawn on a sphere, a plane or a ring", folder / "coated.json");
    refused({"--alpha", "0.2"}, "a surface document has its own roughness", folder / "coated.json");
    refused({"--paths", "all"}, "--paths all can be drawn for one layer without a coating",
            folder / "coated.json");
    refused({"--thickness-noise", "1:2"}, "--thickness-noise: takes a stack",
            folder / "coated.json");
    refused({"--vary", "alpha=0.1,0.2"}, "--vary alpha: a surface document has its own",
            folder / "coated.json");
    irido::Picture square{8, 8, std::vector<float>(256, 1.0F)};
    write_text(folder / "square.exr", irido::tables::exr_file(square, "{}"));
    refused({"--environment", folder / "square.exr"}, "twice as wide as high");
    irido::Picture bad{8, 4, std::vector<float>(128, 1.0F)};
    bad.rgba[5] = std::numeric_limits<float>::quiet_NaN();
    write_text(folder / "bad.exr", irido::tables::exr_file(bad, "{}"));
    refused({"--environment", folder / "bad.exr"},
            "radiance must be finite and not below 0 (got nan in row 0, column 1)");
}

TEST_CASE("a surface in white surroundings has the albedo of irido brdf", "[cli][render][slow]") {
    TemporaryFolder folder;
    const std::string file = folder / "surface.json";
    const auto check = [&](const std::string& document, const std::vector<std::string>& more) {
        write_text(file, document);
        std::vector<std::string> words{"--shape",       "plane", "--tilt", "40",
                                       "--environment", "white", "--size", "16,8",
                                       "--samples",     "256",   "-o",     folder / "x.exr"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome drawn = render(words, file);
        INFO(drawn.err);
        REQUIRE(drawn.status == 0);
        const auto image = exr(folder / "x.exr");
        std::vector<std::string> asked{"brdf",          file, "--quantity", "albedo", "--color",
                                       "--light-theta", "40"};
        asked.insert(asked.end(), more.begin(), more.end());
        const auto rows = parse_csv(run_irido(asked).out);
        REQUIRE(rows.size() == 2);
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (std::size_t i = c; i < image.rgb.size(); i += 3)
                sum += static_cast<double>(image.rgb[i]);
            const double expected = std::stod(rows[1][4 + c]);
            CHECK_THAT(sum / 128, WithinAbs(expected, 0.01 * std::max(0.2, expected)));
        }
    };
    check(R"({"inside": 1.35, "layers": [{"stack": "1.35 | (1.35@250 | 1.5@250)^10 | 1.35",
              "alpha": 0.1}], "base": {"albedo": 0.5}})",
          {});
    check(R"({"layers": [{"stack": "1 | (1@125 | 1.5@375)^5 | 1", "alpha": 0.2}],
              "base": {"albedo": 0.8}})",
          {"--paths", "all"});
    check(R"({"layers": [{"stack": "1 | (1@125 | 1.5@375)^5 | 1.5", "alpha": 0.2}]})", {});
}

TEST_CASE("a scratched surface is drawn, and says what it left out", "[cli][render]") {
    TemporaryFolder folder;
    write_text(folder / "worn.json", R"({"base": "air | Ag",
        "scratches": [{"width_um": 2, "depth_um": 0.14, "angle_deg": 30, "point_um": [0, 0]}],
        "fields": [{"count_per_mm2": 40, "length_um": [200, 3000], "width_um": [1, 2],
                    "depth_um": [0.1, 0.2], "angle_deg": [-180, 180]}]})");
    const Outcome outcome =
        render({"--size", "16", "--samples", "4", "--stats", "--light",
                R"({"direction": [1, 2, 1], "irradiance": 3})", "-o", folder / "x.png"},
               folder / "worn.json");
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK_THAT(outcome.err, Contains("skipped: 1 single scratch: fields are seen on average") &&
                                Contains("balance heuristic"));
}

TEST_CASE("lamps inside a clear shape, around an opaque one or half inside are drawn",
          "[cli][render]") {
    TemporaryFolder folder;
    const auto seen = [&](const std::vector<std::string>& more, const std::string& stack) {
        std::vector<std::string> all{"--size", "8,4", "--samples", "4", "-o", folder / "x.exr"};
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = render(all, stack);
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return exr(folder / "x.exr").rgb;
    };
    const std::string inside = R"({"center": [0, 0, 0], "radius": 0.5, "radiance": 9})";
    const std::string bubble = "1 | 1.33@300 | 1";
    CHECK(
        seen({"--shape", "bubble", "--light", inside}, bubble) !=
        seen({"--shape", "bubble", "--light", R"({"center": [0, 0, -9], "radius": 0.5})"}, bubble));
    const std::string half = R"({"center": [0, 0, 1], "radius": 0.5})",
                      around = R"({"center": [0, 0, 0], "radius": 5})",
                      hole = R"({"center": [0, 0, 0], "radius": 0.2})";
    seen({"--light", half}, "1 | 2");
    seen({"--light", around}, "1 | 2");
    seen({"--light", hole, "--shape", "ring"}, "1 | 2");
}

TEST_CASE("a sheet leaves out the materials that cannot be drawn", "[cli][render]") {
    TemporaryFolder folder;
    write_text(folder / "scene.json", R"({"materials": [
        {"name": "film", "stack": "air | 1.33@300 | 1.5", "shading": "color"},
        {"name": "blade", "surface": {"scratches": [
            {"width_um": 3, "depth_um": 0.2, "angle_deg": 10, "point_um": [5, 3]}]}},
        {"name": "broken", "stack": "air | Xx@300 | 1.5", "shading": "color"}]})");
    const std::string scene = folder / "scene.json";
    const Outcome some = render({"--size", "16", "-o", folder / "x.png"}, scene);
    CHECK(some.status == 1);
    CHECK_THAT(some.err,
               Contains("scene.json: /materials/1/surface: material blade: scratches are drawn") &&
                   Contains("material broken: ") && Contains("unknown material") &&
                   Contains("scene.json: 2 of 3 materials left out\n"));
    write_text(folder / "film.json", R"({"materials": [
        {"name": "film", "stack": "air | 1.33@300 | 1.5", "shading": "color"},
        {"name": "film2", "stack": "air | 1.33@300 | 1.5", "shading": "color"}]})");
    CHECK(render({"--size", "16", "-o", folder / "y.png"}, folder / "film.json").status == 0);
    const auto width = [](const std::string& png) {
        return static_cast<unsigned char>(png[18]) * 256 + static_cast<unsigned char>(png[19]);
    };
    CHECK(width(read_file(folder / "x.png")) == 8 + 24);      // one picture
    CHECK(width(read_file(folder / "y.png")) == 8 + 2 * 24);  // two
    check_refused(render({"--size", "16", "--show", "blade", "-o", folder / "z.png"}, scene),
                  "/materials/1/surface: material blade: scratches are drawn as fields");
    CHECK_FALSE(std::filesystem::exists(folder / "z.png"));
    check_refused(render({"--size", "16", "--shape", "bubble", "-o", folder / "z.png"}, scene),
                  "material broken");
}

TEST_CASE("scenes make a sheet of their materials, or a picture of one", "[cli][render]") {
    TemporaryFolder folder;
    write_text(folder / "scene.json", R"({"materials": [
        {"name": "one", "stack": "air | 1.33@300 | 1.5", "shading": "color"},
        {"name": "two", "stack": "air | 1.33@500 | 1.5", "shading": "color"}]})");
    const std::string scene = folder / "scene.json";
    CHECK(render({"--size", "16", "-o", folder / "sheet.png"}, scene).status == 0);
    REQUIRE(render({"--size", "32,16", "--show", "two", "-o", folder / "two.exr"}, scene).status ==
            0);
    REQUIRE(render({"--size", "32,16", "-o", folder / "same.exr"}, "air | 1.33@500 | 1.5").status ==
            0);
    CHECK(exr(folder / "two.exr").rgb == exr(folder / "same.exr").rgb);
    check_refused(render({"--show", "three", "-o", folder / "x.png"}, scene),
                  "--show: must be one of one, two (got 'three')");
    check_refused(render({"-o", folder / "x.exr"}, scene), "makes a contact sheet, .png");
}

TEST_CASE("an interrupted picture leaves no file", "[cli][render]") {
    TemporaryFolder folder;
    const Outcome outcome =
        run_shell("timeout --preserve-status -s INT 0.5 \"$IRIDO\" render \"" + kFilm +
                      "\" --exact --size 4000 --thickness-noise 100:800 -o x.png; echo $?; ls",
                  folder.path());
    CHECK(outcome.out == "130\n");
}
