#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>
#include <set>

#include "tests/support/program.hpp"

using namespace irido::test;

namespace {

using Table = std::vector<std::vector<std::string>>;
const std::string kFilm = "1 | 1.5@100 | 1.9+1.5i";
const std::string kMirror = "1 | (1@200 | 1.5@180)^10 | 1";
const Words kFormats{"csv", "json", "npy", "h5"};

Table rows_of(const Words& arguments) {
    return parse_csv(out_of(arguments));
}

/// The command quoted for a shell.
std::string in_quotes(const Words& arguments) {
    std::string text;
    for (const std::string& argument : arguments) text += " '" + argument + "'";
    return text;
}

std::set<std::string> names_in(const std::string& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

int count_from_environment(const char* name, int otherwise) {
    const char* const text = std::getenv(name);
    return text ? std::atoi(text) : otherwise;
}

/// Appends the values below a header line, each row preceded by the values of the varied columns.
void append_rows(Table& to, const Words& leading, const Table& rows) {
    for (std::size_t row = 1; row < rows.size(); ++row) to.push_back(leading + rows[row]);
}

}  // namespace

TEST_CASE("a sweep's rows are those of its command, one stack after another", "[cli][sweep]") {
    const std::map<std::string, std::pair<std::string, Words>> queries{
        {"spectrum", {kFilm, {"-w", "400:700:100", "-a", "0,60", "-p", "s,u"}}},
        {"color", {kFilm, {"-a", "0,40,80", "--side", "R,T", "--method", "quadrature", "--stats"}}},
        {"bands", {kMirror, {"-a", "0,20"}}},
        {"cm", {kFilm, {"-a", "0,50", "--orders", "0:2:1", "--side", "T,R"}}}};
    for (const auto& [command, query] : queries) {
        const auto& [stack, options] = query;
        const std::string thickness =
            command == "bands" ? "layers.0.layers.1.thickness_nm" : "layers.0.thickness_nm";
        const Table swept = rows_of(Words{"sweep", stack, "--compute", command, "--vary",
                                          "substrate=1.2,Si", "--vary", thickness + "=150:170:10"} +
                                    options);
        Table single;
        for (const std::string substrate : {"1.2", "Si"}) {
            for (const std::string nm : {"150", "160", "170"}) {
                const Table rows = rows_of(Words{command, stack, "--set", "substrate=" + substrate,
                                                 "--set", thickness + "=" + nm} +
                                           options);
                if (single.empty()) single.push_back(Words{"substrate", thickness} + rows[0]);
                append_rows(single, {substrate, nm}, rows);
            }
        }
        INFO(command);
        CHECK(swept == single);
    }
}

TEST_CASE("angles and wavelengths are varied like values of the stack", "[cli][sweep]") {
    const Words whole{"sweep",    kFilm,    "--compute",
                      "spectrum", "--vary", "layers.0.thickness_nm=100,250"};
    const Table expected = rows_of(whole + Words{"-a", "0,30,60", "-w", "500,600"});
    // wavelength_nm and angle_deg are columns 1 and 2 of these rows
    const auto row_of = [&](const std::string& nm, const std::string& w, const std::string& a) {
        for (const auto& row : expected)
            if (row[0] == nm && row[1] == w && row[2] == a) return row;
        return Words{};
    };
    const auto check = [&](const Words& order) {
        Words arguments{"sweep", kFilm, "--compute", "spectrum"};
        const std::map<std::string, std::string> lists{{"layers.0.thickness_nm", "100,250"},
                                                       {"wavelength_nm", "500,600"},
                                                       {"angle_deg", "0,30,60"}};
        for (const std::string& path : order)
            arguments = arguments + Words{"--vary", path + "=" + lists.at(path)};
        const Table rows = rows_of(arguments);
        REQUIRE(rows.size() == 13);
        CHECK(rows[0] == order + Words{"polarization", "R", "T", "A"});
        std::set<Words> seen;
        for (std::size_t i = 1; i < rows.size(); ++i) {
            std::map<std::string, std::string> value;
            for (std::size_t c = 0; c < 3; ++c) value[order[c]] = rows[i][c];
            const Words want =
                row_of(value["layers.0.thickness_nm"], value["wavelength_nm"], value["angle_deg"]);
            REQUIRE(!want.empty());
            CHECK(Words(rows[i].begin() + 3, rows[i].end()) == Words(want.begin() + 3, want.end()));
            seen.insert({rows[i][0], rows[i][1], rows[i][2]});
        }
        CHECK(seen.size() == 12);
        CHECK(rows[1][2] != rows[2][2]);  // the last --vary changes fastest
    };
    check({"layers.0.thickness_nm", "wavelength_nm", "angle_deg"});
    check({"angle_deg", "layers.0.thickness_nm", "wavelength_nm"});
    check({"wavelength_nm", "angle_deg", "layers.0.thickness_nm"});
}

TEST_CASE("points are combinations that a file lists", "[cli][sweep]") {
    const TemporaryFolder folder;
    const std::string points = folder / "points.csv";
    write_text(points,
               "layers.0.thickness_nm,angle_deg,substrate\r\n100,10,Si\r\n"
               "250.5,70,\"{\"\"n\"\": 1.5, \"\"k\"\": 0.1}\"\r\n\r\n100,0,1.9+1.5i\r\n");
    const Table rows = rows_of({"sweep", kFilm, "--points", points, "--vary", "incident=1,1.33",
                                "--compute", "color", "--method", "quadrature"});
    REQUIRE(rows.size() == 7);
    CHECK(Words(rows[0].begin(), rows[0].begin() + 5) ==
          Words{"layers.0.thickness_nm", "angle_deg", "substrate", "incident", "side"});
    const std::string index = R"({"n":1.5,"k":0.1})";
    const Table single = rows_of({"color", kFilm, "--set", "layers.0.thickness_nm=250.5", "--set",
                                  "substrate=" + index, "--set", "incident=1.33", "-a", "70",
                                  "--method", "quadrature"});
    CHECK(rows[4][0] == "250.5");
    // the index contains a comma, at which parse_csv() splits it
    CHECK(Words(rows[4].end() - 11, rows[4].end()) == Words(single[1].end() - 11, single[1].end()));
}

TEST_CASE("wavelengths of points have the unit that their column names", "[cli][sweep]") {
    const TemporaryFolder folder;
    const auto with = [&](const std::string& points) {
        write_text(folder / "points.csv", points);
        return run_irido(
            {"sweep", kFilm, "--points", folder / "points.csv", "--compute", "spectrum"});
    };
    const Outcome nm = with("layers.0.thickness_nm,wavelength_nm\n100,550\n200,570\n");
    CHECK(nm.status == 0);
    for (const std::string& other : std::vector<std::string>{
             "wavelength_um\n100,0.55\n200,0.57\n", "Wavelength (angstrom)\n100,5500\n200,5700\n",
             "nm\n100,550\n200,570\n"}) {
        INFO(other);
        CHECK(with("layers.0.thickness_nm," + other).out == nm.out);
    }
    check_refused(with("wavelength,layers.0.thickness_nm\n550,100\n"), "must name its unit");
    check_refused(with("wavelength_um,layers.0.thickness_nm\n5e9,100\n"),
                  "wavelength_nm: must be in [1, 1e+07] (got 5e+12)");
    check_refused(with("wavelength_nm;layers.0.thickness_nm\n550;100\n"),
                  "columns must be separated by commas");
}

TEST_CASE("a sweep's bytes do not depend on threads", "[cli][sweep][slow]") {
    const TemporaryFolder folder;
    for (const std::string& format : kFormats) {
        std::string first;
        for (const std::string threads : {"1", "2", "7"}) {
            const std::string file = folder / ("sweep." + format);
            out_of({"sweep", kFilm, "--vary", "layers.0.thickness_nm=0:3000:3", "-a", "0:80:20",
                    "--vary", "substrate=Si,Ag", "--compute", "color", "-j", threads, "-o", file});
            if (first.empty()) first = read_file(file);
            CHECK(read_file(file) == first);
        }
    }
    CHECK(names_in(folder.path()) ==
          std::set<std::string>{"sweep.csv", "sweep.json", "sweep.npy", "sweep.h5"});
}

TEST_CASE("standard output has the bytes of the file", "[cli][sweep]") {
    const TemporaryFolder folder;
    const Words sweep{"sweep",     kMirror, "--vary", "layers.0.repeat=2:30:1",
                      "--compute", "bands", "-a",     "0:40:10"};
    for (const std::string format : {"csv", "json"}) {
        const std::string file = folder / ("sweep." + format);
        out_of(sweep + Words{"-o", file});
        CHECK(out_of(sweep + Words{"-f", format}) == read_file(file));
    }
    check_refused(run_irido(sweep + Words{"-f", "npy"}), "number of rows is not known");
    check_refused(run_irido(sweep + Words{"-f", "h5"}), "--output");
}

TEST_CASE("a killed sweep is resumed to the same bytes", "[cli][sweep][slow]") {
    const int kills = count_from_environment("IRIDO_TEST_KILLS", 12);
    std::mt19937 random(20);
    for (const std::string& format : kFormats) {
        const TemporaryFolder folder;
        const Words sweep{"sweep",    kFilm,        "--vary",    "layers.0.thickness_nm=0:40000:20",
                          "-a",       "0:80:40",    "--compute", "color",
                          "--method", "quadrature", "-o"};
        const std::string whole = folder / ("whole." + format), file = folder / ("f." + format);
        const auto start = std::chrono::steady_clock::now();
        out_of(sweep + Words{whole});
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        std::uniform_real_distribution<double> moment(0.1 * took.count(), 1.2 * took.count());
        int killed = 0, ended = 0;
        while (killed < kills / 4 || ended == 0) {
            const std::string seconds = std::to_string(moment(random));
            const Outcome outcome =
                run_shell("timeout -s " + std::string(killed % 3 == 2 ? "INT" : "KILL") + " " +
                              seconds + " \"$IRIDO\"" + in_quotes(sweep + Words{file, "--resume"}),
                          folder.path());
            if (outcome.status != 0) ++killed;
            if (std::filesystem::exists(file)) {  // it may have been killed right after finishing
                ++ended;
                CHECK(read_file(file) == read_file(whole));
                CHECK_FALSE(std::filesystem::exists(file + ".part"));
                std::filesystem::remove(file);
                REQUIRE(ended < 1000);
            } else {
                CHECK(outcome.status != 0);
            }
        }
    }
}

TEST_CASE("a part is resumed by its own command only", "[cli][sweep][slow]") {
    const TemporaryFolder folder;
    const std::string file = folder / "f.csv";
    const Words sweep{"sweep",     kFilm,   "--vary",   "layers.0.thickness_nm=0:1e6:20",
                      "--compute", "color", "--method", "quadrature"};
    const Outcome stopped = run_shell(  // as soon as the part has rows, on any machine
        "env --default-signal=INT \"$IRIDO\"" + in_quotes(sweep + Words{"-o", file}) +
            " & while kill -0 $! && [ \"$(stat -c %s f.csv.part || echo 0)\" -lt 4000 ]; do "
            "sleep 0.02; done 2> /dev/null; kill -INT $!; wait $!; echo $?",
        folder.path());
    CHECK(stopped.out == "130\n");
    CHECK(stopped.err.find("--resume") != std::string::npos);
    const std::string part = read_file(file + ".part");
    CHECK(part.ends_with("\n"));
    CHECK(out_of({"sweep", kFilm, "--vary", "layers.0.thickness_nm=0:400:20", "--compute", "color",
                  "--method", "quadrature"})
              .starts_with(part.substr(0, part.find('\n', 2000) + 1)));
    check_refused(run_irido(sweep + Words{"-o", file, "--resume", "-a", "1"}), "another request");
    CHECK(read_file(file + ".part") == part);
}

TEST_CASE("shards put together are the whole sweep", "[cli][sweep][slow]") {
    const TemporaryFolder folder;
    const Words sweep{
        "sweep",    kMirror,          "--vary", "layers.0.layers.0.thickness_nm=100:400:50",
        "--vary",   "substrate=1,Si", "-a",     "0,30",
        "--compute"};
    const std::map<std::string, Words> queries{
        {"spectrum", {"-w", "400:700:50"}}, {"color", {"--stats"}}, {"bands", {}}};
    for (const auto& [command, options] : queries) {
        for (const std::string& format : kFormats) {
            const std::string whole = folder / ("whole." + format);
            out_of(sweep + Words{command} + options + Words{"-o", whole});
            for (const int shards : {2, 7}) {
                Words files;
                for (int k = shards; k >= 1; --k) {
                    files.push_back(folder / (std::to_string(k) + "." + format));
                    out_of(sweep + Words{command} + options +
                           Words{"--shard", std::to_string(k) + "/" + std::to_string(shards), "-o",
                                 files.back()});
                }
                const std::string merged = folder / ("merged." + format);
                out_of(Words{"sweep", "--merge"} + files + Words{"-o", merged});
                INFO(command << " " << format << " " << shards);
                CHECK(read_file(merged) == read_file(whole));
                files.pop_back();
                check_refused(run_irido(Words{"sweep", "--merge"} + files + Words{"-o", merged}),
                              "shard 1 of " + std::to_string(shards));
            }
        }
    }
}

TEST_CASE("shards take about as much work each", "[cli][sweep][slow]") {
    constexpr int kShards = 8;
    const Words sweep{"sweep",    kFilm,        "--vary",    "layers.0.thickness_nm=100:100000:300",
                      "-a",       "0:80:10",    "--compute", "color",
                      "--method", "quadrature", "--stats"};
    double most = 0, all = 0;
    for (int k = 1; k <= kShards; ++k) {
        const Table rows = rows_of(
            sweep + Words{"--quiet", "--shard", std::to_string(k) + "/" + std::to_string(kShards)});
        double work = 0;
        for (std::size_t row = 1; row < rows.size(); ++row) work += std::stod(rows[row][14]);
        most = std::max(most, work);
        all += work;
    }
    // points of a wavelength are computed in powers of two, which the estimate does not model
    CHECK(most < 1.35 * all / kShards);
}

TEST_CASE("what cannot be computed is said, or left out", "[cli][sweep]") {
    const Words sweep{
        "sweep", "1.5 | 1@300 | 1.7", "--vary", "angle_deg=0:80:20", "--compute", "cm", "-p",
        "s",     "--orders",          "1"};
    const Outcome refused = run_irido(sweep);
    CHECK(refused.status == 2);
    CHECK(refused.err.find("at angle_deg=60: ") != std::string::npos);
    const Outcome kept = run_irido(sweep + Words{"--keep-going"});
    CHECK(kept.status == 0);
    CHECK(parse_csv(kept.out).size() == 4);
    CHECK(kept.err.find("left out 2 of 5; the first fails at angle_deg=60: ") != std::string::npos);
    // whether or not the angles are given together
    const Outcome list =
        run_irido({"sweep", "1.5 | 1@300 | 1.7", "--vary", "substrate=1.7,1.6", "-a", "0:80:20",
                   "--compute", "cm", "-p", "s", "--orders", "1", "--keep-going"});
    CHECK(parse_csv(list.out).size() == 7);
    CHECK(list.err.find("the first fails at substrate=1.7, angle_deg=60: ") != std::string::npos);
    // whichever value comes first
    const Outcome first =
        run_irido({"sweep", kFilm, "--vary", "layers.0.material=1.5+0.1i,1.5", "--compute", "cm",
                   "-p", "s", "--orders", "1", "--keep-going"});
    CHECK(first.status == 0);
    CHECK(parse_csv(first.out).size() == 2);
    // regardless of the parts
    for (const std::string shard : {"1/2", "2/2"}) {
        const Outcome part = run_irido({"sweep", "1.6 | (1.5@100 | 1.7@150)^10 | 1.6", "--vary",
                                        "layers.0.repeat=5,10", "-a", "0,85", "--compute", "bands",
                                        "--keep-going", "--shard", shard});
        INFO(part.err);
        CHECK(part.status == 0);
        CHECK(part.err.find("left out 1 of 2") != std::string::npos);
    }
    const Outcome tolerance =
        run_irido({"sweep", kFilm, "--vary", "layers.0.thickness_nm=10,20", "--compute", "color",
                   "--method", "naive", "--tolerance", "1e-3"});
    CHECK(tolerance.status == 1);
    CHECK(tolerance.err.find("at layers.0.thickness_nm=10: ") != std::string::npos);
}

TEST_CASE("wavelengths that cannot be computed take no other with them", "[cli][sweep]") {
    const std::string oxide = "air | SiO2@100 | Si";  // data from 210 nm
    const Words spectrum{"--compute", "spectrum", "--keep-going", "--quiet"};
    const Table all = rows_of(Words{"sweep", oxide, "--vary", "wavelength_nm=500,600"} + spectrum);
    REQUIRE(all.size() == 3);
    for (const std::string list : {"150,500,600", "500,150,600", "500,600,150"}) {
        CHECK(rows_of(Words{"sweep", oxide, "--vary", "wavelength_nm=" + list} + spectrum) == all);
        CHECK(rows_of(Words{"sweep", oxide, "--vary", "wavelength_nm=" + list, "--shard", "1/1"} +
                      spectrum) == all);
    }
    // with other values before and after it, in parts, and from a file
    const std::string film = "layers.0.thickness_nm=100,200", light = "wavelength_nm=150,500,600";
    const Table before = rows_of(Words{"sweep", oxide, "--vary", light, "--vary", film} + spectrum);
    CHECK(before.size() == 5);
    const Words after{"sweep", oxide, "--vary", film, "--vary", light};
    const Table rows = rows_of(after + spectrum);
    CHECK(rows.size() == 5);
    Table parts;
    for (const std::string shard : {"1/2", "2/2"}) {
        const Table part = rows_of(after + Words{"--shard", shard} + spectrum);
        parts.insert(parts.end(), part.begin() + (parts.empty() ? 0 : 1), part.end());
    }
    CHECK(parts == rows);
    const TemporaryFolder folder;
    write_text(folder / "p.csv",
               "wavelength_nm,layers.0.thickness_nm\n150,100\n500,100\n600,200\n");
    CHECK(rows_of(Words{"sweep", oxide, "--points", folder / "p.csv"} + spectrum).size() == 3);
}

TEST_CASE("a sweep in which nothing is left fails and replaces nothing", "[cli][sweep]") {
    const TemporaryFolder folder;
    const std::string file = folder / "rows.csv";
    const Words sweep{
        "sweep",    "air | SiO2@100 | Si", "--vary", "wavelength_nm=150,160", "--compute",
        "spectrum", "--keep-going"};
    const std::string reason =
        "irido: error: nothing is left: none of 2 combinations can be computed; the first fails at "
        "wavelength_nm=150: ";
    const auto check_failed = [&](const Words& options) {
        const Outcome outcome = run_irido(sweep + options);
        INFO(outcome.err);
        CHECK(outcome.status == 1);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.starts_with(reason));
    };
    check_failed({});
    check_failed({"-o", file});
    check_failed({"-o", file, "--resume"});
    CHECK(names_in(folder.path()).empty());
    write_text(file, "older rows");
    check_failed({"-o", file});
    CHECK(read_file(file) == "older rows");
    CHECK(names_in(folder.path()) == std::set<std::string>{"rows.csv"});
    // a part may be empty
    const Words part{
        "sweep",    "air | SiO2@100 | Si", "--vary", "wavelength_nm=150,500", "--compute",
        "spectrum", "--keep-going",        "--quiet"};
    for (const std::string k : {"1", "2"})
        CHECK(run_irido(part + Words{"--shard", k + "/2", "-o", folder / k + ".csv"}).status == 0);
    CHECK(run_irido({"sweep", "--merge", folder / "2.csv", folder / "1.csv", "-o", file}).status ==
          0);
    CHECK(read_file(file) == out_of(part));
}

