#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;

namespace {

const std::string kSpoon = "schemas/examples/surfaces/worn-spoon.json";

}  // namespace

TEST_CASE("irido scratches lists the same scratches in every extent", "[cli][scratch]") {
    const auto rows = [](const std::string& extent, const std::string& origin) {
        const Outcome outcome = run_irido(
            {"scratches", kSpoon, "--extent", extent, "--origin", origin, "--reach", "1"});
        REQUIRE(outcome.status == 0);
        return parse_csv(outcome.out);
    };
    const auto wide = rows("3000,2000", "0,0"), part = rows("400,300", "700,900");
    CHECK(wide[0] == std::vector<std::string>{"x_um", "y_um", "angle_deg", "start_um", "end_um",
                                              "width_um", "depth_um"});
    CHECK(wide.size() > 240);
    CHECK(part.size() > 10);
    for (const auto& row : part) CHECK(std::ranges::find(wide, row) != wide.end());
    CHECK(wide[1] == std::vector<std::string>{"10", "-5", "30", "-800", "1200", "2", "0.14"});
    const Outcome endless = run_irido(
        {"scratches", "-"},
        R"({"scratches": [{"width_um": 1, "depth_um": 1, "angle_deg": 0, "point_um": [0, 0]}]})");
    CHECK(endless.out.ends_with("0,0,0,,,1,1\n"));
}

TEST_CASE("grids of scratches pass their check, and altered ones do not", "[cli][scratch]") {
    const TemporaryFolder folder;
    const std::string grid = folder / "spoon.bin";
    REQUIRE(run_irido({"scratches", kSpoon, "--extent", "2000,1500", "--grid", grid}).status == 0);
    CHECK(run_irido({"scratches", "--check", grid}).out == grid + ": ok\n");
    const auto header = nlohmann::json::parse(read_file(grid + ".json"));
    CHECK(header["columns"] == 20);
    CHECK(header["rows"] == 15);
    CHECK(header["entries"]["count"].get<std::size_t>() > 300);
    const std::string bytes = read_file(grid);
    write_text(grid, bytes.substr(4));
    const Outcome cut = run_irido({"scratches", "--check", grid});
    CHECK(cut.status == 1);
    CHECK_THAT(cut.out, Contains("requires"));
    std::string altered = bytes;
    altered[altered.size() - 1] = 'x';
    write_text(grid, altered);
    CHECK_THAT(run_irido({"scratches", "--check", grid}).out, Contains("checksum"));
    check_refused(run_irido({"scratches", kSpoon, "--extent", "3"}), "--extent");
    check_refused(run_irido({"scratches", kSpoon, "--grid", grid, "--cell", "0"}), "--cell");
    check_refused(run_irido({"scratches", kSpoon, "--grid", folder / "x.csv"}),
                  "--grid: a grid is binary; name it otherwise than .csv");
    check_refused(run_irido({"scratches"}), "SURFACE");
    check_refused(run_irido({"scratches", "1 | 1.5@100 | 1"}),
                  "must be a surface with scratches\n");
    check_refused(run_irido({"scratches", "schemas/examples/soap-bubble.json"}),
                  "soap-bubble.json: must be a surface with scratches\n");
    check_refused(run_irido({"scratches", "schemas/examples/surfaces/green-on-pale.json"}),
                  "scratches");
}
