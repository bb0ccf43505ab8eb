#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/support/program.hpp"

using namespace irido::test;

namespace {

using Table = std::vector<std::vector<std::string>>;

std::vector<double> column_of(const Table& table, const std::string& name) {
    const auto found = std::find(table[0].begin(), table[0].end(), name);
    REQUIRE(found != table[0].end());
    std::vector<double> values;
    for (std::size_t row = 1; row < table.size(); ++row)
        values.push_back(std::stod(table[row][static_cast<std::size_t>(found - table[0].begin())]));
    return values;
}

/// mean, sd, p5, p50, p95 by quantity, from a summary with one row per quantity.
std::map<std::string, std::vector<double>> summary_of(const Words& arguments) {
    const Table table = parse_csv(out_of(arguments));
    REQUIRE(table[0] == Words{"quantity", "mean", "sd", "p5", "p50", "p95"});
    std::map<std::string, std::vector<double>> result;
    for (std::size_t row = 1; row < table.size(); ++row)
        for (std::size_t c = 1; c < 6; ++c)
            result[table[row][0]].push_back(std::stod(table[row][c]));
    return result;
}

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Covariance: the mean product of the deviations from the means.
double covariance(const std::vector<double>& a, const std::vector<double>& b) {
    const double mean_a = mean_of(a), mean_b = mean_of(b);
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
    return sum / static_cast<double>(a.size());
}

double normal(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

const std::string kCoating = "1 | 2.3@60 | 1.46@94 | 2.3@58 | 1.46@90 | 1.52";
const Words kAt550{"--compute", "spectrum", "-w", "550"};

}  // namespace

TEST_CASE("means and standard deviations of a film's colour are those of the integral",
          "[cli][sweep][scatter]") {
    // R(550), L, a, b of 310 nm of 1.46 on 4.08 + 0.04i with 2 %, D65, 2-degree observer:
    // Gauss-Hermite with 80 nodes, to 1e-12
    const std::vector<std::string> names{"R", "L", "a", "b"};
    const std::vector<double> mean{0.17001138778055883, 49.2303480252528, -4.519009754739935,
                                   -28.017126359865237};
    const std::vector<double> sd{0.02612291864740143, 2.0506948750467764, 6.834596748864618,
                                 3.581291762587943};
    constexpr double kSamples = 10000;
    const Words scattered{"sweep",     "1 | 1.46@310 | 4.08+0.04i",
                          "--scatter", "layers.*.thickness_nm=2%",
                          "--samples", "10000",
                          "--seed",    "5"};
    std::map<std::string, std::vector<double>> values;
    values["R"] = column_of(parse_csv(out_of(scattered + kAt550)), "R");
    const Table colors =
        parse_csv(out_of(scattered + Words{"--compute", "color", "--tolerance", "1e-5"}));
    const auto x = column_of(colors, "X"), y = column_of(colors, "Y"), z = column_of(colors, "Z");
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double f_x = std::cbrt(x[i] / 0.950471), f_y = std::cbrt(y[i]),
                     f_z = std::cbrt(z[i] / 1.088829);  // all above 216/24389
        REQUIRE(std::min({x[i], y[i], z[i]}) > 0.01);
        values["L"].push_back(116 * f_y - 16);
        values["a"].push_back(500 * (f_x - f_y));
        values["b"].push_back(200 * (f_y - f_z));
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        INFO(names[i]);
        const std::vector<double>& got = values.at(names[i]);
        const double error = sd[i] / std::sqrt(kSamples);
        CHECK(std::abs(mean_of(got) - mean[i]) < 4 * error);
        CHECK(std::abs(std::sqrt(covariance(got, got)) - sd[i]) < 4 * error);  // kurtosis < 5
    }
}