TEST_CASE("a job array of one, an edited digit, another SIMD level", "[cli][sweep]") {
    const TemporaryFolder folder;
    const std::string one = folder / "1.csv", two = folder / "2.csv", all = folder / "all.csv";
    const Words sweep{"sweep",     kFilm,      "--vary", "layers.0.thickness_nm=100:200:10",
                      "--compute", "spectrum", "-w",     "500"};
    const std::string rows = out_of(sweep);
    REQUIRE(run_irido(sweep + Words{"--shard", "1/1", "-o", one}).status == 0);
    CHECK(names_in(folder.path()) == std::set<std::string>{"1.csv", "1.csv.sweep"});
    CHECK(run_irido({"sweep", "--merge", one, "-o", all}).status == 0);
    CHECK(read_file(all) == rows);
    REQUIRE(run_irido(sweep + Words{"--shard", "1/2", "-o", one}).status == 0);
    REQUIRE(run_irido(sweep + Words{"--shard", "2/2", "-o", two}).status == 0);
    const Words merge{"sweep", "--merge", one, two, "-o", all};
    std::string edited = read_file(two);
    edited[edited.size() - 3] ^= 1;
    write_text(two, edited);
    check_refused(run_irido(merge), "2.csv: does not match its journal: rerun it");
    REQUIRE(run_irido(sweep + Words{"--shard", "2/2", "-o", two, "--resume"}).status == 0);
    CHECK(run_irido(merge).status == 0);
    CHECK(read_file(all) == rows);
    const std::string plain =
        "IRIDO_SIMD=plain \"$IRIDO\"" + in_quotes(sweep + Words{"--shard", "2/2", "-o", two});
    REQUIRE(run_shell(plain, folder.path()).status == 0);
    check_refused(run_irido(merge), "was computed at SIMD level plain");
}

