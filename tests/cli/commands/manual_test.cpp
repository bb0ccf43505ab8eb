#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>
#include <sstream>

#include "tests/support/program.hpp"

using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

struct Page {
    std::vector<std::string> command;  ///< without the program's name
    std::string name;                  ///< "irido lut color"
    std::string text;
};

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// The manual pages of all commands of the program.
std::vector<Page> all_manual_pages() {
    const TemporaryFolder folder;
    REQUIRE(run_irido({"manual", "-o", folder.path()}).status == 0);
    std::vector<Page> pages;
    static const std::regex synopsis(R"(\n\.SH SYNOPSIS\n\\fB((?:[^\\]|\\-)*)\\fR)");
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string text = read_file(entry.path());
        std::smatch match;
        REQUIRE(std::regex_search(text, match, synopsis));
        const std::string name = std::regex_replace(match[1].str(), std::regex(R"(\\-)"), "-");
        std::vector<std::string> command = words_of(name);
        command.erase(command.begin());
        pages.push_back({command, name, text});
    }
    return pages;
}

/// The lines of one section of a page.
std::string section(const std::string& page, const std::string& name) {
    const std::string head = "\n.SH " + name + "\n";
    const std::size_t begin = page.find(head);
    if (begin == std::string::npos) return "";
    const std::size_t end = page.find("\n.SH ", begin + 1);
    return page.substr(begin + head.size(), end - begin - head.size() + 1);
}

std::string help_of(const Page& page) {
    std::vector<std::string> words = page.command;
    words.emplace_back("--help");
    const Outcome help = run_irido(words);
    CHECK(help.status == 0);
    return help.out;
}

/// Completions of the last word of each line in a real bash: one line each, separated by blanks.
/// The last word is empty after a trailing blank.
std::vector<std::string> completed(const std::vector<std::string>& lines) {
    const TemporaryFolder folder;
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    write_text(folder / "lines", text);
    const Outcome outcome = run_shell(
        "bash -c 'source <(\"$IRIDO\" completion bash); while IFS= read -r line; do "
        "read -r -a COMP_WORDS <<< \"$line\"; [[ $line == *\" \" ]] && COMP_WORDS+=(\"\"); "
        "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _irido; echo \"${COMPREPLY[*]}\"; done' < '" +
            (folder / "lines") + "'",
        IRIDO_SOURCE_DIR);
    CHECK(outcome.err.empty());
    std::vector<std::string> replies;
    std::istringstream stream(outcome.out);
    for (std::string reply; std::getline(stream, reply);) replies.push_back(reply);
    REQUIRE(replies.size() == lines.size());
    return replies;
}

}  // namespace

TEST_CASE("every command has a purpose, examples, a manual page and a place in the docs' index",
          "[cli][manual][slow]") {
    const std::string index = read_file(IRIDO_SOURCE_DIR "/docs/README.md");
    const std::vector<Page> pages = all_manual_pages();
    CHECK(pages.size() > 25);
    static const std::regex name(R"(^\S+ \\- \S.*\S\n$)");
    for (const Page& page : pages) {
        INFO(page.name);
        CHECK(std::regex_match(section(page.text, "NAME"), name));
        for (const char* const part :
             {"DESCRIPTION", "OPTIONS", "EXIT STATUS", "ENVIRONMENT", "FILES", "SEE ALSO"})
            CHECK_FALSE(section(page.text, part).empty());
        const std::string examples = section(page.text, "EXAMPLES");  // .nf and .fi
        CHECK(std::count(examples.begin(), examples.end(), '\n') >= 2 + 2);
        CHECK_THAT(help_of(page), Contains("Examples:\n"));
        if (!page.command.empty()) CHECK_THAT(index, Contains("`" + page.name + "`"));
    }
}

TEST_CASE("help and manual pages say what a LIST is where an option takes one",
          "[cli][manual][slow]") {
    static const std::regex takes(R"(\n  -[^\n ]* (\S+=)?LIST\b)");
    std::size_t lists = 0;
    for (const Page& page : all_manual_pages()) {
        INFO(page.name);
        const std::string help = help_of(page);
        const bool has_list = std::regex_search(help, takes);
        lists += has_list ? 1 : 0;
        CHECK((help.find("\nLIST: v | start:stop:step") != std::string::npos) == has_list);
        CHECK((page.text.find("A LIST is v | start:stop:step") != std::string::npos) == has_list);
    }
    CHECK(lists > 8);
}

