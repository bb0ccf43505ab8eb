#include <algorithm>
#include <catch2/catch.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>

#include "core/math/simd_level.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::test;

namespace {

struct Example {
    std::string command, output;
};

/// Every "    $ command" of a page, with the indented lines that follow.
std::vector<Example> examples(const std::string& page) {
    const std::string indent = "    ";
    std::vector<Example> found;
    std::istringstream lines(read_file(page));
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

/// The number that makes up the whole field, or nothing.
std::optional<double> number_in(const std::string& field) {
    double value = 0;
    const char* const end = field.data() + field.size();
    const auto [stop, error] = std::from_chars(field.data(), end, value);
    if (error != std::errc() || stop != end) return std::nullopt;
    return value;
}

/// Compares texts exactly, and numbers to 16 units in the last place of 1, or of themselves if
/// larger: the outputs are sums of terms of order 1 (powers, weights of a colour), whose last
/// digits depend on the SIMD level, that is on how many terms are added at once. Differences of up
/// to 9 have occurred.
bool same_field(const std::string& a, const std::string& b) {
    if (a == b) return true;
    constexpr double kMost = 16 * std::numeric_limits<double>::epsilon();
    const auto x = number_in(a), y = number_in(b);
    return x && y && std::abs(*x - *y) <= kMost * std::max(1.0, std::abs(*y));
}

/// Compares two outputs line by line and field by field; none may be missing.
void check_same(const std::string& got_text, const std::string& want_text) {
    const auto got = parse_csv(got_text), want = parse_csv(want_text);
    REQUIRE(got.size() == want.size());
    for (std::size_t row = 0; row < want.size(); ++row) {
        REQUIRE(got[row].size() == want[row].size());
        for (std::size_t c = 0; c < want[row].size(); ++c) {
            INFO(got[row][c] << " for " << want[row][c]);
            CHECK(same_field(got[row][c], want[row][c]));
        }
    }
}

/// README.md and the pages of docs/.
std::vector<std::string> pages() {
    std::vector<std::string> found{IRIDO_SOURCE_DIR "/README.md"};
    for (const auto& entry : std::filesystem::directory_iterator(IRIDO_SOURCE_DIR "/docs"))
        if (entry.path().extension() == ".md") found.push_back(entry.path().string());
    std::ranges::sort(found);
    return found;
}

}  // namespace

TEST_CASE("fields are compared whole", "[readme]") {
    CHECK(same_field("0.25", "0.25"));
    CHECK(same_field("0.25000000000000006", "0.25"));
    CHECK(same_field("57.69215391984249", "57.69215391984247"));
    CHECK_FALSE(same_field("0.25000000000001", "0.25"));
    CHECK_FALSE(same_field("0.25 nm", "0.25"));
    CHECK_FALSE(same_field("0.25000000000000006 nm", "0.25 nm"));
    CHECK_FALSE(same_field("12", "13"));
    CHECK_FALSE(same_field("", "0"));
    CHECK_FALSE(same_field("nan", "0"));
}

TEST_CASE("the commands of every page print what it shows, at every SIMD level",
          "[cli][readme][slow]") {
    for (const SimdLevel level : kSimdLevels) {
        if (!is_available(level)) {
            WARN("not run at " << name_of(level) << ", which this machine lacks");
            continue;
        }
        std::size_t count = 0;
        for (const std::string& page : pages())
            for (const auto& [command, output] : examples(page)) {
                const Outcome outcome =
                    run_shell("export IRIDO_SIMD=" + std::string(name_of(level)) +
                                  "; irido() { \"$IRIDO\" \"$@\"; }; " + command + " 2>&1",
                              IRIDO_SOURCE_DIR);
                INFO(page << ", " << name_of(level) << ": " << command << "\n" << outcome.out);
                check_same(outcome.out, output);
                ++count;
            }
        CHECK(count >= 30);
    }
}

TEST_CASE("links between pages lead to files that are there", "[readme]") {
    for (const std::string& page : pages()) {
        const std::string text = read_file(page);
        for (std::size_t at = text.find("]("); at != std::string::npos;
             at = text.find("](", at + 1)) {
            const std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
            if (target.find("://") != std::string::npos || target.starts_with('#')) continue;
            INFO(page << " links to " << target);
            CHECK(std::filesystem::exists(std::filesystem::path(page).parent_path() / target));
        }
    }
}

TEST_CASE("the README is short", "[readme]") {
    const std::string text = read_file(IRIDO_SOURCE_DIR "/README.md");
    CHECK(std::ranges::count(text, '\n') <= 200);
}
