#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
    std::string file;  ///< relative to the project
    std::string target;
};

/// Every #include in every source below a folder of the project.
std::vector<Include> includes_below(const std::string& room) {
    static const std::regex pattern(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
    std::vector<Include> found;
    const fs::path root = IRIDO_SOURCE_DIR;
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
        const auto extension = entry.path().extension();
        if (extension != ".cpp" && extension != ".hpp" && extension != ".inc") continue;
        std::ifstream stream(entry.path());
        std::smatch match;
        for (std::string line; std::getline(stream, line);)
            if (std::regex_search(line, match, pattern))
                found.push_back({fs::relative(entry.path(), root).string(), match[1]});
    }
    return found;
}

std::string room_of(const std::string& target) {
    return target.substr(0, target.find('/'));
}

/// The subfolder of a folder: "coherent" for core/coherent/layer.hpp, "" for core/error.hpp.
std::string inner_room_of(const std::string& target) {
    const std::size_t begin = target.find('/') + 1, end = target.find('/', begin);
    return end == std::string::npos ? "" : target.substr(begin, end - begin);
}

/// Every source below a folder of the project, relative to the project.
std::vector<std::string> sources_below(const std::string& room) {
    std::vector<std::string> found;
    const fs::path root = IRIDO_SOURCE_DIR;
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
        const std::string file = fs::relative(entry.path(), root).string();
        const bool is_source = file.ends_with(".cpp") || file.ends_with(".hpp");
        if (is_source && file.find("node_modules") == std::string::npos) found.push_back(file);
    }
    return found;
}

const std::vector<std::string> kRooms{"core", "schemas", "tables", "cli"};

}  // namespace

TEST_CASE("includes run one way: cli -> tables -> schemas -> core", "[architecture]") {
    const std::map<std::string, std::set<std::string>> allowed{
        {"core", {"core"}},
        {"schemas", {"schemas", "core"}},
        {"tables", {"tables", "schemas", "core"}},
        {"cli", {"cli", "tables", "schemas", "core"}},
    };
    for (const auto& [room, reachable] : allowed) {
        const std::vector<Include> includes = includes_below(room);
        CHECK_FALSE(includes.empty());
        for (const auto& [file, target] : includes) {
            if (!allowed.contains(room_of(target)) || target.find('/') == std::string::npos)
                continue;
            INFO(file << " includes " << target);
            CHECK(reachable.contains(room_of(target)));
        }
    }
}

TEST_CASE("each room has its namespace", "[architecture]") {
    const std::map<std::string, std::string> named{{"core", "irido"},
                                                   {"schemas", "irido::schemas"},
                                                   {"tables", "irido::tables"},
                                                   {"cli", "irido::cli"}};
    const std::set<std::string> others{"valijson", "CLI", "irido::HWY_NAMESPACE",
                                       "irido::textbook"};
    for (const auto& [room, name] : named)
        for (const std::string& file : sources_below(room)) {
            std::ifstream stream(fs::path(IRIDO_SOURCE_DIR) / file);
            for (std::string line; std::getline(stream, line);) {
                if (!line.starts_with("namespace ") || !line.ends_with(" {")) continue;
                if (line == "namespace {") continue;
                const std::string opened = line.substr(10, line.size() - 12);
                if (others.contains(opened)) continue;
                INFO(file << " opens namespace " << opened);
                CHECK(opened == name);
            }
        }
}

// Each may include those listed before it, and itself. Only the main program includes all.
// The linker keeps one copy of what two types of a name have in common, for both.
TEST_CASE("types of one namespace have different names", "[architecture]") {
    static const std::regex opens(R"re(^(?:inline )?namespace ?([\w:]*) \{$)re");
    static const std::regex type(R"re(^(?:struct|class) (\w+)(?: final)?(?: :.*)? \{)re");
    std::map<std::string, std::string> home;
    for (const std::string& room : kRooms) {
        for (const std::string& file : sources_below(room)) {
            if (!file.ends_with(".hpp")) continue;
            std::ifstream stream(fs::path(IRIDO_SOURCE_DIR) / file);
            std::string space, before;
            std::smatch match;
            for (std::string line; std::getline(stream, line); before = line) {
                if (std::regex_search(line, match, opens)) space += "::" + match[1].str();
                // arguments are part of a template's name
                if (before.starts_with("template") || !std::regex_search(line, match, type))
                    continue;
                const auto [other, is_new] = home.emplace(space + "::" + match[1].str(), file);
                CAPTURE(match[1].str(), file, other->second);
                CHECK(is_new);
            }
        }
    }
    CHECK(home.size() > 300);
}

