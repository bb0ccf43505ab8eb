// Tables of layered surfaces: over half-angle coordinates, and for shaders.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/color/held_stack.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"
#include "core/rough/layered/layered_color.hpp"
#include "core/rough/walk/layered_nodes.hpp"
#include "tables/lut/lut_file.hpp"
#include "tables/lut/measured/half_angle_table.hpp"
#include "tests/support/d65_tables.hpp"
#include "tests/support/program.hpp"
#include "tests/support/sample_surfaces.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

FoundNodes nodes_of(const LayeredScattering& scattering, const NodeRequest& request) {
    const Sensitivity& sensitivity = d65_tables().sensitivity();
    const TabulatedScattering exact(scattering, equal_rule(sensitivity, 471), sensitivity.white(),
                                    Paths::single, Crossings::single, Execution(0));
    return find_nodes(scattering, exact, d65_tables(), request, Execution(0));
}

/// The largest CIEDE2000 against exact colours at pairs that no fit has seen.
double true_error(const LayeredNodes& table, const LayeredScattering& scattering,
                  std::size_t pairs) {
    const LayeredColor colors(d65_tables(), scattering.surface(), Crossings::single, 1e-4,
                              Execution(0));
    const std::vector<ScatterPair> some = sample_pairs(pairs, 77);
    const std::vector<SurfaceColor> exact = colors.brdf(some, Paths::single);
    double worst = 0;
    for (std::size_t p = 0; p < some.size(); ++p) {
        Triple truth = exact[p].xyz;
        for (double& part : truth) part /= kPi;
        worst = std::max(worst, scatter_difference(table(scattering, some[p]), truth,
                                                   d65_tables().sensitivity().white()));
    }
    return worst;
}

}  // namespace

TEST_CASE("half-angle coordinates", "[tables][measured]") {
    Random random(3);
    for (int k = 0; k < 1000; ++k) {
        const tables::HalfAngles at{random.uniform(0, 50), random.uniform(0, 39),
                                    random.uniform(0, 90)};
        const tables::HalfAnglePair found = tables::directions_of(at);
        REQUIRE(found.is_above);
        const auto& [theta_i, theta_o, near, far] = found.pair;
        const double i = theta_i * kDegree, o = theta_o * kDegree;
        CHECK_THAT(near * near + far * far, WithinAbs(1, 1e-12));
        // cos 2 theta_d is i.o, and |i + o| cos theta_h is the sum of their heights
        const double dot =
            std::cos(i) * std::cos(o) + std::sin(i) * std::sin(o) * (near * near - far * far);
        CHECK_THAT(dot, WithinAbs(std::cos(2 * at.theta_d_deg * kDegree), 1e-12));
        CHECK_THAT(std::cos(i) + std::cos(o), WithinAbs(2 * std::cos(at.theta_d_deg * kDegree) *
                                                            std::cos(at.theta_h_deg * kDegree),
                                                        1e-12));
        // i and o change places with half a turn of phi_d
        const tables::HalfAnglePair turned =
            tables::directions_of({at.theta_h_deg, at.theta_d_deg, at.phi_d_deg + 180});
        CHECK_THAT(turned.pair.theta_i_deg, WithinAbs(theta_o, 1e-9));
        CHECK_THAT(turned.pair.near, WithinAbs(near, 1e-12));
    }
    CHECK_FALSE(tables::directions_of({60, 60, 0}).is_above);
}

TEST_CASE("nodes reproduce what is seen through layers", "[tables][layered][slow]") {
    for (const char* json : {R"({"base": {"albedo": [[400, 0.1], [600, 0.9]]}, "layers": [
                {"stack": "1 | (1@125 | 1.5@375)^10 | 1", "alpha": 0.2},
                {"stack": "1 | 1.4+0.02i@500 | 1", "alpha": 0.3}]})",
                             R"({"layers": [{"stack": "1 | (1@120 | 1.6@90)^6 | 1", "alpha": 0.15},
                         {"stack": "1 | 1.33@400 | 1.9+1.5i", "alpha": 0.1}]})"}) {
        INFO(json);
        const LayeredScattering scattering(surface_of(json), Crossings::single, Execution(0));
        const FoundNodes found = nodes_of(scattering, {});
        CHECK(found.error <= 1);
        CHECK(found.table.wavelength_nm.size() % 3 == 0);
        CHECK(found.products > 2 * found.error);
        CHECK(true_error(found.table, scattering, 20) <= 1.3 * found.error + 0.02);
    }
}

TEST_CASE("more nodes err less, and one opaque layer needs none", "[tables][layered][slow]") {
    const LayeredScattering pale(surface_of(R"({"base": {"albedo": 0.9}, "layers": [
            {"stack": "1 | (1@250 | 1.5@250)^10 | 1", "alpha": 0.1}]})"),
                                 Crossings::single, Execution(0));
    NodeRequest request{.nodes = 3, .angles = 1024};
    const double few = nodes_of(pale, request).error;
    request.nodes = 12;
    const double more = nodes_of(pale, request).error;
    CHECK(few > 5 * more);
    const LayeredScattering film(
        surface_of(R"({"layers": [{"stack": "1 | 1.33@300 | 1.9+1.5i", "alpha": 0.1}]})"),
        Crossings::single, Execution(0));
    const FoundNodes found = nodes_of(film, {});
    CHECK(found.table.wavelength_nm.empty());
    CHECK(found.error < 0.2);
    CHECK(found.table.top.size() == 256);
}

