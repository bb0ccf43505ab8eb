#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

const std::string kFilm = "1 | 1.33@400 | 1.9+1.5i";

double number(const std::string& text) {
    return std::stod(text);
}

json info(const std::string& file) {
    const Outcome outcome = run_irido({"lut", "info", file});
    REQUIRE(outcome.status == 0);
    return json::parse(outcome.out);
}

}  // namespace

// Reference rows: a 60-digit evaluation, rounded to double.
TEST_CASE("falpha agrees with a 60-digit evaluation", "[cli][lut]") {
    const auto want = parse_csv(
        "alpha,theta_i_deg,theta_d_deg,F\n"
        "0.2,20,15,1.8901438839298736\n0.2,20,45,0.2722569611850245\n"
        "0.2,20,75,0.023254638025755423\n0.2,60,15,0.07600163461048545\n"
        "0.2,60,45,0.7872043926777261\n0.2,60,75,0.33354570223087154\n");
    const auto got = parse_csv(run_irido({"lut", "falpha", "--alpha", "0.2", "--theta-i", "20,60",
                                          "--theta-d", "15,45,75", "--dtype", "f64"})
                                   .out);
    REQUIRE(got.size() == want.size());
    CHECK(got[0] == want[0]);
    for (std::size_t row = 1; row < want.size(); ++row) {
        for (const std::size_t c : {0U, 1U, 2U}) CHECK(got[row][c] == want[row][c]);
        CHECK(std::abs(number(got[row][3]) / number(want[row][3]) - 1) < 1e-13);
    }
}

TEST_CASE("falpha covers 0:89.75:0.25 by default", "[cli][lut]") {
    const auto rows = parse_csv(run_irido({"lut", "falpha"}).out);
    REQUIRE(rows.size() == 360 * 360 + 1);
    CHECK(rows[1] == std::vector<std::string>{"0.1", "0", "0", "0"});
    CHECK(rows[2][2] == "0.25");
    CHECK(rows.back()[1] == "89.75");
}

TEST_CASE("transmissivity has the columns of the contract", "[cli][lut]") {
    const auto rows =
        parse_csv(run_irido({"lut", "transmissivity", "1 | (1@250 | 1.5@250)^10 | 1", "--alpha",
                             "0.1", "--theta-i", "0,40", "-w", "500,600", "--dtype", "f64"})
                      .out);
    REQUIRE(rows.size() == 5);
    CHECK(rows[0] == std::vector<std::string>{"alpha", "theta_i_deg", "wavelength_nm", "ft_cos"});
    CHECK(rows[4][1] == "40");
    CHECK(rows[4][2] == "600");
}

TEST_CASE("samples of a colour table are irido color's", "[cli][lut]") {
    const auto table =
        parse_csv(run_irido({"lut", "color", kFilm, "--vary", "layers.0.thickness_nm=100,300",
                             "--theta", "0,60", "--dtype", "f64"})
                      .out);
    REQUIRE(table.size() == 5);
    CHECK(table[0] ==
          std::vector<std::string>{"theta_deg", "layers.0.thickness_nm", "R", "G", "B"});
    for (std::size_t row = 1; row < table.size(); ++row) {
        const auto color = parse_csv(run_irido({"color", kFilm, "-a", table[row][0], "--set",
                                                "layers.0.thickness_nm=" + table[row][1]})
                                         .out);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(std::abs(number(table[row][2 + c]) - number(color[1][7 + c])) < 5e-6);
    }
}

TEST_CASE("the space xyz gives X, Y and Z as irido color prints them", "[cli][lut]") {
    const auto table = parse_csv(run_irido({"lut", "color", kFilm, "--theta", "30", "--space",
                                            "xyz", "--illuminant", "A", "--dtype", "f64"})
                                     .out);
    const auto color = parse_csv(run_irido({"color", kFilm, "-a", "30", "--illuminant", "A"}).out);
    REQUIRE(table.size() == 2);
    CHECK(table[0] == std::vector<std::string>{"theta_deg", "X", "Y", "Z"});
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::abs(number(table[1][1 + c]) - number(color[1][2 + c])) < 2e-6);
}