TEST_CASE("a yield is the probability of the thicknesses that keep the limit",
          "[cli][sweep][scatter]") {
    // a single film: r01 and r12 have the same sign, so R rises with cos 2 phi, phi = 2 pi n
    // d/lambda
    const double n = 1.38, base = 1.52, lambda = 550, thickness = 97, sigma = 3, limit = 0.0127;
    const double r01 = (1 - n) / (1 + n), r12 = (n - base) / (n + base);
    const double squares = r01 * r01 + r12 * r12, product = r01 * r12;
    const double cosine = (limit * (1 + product * product) - squares) / (2 * product * (1 - limit));
    const double quarter = lambda / (4 * n);
    const double half_width = (M_PI - std::acos(cosine)) / 2 * lambda / (2 * M_PI * n);
    const double expected = normal((quarter + half_width - thickness) / sigma) -
                            normal((quarter - half_width - thickness) / sigma);
    REQUIRE(expected > 0.3);
    REQUIRE(expected < 0.9);
    constexpr double kSamples = 20000;
    const Words arguments{"sweep",     "1 | 1.38@97 | 1.52",
                          "--scatter", "layers.0.thickness_nm=3nm",
                          "--samples", "20000",
                          "--summary", "--limit",
                          "R<=0.0127", "--limit",
                          "T > 0.5",   "--limit",
                          "T>=0.98735"};
    const auto found = summary_of(arguments + kAt550);
    const double se = std::sqrt(expected * (1 - expected) / kSamples);
    CHECK(std::abs(found.at("R<=0.0127")[0] - expected) < 4 * se);
    CHECK(found.at("R<=0.0127")[1] ==
          Approx(std::sqrt(found.at("R<=0.0127")[0] * (1 - found.at("R<=0.0127")[0]))));
    CHECK(found.at("T>0.5")[0] == 1);
    // R + T = 1: a stricter limit than the first one
    CHECK(found.at("yield")[0] == found.at("T>=0.98735")[0]);
    CHECK(found.at("yield")[0] < found.at("R<=0.0127")[0]);
}

TEST_CASE("a summary is of the rows that the sweep would write", "[cli][sweep][scatter]") {
    const Words arguments =
        Words{"sweep", kCoating, "--scatter", "layers.*.thickness_nm=3%", "--samples", "101"} +
        kAt550;
    const std::vector<double> rows = column_of(parse_csv(out_of(arguments)), "R");
    REQUIRE(rows.size() == 101);
    std::vector<double> sorted = rows;
    std::sort(sorted.begin(), sorted.end());
    const auto found = summary_of(arguments + Words{"--summary"}).at("R");
    CHECK(found[0] == Approx(mean_of(rows)).epsilon(1e-14));
    CHECK(found[1] == Approx(std::sqrt(covariance(rows, rows))).epsilon(1e-12));
    CHECK(found[2] == sorted[5]);
    CHECK(found[3] == sorted[50]);
    CHECK(found[4] == sorted[95]);
}

TEST_CASE("a sample's row is that of its stack", "[cli][sweep][scatter]") {
    const Words query{"-w", "450:650:100", "-a", "0,50", "-p", "s,p"};
    const Table swept =
        parse_csv(out_of(Words{"sweep", kCoating, "--scatter", "layers.*.thickness_nm=2%",
                               "--scatter", "layers.1.thickness_nm=0", "--scatter",
                               "substrate=0.01", "--samples", "4", "--compute", "spectrum"} +
                         query));
    const Words names{"sample",
                      "layers.0.thickness_nm",
                      "layers.1.thickness_nm",
                      "layers.2.thickness_nm",
                      "layers.3.thickness_nm",
                      "substrate"};
    REQUIRE(Words(swept[0].begin(), swept[0].begin() + 6) == names);
    REQUIRE(swept.size() == 1 + 4 * 12);
    for (std::size_t sample = 0; sample < 4; ++sample) {
        const Words& first = swept[1 + 12 * sample];
        CHECK(first[0] == std::to_string(sample + 1));
        CHECK(first[2] == "94");
        Words arguments = Words{"spectrum", kCoating} + query;
        for (std::size_t c = 1; c < 6; ++c)
            arguments = arguments + Words{"--set", names[c] + "=" + first[c]};
        const Table single = parse_csv(out_of(arguments));
        for (std::size_t row = 0; row < 12; ++row) {
            const Words& got = swept[1 + 12 * sample + row];
            CHECK(Words(got.begin() + 6, got.end()) == single[1 + row]);
        }
    }
}