TEST_CASE("a value inside of another that varies is refused", "[cli][sweep][refused]") {
    const std::string layer = R"({"material":1.4,"thickness_nm":5})";
    const std::vector<std::pair<std::string, std::string>> pairs{
        {"layers.0.thickness_nm=1,2", "layers.0=" + layer},
        {"layers.0.material.n=1.5,1.6", "layers.0.material={\"n\":1.4}"},
        {"layers.0.material.n=1.5,1.6", "layers.0=" + layer},
        {"layers.0.thickness_nm=1,2", "layers=[" + layer + "]"},
        {"layers.0.thickness_nm=1,2", "layers.00=" + layer}};
    for (const auto& [inner, outer] : pairs) {
        const std::string said = inner.substr(0, inner.find('=')) + " is inside " +
                                 outer.substr(0, outer.find('=')) + ", which also varies";
        const Words compute{"--compute", "color"};
        check_refused(run_irido(Words{"sweep", kFilm, "--vary", inner, "--vary", outer} + compute),
                      "--vary: " + said);
        check_refused(run_irido(Words{"sweep", kFilm, "--vary", outer, "--vary", inner} + compute),
                      "--vary: " + said);
    }
    for (const std::string twice : {"layers.0.thickness_nm=3", "layers.00.thickness_nm=3"})
        check_refused(run_irido({"sweep", kFilm, "--vary", "layers.0.thickness_nm=1,2", "--vary",
                                 twice, "--compute", "color"}),
                      "is varied twice");
    const TemporaryFolder folder;
    write_text(folder / "p.csv", "layers.0.thickness_nm,substrate\n1,Ag\n2,Au\n");
    check_refused(run_irido({"sweep", kFilm, "--points", folder / "p.csv", "--vary",
                             "layers.0=" + layer, "--compute", "color"}),
                  "--points: layers.0.thickness_nm is inside layers.0");
    // neither is inside the other
    CHECK(run_irido({"sweep", kFilm, "--vary", "layers.0.material=1.4,1.5", "--vary",
                     "layers.0.thickness_nm=1,2", "--compute", "color"})
              .status == 0);
}