TEST_CASE("includes run one way between the rooms inside a room", "[architecture]") {
    const std::map<std::string, std::vector<std::string>> order{
        {"core",
         {"",           "math",   "material", "stack",    "coherent",    "incoherent", "thickness",
          "film",       "vector", "spectrum", "periodic", "colorimetry", "engines",    "color",
          "comparison", "rough",  "scratch",  "design",   "render",      "truth"}},
        {"schemas", {"", "readers", "documents"}},
        {"tables",
         {"", "files", "records", "resume", "pictures", "lut", "scratch", "shaders", "view"}},
        {"cli", {"", "options", "queries", "sweep", "comparison", "manual", "commands", "bench"}},
    };
    for (const auto& [room, inner] : order) {
        const auto place = [&names = inner](const std::string& name) {
            const auto found = std::ranges::find(names, name);
            INFO("the room '" << name << "' has no place in the order");
            REQUIRE(found != names.end());
            return found - names.begin();
        };
        for (const auto& [file, target] : includes_below(room)) {
            if (room_of(target) != room || target.find('/') == std::string::npos) continue;
            if (file == "cli/main.cpp") continue;
            INFO(file << " includes " << target);
            CHECK(place(inner_room_of(target)) <= place(inner_room_of(file)));
        }
    }
}

TEST_CASE("no folder is crowded and no source is long", "[architecture]") {
    constexpr std::size_t kMostUnits = 24, kMostLines = 600;  // a .cpp and its .hpp are one unit
    std::map<fs::path, std::set<std::string>> units;
    for (const std::string& room : kRooms)
        for (const std::string& file : sources_below(room))
            units[fs::path(file).parent_path()].insert(fs::path(file).stem().string());
    for (const auto& [folder, names] : units) {
        INFO(folder << " holds " << names.size() << " units");
        CHECK(names.size() <= kMostUnits);
    }
    for (const std::string room : {"core", "schemas", "tables", "cli", "tests"})
        for (const std::string& file : sources_below(room)) {
            std::ifstream stream(fs::path(IRIDO_SOURCE_DIR) / file);
            const auto lines = std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
            INFO(file << " has " << lines << " lines");
            CHECK(static_cast<std::size_t>(lines) <= kMostLines);
        }
}

TEST_CASE("few headers read the whole of CLI11", "[architecture]") {
    std::set<std::string> headers;
    for (const auto& [file, target] : includes_below("cli"))
        if (target == "CLI/CLI.hpp" && file.ends_with(".hpp")) headers.insert(file);
    CHECK(headers.size() <= 3);
}

TEST_CASE("core knows no files, streams, documents or clocks", "[architecture]") {
    const std::set<std::string> foreign{"fstream", "iostream", "ostream",    "istream", "sstream",
                                        "cstdio",  "chrono",   "filesystem", "ctime",   "stdio.h"};
    for (const auto& [file, target] : includes_below("core")) {
        INFO(file << " includes " << target);
        CHECK_FALSE(foreign.contains(target));
        CHECK(target.find("json") == std::string::npos);
        CHECK(target.find("yaml") == std::string::npos);
        CHECK(target.find("CLI") == std::string::npos);
    }
}

TEST_CASE("one file includes FFTW, one HDF5, one room each knows JSON schemas and YAML",
          "[architecture]") {
    std::map<std::string, std::set<std::string>> users;
    for (const std::string& room : kRooms)
        for (const auto& [file, target] : includes_below(room)) {
            if (target == "fftw3.h") users["fftw"].insert(file);
            if (target == "hdf5.h") users["hdf5"].insert(file);
            if (target.starts_with("valijson/")) users["valijson"].insert(file);
            if (target.starts_with("yaml-cpp/")) users["yaml"].insert(file);
        }
    CHECK(users["fftw"] == std::set<std::string>{"core/math/transform.cpp"});
    CHECK(users["hdf5"] == std::set<std::string>{"tables/records/h5_file.cpp"});
    CHECK(users["valijson"] == std::set<std::string>{"schemas/documents/schema_check.cpp"});
    CHECK(users["yaml"] ==
          std::set<std::string>{"schemas/readers/materials/refractiveindex_info.cpp"});
}
