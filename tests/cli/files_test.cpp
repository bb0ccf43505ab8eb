#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/support/program.hpp"

using namespace irido::test;

namespace {

using Catch::Matchers::Contains;
namespace fs = std::filesystem;

const std::string kStack = R"({"name": "film", "incident": "air",
 "layers": [{"material": {"file": "glass.csv"}, "thickness_nm": 100}], "substrate": "Si"})";
const std::string kGlass = "300,1.5\n900,1.45\n";
const std::string kWithMetal = "air | TiO2@100 | Si";

/// A folder with a stack, its material, an illuminant, points, and links to the stack.
class InputFolder {
public:
    InputFolder() {
        write_text(folder_ / "s.json", kStack);
        write_text(folder_ / "glass.csv", kGlass);
        write_text(folder_ / "light.csv", "300,1\n900,1\n");
        write_text(folder_ / "points.csv", "layers.0.thickness_nm\n100\n200\n");
        write_text(folder_ / "scene.json", R"({"materials": {"a": {"stack": "s.json"}}})");
        fs::create_hard_link(folder_ / "s.json", folder_ / "hard.csv");
        fs::create_symlink("s.json", folder_ / "soft.csv");
        fs::create_symlink("nothing.csv", folder_ / "dangling.csv");
        fs::create_directory(folder_ / "sub");
    }

    Outcome shell(const std::string& command) const { return run_shell(command, folder_.path()); }
    std::string operator/(const std::string& name) const { return folder_ / name; }

    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
    }
    bool is_unchanged() const {
        return read_file(folder_ / "s.json") == kStack &&
               read_file(folder_ / "glass.csv") == kGlass && fs::is_symlink(folder_ / "soft.csv") &&
               fs::is_symlink(folder_ / "dangling.csv");
    }

private:
    TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("what a killed process of the same number left does not stop the next one",
          "[cli][files]") {
    const InputFolder folder;
    const Outcome outcome = folder.shell(
        "touch out.csv.part$$; exec $IRIDO "
        "spectrum '1 | 2@9 | 1' -w 550 -o out.csv");
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(folder.shell("wc -l < out.csv").out == "2\n");
}

TEST_CASE("what killed processes left of the same output is removed", "[cli][files]") {
    const InputFolder folder;
    const Outcome outcome = folder.shell(
        "sleep 60 > wait.txt 2>&1 & live=$!; dead=$(sh -c 'echo $$'); "
        "touch -d '1 hour ago' out.csv.part$dead out.csv.part$dead-3 out.csv.part$live "
        "out.csv.part$dead.gz out.csv.part other.csv.part$dead && touch out.csv.part$dead-1 && "
        "$IRIDO spectrum '1 | 2@9 | 1' -w 550 -o out.csv && "
        "ls out.csv* other.csv* | sed \"s/$dead/DEAD/;s/$live/LIVE/\" | "
        "LC_ALL=C sort | tr '\\n' ' '; kill $live");
    INFO(outcome.err);
    // a young one may be about to be locked; others are not irido's, or another output's
    CHECK(outcome.out ==
          "other.csv.partDEAD out.csv out.csv.part out.csv.partDEAD-1 out.csv.partDEAD.gz "
          "out.csv.partLIVE ");
}

TEST_CASE("a part that another process is writing is left", "[cli][files]") {
    const InputFolder folder;
    // the lock of a process on another machine, whose number means no process here
    const Outcome outcome = folder.shell(
        "python3 -c 'import fcntl, os, time\n"
        "part = open(\"out.csv.part4194303\", \"w\")\n"
        "fcntl.lockf(part, fcntl.LOCK_EX)\n"
        "os.utime(\"out.csv.part4194303\", (0, 0))\n"
        "print(flush=True)\n"
        "time.sleep(60)' > ready & until [ -s ready ]; do sleep 0.05; done; "
        "$IRIDO spectrum '1 | 2@9 | 1' -w 550 -o out.csv; ls out.csv.part*; kill $!; wait; "
        "$IRIDO spectrum '1 | 2@9 | 1' -w 550 -o out.csv; ls | grep -c part");
    INFO(outcome.err);
    CHECK(outcome.out == "out.csv.part4194303\n0\n");
}

