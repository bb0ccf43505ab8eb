#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::WithinRel;

namespace {

const std::string kMirror = "1 | (1@250 | 1.5@250)^10 | 1";
const std::string kPale = "schemas/examples/surfaces/green-on-pale.json";

std::vector<std::vector<std::string>> rows_of(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"brdf"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = done(arguments);
    return parse_csv(outcome.out);
}

}  // namespace

TEST_CASE("rows of brdf", "[cli][brdf]") {
    const auto rows = rows_of({kMirror, "--alpha", "0.1", "--light-theta", "30", "--view-theta",
                               "20,30", "--view-phi", "0,180", "-w", "450,550"});
    REQUIRE(rows.size() == 9);
    CHECK(rows[0] == std::vector<std::string>{"light_theta_deg", "light_phi_deg", "view_theta_deg",
                                              "view_phi_deg", "wavelength_nm", "brdf_per_sr"});
    CHECK(rows[7][4] == "450");
    CHECK(rows[7][3] == "180");
    CHECK_THAT(std::stod(rows[7][5]), WithinRel(1.0713005613365996, 1e-11));
    CHECK_THAT(std::stod(rows[8][5]), WithinRel(9.789604879615283, 1e-11));
    // azimuths are relative: the same pair, rotated
    const auto turned = rows_of({kMirror, "--alpha", "0.1", "--light-theta", "30", "--view-theta",
                                 "30", "--light-phi", "270", "--view-phi", "90", "-w", "450"});
    CHECK(turned[1][5] == rows[7][5]);
}

TEST_CASE("a file of directions", "[cli][brdf]") {
    const TemporaryFolder folder;
    const std::string header = "view_phi_deg,view_theta_deg,light_phi_deg,light_theta_deg\n";
    write_text(folder / "d.csv", header + "180,30,0,30\n0,10,0,20\n");
    const auto rows =
        rows_of({kMirror, "--alpha", "0.1", "--directions", folder / "d.csv", "-w", "550"});
    REQUIRE(rows.size() == 3);
    CHECK_THAT(std::stod(rows[1][5]), WithinRel(9.789604879615283, 1e-11));
    write_text(folder / "bad.csv", header + "180,95,0,30\n");
    check_refused(run_irido({"brdf", kPale, "--directions", folder / "bad.csv"}),
                  "view_theta_deg must be in [0, 90] (got 95)");
    write_text(folder / "few.csv", "view_phi_deg,view_theta_deg\n0,0\n");
    check_refused(run_irido({"brdf", kPale, "--directions", folder / "few.csv"}),
                  "must have the column light_theta_deg");
}

TEST_CASE("quantities of brdf", "[cli][brdf]") {
    const auto albedo =
        rows_of({kPale, "--quantity", "albedo", "--light-theta", "0", "-w", "450,550,650"});
    CHECK(albedo[0] == std::vector<std::string>{"light_theta_deg", "wavelength_nm", "albedo"});
    CHECK_THAT(std::stod(albedo[1][2]), WithinRel(0.2896959755831737, 1e-6));
    const auto tau = rows_of({kPale, "--quantity", "transmissivity", "-w", "450"});
    CHECK(tau[0] ==
          std::vector<std::string>{"layer", "theta_deg", "wavelength_nm", "ft_cos", "p_trans"});
    CHECK_THAT(std::stod(tau[1][3]), WithinRel(0.9363140314426337, 1e-11));
    const auto sampling = rows_of({kPale, "--quantity", "sampling", "-w", "450"});
    REQUIRE(sampling.size() == 4);
    CHECK(sampling[0] ==
          std::vector<std::string>{"light_theta_deg", "wavelength_nm", "layer", "probability"});
    const auto color = rows_of({kPale, "--color", "--light-theta", "45", "--view-theta", "45"});
    CHECK(color[0] == std::vector<std::string>{"light_theta_deg", "light_phi_deg", "view_theta_deg",
                                               "view_phi_deg", "X", "Y", "Z", "r", "g", "b",
                                               "hex"});
    // a white diffuser is white
    const TemporaryFolder folder;
    write_text(folder / "white.json", R"({"base": {"albedo": 1}})");
    const auto white = rows_of({folder / "white.json", "--color", "--view-theta", "80"});
    CHECK(white[1].back() == "#ffffff");
    CHECK_THAT(std::stod(white[1][5]), WithinRel(1, 1e-12));
}