TEST_CASE("sweeps say what was used again", "[cli][sweep]") {
    const Outcome outcome = run_irido({"sweep", kFilm, "--vary", "substrate=Ag,Au,Cu", "--vary",
                                       "layers.0.thickness_nm=0:100:10", "--compute", "spectrum",
                                       "-w", "500", "--stats"});
    CHECK(outcome.err.find("33 stacks; 3 structures") != std::string::npos);
}

TEST_CASE("a sweep that cannot be written leaves nothing", "[cli][sweep]") {
    const TemporaryFolder folder;
    const std::string command =
        "\"$IRIDO\"" + in_quotes({"sweep", kFilm, "--vary", "layers.0.thickness_nm=0:20000:1",
                                  "--compute", "color", "--quiet"});
    for (const std::string& format : kFormats) {
        const Outcome full =
            run_shell("ulimit -f 100; " + command + " -o f." + format + "; echo $?", folder.path());
        CHECK(full.out == "2\n");
        CHECK(full.err.find("f." + format + ": cannot be written: ") != std::string::npos);
        CHECK(names_in(folder.path()).empty());
    }
    const Outcome kept =
        run_shell("ulimit -f 100; " + command + " -o f.csv --resume; echo $?", folder.path());
    CHECK(kept.out == "2\n");
    CHECK(names_in(folder.path()) == std::set<std::string>{"f.csv.part", "f.csv.sweep"});
    CHECK(run_shell(command + " -o f.csv --resume && " + command + " | cmp - f.csv", folder.path())
              .status == 0);
    CHECK(run_shell(command + " > /dev/full; echo $?", folder.path()).out == "2\n");
    CHECK(run_shell(command + " -o /dev/full; echo $?", folder.path()).out == "2\n");
    const Outcome pipe = run_shell(command + " | head -1", folder.path());
    CHECK(pipe.err.empty());
    CHECK(run_shell(command + " -o /proc/f.csv; echo $?", folder.path()).out == "2\n");
}