TEST_CASE("an output that is one of the inputs is refused, whatever it is called", "[cli][files]") {
    const InputFolder folder;
    const std::size_t files = folder.files();
    const std::string vary = "--vary layers.0.thickness_nm=1,2 --compute spectrum -w 550 ";
    for (const std::string& command : std::vector<std::string>{
             "spectrum s.json -f csv -o s.json",
             "spectrum s.json -f csv -o ./sub/../s.json",
             "spectrum s.json -o hard.csv",
             "spectrum s.json -o soft.csv",
             "spectrum soft.csv -f csv -o s.json",
             "spectrum s.json -w 550 -o glass.csv",
             "spectrum - -f csv -o s.json < s.json",
             "spectrum /dev/stdin --set layers.0.material=SiO2 -o hard.csv < s.json",
             "spectrum s.json -w 550 >> s.json",
             "color s.json -f csv -o s.json",
             "color s.json --illuminant light.csv -o light.csv",
             "color s.json -f svg -o hard.csv",
             "cm s.json --set substrate=1.5 -o hard.csv",
             "lut color s.json --vary layers.0.thickness_nm=0:100/4 -o hard.csv",
             "lut cumulative --illuminant light.csv -o light.csv",
             "sweep s.json " + vary + "-f csv -o s.json",
             "sweep s.json " + vary + "-o glass.csv",
             "sweep s.json " + vary + ">> s.json",
             "sweep s.json --points points.csv --compute spectrum -w 550 -o points.csv",
             "view s.json -f html -o hard.csv",
             "render s.json --size 8,8 -f png -o s.json",
             "profile s.json -w 550 -o glass.csv",
             "compare s.json --quiet --engine gltf --set layers.0.material=1.3 -o hard.csv",
             "design s.json --free layers.0.thickness_nm=50:150 --target 'R 500 = 0' -o s.json",
             "brdf s.json --alpha 0.1 -w 550 -o glass.csv",
             "convert s.json -o hard.csv",
         }) {
        INFO(command);
        check_refused(folder.shell("\"$IRIDO\" " + command), "is one of the inputs");
        CHECK(folder.is_unchanged());
        CHECK(folder.files() == files);
    }
}

TEST_CASE("files beside an output are not the inputs either", "[cli][files]") {
    const InputFolder folder;
    const std::string vary = " --quiet --vary layers.0.thickness_nm=1,2 --compute spectrum ";
    for (const std::string& name :
         std::vector<std::string>{"x.h5.part", "x.h5.sweep", "x.h5.part.tmp", "x.bin.json"}) {
        INFO(name);
        write_text(folder / name, kStack);
        const bool is_lut = name.starts_with("x.bin");
        check_refused(folder.shell(is_lut ? "\"$IRIDO\" lut color " + name +
                                                " --vary layers.0.thickness_nm=0:100/4 -o x.bin"
                                          : "\"$IRIDO\" sweep " + name + vary + "-o x.h5"),
                      name + ": is one of the inputs");
        CHECK(read_file(folder / name) == kStack);
        fs::remove(folder / name);
    }
}

TEST_CASE("a table that is compared is an input", "[cli][files]") {
    const InputFolder folder;
    const std::string stack = "'1 | 1.3@300 | 1.5'";
    CHECK(folder
              .shell("\"$IRIDO\" lut color " + stack +
                     " --vary layers.0.thickness_nm=0:100/3 --cos 0:1/3 -o t.npy")
              .status == 0);
    const std::string table = read_file(folder / "t.npy");
    for (const std::string& name : std::vector<std::string>{"t.npy", "t.npy.json"}) {
        check_refused(folder.shell("\"$IRIDO\" compare " + stack +
                                   " --lut t.npy --random 5 -f csv -o " + name),
                      name + ": is one of the inputs");
        CHECK(read_file(folder / "t.npy") == table);
    }
}