TEST_CASE("sensitivity at a path of 0 is the white, cumulative ends there", "[cli][lut]") {
    const auto h = parse_csv(
        run_irido({"lut", "sensitivity", "--opd", "0,550", "--sigma", "0,50", "--dtype", "f64"})
            .out);
    REQUIRE(h.size() == 5);
    CHECK(h[0] == std::vector<std::string>{"opd_sigma_nm", "opd_nm", "X_re", "Y_re", "Z_re", "X_im",
                                           "Y_im", "Z_im"});
    CHECK(std::abs(number(h[1][3]) - 1) < 1e-12);
    CHECK(number(h[1][6]) == Approx(0).margin(1e-12));
    // at one wavelength, 550 nm, Y is nearly in phase; a standard deviation of 50 nm reduces it
    CHECK(number(h[2][3]) > 0.7);
    CHECK(number(h[4][3]) < 0.9 * number(h[2][3]));
    const auto sums =
        parse_csv(run_irido({"lut", "cumulative", "-w", "360,550,830", "--dtype", "f64"}).out);
    REQUIRE(sums.size() == 4);
    CHECK(sums[1] == std::vector<std::string>{"360", "0", "0", "0"});
    CHECK(std::abs(number(sums[3][2]) - 1) < 1e-12);
}

// The same noise as in the test of PerlinNoise, from its definition at (0.5, 0.5, 0).
TEST_CASE("lut thickness is noise between two thicknesses", "[cli][lut]") {
    TemporaryFolder folder;
    const auto rows =
        parse_csv(run_irido({"lut", "thickness", "--noise-scale", "1", "--range", "100:800", "--u",
                             "0,0.5,1", "--v", "0,0.5", "--dtype", "f64"})
                      .out);
    REQUIRE(rows.size() == 7);
    CHECK(rows[0] == std::vector<std::string>{"u", "v", "thickness_nm"});
    CHECK(rows[1] == std::vector<std::string>{"0", "0", "450"});
    CHECK(rows[2][1] == "0.5");
    CHECK(rows[4] == std::vector<std::string>{"0.5", "0.5", "362.5"});
    CHECK(rows[5] == std::vector<std::string>{"1", "0", "450"});
    for (const std::string name : {"a.npy", "a.exr", "a.ktx2", "a.bin", "a.png"}) {
        INFO(name);
        REQUIRE(run_irido({"lut", "thickness", "--size", "32", "--seed", "3", "--octaves", "2",
                           "--dtype", "f32", "-o", folder / name})
                    .status == 0);
        if (name == "a.png") continue;
        CHECK(run_irido({"lut", "check", folder / name}).status == 0);
        const json made = info(folder / name);
        CHECK(
            made["request"] ==
            json{{"noise_scale", 4.0}, {"octaves", 2}, {"seed", 3}, {"range_nm", {100.0, 1000.0}}});
    }
    const auto refused = [](const std::vector<std::string>& more, const std::string& error) {
        std::vector<std::string> words{"lut", "thickness"};
        words.insert(words.end(), more.begin(), more.end());
        check_refused(run_irido(words), error);
    };
    refused({"--range", "800:100"}, "--range: must be LO:HI, LO not above HI");
    refused({"--range", "100"}, "--range: must be LO:HI");
    refused({"--range", "-1:5"}, "--range: must be in [0, 1e+09]");
    refused({"--octaves", "17"}, "--octaves: must be in [1, 16] (got 17)");
    refused({"--seed", "nan"}, "--seed");
    refused({"--noise-scale", "-1"}, "--noise-scale: must be in [0, 1e+06]");
}

