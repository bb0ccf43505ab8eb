#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("the program says what it is", "[cli]") {
    const Outcome version = run_irido({"--version"});
    CHECK(version.status == 0);
    CHECK_THAT(version.out, StartsWith("irido ") && Contains("SIMD"));
    CHECK(run_irido({"--help"}).status == 0);
    CHECK(run_irido({}).status == 2);
}

TEST_CASE("every help page has a purpose and two examples", "[cli]") {
    const std::vector<std::vector<std::string>> commands{{"spectrum"},
                                                         {"color"},
                                                         {"validate"},
                                                         {"materials"},
                                                         {"materials", "list"},
                                                         {"materials", "show"},
                                                         {"bench"},
                                                         {"bench", "speed"},
                                                         {"bench", "stability"}};
    for (auto command : commands) {
        command.emplace_back("--help");
        const Outcome help = run_irido(command);
        INFO(help.out);
        CHECK(help.status == 0);
        const std::size_t examples = help.out.find("Examples:");
        REQUIRE(examples != std::string::npos);
        const std::string rest = help.out.substr(examples);
        CHECK(std::count(rest.begin(), rest.end(), '\n') >= 3);
        CHECK_THAT(rest, Contains("  irido " + command[0]));
    }
}

TEST_CASE("materials are listed and shown", "[cli][materials]") {
    const Outcome list = run_irido({"materials", "list"});
    CHECK_THAT(list.out,
               StartsWith("name,aliases,first_nm,last_nm,covers_380_780,source,year,film\n"));
    CHECK(parse_csv(list.out).size() > 40);
    const Outcome gold = run_irido({"materials", "show", "Au", "-w", "400:800:100"});
    CHECK_THAT(gold.out, StartsWith("wavelength_nm,n,k\n400,1.46"));
    CHECK_THAT(gold.err, Contains("Johnson") && Contains("187.9 to 1937 nm"));
    const Outcome unknown = run_irido({"materials", "show", "au"});
    CHECK(unknown.status == 2);
    CHECK_THAT(unknown.err, Contains("did you mean"));
    CHECK(run_irido({"materials", "show", "TiO2-rutile", "-w", "400"}).status == 2);
    const auto rutile = parse_csv(run_irido({"materials", "show", "TiO2-rutile"}).out);
    CHECK(rutile[1][0] == "430");
    CHECK(rutile.back()[0] == "780");
}

TEST_CASE("validate says ok, or everything that is wrong", "[cli][validate]") {
    const TemporaryFolder folder;
    write_text(folder / "good.json", R"({"incident": 1, "layers": [], "substrate": 1.5})");
    write_text(
        folder / "bad.json",
        R"({"incident": 1, "layers": [{"material": "Xx", "thickness_nm": -5}], "substrat": 2})");
    const Outcome outcome = run_irido({"validate", "good.json", "bad.json"}, "", folder.path());
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Contains("good.json: ok\n"));
    CHECK_THAT(outcome.out,
               Contains("bad.json: /layers/0/thickness_nm: must be in [0, 1e9] (got -5)"));
    CHECK_THAT(outcome.out, Contains("substrat"));
    CHECK(run_irido({"validate", "good.json"}, "", folder.path()).status == 0);
    const Outcome missing = run_irido({"validate", "none.json"}, "", folder.path());
    CHECK(missing.status == 2);
}

TEST_CASE("all examples are valid and have a colour", "[cli][examples]") {
    const Outcome all = run_shell("\"$IRIDO\" validate schemas/examples/*.json", IRIDO_SOURCE_DIR);
    INFO(all.out);
    CHECK(all.status == 0);
    const Outcome colors = run_shell(
        "for f in schemas/examples/*.json; do \"$IRIDO\" color \"$f\" -a 0,60 > /dev/null || "
        "echo \"$f\"; done",
        IRIDO_SOURCE_DIR);
    CHECK(colors.out.empty());
}

TEST_CASE("validate prints the schema that it uses", "[cli][validate]") {
    const Outcome schema = run_irido({"validate", "--schema"});
    CHECK(schema.status == 0);
    CHECK(schema.out == read_file(IRIDO_SOURCE_DIR "/schemas/stack.schema.json"));
    CHECK(run_irido({"validate"}).status == 2);
}