TEST_CASE("messages never go into a file that is written", "[cli][files]") {
    const InputFolder folder;
    const std::string noted = "\"$IRIDO\" spectrum 'Si | air@100 | Si' -w 1090 -o x.csv ";
    CHECK(folder.shell(noted).err.find("taken as transparent") != std::string::npos);
    const std::string expected = read_file(folder / "x.csv");
    for (const std::string& closed : std::vector<std::string>{"2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
        INFO(closed);
        fs::remove(folder / "x.csv");
        CHECK(folder.shell(noted + closed).status == 0);
        CHECK(read_file(folder / "x.csv") == expected);
    }
    check_refused(folder.shell("\"$IRIDO\" spectrum - -w 550 <&-"),
                  "<stdin>: cannot be read: Bad file descriptor");
}

TEST_CASE("two outputs are two files", "[cli][files]") {
    const InputFolder folder;
    const std::string bands = "\"$IRIDO\" bands '1 | (1@200 | 1.5@180)^10 | 1' -a 0,10 ";
    write_text(folder / "old.svg", "old");
    fs::create_hard_link(folder / "old.svg", folder / "same.csv");
    for (const std::string& outputs : std::vector<std::string>{
             "-o x.svg -f csv --plot x.svg", "-o x.svg -f csv --plot ./sub/../x.svg",
             "-o same.csv --plot old.svg"}) {
        INFO(outputs);
        check_refused(folder.shell(bands + outputs), "is the same file as");
        CHECK_FALSE(fs::exists(folder / "x.svg"));
        CHECK(read_file(folder / "old.svg") == "old");
    }
    fs::create_symlink("t.bin", folder / "t.bin.json");
    write_text(folder / "t.bin", "old");
    check_refused(folder.shell("\"$IRIDO\" lut color '" + kWithMetal +
                               "' --vary layers.0.thickness_nm=0:100/4 -o t.bin"),
                  "is the same file as");
    CHECK(read_file(folder / "t.bin") == "old");
}

TEST_CASE("an output is refused that is a link to nothing, or nothing", "[cli][files]") {
    const InputFolder folder;
    const std::string stack = " '" + kWithMetal + "' ";
    for (const std::string& command : std::vector<std::string>{
             "spectrum" + stack + "-w 550", "color" + stack,
             "lut color" + stack + "--vary layers.0.thickness_nm=0:100/4", "materials list",
             "sweep" + stack + "--vary layers.0.thickness_nm=1,2 --compute spectrum"}) {
        INFO(command);
        check_refused(folder.shell("\"$IRIDO\" " + command + " -o dangling.csv"),
                      "dangling.csv: cannot be written: dangling symbolic link");
        check_refused(folder.shell("\"$IRIDO\" " + command + " -o ''"), "must name a file");
        CHECK(folder.is_unchanged());
    }
}

TEST_CASE("links to files, devices, pipes and files without a name are written to",
          "[cli][files]") {
    const InputFolder folder;
    const std::string run = "\"$IRIDO\" spectrum '" + kWithMetal + "' -w 550 ";
    const std::string expected = folder.shell(run).out;
    write_text(folder / "real.csv", "old");
    fs::create_symlink("real.csv", folder / "link.csv");
    CHECK(folder.shell(run + "-o link.csv").status == 0);
    CHECK(fs::is_symlink(folder / "link.csv"));
    CHECK(read_file(folder / "real.csv") == expected);
    CHECK(folder.shell(run + "-o /dev/stdout").out == expected);
    CHECK(folder.shell(run + "-o /dev/stdout | cat").out == expected);
    CHECK(folder.shell(run + "-o /dev/null").status == 0);
    CHECK(folder.shell("mkfifo f; " + run + "-f csv -o f & cat f; wait").out == expected);
    CHECK(
        folder.shell("exec 3<> gone; rm gone; " + run + "-f csv -o /dev/fd/3; cat /dev/fd/3").out ==
        expected);
}

TEST_CASE("output that cannot be written is refused by every command", "[cli][files][slow]") {
    const InputFolder folder;
    const std::string examples = IRIDO_SOURCE_DIR "/schemas/examples/";
    const std::string stack = " '" + kWithMetal + "' ",
                      spoon = examples + "surfaces/worn-spoon.json";
    write_text(folder / "plain.json", R"({"materials": [
        {"name": "a", "stack": "1 | 1.5@200 | 2", "shading": "color"}]})");
    const std::vector<std::string> with_output{
        "spectrum" + stack + "-w 550",
        "color" + stack,
        "cm '1 | 1.42@400 | 1.87'",
        "bands '1 | (1@200 | 1.5@180)^10 | 1'",
        "profile" + stack + "-w 550",
        "brdf" + stack + "--alpha 0.1 -w 550",
        "scratches " + spoon,
        "compare list",
        "sweep" + stack + "--vary layers.0.thickness_nm=1,2 --compute spectrum -w 550",
        "lut color" + stack + "--vary layers.0.thickness_nm=0:100/4 --cos 0:1/4",
        "lut list",
        "render" + stack + "--size 8 -f png",
        "view" + stack,
        "materials list",
        "materials show Au -w 500 --quiet",
        "convert" + stack,
        "bench stability --regime critical --count 1"};
    const std::vector<std::string> without_output{"plan plain.json --quiet", "validate plain.json",
                                                  "validate --schema",       "lut shader color",
                                                  "manual spectrum",         "completion bash"};
    const auto refused = [&](const std::string& command, const std::string& said) {
        const Outcome outcome = folder.shell("\"$IRIDO\" " + command);
        INFO(command);
        check_refused(outcome, said);
    };
    for (const std::string& command : with_output) {
        refused(command + " -o /dev/full", "/dev/full: cannot be written: No space left");
        const std::string null = command + (command.starts_with("view") ? " -f html" : "");
        refused(null + " > /dev/full", "standard output: cannot be written: No space left");
    }
    for (const std::string& command : without_output)
        refused(command + " > /dev/full", "standard output: cannot be written: No space left");
    for (const auto* commands : {&with_output, &without_output})
        for (std::string command : *commands) {  // nobody reads: quiet
            if (command.starts_with("view")) command += " -f html";
            INFO(command);
            const Outcome outcome = folder.shell("{ \"$IRIDO\" " + command +
                                                 "; echo $? > status; } | true; cat status");
            CHECK(outcome.out == "0\n");
            CHECK(outcome.err.empty());
        }
    fs::remove(folder / "status");
    refused("plan plain.json -o /dev/full", "--output: must name a folder (got '/dev/full')");
    refused("plan plain.json -o plain.json", "the plan goes to standard output");
    refused("bake plain.json -o /dev/full", "/dev/full: cannot be created");
    refused("bands '1 | (1@200 | 1.5@180)^10 | 1' -a 0:80:20 --plot /dev/full",
            "--plot: must end in");
}