TEST_CASE("draws depend on seed, sample and path alone", "[cli][sweep][scatter]") {
    const auto drawn = [](const Words& more) {
        return parse_csv(out_of(Words{"sweep", kCoating, "--scatter", "layers.2.thickness_nm=2%"} +
                                more + kAt550));
    };
    const std::vector<double> some = column_of(drawn({"--samples", "3"}), "layers.2.thickness_nm");
    // pinned values: the same on every machine
    CHECK(some == std::vector<double>{56.892700879417276, 58.857423771835236, 58.77343084884983});
    const std::string name = "layers.2.thickness_nm";
    const auto more = column_of(drawn({"--samples", "9"}), name);
    CHECK(std::equal(some.begin(), some.end(), more.begin()));
    CHECK(column_of(drawn({"--samples", "3", "--seed", "1"}), name) == some);
    CHECK(column_of(drawn({"--samples", "3", "--seed", "2"}), name) != some);
    CHECK(column_of(drawn({"--samples", "3", "--scatter", "layers.0.thickness_nm=1"}), name) ==
          some);
    CHECK(column_of(drawn({"--samples", "3", "--reverse"}), name) == some);
    const auto lists = column_of(
        drawn({"--samples", "3", "--vary", "substrate=1.4,1.6", "--vary", "angle_deg=0,10"}), name);
    REQUIRE(lists.size() == 12);
    for (std::size_t i = 0; i < lists.size(); ++i) CHECK(lists[i] == some[i / 4]);
}

TEST_CASE("samples are the same whatever threads, shards and formats", "[cli][sweep][scatter]") {
    const TemporaryFolder folder;
    const Words arguments = Words{"sweep",     kCoating, "--scatter", "layers.*.thickness_nm=2%",
                                  "--samples", "500",    "-a",        "0,40"} +
                            kAt550;
    const std::string whole = out_of(arguments + Words{"-j", "1"});
    CHECK(out_of(arguments + Words{"-j", "3"}) == whole);
    Words merge{"sweep", "--merge"};
    for (const std::string k : {"1", "2", "3"}) {
        const std::string part = folder / ("part-" + k + ".csv");
        out_of(arguments + Words{"--shard", k + "/3", "--resume", "-j", "2", "-o", part});
        merge.push_back(part);
    }
    out_of(merge + Words{"-o", folder / "all.csv"});
    CHECK(read_file(folder / "all.csv") == whole);
    // a shard with another seed does not belong
    out_of(arguments + Words{"--seed", "2", "--shard", "2/3", "-o", folder / "part-2.csv"});
    CHECK(run_irido(merge + Words{"-o", folder / "other.csv"}).status == 2);
    const Words summary{"--summary", "--limit", "R<0.5"};
    CHECK(out_of(arguments + summary + Words{"-j", "1"}) ==
          out_of(arguments + summary + Words{"-j", "4"}));
}

TEST_CASE("repetitions of a group have errors of their own unless they are linked",
          "[cli][sweep][scatter]") {
    const std::string mirror = "1 | (2.3@60 | (1.46@50 | 1.7@40)^2)^3 | 1.52@100 | 1.52";
    const auto drawn = [&](const std::string& link) {
        return parse_csv(out_of(Words{"sweep", mirror, "--scatter", "layers.*.thickness_nm=2%",
                                      "--samples", "2000", "--link", link} +
                                kAt550));
    };
    const Table all = drawn("none");
    const auto path = [](std::size_t outer, std::size_t inner) {
        return "layers.0.layers." + std::to_string(outer) + ".layers." + std::to_string(inner) +
               ".thickness_nm";
    };
    std::vector<std::pair<std::string, double>> layers;
    for (const std::size_t repetition : {0U, 1U, 2U}) {
        layers.emplace_back("layers.0.layers." + std::to_string(2 * repetition) + ".thickness_nm",
                            60);
        for (const std::size_t inner : {0U, 1U, 2U, 3U})
            layers.emplace_back(path(2 * repetition + 1, inner), inner % 2 == 0 ? 50 : 40);
    }
    layers.emplace_back("layers.1.thickness_nm", 100);
    REQUIRE(layers.size() == 16);
    const double unit = 1 / std::sqrt(2000.0);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        CHECK(all[0][1 + i] == layers[i].first);
        const auto values = column_of(all, layers[i].first);
        const double sigma = 0.02 * layers[i].second;
        CHECK(std::abs(mean_of(values) - layers[i].second) < 4 * sigma * unit);
        CHECK(std::abs(covariance(values, values) / (sigma * sigma) - 1) <
              4 * std::sqrt(2.0) * unit);
        for (std::size_t j = 0; j < i; ++j) {
            const auto other = column_of(all, layers[j].first);
            CHECK(std::abs(covariance(values, other)) <
                  4.5 * sigma * 0.02 * layers[j].second * unit);
        }
    }
    const Table repeat = drawn("repeat"), material = drawn("material"), linked = drawn("all");
    const std::string outer = "layers.0.layers.0.thickness_nm", first = path(1, 0),
                      second = path(1, 1), below = "layers.1.thickness_nm";
    const Words kept{outer, first, second, below};
    for (const Table& table : {repeat, material, linked})
        CHECK(Words(table[0].begin() + 1, table[0].begin() + 5) == kept);
    const auto relative = [&](const Table& table, const std::string& name, double nominal) {
        std::vector<double> values = column_of(table, name);
        for (double& value : values) value = value / nominal - 1;
        return values;
    };
    const double variance = 0.02 * 0.02;
    CHECK(std::abs(covariance(relative(repeat, outer, 60), relative(repeat, first, 50))) <
          5 * variance * unit);
    const auto a = relative(linked, outer, 60), b = relative(linked, below, 100);
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == Approx(b[i]).margin(1e-14));
    CHECK(covariance(relative(material, outer, 60), relative(material, below, 100)) <
          5 * variance * unit);
}