TEST_CASE("carrier and table give back the sensitivity", "[cli][lut]") {
    TemporaryFolder folder;
    const std::string file = folder / "h.npy";
    REQUIRE(run_irido({"lut", "sensitivity", "--carrier", "--opd", "0,1234", "--dtype", "f64", "-o",
                       folder / "h.csv"})
                .status == 0);
    const json carrier = info(folder / "h.csv")["request"]["carrier_nm"];
    const auto with = parse_csv(read_file(folder / "h.csv"));
    const auto plain =
        parse_csv(run_irido({"lut", "sensitivity", "--opd", "0,1234", "--dtype", "f64"}).out);
    for (std::size_t j = 0; j < 3; ++j) {
        const double turn = 2 * std::numbers::pi * 1234 / carrier[j].get<double>();
        const double re = number(with[2][2 + j]), im = number(with[2][5 + j]);
        CHECK(std::abs(re * std::cos(turn) - im * std::sin(turn) - number(plain[2][2 + j])) <
              1e-11);
        CHECK(std::abs(re * std::sin(turn) + im * std::cos(turn) - number(plain[2][5 + j])) <
              1e-11);
    }
}

TEST_CASE("a tolerance is kept by the smallest power of two", "[cli][lut][slow]") {
    TemporaryFolder folder;
    const std::vector<std::string> request{"lut", "color", kFilm, "--vary",
                                           "layers.0.thickness_nm=0:1000/2"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> all = request;
        all.insert(all.end(), more.begin(), more.end());
        return run_irido(all);
    };
    REQUIRE(with({"--tolerance", "1", "-o", folder / "fit.npy"}).status == 0);
    const json fit = info(folder / "fit.npy");
    CHECK(fit["error"]["value"].get<double>() <= 1);
    const int rows = fit["axes"][0]["count"], columns = fit["axes"][1]["count"];
    for (const auto& [r, c] : {std::pair{rows / 2, columns}, {rows, columns / 2}}) {
        REQUIRE(
            with({"--size", std::to_string(r) + "x" + std::to_string(c), "-o", folder / "half.npy"})
                .status == 0);
        CHECK(info(folder / "half.npy")["error"]["value"].get<double>() > 1);
    }
    REQUIRE(with({"--tolerance", "1", "--any-size", "-o", folder / "any.npy"}).status == 0);
    const json any = info(folder / "any.npy");
    CHECK(any["axes"][0]["count"].get<int>() * any["axes"][1]["count"].get<int>() < rows * columns);
}

TEST_CASE("the stated error is what interpolation is off by", "[cli][lut]") {
    TemporaryFolder folder;
    REQUIRE(run_irido(
                {"lut", "cumulative", "-w", "360:830/64", "--dtype", "f64", "-o", folder / "c.csv"})
                .status == 0);
    const auto table = parse_csv(read_file(folder / "c.csv"));
    const auto exact =
        parse_csv(run_irido({"lut", "cumulative", "-w", "360:830/631", "--dtype", "f64"}).out);
    double worst = 0;
    for (std::size_t i = 1; i < exact.size(); ++i) {
        const double x = static_cast<double>(i - 1) / 10;
        const auto low = std::min<std::size_t>(static_cast<std::size_t>(x), 62);
        for (std::size_t c = 1; c < 4; ++c) {
            const double w = x - static_cast<double>(low);
            const double line = (1 - w) * number(table[low + 1][c]) + w * number(table[low + 2][c]);
            worst = std::max(worst, std::abs(line - number(exact[i][c])));
        }
    }
    const double stated = info(folder / "c.csv")["error"]["value"];
    CHECK(worst <= stated * 1.01);
    CHECK(worst > stated * 0.9);
}

TEST_CASE("fringes that are gone end a table early, and it says so", "[cli][lut][slow]") {
    TemporaryFolder folder;
    const Outcome outcome =
        run_irido({"lut", "color", "1 | 1.5@400 | 1.9+1.5i", "--theta", "0:60/8", "--vary",
                   "layers.0.thickness_nm=0:100000/8", "--tolerance", "1", "-o", folder / "t.npy"});
    REQUIRE(outcome.status == 0);
    CHECK_THAT(outcome.err,
               Contains("layers.0.thickness_nm: no fringes are left, constant beyond "));
    const json axis = info(folder / "t.npy")["axes"][1];
    CHECK(axis["last"].get<double>() < 30000);
    // the same for the thickness itself, once all of it is that thick
    const Outcome thick = run_irido({"lut", "color", "1 | 1.5@400 | 1.9+1.5i", "--theta", "0:60/8",
                                     "--vary", "layers.0.thickness_nm=60000:100000/8",
                                     "--tolerance", "1", "-o", folder / "u.npy"});
    REQUIRE(thick.status == 0);
    CHECK(info(folder / "u.npy")["axes"][1]["count"] == 1);
}

