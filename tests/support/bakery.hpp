#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/program.hpp"

namespace irido::test {

using BakedFiles = std::map<std::string, std::string>;

/// Of a folder, by name.
inline BakedFiles files_in(const std::string& folder) {
    BakedFiles files;
    for (const auto& file : std::filesystem::directory_iterator(folder))
        files[file.path().filename().string()] = read_file(file.path().string());
    return files;
}

/// A scene in a folder of its own, and bakes of it beside it.
class Bakery {
public:
    explicit Bakery(const std::string& scene) { set(scene); }

    void set(const std::string& scene) const { write_text(stage_ / "scene.json", scene); }
    void set(const nlohmann::json& scene) const { set(scene.dump()); }
    std::string path(const std::string& name) const { return stage_ / name; }

    Outcome bake(const std::string& folder, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"bake", path("scene.json"), "-o", path(folder)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_irido(arguments);
    }
    BakedFiles baked(const std::string& folder, const std::vector<std::string>& more = {}) const {
        const Outcome outcome = bake(folder, more);
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return files_in(path(folder));
    }
    /// The file in a baked folder whose name begins with `start`.
    std::string file(const std::string& folder, const std::string& start) const {
        for (const auto& [name, bytes] : files_in(path(folder)))
            if (name.starts_with(start)) return path(folder) + "/" + name;
        throw std::runtime_error("no file " + start);
    }

private:
    TemporaryFolder stage_;
};

}  // namespace irido::test