TEST_CASE("the number of threads does not show", "[cli][brdf]") {
    for (const std::vector<std::string>& what :
         {std::vector<std::string>{"-w", "400:700:20"}, {"--color"}}) {
        std::vector<std::string> arguments{"brdf", kPale, "--view-theta", "0:80:10"};
        arguments.insert(arguments.end(), what.begin(), what.end());
        const std::string once = run_irido(arguments).out;
        arguments.insert(arguments.end(), {"-j", "1"});
        CHECK(run_irido(arguments).out == once);
    }
}

TEST_CASE("brdf draws its rows", "[cli][brdf]") {
    for (const std::vector<std::string>& what :
         {std::vector<std::string>{"-w", "550"}, {"--color"}}) {
        std::vector<std::string> arguments{"brdf", kPale, "--view-theta", "0:80:4", "-f", "svg"};
        arguments.insert(arguments.end(), what.begin(), what.end());
        const Outcome outcome = run_irido(arguments);
        INFO(outcome.err);
        CHECK(outcome.status == 0);
        CHECK(outcome.out.find("<svg") != std::string::npos);
    }
}

TEST_CASE("all paths of two layers, and their simulation", "[cli][brdf][slow]") {
    const std::vector<std::string> surface{"schemas/examples/surfaces/blue-over-red.json",
                                           "--light-theta",
                                           "30",
                                           "--view-theta",
                                           "30",
                                           "-w",
                                           "450"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = surface;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return rows_of(arguments);
    };
    const auto all = with({"--paths", "all"});
    CHECK_THAT(std::stod(all[1][5]), WithinRel(4.95633123942, 1e-3));
    const auto simulated = with({"--paths", "simulation", "--samples", "2000", "--seed", "3"});
    CHECK(simulated[0].back() == "stderr");
    CHECK_THAT(std::stod(simulated[1][5]), WithinRel(4.95633123942, 2e-2));
    CHECK(with({"--paths", "simulation", "--samples", "2000", "--seed", "3", "-j", "1"}) ==
          simulated);
}

TEST_CASE("light that rough films refract", "[cli][brdf]") {
    const auto rows = rows_of({"1 | 1.33@400 | 1.5", "--alpha", "0.2", "--side", "T",
                               "--light-theta", "30", "--view-theta", "19.5,60", "-w", "550"});
    CHECK(rows[0].back() == "btdf_per_sr");
    CHECK(std::stod(rows[1][5]) > 20);
    CHECK(rows[2][5] == "0");  // no facet refracts so far
    const std::vector<std::string> film{"1 | 1.33@400 | 1.9+1.5i",
                                        "--alpha",
                                        "0.2",
                                        "--light-theta",
                                        "30",
                                        "--view-theta",
                                        "30",
                                        "--color"};
    const auto color = [&](const std::string& method) {
        std::vector<std::string> arguments = film;
        arguments.insert(arguments.end(), {"--method", method});
        return std::stod(rows_of(arguments)[1][5]);
    };
    CHECK_THAT(color("fourier"), WithinRel(color("auto"), 1e-5));
    CHECK_THAT(color("gaussian"), WithinRel(color("auto"), 2e-2));
    CHECK(color("gaussian") != color("auto"));
}