TEST_CASE("tables have the same bytes from run to run and thread to thread", "[cli][lut][slow]") {
    TemporaryFolder folder;
    for (const std::string format : {"csv", "npy", "bin", "ktx2", "exr"}) {
        std::vector<std::string> bytes;
        for (const std::string threads : {"1", "2", "5"}) {
            const std::string file = folder / (threads + "." + format);
            REQUIRE(run_irido({"lut", "color", kFilm, "--vary", "layers.0.thickness_nm=0:500/32",
                               "--cos", "0:1/16", "-j", threads, "-o", file})
                        .status == 0);
            bytes.push_back(read_file(file));
            CHECK(run_irido({"lut", "check", file}).out == file + ": ok\n");
        }
        CHECK(bytes[0] == bytes[1]);
        CHECK(bytes[0] == bytes[2]);
    }
}

TEST_CASE("textures that no GPU takes are noted", "[cli][lut]") {
    TemporaryFolder folder;
    const auto said = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"lut", "color", "1 | 1.33@400 | 1", "-o",
                                           folder / "t.ktx2"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run_irido(arguments);
        CHECK(outcome.status == 0);
        return outcome.err;
    };
    const std::string vary = "layers.0.thickness_nm=0:100/";
    CHECK_THAT(said({"--cos", "1", "--vary", vary + "16385"}),
               Contains("layers.0.thickness_nm: 16385 texels; most GPUs take at most 16384\n"));
    CHECK_THAT(said({"--cos", "0.5,1", "--vary", vary + "16384"}), !Contains("GPUs"));
}

TEST_CASE("no path and no thread count get into a file", "[cli][lut]") {
    TemporaryFolder folder;
    const std::string stack = IRIDO_SOURCE_DIR "/schemas/examples/soap-bubble.json";
    REQUIRE(run_irido({"lut", "color", stack, "-j", "3", "-o", folder / "t.ktx2"}).status == 0);
    const std::string text = info(folder / "t.ktx2").dump();
    CHECK(text.find("/") == std::string::npos);
    CHECK(text.find("thread") == std::string::npos);
    CHECK_THAT(text, Contains("\"stack\":{"));
}

TEST_CASE("check finds what was altered, truncated or foreign", "[cli][lut]") {
    TemporaryFolder folder;
    for (const std::string format : {"npy", "bin", "ktx2", "exr"}) {
        const std::string file = folder / ("t." + format);
        REQUIRE(run_irido({"lut", "cumulative", "-o", file}).status == 0);
        const std::string bytes = read_file(file);
        std::string altered = bytes;
        altered[altered.size() - 30] = static_cast<char>(altered[altered.size() - 30] ^ 0x11);
        for (const std::string& text : {altered, bytes.substr(0, bytes.size() / 2),
                                        std::string("hello, world"), std::string()}) {
            write_text(file, text);
            const Outcome outcome = run_irido({"lut", "check", file});
            CAPTURE(format, text.size());
            CHECK(outcome.status == 1);
            CHECK_THAT(outcome.out, StartsWith(file + ": "));
            CHECK(outcome.out.find(file, 1) == std::string::npos);
            CHECK(outcome.out.find(": ok") == std::string::npos);
        }
    }
}