TEST_CASE("layers of a material move together when they are linked by it",
          "[cli][sweep][scatter]") {
    const Table rows =
        parse_csv(out_of(Words{"sweep", "air | TiO2@60 | SiO2@94 | TiO2@120 | BK7", "--scatter",
                               "layers.*.thickness_nm=2%", "--scatter", "layers.2.thickness_nm=6",
                               "--samples", "50", "--link", "material"} +
                         kAt550));
    const auto first = column_of(rows, "layers.0.thickness_nm"),
               second = column_of(rows, "layers.1.thickness_nm"),
               third = column_of(rows, "layers.2.thickness_nm");
    bool differs = false;
    for (std::size_t i = 0; i < first.size(); ++i) {
        CHECK((first[i] - 60) / 1.2 == Approx((third[i] - 120) / 6).margin(1e-12));
        differs = differs || std::abs((first[i] - 60) / 1.2 - (second[i] - 94) / 1.88) > 0.1;
    }
    CHECK(differs);
    // and a mirror stays a mirror, whose landmarks can be found
    const Table edges = parse_csv(out_of(
        {"sweep", "1 | (1@200 | 1.5@180)^10 | 1", "--scatter", "layers.*.thickness_nm=1%", "--link",
         "material", "--samples", "20", "--summary", "--compute", "bands", "--gaps"}));
    CHECK(edges.size() > 3);
}

TEST_CASE("a summary names the rows of a sample where there are several", "[cli][sweep][scatter]") {
    const Table table =
        parse_csv(out_of({"sweep", kCoating, "--scatter", "layers.*.thickness_nm=2%", "--samples",
                          "40", "--vary", "substrate=1.5,Ag", "--compute", "spectrum", "-w",
                          "500,600", "-a", "0,60", "-p", "s", "--summary", "--limit", "R<0.9"}));
    REQUIRE(table[0] == Words{"substrate", "wavelength_nm", "angle_deg", "quantity", "mean", "sd",
                              "p5", "p50", "p95"});
    REQUIRE(table.size() == 1 + 2 * (4 * 3 + 2));
    CHECK(Words(table[1].begin(), table[1].begin() + 4) == Words{"1.5", "500", "0", "R"});
    CHECK(Words(table[12].begin(), table[12].begin() + 4) == Words{"1.5", "600", "60", "A"});
    CHECK(Words(table[13].begin(), table[13].begin() + 4) == Words{"1.5", "", "", "R<0.9"});
    CHECK(Words(table[14].begin(), table[14].begin() + 4) == Words{"1.5", "", "", "yield"});
    CHECK(Words(table[15].begin(), table[15].begin() + 4) == Words{"Ag", "500", "0", "R"});
    CHECK(table[13][4] == "1");
    CHECK(table[27][4] == "0");
    // a flag is counted, a string is not a quantity
    const Table color =
        parse_csv(out_of({"sweep", kCoating, "--scatter", "layers.*.thickness_nm=2%", "--samples",
                          "40", "--compute", "color", "--side", "R,T", "--summary"}));
    CHECK(Words(color[0].begin(), color[0].begin() + 2) == Words{"side", "quantity"});
    REQUIRE(color.size() == 1 + 2 * 9);
    CHECK(Words(color[9].begin(), color[9].begin() + 2) == Words{"R", "in_gamut"});
}

