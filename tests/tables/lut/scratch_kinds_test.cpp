#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

using namespace irido::test;

namespace {

double value(const std::vector<std::vector<std::string>>& rows, std::size_t row,
             std::size_t column) {
    return std::stod(rows.at(row).at(column));
}

}  // namespace

// Reference rows: exact integrals in double, accurate to 1e-11.
TEST_CASE("lut scratch agrees with exact integrals", "[cli][lut]") {
    const auto rows = parse_csv(
        run_irido({"lut", "scratch", "--u", "0.731,3.2", "--depth", "0.14,0.6", "--derivative"})
            .out);
    REQUIRE(rows.size() == 5);
    CHECK(rows[0] ==
          std::vector<std::string>{"u_um", "depth_um", "X", "Y", "Z", "dX_du", "dY_du", "dZ_du"});
    CHECK(rows[1][0] == "0.731");
    CHECK(rows[1][1] == "0.14");
    const std::vector<double> first{1.6689969692542799,  1.8044583691492815,  1.7694292367590834,
                                    0.19537658982328301, 0.27214729260189374, 0.27993740835571185};
    const std::vector<double> last{0.4156353420259461,   0.6550449771428876,
                                   1.5464618010651938,   0.0014670795106226718,
                                   0.002760446885569974, 0.0058327662933414775};
    for (std::size_t c = 0; c < 6; ++c) {
        CHECK(std::abs(value(rows, 1, 2 + c) - first[c]) < 2e-11);
        CHECK(std::abs(value(rows, 4, 2 + c) - last[c]) < 2e-11);
    }
    const auto equal = parse_csv(run_irido({"lut", "scratch", "--u", "0.05", "--depth", "1.75",
                                            "--illuminant", "E", "--derivative"})
                                     .out);
    CHECK(std::abs(value(equal, 1, 2) - 0.16820487253286037) < 2e-11);
    CHECK(std::abs(value(equal, 1, 7) - 4.119631374968874) < 2e-11);
    const auto rgb = parse_csv(
        run_irido({"lut", "scratch", "--u", "0.731", "--depth", "0.14", "--space", "srgb"}).out);
    CHECK(rgb[0] == std::vector<std::string>{"u_um", "depth_um", "r", "g", "b"});
    // the identity between the forms with and without carrier
    const auto q = parse_csv(
        run_irido({"lut", "scratch", "--u", "0.731", "--depth", "0,0.14", "--carrier"}).out);
    CHECK(q[0] == std::vector<std::string>{"u_um", "depth_um", "X_re", "Y_re", "Z_re", "X_im",
                                           "Y_im", "Z_im"});
    const std::vector<double> carrier{0.575, 0.557, 0.452};
    for (std::size_t c = 0; c < 3; ++c) {
        const double turn = 4 * 3.141592653589793 * 0.14 / carrier[c];
        const double t = 2 * value(q, 1, 2 + c) - 2 * (std::cos(turn) * value(q, 2, 2 + c) -
                                                       std::sin(turn) * value(q, 2, 5 + c));
        CHECK(std::abs(t - first[c]) < 1e-11);
    }
    // taken with respect to the place, in every form, the derivative is the same
    const auto place = parse_csv(run_irido({"lut", "scratch", "--u", "0.731", "--depth", "0.14",
                                            "--per-place", "--u-scale", "1.5"})
                                     .out);
    CHECK(place[0][2] == "dX_dx");
    CHECK(std::abs(value(place, 1, 3) - first[4] * 2.231 * 2.231 / 1.5) < 1e-10);
}

TEST_CASE("tables of scratches measure their error and pass their check", "[cli][lut][slow]") {
    const TemporaryFolder folder;
    const auto made = [&](std::vector<std::string> arguments, const std::string& file) {
        arguments.insert(arguments.begin(), "lut");
        arguments.insert(arguments.end(), {"-o", folder / file, "--quiet"});
        const Outcome outcome = done(arguments);
        CHECK(run_irido({"lut", "check", folder / file}).out == folder / file + ": ok\n");
        return nlohmann::json::parse(run_irido({"lut", "info", folder / file}).out);
    };
    const auto carrier = made({"scratch", "--carrier"}, "t.ktx2");
    CHECK(carrier["axes"][0]["count"] == 256);
    CHECK(carrier["axes"][1]["count"] == 64);
    CHECK(carrier["request"]["u_scale_um"] == 2);
    CHECK(carrier["request"]["depth_scale_um"] == 1);
    CHECK(carrier["axes"][1]["last"] == 3.15);
    CHECK(carrier["error"]["value"].get<double>() < 0.5);
    CHECK(carrier["error"]["value"].get<double>() > 1e-3);
    const auto narrow = made({"scratch", "--carrier", "--per-place", "--dtype", "f16"}, "d.ktx2");
    CHECK(narrow["channels"][0] == "dX_dx_re");
    made({"scratch", "--u", "0:10/64", "--depth", "0:1/64", "--derivative"}, "plain.npy");
    const auto footprint = made({"scratch-footprint"}, "g.exr");
    CHECK(footprint["error"]["value"].get<double>() < 1e-3);
}

TEST_CASE("impossible tables of scratches are refused", "[cli][lut]") {
    const auto refused = [](std::vector<std::string> arguments, const std::string& error) {
        arguments.insert(arguments.begin(), {"lut", "scratch"});
        check_refused(run_irido(arguments), error);
    };
    refused({"--u", "-1"}, "--u");
    refused({"--u", "1,1"}, "strictly");
    refused({"--depth", "101"}, "--depth");
    refused({"--carrier", "--space", "srgb"}, "--space xyz");
    refused({"--carrier", "--derivative"}, "--derivative");
    refused({"--carrier", "--depth", "0.1,0.2"}, "begin at 0");
    refused({"--u-count", "1024"}, "u_um");
    refused({"--u-count", "8"}, "--u-count");
    refused({"--depth-max", "0"}, "--depth-max");
    refused({"--depth-scale", "nan"}, "--depth-scale");
    refused({"--space", "lab"}, "--space");
    check_refused(run_irido({"lut", "scratch-footprint", "--offset", "2"}), "--offset");
}

TEST_CASE("the footprint's table holds the mean over an ellipse", "[cli][lut]") {
    // offset |s_b|/(h + 3 sigma) and extent h/(h + sigma) of a worked case with mean 0.6763527...
    const double h = 82.97875874387034 / 60, s = 9.330127018922193 / 60;
    const auto text = [](double x) { return nlohmann::json(x).dump(); };
    const auto rows =
        parse_csv(run_irido({"lut", "scratch-footprint", "--offset", text(s / (h + 3)), "--extent",
                             text(h / (h + 1)) + ",1", "--dtype", "f64"})
                      .out);
    CHECK(rows[0] == std::vector<std::string>{"offset", "extent", "G"});
    CHECK(std::abs(value(rows, 1, 2) / (1 + h) - 0.6763527859375671) < 1e-13);
    CHECK(value(rows, 2, 2) > 1.12);
}