TEST_CASE("metadata that was edited is found", "[cli][lut]") {
    TemporaryFolder folder;
    const std::string file = folder / "t.npy";
    REQUIRE(run_irido({"lut", "cumulative", "-o", file}).status == 0);
    std::string text = read_file(file + ".json");
    const std::string from = "\"illuminant\":\"D65\"";
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), "\"illuminant\":\"A\"");
    write_text(file + ".json", text);
    const Outcome outcome = run_irido({"lut", "check", file});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Contains("the metadata was modified"));
}

TEST_CASE("check goes on past a file that is not there", "[cli][lut]") {
    TemporaryFolder folder;
    REQUIRE(run_irido({"lut", "cumulative", "-o", folder / "a.npy"}).status == 0);
    const Outcome outcome =
        run_irido({"lut", "check", folder / "a.npy", folder / "none.npy", folder / "a.npy"});
    CHECK(outcome.status == 2);
    const std::string ok = (folder / "a.npy") + ": ok\n";
    CHECK(outcome.out == ok + ok);
    CHECK_THAT(outcome.err, Contains("none.npy"));
}

TEST_CASE("tables of stacks that amplify pass their check", "[cli][lut]") {
    TemporaryFolder folder;
    REQUIRE(
        run_irido({"lut", "color", "1 | 1.33-0.1i@400 | 1.5", "--vary",
                   "layers.0.thickness_nm=0:2000/16", "--theta", "0:60/4", "-o", folder / "a.npy"})
            .status == 0);
    CHECK(run_irido({"lut", "check", folder / "a.npy"}).status == 0);
}

TEST_CASE("a mirror that reflects nothing has no colour", "[cli][color]") {
    const auto rows = parse_csv(run_irido({"color", "1 | (1@60 | 1@94)^1000 | 1"}).out);
    for (std::size_t c = 2; c < 5; ++c) {
        CHECK(number(rows[1][c]) >= 0);
        CHECK(number(rows[1][c]) < 1e-6);
    }
}

TEST_CASE("values that were edited are found", "[cli][lut]") {
    TemporaryFolder folder;
    const std::string file = folder / "f.csv";
    REQUIRE(run_irido({"lut", "falpha", "--alpha", "0.3", "--theta-i", "10,20", "--theta-d",
                       "0:89:1", "--dtype", "f64", "-o", file})
                .status == 0);
    CHECK(run_irido({"lut", "check", file}).status == 0);
    std::string doubled = "alpha,theta_i_deg,theta_d_deg,F\n";
    for (const auto& row : parse_csv(read_file(file)))
        if (row[0] != "alpha")
            doubled += row[0] + "," + row[1] + "," + row[2] + "," +
                       std::to_string(2 * number(row[3])) + "\n";
    write_text(file, doubled);
    const Outcome outcome = run_irido({"lut", "check", file});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Contains("checksum"));
}

