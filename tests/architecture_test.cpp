#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
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

/// Every #include of every source below a folder of the project.
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
    for (const std::string room : {"core", "schemas", "tables", "cli"})
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
