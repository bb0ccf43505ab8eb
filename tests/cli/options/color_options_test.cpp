#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>

#include "core/color/color_method.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Contains;

namespace {

/// A text on one line, with single blanks.
std::string on_one_line(const std::string& text) {
    return std::regex_replace(text, std::regex("\\s+"), " ");
}

}  // namespace

TEST_CASE("pages, completions and messages know every colour method", "[cli][color_method]") {
    const std::string color = on_one_line(run_irido({"color", "--help"}).out);
    std::string manual = run_irido({"manual", "color"}).out;
    std::erase(manual, '\\');  // hyphens are escaped
    const std::string pareto = on_one_line(run_irido({"bench", "pareto", "--help"}).out);
    const std::string unknown = run_irido({"color", "1 | 1.5", "--method", "no"}).err;
    const std::string guide = read_file(IRIDO_SOURCE_DIR "/docs/methods-and-accuracy.md");
    std::vector<std::string> completions;
    for (const char* const shell : {"bash", "zsh", "fish"})
        completions.push_back(run_irido({"completion", shell}).out);
    for (const ColorMethodKind* const method : color_methods()) {
        const std::string name(method->name);
        CAPTURE(name);
        CHECK_THAT(color, Contains(on_one_line(std::string(method->help))));
        CHECK_THAT(manual, Contains(name));
        CHECK_THAT(pareto, Contains(name));
        CHECK_THAT(unknown, Contains(name));
        CHECK(std::regex_search(guide, std::regex("`" + name + "(/[A-Z])?`")));
        for (const std::string& words : completions)
            CHECK(std::regex_search(words, std::regex("\\b" + name + "\\b")));
    }
}

TEST_CASE("help texts are no wider than a page", "[cli][color_method]") {
    for (const std::vector<std::string>& page :
         {std::vector<std::string>{"color", "--help"}, {"bench", "pareto", "--help"}}) {
        const std::string text = run_irido(page).out;
        std::size_t longest = 0, begin = 0;
        for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos;
             begin = end + 1)
            longest = std::max(longest, end - begin);
        CHECK(longest <= 100);
    }
}

TEST_CASE("numbers of colour methods are read by their ranges", "[cli][color_method]") {
    for (const ColorMethodKind* const method : color_methods()) {
        const std::string name(method->name);
        CAPTURE(name);
        if (!method->takes_number()) {
            check_refused(run_irido({"color", "1 | 1.5", "--method", name + "/2"}),
                          "--method: " + name + " takes no number (got '" + name + "/2')");
            continue;
        }
        for (const double beyond : {method->number.fewest - 1, method->number.most + 1}) {
            const std::string typed = std::to_string(static_cast<long>(beyond));
            check_refused(run_irido({"color", "1 | 1.5", "--method", name + "/" + typed}),
                          "--method: the number of " + name);
        }
    }
}