TEST_CASE("inputs that never end are refused", "[cli][files][slow]") {
    const InputFolder folder;
    const std::string stack = " '" + kWithMetal + "' ";
    for (const std::string& command : std::vector<std::string>{
             "spectrum /dev/zero", "spectrum - < /dev/zero", "validate /dev/zero", "plan /dev/zero",
             "color" + stack + "--illuminant /dev/zero",
             "sweep" + stack + "--points /dev/zero --compute spectrum"}) {
        INFO(command);
        const Outcome outcome = folder.shell("\"$IRIDO\" " + command);
        check_refused(outcome, "must be at most 64 MiB");
    }
    folder.shell("mkfifo fifo.csv; ln -s /dev/zero zero.csv");
    for (const std::string& file : std::vector<std::string>{"fifo.csv", "zero.csv"})
        check_refused(folder.shell("timeout 10 \"$IRIDO\" spectrum s.json --set "
                                   "layers.0.material.file=" +
                                   file),
                      "must be a regular file");
    check_refused(folder.shell("mkfifo t.ktx2; timeout 10 \"$IRIDO\" lut info t.ktx2"),
                  "must be a regular file");
}

TEST_CASE("a stack may come from a pipe", "[cli][files]") {
    const InputFolder folder;
    const std::string expected = folder.shell("\"$IRIDO\" spectrum s.json -w 550").out;
    CHECK(folder.shell("cat s.json | \"$IRIDO\" spectrum - -w 550").out == expected);
    CHECK(folder.shell("sed s/{.file.*csv.}/1.5/ s.json | \"$IRIDO\" spectrum /dev/stdin -w 550")
              .out ==
          folder.shell("\"$IRIDO\" spectrum s.json --set layers.0.material=1.5 -w 550").out);
    CHECK(folder.shell("mkfifo f.json; cat s.json > f.json & \"$IRIDO\" spectrum f.json -w 550")
              .out == expected);
    CHECK_FALSE(expected.empty());
}

