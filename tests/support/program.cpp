#include "tests/support/program.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace irido::test {

namespace {

std::string in_quotes(const std::string& text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'') {
            out += "'\\''";
        } else {
            out += c;
        }
    }
    return out + "'";
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "irido-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string read_file(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw std::runtime_error("cannot read " + path);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_text(const std::string& path, const std::string& text) {
    std::ofstream stream(path, std::ios::binary);
    stream << text;
    if (!stream) throw std::runtime_error("cannot write " + path);
}

Outcome run_shell(const std::string& command, const std::string& folder) {
    const TemporaryFolder captured;
    // a sanitized program that looks for leaks when it ends takes twice as long to start and end;
    // those of the rooms are found in the tests' own process
    const std::string line = "cd " + in_quotes(folder) + " && IRIDO=" + in_quotes(IRIDO_BINARY) +
                             " && ASAN_OPTIONS=detect_leaks=0 && export IRIDO ASAN_OPTIONS && { " +
                             command + "\n} > " + in_quotes(captured / "out") + " 2> " +
                             in_quotes(captured / "err");
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            read_file(captured / "out"), read_file(captured / "err")};
}

Words operator+(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Outcome run_irido(const Words& arguments, const std::string& input, const std::string& folder) {
    const TemporaryFolder stage;
    write_text(stage / "in", input);
    std::string command = "\"$IRIDO\"";
    for (const std::string& argument : arguments) command += " " + in_quotes(argument);
    return run_shell(command + " < " + in_quotes(stage / "in"), folder);
}

Outcome done(const Words& arguments, const std::string& input, const std::string& folder) {
    Outcome outcome = run_irido(arguments, input, folder);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return outcome;
}

std::string out_of(const Words& arguments) {
    return done(arguments).out;
}

void check_refused(const Outcome& outcome, const std::string& error) {
    using Catch::Matchers::Contains;
    using Catch::Matchers::StartsWith;
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, StartsWith("irido: error: ") && Contains(error));
    CHECK(std::ranges::count(outcome.err, '\n') == 1);
}

std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
    }
    return rows;
}

}  // namespace irido::test