TEST_CASE("shards of a simulation are joined", "[cli][brdf]") {
    const TemporaryFolder folder;
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{
            "brdf",  kMirror, "--alpha", "0.1",     "--light-theta", "30",        "--view-theta",
            "20,30", "-w",    "450,550", "--paths", "simulation",    "--samples", "901"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_irido(arguments);
    };
    const std::string a = folder / "a.csv", b = folder / "b.csv";
    REQUIRE(run({"--shard", "1/2", "-o", a}).status == 0);
    REQUIRE(run({"--shard", "2/2", "-o", b}).status == 0);
    CHECK(parse_csv(read_file(b))[1][8] == "450");
    const std::string whole = run({}).out;
    CHECK(whole.size() > 100);
    CHECK(run({"--merge", b, a}).out == whole);
    CHECK(run_irido({"brdf", "--merge", b, a}).out == whole);  // the files say of what
    CHECK(run_irido({"brdf", "--merge", b, a, "-f", "svg"}).status == 0);
    check_refused(run({"--merge", a}), "the shards end at sample 451 of 901");
    check_refused(run({"--merge", a, a}), "begins with sample 0; the shards before it end at 451");
    check_refused(run({"--merge", a, b, "--light-phi", "10"}), "is a shard of another request");
    check_refused(run({"--merge", a, b, "--shard", "1/2"}), "mutually exclusive");
    check_refused(run({"--merge", a, b, "--seed", "2"}), "is a shard of another request");
    check_refused(run_irido({"brdf"}), "SURFACE is required");
    const std::string other = folder / "other.csv";
    REQUIRE(run({"--shard", "2/2", "--seed", "2", "-o", other}).status == 0);
    check_refused(run_irido({"brdf", "--merge", a, other}), "is a shard of another request");
}