TEST_CASE("whatever the names are, what is written is well formed", "[cli][files][slow]") {
    const InputFolder folder;
    const std::string odd =
        R"("\u0001 ]]> & < \uFFFE \uFFFF \u001b \" \u00b5m \ud83c\udf08\u0000")";
    const auto stack = [](const std::string& name) {
        return "{\"name\": " + name +
               R"(, "incident": "air", "layers": [{"material": {"n": 1.5, "name": )" + name +
               R"(}, "thickness_nm": 100}], "substrate": "Si"})";
    };
    write_text(folder / "odd.json", stack(odd));
    fs::copy_file(folder / "odd.json", folder / "\xFF]]>.json");
    fs::copy_file(folder / "light.csv", folder / "\xFF.csv");
    const std::string xml = "python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' ";
    const std::string json =
        "python3 -c 'import sys, json; json.load(open(sys.argv[1], encoding=\"utf-8\"))' ";
    for (const std::string& command :
         std::vector<std::string>{"color odd.json -a 0,10 -o x.svg",
                                  "color '\xFF]]>.json' --set 'name=\"\"' -o x.svg"}) {
        INFO(command);
        CHECK(folder.shell("\"$IRIDO\" " + command + " && " + xml + "x.svg").err.empty());
    }
    CHECK(folder
              .shell("\"$IRIDO\" bands '1 | (1@200 | 1.5@180)^10 | 1' --set 'name=]]>' -a 0,10 "
                     "--plot x.svg > /dev/null && " +
                     xml + "x.svg")
              .err.empty());
    CHECK(folder
              .shell("\"$IRIDO\" lut color odd.json --vary layers.0.thickness_nm=0:100/4 -o x.bin "
                     "&& " +
                     json + "x.bin.json && \"$IRIDO\" lut info x.bin > i.json && " + json +
                     "i.json")
              .err.empty());
    for (const std::string& format : std::vector<std::string>{"csv", "json"}) {
        INFO(format);
        CHECK(folder
                  .shell("\"$IRIDO\" color odd.json --compare-illuminants --illuminant '\xFF.csv' "
                         "-f " +
                         format + " -o x && python3 -c 'open(\"x\", encoding=\"utf-8\").read()'")
                  .err.empty());
    }
    write_text(folder / "odd.csv", "substrate\nSi\n\xFF\n");
    write_text(folder / "nul.csv", std::string("name\na\nb\0\n", 10));
    const std::string sweep = "\"$IRIDO\" sweep s.json --compute spectrum -w 550 ";
    for (const std::string& command : std::vector<std::string>{
             sweep + "--points odd.csv", sweep + "--points nul.csv", sweep + "--vary 'name=a,\xFF'",
             sweep + "--vary '\xFF=1,2'", std::string("\"$IRIDO\" color s.json --set 'name=\xFF'"),
             std::string("\"$IRIDO\" color s.json --set 'name=\x01'"),
             std::string("\"$IRIDO\" color 'air | \xFF@10 | Si'")}) {
        INFO(command);
        check_refused(folder.shell(command), "must be UTF-8 without control characters");
    }
}