TEST_CASE("lut brdf writes half-angle tables with their error", "[cli][brdf][slow]") {
    const TemporaryFolder folder;
    const std::string film = R"({"layers": [{"stack": "1 | 1.33@300 | 1.9+1.5i", "alpha": 0.3}]})";
    const std::string file = folder / "film.npy";
    const Outcome made = run_irido({"lut", "brdf", "-", "--tolerance", "2", "-o", file}, film);
    REQUIRE(made.status == 0);
    const tables::Lut lut = tables::read_lut(file);
    CHECK(lut.kind == "brdf");
    REQUIRE(lut.axes.size() == 3);
    CHECK(lut.axes[0].name == "phi_d_deg");
    CHECK(lut.axes[1].name == "theta_h_deg");
    CHECK(lut.axes[2].name == "theta_d_deg");
    CHECK(lut.facts["error"]["measure"] == "delta_e_2000");
    CHECK(lut.facts["error"]["value"].get<double>() <= 2);
    CHECK(lut.facts["error"]["value"].get<double>() > 0.02);
    CHECK(run_irido({"lut", "check", file}).out.ends_with(": ok\n"));
    // one sample against irido brdf
    const std::size_t h = lut.axes[1].count() / 3, d = lut.axes[2].count() / 3;
    const std::size_t p = lut.axes[0].count() - 1;
    const tables::HalfAnglePair sample = tables::directions_of(
        {lut.axes[1].values[h], lut.axes[2].values[d], lut.axes[0].values[p]});
    REQUIRE(sample.is_above);
    const tables::TablePair& pair = sample.pair;
    const double phi = 2 * std::atan2(pair.far, pair.near) / kDegree;
    const Outcome exact = run_irido(
        {"brdf", "-", "--color", "--light-theta", std::to_string(pair.theta_i_deg), "--view-theta",
         std::to_string(pair.theta_o_deg), "--view-phi", std::to_string(phi), "-f", "json"},
        film);
    const auto row = nlohmann::json::parse(exact.out)[0];
    const std::size_t at = ((p * lut.axes[1].count() + h) * lut.axes[2].count() + d) * 3;
    for (std::size_t c = 0; c < 3; ++c)
        CHECK_THAT(kPi * lut.values[at + c],
                   WithinAbs(row[std::string(1, "rgb"[c])].get<double>(), 2e-3));
}

TEST_CASE("tables of surfaces refuse what they cannot be", "[cli][brdf][slow]") {
    const TemporaryFolder folder;
    const std::string pale = "schemas/examples/surfaces/green-on-pale.json";
    const auto refused = [&](std::vector<std::string> words, const std::string& error,
                             const std::string& input = "") {
        words.insert(words.begin(), "lut");
        INFO(error);
        check_refused(run_irido(words, input), error);
    };
    refused({"brdf", pale, "-o", folder / "x.txt"}, "must be one of binary, merl, bsdf");
    refused({"brdf", pale, "-f", "merl"}, "--output: is required");
    refused({"brdf", pale, "-w", "500,400", "-o", folder / "x.bsdf"}, "--wavelengths: must ascend");
    refused({"brdf", pale, "-w", "500", "-o", folder / "x.binary"}, "--wavelengths: takes .bsdf");
    refused({"brdf", pale, "-w", "500", "-o", folder / "x.npy"}, "--wavelengths: takes .bsdf");
    refused({"brdf", pale, "--size", "8", "-o", folder / "x.bsdf"}, "--size: .bsdf files have");
    refused({"brdf", pale, "--phi-d", "0,200", "-o", folder / "x.npy"}, "--phi-d");
    refused({"brdf", pale, "--theta-h", "10,5", "-o", folder / "x.npy"}, "theta_h_deg must ascend");
    refused({"brdf", pale, "--size", "4", "-o", folder / "x.png"}, "--phi-d: a picture shows one");
    refused({"brdf", pale, "--paths", "simulation", "-o", folder / "x.npy"},
            "--paths: must be one of single, all");
    refused({"brdf", "schemas/examples/surfaces/worn-spoon.json", "-o", folder / "x.npy"},
            "must be a layered surface");
    refused({"layered", "-", "-o", folder / "x.ktx2"}, "at least one layer",
            R"({"layers": [], "base": {"albedo": 0.5}})");
    refused({"layered", pale, "--nodes", "4", "-o", folder / "x.ktx2"}, "must be a multiple of 3");
    refused({"layered", pale, "--nodes", "63", "-o", folder / "x.ktx2"}, "--nodes");
    refused({"layered", pale, "--nodes", "6", "--tolerance", "1", "-o", folder / "x.ktx2"},
            "--tolerance: cannot be combined");
    refused({"layered", pale, "--size", "1", "-o", folder / "x.ktx2"}, "--size");
    refused({"layered", pale, "--paths", "all", "-o", folder / "x.ktx2"}, "--paths all");
    refused({"layered", "schemas/examples/surfaces/worn-spoon.json", "-o", folder / "x.ktx2"},
            "must be a layered surface");
    refused({"layered", pale, "-o", folder / "x.png"}, "--output: the extension");
}