TEST_CASE("a manual page has all options of a sweep, those of what it computes, too",
          "[cli][manual]") {
    const std::string sweep = run_irido({"manual", "sweep"}).out;
    CHECK_THAT(sweep, StartsWith(".TH \"IRIDO\\-SWEEP\" 1") &&
                          Contains("With \\-\\-compute bands") && Contains("\\-\\-gaps") &&
                          Contains("\\-\\-orders"));
    CHECK_THAT(run_irido({"manual", "lut", "color"}).out,
               StartsWith(".TH \"IRIDO\\-LUT\\-COLOR\""));
    CHECK_THAT(run_irido({"manual"}).out, Contains("irido\\-completion"));
}

TEST_CASE("bash completes commands, options, words and files", "[cli][manual]") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"irido sp", "spectrum"},
        {"irido materials ", "list show find"},
        {"irido lut col", "color"},
        {"irido color stack.json --me", "--method"},
        {"irido color --method four", "fourier fourier-constant"},
        {"irido color --space = di", "display-p3"},  // as bash splits --space=di
        {"irido color --space = ", "srgb rec2020 display-p3 acescg xyz"},
        {"irido spectrum --columns psi_deg,delta_d", "psi_deg,delta_deg"},
        {"irido color -p ", "s p u"},
        {"irido spectrum -f ", "csv json npy pdf png svg"},
        {"irido sweep -f h", "h5"},
        {"irido lut color x --dtype ", "f16 f32 f64"},
        {"irido lut transmissivity x --polarization ", "s p u"},
        {"irido lut shader br", "bragg brdf"},
        {"irido lut albedo x --side ", "R"},
        {"irido sweep --compute ", "spectrum color bands cm"},
        {"irido sweep x --compute bands --gap", "--gaps"},
        {"irido materials show Au", "Au Au-McPeak Au-LD"},
        {"irido materials show N-BK", "N-BK7"},
        {"irido color --illuminant D", "D65 D50"},
        {"irido color --illuminant sche", "schemas"},
        {"irido spectrum schemas/examples/soap-bubble.", "schemas/examples/soap-bubble.json"},
        {"irido bake x -o sche", "schemas"},
        {"irido bake -o schemas/stack", ""},  // no folders match
        {"irido validate --schema ", "stack surface design scene plan manifest lut"},
        {"irido bench speed --cases film,40_e", "film,40_each"},
        {"irido bench stability -r all,gain", "all,gain"},
        {"irido convert -f ", "json expression zemax openfilters csv"},
        {"irido plan -f ", "text json"},
        {"irido completion ", "bash zsh fish"},
        {"irido manual bak", "bake"},
        {"irido spectrum -w ", ""},
        {"irido nothing ", ""},
    };
    std::vector<std::string> lines;
    for (const auto& [line, reply] : cases) lines.push_back(line);
    const std::vector<std::string> replies = completed(lines);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        INFO(lines[i]);
        CHECK(replies[i] == cases[i].second);
    }
}

TEST_CASE("values from fixed lists are completed in every command", "[cli][manual][slow]") {
    static const std::regex option(
        R"(\n  (?:-\w,)?(--[\w-]+) \[?(?:NAMES?|FORMAT|METHOD|LETTERS?|SIDES|DEGREES|COMMAND)\b\]?(?!=))");
    std::vector<std::string> lines;
    for (const Page& page : all_manual_pages()) {
        const std::string help = help_of(page);
        for (std::sregex_iterator at(help.begin(), help.end(), option), end; at != end; ++at)
            lines.push_back(page.name + " " + (*at)[1].str() + " ");
    }
    CHECK(lines.size() > 40);
    const std::vector<std::string> replies = completed(lines);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        INFO(lines[i]);
        CHECK_FALSE(replies[i].empty());
    }
}

TEST_CASE("unknown shells, commands and folders are refused", "[cli][manual]") {
    check_refused(run_irido({"completion", "tcsh"}), "SHELL: must be one of bash, zsh, fish");
    check_refused(run_irido({"completion"}), "SHELL is required");
    check_refused(run_irido({"manual", "spectrun"}),
                  "unknown command 'spectrun' (did you mean \"spectrum\"?)\n");
    check_refused(run_irido({"manual", "lut", "colour"}),
                  "unknown command 'lut colour' (did you mean \"color\"?)\n");
    check_refused(run_irido({"manual", "nosuch"}), "unknown command 'nosuch'\n");
    check_refused(run_irido({"manual", "lut", "nosuch"}), "unknown command 'lut nosuch'\n");
    check_refused(run_irido({"manual", "lut", "color", "more"}), "'lut color more'\n");
    check_refused(run_irido({"manual", "-o", "/no/such/folder"}), "/no/such/folder");
}