TEST_CASE("tables that cannot be are refused", "[cli][lut]") {
    TemporaryFolder folder;
    const std::string vary = "layers.0.thickness_nm=0:100/8";
    check_refused(run_irido({"lut", "colour", kFilm}), "unknown command 'colour'");
    check_refused(run_irido({"lut", "color", kFilm, "--vary", "layers.0.thickness_nm"}),
                  "--vary: must be PATH=LIST");
    check_refused(run_irido({"lut", "color", kFilm, "--vary", "layers.0.thickness_nm=-5:5/3"}),
                  "/layers/0/thickness_nm: must be in [0, 1e9] (got -5)");
    check_refused(run_irido({"lut", "color", kFilm, "--vary", "layers.3.thickness_nm=1,2"}),
                  "layers.3");
    check_refused(run_irido({"lut", "color", kFilm, "--vary", vary, "--side", "R,T"}),
                  "--side: must be R or T for a table");
    check_refused(run_irido({"lut", "color", kFilm, "--cos", "0:1.5/4"}), "--cos: ");
    check_refused(run_irido({"lut", "falpha", "--alpha", "0"}), "--alpha: must be in [1e-04, 1]");
    check_refused(run_irido({"lut", "falpha", "--dtype", "f8"}), "--dtype: must be one of");
    check_refused(run_irido({"lut", "falpha", "--size", "0x3x3"}), "--size: ");
    check_refused(run_irido({"lut", "falpha", "--size", "3x3", "--theta-i", "0,10"}),
                  "must have one number for each of the 3 axes");
    check_refused(run_irido({"lut", "falpha", "-o", folder / "x.gif"}),
                  "--output: the extension must be one of");
    check_refused(run_irido({"lut", "cumulative", "--dtype", "f64", "-o", folder / "x.ktx2"}),
                  "f64");
    check_refused(run_irido({"lut", "sensitivity", "--real", "--carrier"}),
                  "--real cannot be combined with --carrier");
    check_refused(run_irido({"lut", "shader", "colour"}), "must be one of");
    check_refused(run_irido({"lut", "falpha", "-f", "exr", "-o", folder / "x.ktx2"}),
                  "exr contradicts the extension .ktx2");
    check_refused(run_irido({"lut", "falpha", "--any-size"}), "--any-size: ");
    check_refused(run_irido({"lut", "color", kFilm, "--cos", "0,1", "--theta", "0,9"}),
                  "--theta: cannot be combined with --cos");
    check_refused(run_irido({"lut", "color", kFilm, "--vary", vary, "--sigma", "5,0"}),
                  "sigma must ascend");
    check_refused(run_irido({"lut", "info", folder / "none.ktx2"}), "none.ktx2");
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("a tolerance that no size meets is exit status 1", "[cli][lut]") {
    TemporaryFolder folder;
    const Outcome outcome =
        run_irido({"lut", "color", "1 | 1.33@400 | 1", "--vary", "layers.0.thickness_nm=0:100/8",
                   "--tolerance", "0.01", "-o", folder / "t.npy"});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Contains("the function is too steep at cos_theta"));
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("list and shader come from the registries", "[cli][lut]") {
    const std::string list = run_irido({"lut", "list"}).out;
    for (const std::string kind :
         {"albedo", "color", "cumulative", "falpha", "sensitivity", "transmissivity"}) {
        CHECK_THAT(list, Contains("\n" + kind + ","));
        CHECK_THAT(run_irido({"lut", "--help"}).out, Contains("  " + kind + " "));
        const std::string glsl = run_irido({"lut", "shader", kind}).out;
        CHECK_THAT(glsl, Contains("MIT-0") && Contains("irido_"));
        CHECK(glsl.find("float3") == std::string::npos);
        CHECK_THAT(run_irido({"lut", "shader", "--language", "hlsl", kind}).out, !Contains("vec3"));
    }
}

TEST_CASE("a remapped film vanishes where it is thin", "[cli][lut]") {
    const auto at = [](const std::string& film, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"lut",     "color", film,      "--cos", "1,0.5",
                                           "--space", "xyz",   "--dtype", "f64"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = done(arguments);
        std::vector<double> values;
        for (const auto& row : parse_csv(outcome.out))
            if (row != parse_csv(outcome.out).front())
                for (std::size_t c = row.size() - 3; c < row.size(); ++c)
                    values.push_back(number(row[c]));
        return values;
    };
    const auto equal = [](const std::vector<double>& a, const std::vector<double>& b) {
        REQUIRE(a.size() == b.size());
        for (std::size_t k = 0; k < a.size(); ++k) CHECK(std::abs(a[k] - b[k]) < 2e-6);
    };
    const std::string nothing = "1 | 1.5@0 | 1.9+1.5i", thin = "1 | 1.5@5 | 1.9+1.5i";
    const std::string thick = "1 | 1.5@10 | 1.9+1.5i";
    const std::vector<std::string> remap{"--remap-index", "30"};
    equal(at(nothing, remap), at("1 | 1.9+1.5i", {}));
    equal(at(thick, remap), at(thick, {}));  // 2 n d is 30 nm
    // t = 1/2: halfway between the indices
    equal(at(thin, remap), at("1 | 1.25@5 | 1.9+1.5i", {}));
    check_refused(run_irido({"lut", "color", "1 | 1.5@5 | 1.2@5 | 1", "--remap-index", "30"}),
                  "one film");
}