TEST_CASE("thicknesses below 0 are 0", "[cli][sweep][scatter]") {
    const auto values =
        column_of(parse_csv(out_of(Words{"sweep", "1 | 1.5@10 | 1", "--scatter",
                                         "layers.0.thickness_nm=100%", "--samples", "200"} +
                                   kAt550)),
                  "layers.0.thickness_nm");
    CHECK(*std::min_element(values.begin(), values.end()) == 0);
    const auto zeros = std::count(values.begin(), values.end(), 0.0);
    CHECK(zeros > 10);  // 31.7 expected
    CHECK(zeros < 60);
}

TEST_CASE("scattered sweeps refuse what they cannot do", "[cli][sweep][scatter]") {
    const auto refused = [](const Words& more, const std::string& error) {
        check_refused(run_irido(Words{"sweep", kCoating} + more + kAt550), error);
    };
    const Words all{"--scatter", "layers.*.thickness_nm=2%"};
    refused({"--scatter", "layers.0.thickness_nm"}, "--scatter: must be PATH=SIGMA");
    refused({"--scatter", "layers.0.thickness_nm=-1"}, "SIGMA must be a number from 0 on");
    refused({"--scatter", "layers.0.thickness_nm=2%%"}, "SIGMA must be a number from 0 on");
    refused({"--scatter", "layers.0.thickness_nm=nan"}, "SIGMA must be a number from 0 on");
    refused({"--scatter", "layers.9.thickness_nm=1"}, "names no number of the stack");
    refused({"--scatter", "layers.*.thickness=1"}, "names no number of the stack");
    refused({"--scatter", "layers=1"}, "must name a number");
    refused({"--scatter", "angle_deg=1"}, "angle_deg cannot be scattered");
    refused(all + Words{"--samples", "0"}, "--samples: must be in [1, 1e+09]");
    refused(all + Words{"--samples", "1.5"}, "--samples");
    refused(all + Words{"--seed", "-1"}, "--seed");
    refused(all + Words{"--link", "index"}, "--link: must be one of none, repeat, material, all");
    refused(all + Words{"--limit", "R<1"}, "--limit: requires --summary");
    refused(all + Words{"--summary", "--limit", "R=1"}, "--limit: must be COLUMN<=VALUE");
    refused(all + Words{"--summary", "--limit", "R<"}, "--limit: must be COLUMN<=VALUE");
    refused(all + Words{"--summary", "--limit", "Q<1"}, "--limit: unknown column 'Q'");
    refused(all + Words{"--summary", "--shard", "1/2"}, "--shard: a summary is of all samples");
    refused(all + Words{"--summary", "--resume"}, "--resume: a summary is computed in one go");
    refused(all + Words{"--vary", "layers.0.thickness_nm=1,2"}, "is varied twice");
    refused(all + Words{"-o", "/tmp/x.png"}, "samples are not drawn");
    refused({"--samples", "5"}, "--samples: requires --scatter");
    refused({"--summary"}, "--summary: requires --scatter");
    const std::string mirror = "1 | (2.3@60 | 1.46@94)^20000 | 1.52";
    check_refused(run_irido(Words{"sweep", mirror} + all + kAt550), "--link repeat");
    const std::string few = "1 | (2.3@60 | 1.46@94)^20 | 1.52";
    check_refused(run_irido(Words{"sweep", few, "--vary", "layers.0.repeat=1,2"} + all + kAt550),
                  "is inside layers.0, whose repetitions have errors of their own");
    CHECK(run_irido(Words{"sweep", few, "--vary", "layers.0.repeat=1,2", "--link", "repeat",
                          "--samples", "2"} +
                    all + kAt550)
              .status == 0);
}
