#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "tests/program.hpp"

using namespace irido::test;

namespace {

struct Example {
    std::string command, output;
};

/// Every "    $ command" of the README with the indented lines that follow it.
std::vector<Example> examples() {
    const std::string indent = "    ";
    std::vector<Example> found;
    std::istringstream lines(read_file(IRIDO_SOURCE_DIR "/README.md"));
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(indent + "$ ")) {
            found.push_back({line.substr(6), ""});
            inside = true;
        } else if (inside && line.starts_with(indent)) {
            found.back().output += line.substr(4) + "\n";
        } else {
            inside = false;
        }
    }
    return found;
}

/// Equal texts; numbers may differ by rounding, which the processor's library decides.
bool same_field(const std::string& a, const std::string& b) {
    if (a == b) return true;
    try {
        return std::abs(std::stod(a) - std::stod(b)) < 1e-13;
    } catch (const std::exception&) {
        return false;
    }
}

}  // namespace

TEST_CASE("the README's commands print what it shows", "[cli][readme]") {
    const auto all = examples();
    REQUIRE(all.size() >= 5);
    for (const auto& [command, output] : all) {
        const Outcome outcome =
            run_shell("irido() { \"$IRIDO\" \"$@\"; }; " + command + " 2>&1", IRIDO_SOURCE_DIR);
        const auto got = parse_csv(outcome.out), want = parse_csv(output);
        INFO(command << "\n" << outcome.out);
        REQUIRE(got.size() == want.size());
        for (std::size_t row = 0; row < want.size(); ++row) {
            REQUIRE(got[row].size() == want[row].size());
            for (std::size_t c = 0; c < want[row].size(); ++c)
                CHECK(same_field(got[row][c], want[row][c]));
        }
    }
}