TEST_CASE("an empty word is refused where it was typed", "[cli][files]") {
    const InputFolder folder;
    const std::string stack = " '" + kWithMetal + "'";
    for (const auto& [command, said] : std::vector<std::pair<std::string, std::string>>{
             {"materials list -o ''", "--output: must name a file"},
             {"materials show SiO2 -o ''", "--output: must name a file"},
             {"lut list -o ''", "--output: must name a file"},
             {"convert" + stack + " -o ''", "--output: must name a file"},
             {"cm" + stack + " -o ''", "--output: must name a file"},
             {"bands" + stack + " -o ''", "--output: must name a file"},
             {"bench speed -o ''", "--output: must name a file"},
             {"bench stability -o ''", "--output: must name a file"},
             {"bench pareto -o ''", "--output: must name a file"},
             {"bench scene scene.json -o ''", "--output: must name a file"},
             {"sweep --merge a b -o ''", "--output: must name a file"},
             {"plan scene.json -o ''", "--output: must name a folder"},
             {"bake scene.json -o ''", "--output: must name a folder"},
             {"bake scene.json -o b --manifest ''", "--manifest: must name a file"},
             {"plan ''", "SCENE: must name a file"},
             {"validate ''", "FILE: must name a file"},
             {"lut check x ''", "FILE: must name a file"},
             {"spectrum ''", "STACK: must not be empty"},
             {"color" + stack + " -f ''", "--format: must not be empty"},
             {"color" + stack + " --illuminant ''", "--illuminant: must not be empty"},
             {"bands" + stack + " --plot ''", "--plot: must name a file"},
             {"sweep --merge a '' -o x.csv", "--merge: must name a file"},
             {"sweep" + stack + " --compute color --points ''", "--points: must name a file"}}) {
        INFO(command);
        check_refused(folder.shell("\"$IRIDO\" " + command), said);
        CHECK(folder.is_unchanged());
    }
}

TEST_CASE("odd names leave tables, manifests and journals well formed", "[cli][files][slow]") {
    const TemporaryFolder folder;
    const std::string odd = R"("\u0001 ]]> \" \\ \n \uFFFE \uFFFF \u00b5m\u0000")";
    write_text(folder / "odd.json", "{\"name\": " + odd +
                                        R"(, "incident": "air", "layers": [{"material":
        {"n": 1.5, "name": )" + odd + R"(}, "thickness_nm": 100}], "substrate": "Si"})");
    write_text(folder / "check.py", R"(
import glob, json, struct, sys
def metadata(file):
    data = open(file, 'rb').read()
    if file.endswith('.ktx2'):
        place, size = struct.unpack_from('<II', data, 56)
        end = place + size
        while place < end:
            length, = struct.unpack_from('<I', data, place)
            key, value = data[place + 4:place + 4 + length].split(b'\0', 1)
            if key == b'irido.metadata': yield value.rstrip(b'\0')
            place += 4 + (length + 3) // 4 * 4
    elif file.endswith('.exr'):
        place = 8
        while data[place]:
            name, kind = data[place:].split(b'\0', 2)[:2]
            place += len(name) + len(kind) + 2
            length, = struct.unpack_from('<i', data, place)
            if name == b'irido.metadata': yield data[place + 4:place + 4 + length]
            place += 4 + length
    else:
        yield data.split(b'\n{')[0].splitlines()[0] if file.endswith('.sweep') else data
for file in sys.argv[1:]:
    for text in list(metadata(file)) or [b'missing in ' + file.encode()]:
        json.loads(text.decode('utf-8'))
)");
    const auto check = [&](const std::string& command) {
        INFO(command);
        const Outcome outcome = run_shell(command, folder.path());
        CHECK(outcome.status == 0);
        CHECK(outcome.err.empty());
    };
    for (const std::string& file : std::vector<std::string>{"x.exr", "x.ktx2"})
        check("\"$IRIDO\" lut color odd.json --vary layers.0.thickness_nm=0:100/4 --size 4 -o " +
              file + " --quiet && \"$IRIDO\" lut check " + file + " && python3 check.py " + file);
    for (const std::string& file : std::vector<std::string>{"x.csv", "x.npy", "x.h5", "x.json"})
        check(
            "\"$IRIDO\" sweep odd.json --compute spectrum -w 550 --shard 1/1 --vary "
            "'layers.0.material={\"n\": 1.5, \"name\": " +
            odd + "},Si' -o " + file + " && python3 check.py " + file + ".sweep");

    // file and folder names that are not valid text
    fs::create_directory(folder / "d\xFF");
    write_text(folder / "d\xFF/s\x01\xFF]]>.json", R"({"materials": [
        {"name": "a", "stack": "../odd.json", "shading": "color", "angles_deg": [0, 60]}]})");
    const std::string scene = " 'd\xFF/s\x01\xFF]]>.json'";
    const std::string bake = "\"$IRIDO\" bake" + scene + " -o 'b\xFF' --quiet";
    check(bake +
          " && python3 check.py 'b\xFF/manifest.json' && \"$IRIDO\" validate "
          "'b\xFF/manifest.json' && " +
          bake);
    write_text(folder / "d\xFF/s.json", R"({"materials": [
        {"name": "a", "stack": "no.json", "shading": "color", "angles_deg": [0, 60]},
        {"name": "b", "stack": "../odd.json", "shading": "color", "angles_deg": [0, 60]}]})");
    check("\"$IRIDO\" bake 'd\xFF/s.json' -o b --quiet 2> said; python3 check.py b/manifest.json");
    check("\"$IRIDO\" plan 'd\xFF/s.json' -f json > p.json 2> said; python3 check.py p.json");
    fs::create_directory(folder / "e\xFF");
    write_text(folder / "e\xFF/light.csv", "nm,power\n300,1\n830,2\n");
    check(
        "\"$IRIDO\" sweep odd.json --compute color --illuminant 'e\xFF/light.csv' --vary "
        "layers.0.thickness_nm=1,2 --shard 1/1 -o 'y\x01\xFF.csv' && python3 check.py "
        "'y\x01\xFF.csv.sweep'");
}