TEST_CASE("shards that were altered or computed otherwise are refused", "[cli][brdf]") {
    const TemporaryFolder folder;
    write_text(folder / "lamp.csv", "nm,power\n380,1\n780,2\n");
    write_text(folder / "pale.json", read_file(IRIDO_SOURCE_DIR "/" + kPale));
    const auto shard = [&](const std::string& number, const std::string& name,
                           const std::vector<std::string>& more) {
        std::vector<std::string> arguments{
            "brdf",      "pale.json", "--light-theta", "30",   "--paths", "simulation",
            "--samples", "400",       "--shard",       number, "-o",      name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        REQUIRE(run_irido(arguments, "", folder.path()).status == 0);
    };
    const auto refuse = [&](const std::string& second, const std::string& error) {
        check_refused(run_irido({"brdf", "--merge", "one.csv", second}, "", folder.path()), error);
    };
    shard("1/2", "one.csv", {"--color"});
    shard("2/2", "two.csv", {"--color"});
    REQUIRE(run_irido({"brdf", "--merge", "one.csv", "two.csv"}, "", folder.path()).status == 0);
    auto rows = parse_csv(read_file(folder / "two.csv"));
    const auto with = [&](const std::string& column, const std::string& value) {
        const auto place = std::ranges::find(rows[0], column);
        REQUIRE(place != rows[0].end());
        std::string text = read_file(folder / "two.csv");
        const std::string& old = rows[1][static_cast<std::size_t>(place - rows[0].begin())];
        REQUIRE(old != value);
        text.replace(text.rfind("," + old + ",") + 1, old.size(), value);
        write_text(folder / "altered.csv", text);
    };
    for (const auto& [column, value] :
         std::vector<std::pair<std::string, std::string>>{{"X_sum", "150"},
                                                          {"Z_square_low", "1e-3"},
                                                          {"illuminant", "A"},
                                                          {"observer", "10"},
                                                          {"build", "0.0.1"}}) {
        INFO(column);
        with(column, value);
        refuse("altered.csv", "altered.csv: was altered: it does not match its digest");
    }
    // spelt otherwise, as by a spreadsheet, the numbers are the same
    with("all_samples", "400.0");
    CHECK(run_irido({"brdf", "--merge", "one.csv", "altered.csv"}, "", folder.path()).status == 0);
    shard("2/2", "warm.csv", {"--color", "--illuminant", "A"});
    refuse("warm.csv", "warm.csv: has the illuminant A, one.csv D65");
    shard("2/2", "wide.csv", {"--color", "--space", "rec2020"});
    refuse("wide.csv", "wide.csv: has the space rec2020, one.csv srgb");
    ::setenv("IRIDO_SIMD", "baseline", 1);
    shard("2/2", "plain.csv", {"--color"});
    ::unsetenv("IRIDO_SIMD");
    refuse("plain.csv", "plain.csv: was computed at SIMD level baseline, one.csv ");
    shard("1/2", "one.csv", {"--color", "--illuminant", "lamp.csv"});
    write_text(folder / "lamp.csv", "nm,power\n380,2\n780,1\n");
    shard("2/2", "lit.csv", {"--color", "--illuminant", "lamp.csv"});
    refuse("lit.csv", "lit.csv: is a shard of another request than one.csv");
}

TEST_CASE("shards of surfaces in different media are not joined", "[cli][brdf]") {
    const TemporaryFolder folder;
    const auto shard = [&](const std::string& number, const std::string& outside) {
        write_text(folder / "coated.json",
                   R"({"outside": )" + outside + R"(, "inside": 1.35, "base": {"albedo": 0.5}})");
        const Outcome outcome =
            run_irido({"brdf", "coated.json", "-w", "550", "--paths", "simulation", "--samples",
                       "400", "--shard", number + "/2", "-o", number + ".csv"},
                      "", folder.path());
        REQUIRE(outcome.status == 0);
    };
    shard("1", "1");
    shard("2", "1.1");
    check_refused(run_irido({"brdf", "--merge", "1.csv", "2.csv"}, "", folder.path()),
                  "2.csv: is a shard of another request than 1.csv");
}

TEST_CASE("shards in any number join to the bytes of a single run", "[cli][brdf][slow]") {
    const TemporaryFolder folder;
    const std::vector<std::vector<std::string>> requests{
        {"--quantity", "albedo", "--light-theta", "0,60", "-w", "450", "--facets", "filter"},
        {"--light-theta", "20", "--view-theta", "20,70", "--color", "--space", "rec2020"}};
    for (const auto& more : requests) {
        std::vector<std::string> all{"brdf", kPale, "--paths", "simulation", "--samples", "1003"};
        all.insert(all.end(), more.begin(), more.end());
        std::vector<std::string> merge{"brdf", "--merge"};
        for (int k = 7; k >= 1; --k) {
            merge.push_back(folder / std::to_string(k) + ".csv");
            std::vector<std::string> shard = all;
            shard.insert(shard.end(),
                         {"--shard", std::to_string(k) + "/7", "-j", "1", "-o", merge.back()});
            REQUIRE(run_irido(shard).status == 0);
        }
        const bool is_color = more.back() == "rec2020";
        if (is_color) {
            std::vector<std::string> other = merge;
            other.insert(other.end(), {"--space", "acescg"});
            check_refused(run_irido(other), "has colours in another --space");
        }
        const Outcome merged = run_irido(merge);
        INFO(merged.err);
        CHECK(merged.out == run_irido(all).out);
        CHECK(merged.out.size() > 50);
    }
}

TEST_CASE("simulations run to a tolerance, and in colour", "[cli][brdf]") {
    const std::vector<std::string> pale{kPale, "--light-theta", "40",         "--view-theta",
                                        "20",  "--paths",       "simulation", "--tolerance",
                                        "0.05"};
    std::vector<std::string> at = pale, color = pale;
    at.insert(at.end(), {"-w", "500"});
    color.emplace_back("--color");
    const auto row = rows_of(at)[1];
    CHECK(std::stod(row[6]) <= 0.05 * std::stod(row[5]));
    const auto rows = rows_of(color);
    CHECK(rows[0][10] == "hex");
    CHECK(rows[0][11] == "stderr");
    CHECK(std::stod(rows[1][11]) <= 0.05);
}

TEST_CASE("brdf refuses what cannot be", "[cli][brdf]") {
    const auto refuse = [](const std::vector<std::string>& more, const std::string& error) {
        std::vector<std::string> arguments{"brdf"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        check_refused(run_irido(arguments), error);
    };
    refuse({kMirror}, "a stack requires --alpha");
    refuse({kMirror, "--alpha", "2"}, "--alpha: must be in [1e-04, 1] (got 2)");
    refuse({kPale, "--alpha", "0.1"}, "--alpha applies to stacks only");
    refuse({kPale, "--view-theta", "91"}, "--view-theta: must be in [0, 90] (got 91)");
    refuse({kPale, "--light-theta", "nan"}, "--light-theta");
    refuse({kPale, "--quantity", "colour"},
           "--quantity of a layered surface: must be one of brdf, albedo");
    refuse({kPale, "--paths", "few"}, "--paths: must be one of single, all");
    refuse({kPale, "--paths", "simulation", "--samples", "1e9"}, "require --output");
    refuse({kPale, "--samples", "10"}, "--samples: requires --paths simulation");
    refuse({kPale, "--paths", "simulation", "--samples", "1"}, "--samples: must be in [2, 1e+12]");
    refuse({kPale, "--paths", "simulation", "--facets", "none"}, "--facets: must be one of");
    refuse({kPale, "--paths", "simulation", "--color", "--method", "naive"},
           "--method: requires --paths single or all");
    refuse({kPale, "--paths", "simulation", "--samples", "10", "--tolerance", "0.1"},
           "--tolerance of a simulation excludes --samples");
    refuse({kPale, "--paths", "simulation", "--shard", "3/2"}, "--shard: must be");
    refuse({kPale, "--shard", "1/2"}, "--shard: requires --paths simulation");
    for (const std::string format : {"png", "svg", "json", "npy"})
        refuse({kPale, "--paths", "simulation", "--shard", "1/2", "-o", "shard." + format},
               "--shard: must be written as csv, which --merge reads (got " + format + ")");
    refuse({kPale, "--color", "--method", "gaussian"}, "--method: takes the BRDF of one rough");
    refuse({kPale, "--method", "gaussian"}, "--method: requires --color");
    refuse({kPale, "--side", "T"}, "--side T: takes one rough layer without a coating");
    refuse({kPale, "--side", "R,T"}, "--side: must be R or T");
    refuse({kMirror, "--alpha", "0.1", "--side", "T"}, "--side T: light goes straight on");
    refuse({"1 | 1.3@300 | 0.2+3i", "--alpha", "0.1", "--side", "T"}, "does not absorb");
    std::string layers = R"({"stack": "1 | 1.5@100 | 1", "alpha": 0.1})";
    for (int k = 1; k < 10000; ++k) layers += R"(, {"stack": "1 | 1.5@100 | 1", "alpha": 0.1})";
    const TemporaryFolder many;
    write_text(many / "s.json", R"({"layers": [)" + layers + "]}");
    refuse({many / "s.json"}, "/layers");
    refuse({kPale, "--paths", "simulation", "--quantity", "sampling"}, "requires --quantity brdf");
    refuse({kPale, "--transmission", "no"}, "--transmission: must be one of single, multiple");
    refuse({kPale, "--color", "--quantity", "sampling"},
           "--color: requires --quantity brdf or albedo");
    refuse({kPale, "--view-theta", "0:90:0.001", "--light-theta", "0:90:0.001"}, "at most 1e7");
    refuse({"schemas/examples/surfaces/blue-over-red.json", "--set", "layers.1.alpha=0"},
           "/layers/1/alpha: must be in [1e-4, 1] (got 0)");
    const TemporaryFolder folder;
    write_text(folder / "s.json", R"({"layers": [{"stack": "1 | 1.5@100 | 2", "alpha": 0.1}],
                                      "base": {"albedo": 0.5}})");
    refuse({folder / "s.json"}, "/base: is not seen");
}