TEST_CASE("text in UTF-16 is refused as such by every reader", "[cli][refused]") {
    const TemporaryFolder folder;
    for (const std::string mark : {"\xFF\xFE", "\xFE\xFF"}) {
        write_text(folder / "t.json", mark);
        write_text(folder / "t.csv", mark + "n");
        for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
                 {"spectrum", "t.json"},
                 {"color", "1 | 1.5", "--illuminant", "t.csv"},
                 {"brdf", "1 | 1.5", "--alpha", "0.1", "--directions", "t.csv"},
                 {"sweep", "1 | 1.5@1 | 1", "--points", "t.csv", "--compute", "color"},
                 {"plan", "t.json"},
                 {"fit", "t.json"}})
            check_refused(run_irido(arguments, "", folder.path()),
                          "must be UTF-8 text (got UTF-16)");
        const Outcome outcome = run_irido({"validate", "t.json", "t.csv"}, "", folder.path());
        CHECK(outcome.status == 1);
        CHECK(outcome.out ==
              "t.json: must be UTF-8 text (got UTF-16)\nt.csv: must be UTF-8 text (got UTF-16)\n");
    }
}

TEST_CASE("validate knows the tables that other commands read", "[cli]") {
    const TemporaryFolder folder;
    CHECK(out_of({"validate", "schemas/examples/designs/oxide-psi-delta.csv",
                  "schemas/examples/films.csv"}) ==
          "schemas/examples/designs/oxide-psi-delta.csv: ok\nschemas/examples/films.csv: ok\n");
    const auto validate = [&](const std::string& text) {
        write_text(folder / "t.csv", text);
        const Outcome outcome = run_irido({"validate", "t.csv"}, "", folder.path());
        CHECK(outcome.status == (outcome.out == "t.csv: ok\n" ? 0 : 1));
        return outcome.out;
    };
    const std::string ok = "t.csv: ok\n";
    CHECK(validate("# spot 3\nnm;R [%]\n500;4,1\n600;4,2\n") == ok);
    CHECK(validate("nm,R,T\n500,4,0.9\n") ==
          "t.csv: 2:5: R must be a fraction in [-0.02, 1.02] (got 4); name the column \"R [%]\" if "
          "it "
          "is in percent, R_fraction if it exceeds 1\n");
    CHECK(validate("nm,R_s,R_p\n500,0.1,0.2\n") == ok);  // a target names one
    CHECK(validate("nm,R_s,R_p\n500,0.1,2\n")
              .starts_with("t.csv: 2:9: R_p must be a fraction in [-0.02, 1.02] (got 2)"));
    CHECK(validate("nm,R,R\n500,0.1,0.2\n") ==
          "t.csv: has two columns for one purpose, 'R' and 'R'\n");
    CHECK(validate("nm,R,T\n500,0.1,0.9\n510,0.1\n") ==
          "t.csv: 3:1: must have 3 columns (got 2)\n");
    CHECK(validate("layers.0.thickness_nm,substrate\n1,Ag\n2,Au\n") == ok);
    CHECK(validate("layers.0.thickness_nm,substrate\n1,Ag\n2\n") ==
          "t.csv: 3:1: must have as many cells as the header, 2 (got 1)\n");
    CHECK(validate("light_theta_deg,light_phi_deg,view_theta_deg,view_phi_deg\n0,0,0,180\n") == ok);
    CHECK(validate("light_theta_deg,light_phi_deg,view_theta_deg,view_phi_deg\n0,0,99,180\n") ==
          "t.csv: row 1: view_theta_deg must be in [0, 90] (got 99)\n");
    CHECK(validate("id,film_n,film_d_nm,angle_deg,base_n\na,1.3,x,0,2\n") ==
          "t.csv: film_d_nm: row 1: must be a number (got 'x')\n");
    CHECK(validate("nm,power\n400,1\n500,2\n") == ok);
    CHECK(validate("nm,m\n400,1\n500,2\n").starts_with("t.csv: 1:1: must name known columns"));
}

TEST_CASE("a file that may not grow as large as the answer is no file", "[cli]") {
    const TemporaryFolder folder;
    const Outcome outcome = run_shell(
        "ulimit -f 10; \"$IRIDO\" spectrum '1 | 1.5@100 | 1' -a 0:89:1 -o limited.npy; status=$?; "
        "ls; exit $status",
        folder.path());
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == "irido: error: limited.npy: cannot be written: File too large\n");
}