TEST_CASE("rows of many blocks are those of one", "[cli][files][slow]") {
    const TemporaryFolder folder;
    const std::string run = "\"$IRIDO\" spectrum 'air | SiO2@300 | TiO2@100 | Si' -p s,p ";
    SECTION("angles") {
        const auto rows = [&](const std::string& angles) {
            return run_shell(run + "-w 400:700/400 -a " + angles, folder.path()).out;
        };
        const std::string first = rows("0:44.5:0.25"), second = rows("44.75:89.25:0.25");
        const std::string both = rows("0:89.25:0.25");
        CHECK(both.size() > 1000);
        CHECK(both == first + second.substr(second.find('\n') + 1));
    }
    SECTION("wavelengths") {
        const auto rows = [&](const std::string& wavelengths) {
            return parse_csv(run_shell(run + "-w " + wavelengths, folder.path()).out);
        };
        const auto lines = rows("400:700/180001"), some = rows("400:700/16");
        REQUIRE(lines.size() == 2 * 180001 + 1);
        REQUIRE(some.size() == 2 * 16 + 1);
        for (std::size_t p = 0; p < 2; ++p)
            for (std::size_t w = 0; w < 16; ++w)
                CHECK(lines[1 + p * 180001 + w * 12000] == some[1 + p * 16 + w]);
    }
}

TEST_CASE("memory does not grow with the rows of a spectrum", "[cli][files][slow]") {
    const TemporaryFolder folder;
    const auto peak_mib = [&](const std::string& angles) {
        const Outcome outcome = run_shell(
            "python3 -c 'import os, resource, subprocess; subprocess.run([os.environ[\"IRIDO\"], "
            "\"spectrum\", \"air | 1.5@100 | 1.5\", \"-w\", \"400:700/1000\", \"-a\", \"0:89/" +
                angles +
                "\", \"-f\", \"npy\", \"-o\", \"/dev/null\"], check=True); "
                "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024)'",
            folder.path());
        CHECK(outcome.err.empty());
        return std::stod("0" + outcome.out);
    };
    const double of_few = peak_mib("300"), of_many = peak_mib("1500");
    CHECK(of_few > 1);
    CHECK(of_many > 1);
#ifndef __SANITIZE_ADDRESS__  // which delays freeing memory
    CHECK(of_many < of_few + 60);
#endif
}