TEST_CASE("sweeps refuse what makes no sense", "[cli][sweep][slow]") {
    const auto refused = [](const Words& options, const std::string& error) {
        check_refused(run_irido(Words{"sweep", kFilm} + options), error);
    };
    const Words color{"--compute", "color"}, some{"--vary", "layers.0.thickness_nm=1,2"};
    refused(some, "--compute: is required");
    refused(some + Words{"--compute", "hue"}, "--compute: must be one of");
    refused(color, "requires --vary PATH=LIST, --points FILE or --scatter PATH=SIGMA");
    refused(color + Words{"--vary", "layers.0.thickness_nm"}, "must be PATH=LIST");
    refused(color + Words{"--vary", "layers.0.thickness_nm=-1:5:1"},
            "must be in [0, 1e9] (got -1)");
    refused(color + Words{"--vary", "layers.0.thickness_nm=Ag,1,2"},
            "--vary layers.0.thickness_nm: must be numbers");
    refused(color + Words{"--vary", "layers.1.thickness_nm=1,2"}, "layers.1.thickness_nm");
    refused(color + Words{"--vary", "layers.0.thicknes_nm=1,2"}, "thickness_nm");
    refused(color + Words{"--vary", "substrate=Ag,Unobtainium"}, "Unobtainium");
    refused(color + Words{"--vary", "substrate=Ag,,Au"}, "values must not be empty");
    refused(color + some + some, "varied twice");
    refused(color + Words{"--vary", "layers.0.thickness_nm=0:1/10000000", "--vary",
                          "layers.0.material=1:2/10000000", "--vary", "substrate=1:2/100"},
            "1e15 combinations");
    refused(color + Words{"--vary", "layers.0.thickness_nm=0:1/10000000", "--vary",
                          "layers.0.material=1:2/10000000", "-a", "0:1/100000"},
            "1e18 combinations");
    refused(color + Words{"--vary", "angle_deg=0,91"}, "must be in [0, 90] (got 91)");
    refused(color + Words{"--vary", "wavelength_nm=500,600"}, "--compute spectrum");
    refused(color + Words{"--vary", "angle_deg=0,10", "-a", "5"}, "--angles: cannot be combined");
    refused({"--compute", "spectrum", "--vary", "wavelength_nm=500", "-w", "5"},
            "--wavelengths: cannot be combined");
    refused(color + some + Words{"--shard", "3/2"}, "--shard");
    refused(color + some + Words{"--shard", "0/2"}, "--shard");
    refused(color + some + Words{"--shard", "2"}, "must be K/N");
    refused(color + some + Words{"--resume"}, "requires --output FILE");
    refused(color + some + Words{"-f", "gif"}, "must be one of csv, h5, json, npy, pdf, png, svg");
    refused(color + Words{"--points", "tests/data/glass.csv"}, "");
    const TemporaryFolder folder;
    const std::string points = folder / "points.csv";
    write_text(points, "layers.0.thickness_nm,angle_deg\n5,10\n-5,20\n");
    refused(color + Words{"--points", points}, "points.csv: combination 2: ");
    write_text(points, "layers.0.thickness_nm\n5\n6\nthick\n7\n");
    refused(color + Words{"--points", points},
            "combination 3: layers.0.thickness_nm: must be numbers (got 'thick')");
    write_text(points, "substrate,angle_deg\nSi,10\nSi,99\n");
    refused(color + Words{"--points", points}, "combination 2: angle_deg: must be in [0, 90]");
    write_text(points, "substrate,angle_deg\nSi,10\nNone,9\n");
    refused(color + Words{"--points", points}, "combination 2: ");
    refused({"--compute", "spectrum", "--columns", "A_layers", "--vary",
             R"(layers=[{"material":1.5,"thickness_nm":9}],[])"},
            "the same number of layers");
    check_refused(run_irido(Words{"sweep"} + color + some), "STACK is required");
    check_refused(run_irido({"sweep", "--merge", "README.md", "-o", "/tmp/never.csv"}),
                  "README.md");
}
