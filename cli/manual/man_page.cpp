#include <algorithm>
#include <array>
#include <regex>
#include <sstream>

#include "cli/manual/manual.hpp"
#include "cli/options/command.hpp"

namespace irido::cli {

namespace {

/// Text escaped so that troff prints it verbatim.
std::string plain(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '\\':
                out += "\\e";
                break;
            case '-':
                out += "\\-";
                break;
            case '\'':
                out += "\\(aq";
                break;
            case '`':
                out += "\\(ga";
                break;
            case '^':
                out += "\\(ha";
                break;
            case '~':
                out += "\\(ti";
                break;
            case '"':
                out += "\\(dq";
                break;
            default:
                out += c;
        }
    }
    return out.starts_with('.') ? "\\&" + out : out;
}

std::string bold(std::string_view text) {
    return "\\fB" + plain(text) + "\\fR";
}

std::string italic(std::string_view text) {
    return "\\fI" + plain(text) + "\\fR";
}

std::string section(const std::string& name) {
    return ".SH " + name + "\n";
}

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Paragraphs; indented lines are kept as lines.
std::string paragraphs(const std::string& text) {
    std::string out = ".PP\n";
    bool is_kept = false;
    for (const std::string& line : lines_of(text)) {
        const bool is_indented = line.starts_with(' ');
        if (is_indented != is_kept) out += is_indented ? ".nf\n" : ".fi\n";
        is_kept = is_indented;
        out += line.empty() ? ".PP\n" : (is_indented ? "\\&" : "") + plain(line) + "\n";
    }
    return out + (is_kept ? ".fi\n" : "");
}

/// An option's text: "word: meaning" and "word  meaning" begin new lines, all other text is filled.
std::string option_text(const std::string& text) {
    static const std::regex entry(R"(^(\w[\w/()-]*: |\S.*  ).*)");
    std::string out;
    bool after_indented = false;
    for (const std::string& line : lines_of(text)) {
        const bool is_indented = line.starts_with(' ');
        const bool begins = after_indented ? !is_indented : std::regex_match(line, entry);
        if (begins && !out.empty()) out += ".br\n";
        out += plain(line.substr(std::min(line.find_first_not_of(' '), line.size()))) + "\n";
        after_indented = is_indented;
    }
    return out;
}

std::string option_entry(const OptionPage& option) {
    std::string head;
    for (const std::string& spelling : option.spellings)
        head += (head.empty() ? "" : ", ") +
                (spelling.starts_with('-') ? bold(spelling) : italic(spelling));
    if (!option.type.empty() && option.type != option.spellings.front())
        head += " " + std::string(option.may_lack_value ? "[" : "") + italic(option.type) +
                (option.may_lack_value ? "]" : "");
    return ".TP\n" + head + "\n" + option_text(option.text);
}

std::string synopsis(const CommandPage& page) {
    std::string out = bold(page.name);
    if (!page.commands.empty()) return out + " " + italic("COMMAND") + " ...\n";
    for (const OptionPage& argument : page.arguments) {
        const std::string name =
            italic(argument.spellings.front()) + (argument.repeats ? " ..." : "");
        out += argument.is_required ? " " + name : " [" + name + "]";
    }
    for (const OptionPage& option : page.options)
        if (option.is_required)
            out += " " + bold(option.spellings.front()) + " " + italic(option.type);
    return out + " [" + italic("options") + "]\n";
}

bool is_common(const OptionPage& option) {
    constexpr std::array<std::string_view, 6> kCommon{"--output", "--format", "--threads",
                                                      "--quiet",  "--help",   "--version"};
    return std::ranges::find(kCommon, option.spellings.back()) != kCommon.end();
}

bool is_of_stack(const OptionPage& option) {
    return option.spellings.back() == "--set" || option.spellings.back() == "--material";
}

std::string options_of(const CommandPage& page) {
    std::string arguments, own, stack, common, out;
    for (const OptionPage& argument : page.arguments) arguments += option_entry(argument);
    for (const OptionPage& option : page.options)
        (is_common(option) ? common : is_of_stack(option) ? stack : own) += option_entry(option);
    const auto add = [&out](const std::string& name, const std::string& entries) {
        if (!entries.empty()) out += ".SS " + name + "\n" + entries;
    };
    add("Arguments", arguments);
    add("Command options", own);
    for (const OptionGroup& group : page.groups) {
        std::string entries;
        for (const OptionPage& option : group.options) entries += option_entry(option);
        add("With \\-\\-compute " + group.value, entries);
    }
    add("Stack options", stack);
    add("Output and execution", common);
    if (page.takes_list) add("Lists", paragraphs("A LIST is " + std::string(kListHelp)));
    return section("OPTIONS") + out;
}

std::string commands_of(const CommandPage& page) {
    if (page.commands.empty()) return "";
    std::string out = section("COMMANDS");
    for (const CommandPage& command : page.commands)
        out += ".TP\n" + bold(command.name.substr(page.name.size() + 1)) + "\n" +
               plain(command.summary) + "\n";
    return out;
}

std::string examples_of(const CommandPage& page) {
    std::string out = section("EXAMPLES") + ".nf\n";
    for (const std::string& example : page.examples) out += plain(example) + "\n";
    return out + ".fi\n";
}

std::string see_also(const CommandPage& program, const CommandPage& page) {
    std::vector<std::string> names;
    for (const CommandPage* other : all_pages(program)) {
        const std::size_t blank = other->name.find_last_of(' ');
        const std::string parent = other->name.substr(0, blank == other->name.npos ? 0 : blank);
        const bool is_below = parent == page.name, is_above = other == &program;
        const bool is_beside = parent == page.name.substr(0, page.name.find_last_of(' '));
        if (other != &page && (is_below || is_above || is_beside))
            names.push_back(page_name(*other));
    }
    std::string out = section("SEE ALSO");
    for (const std::string& name : names)
        out += (&name == &names.front() ? "" : ",\n") + bold(name) + "(1)";
    return out + "\n";
}

constexpr const char* kExitStatus =
    ".TP\n0\nDone.\n"
    ".TP\n1\nA check that was asked for failed (\\fBvalidate\\fR, \\fBlut check\\fR, a\n"
    "\\fB\\-\\-tolerance\\fR that cannot be met), or some of several things could not be made.\n"
    ".TP\n2\nWrong usage, bad input, or a file that cannot be read or written: one line on\n"
    "standard error says which, and nothing partial is left behind.\n"
    ".TP\n130\nInterrupted.\n";

constexpr const char* kEnvironment =
    ".TP\n.B IRIDO_SIMD\n"
    "The vector instructions to compute with: avx512, avx2, baseline, or plain (point by point);\n"
    "the widest that the machine has by default. Last digits depend on it.\n";

constexpr const char* kFiles =
    ".TP\n.I share/irido/examples\n"
    "Stacks, materials and scenes to begin with, below the folder that irido was installed to\n"
    "(such as /usr).\n"
    ".TP\n.I share/irido/*.schema.json\n"
    "JSON Schemas of stacks, scenes, manifests and the metadata of tables;\n"
    "\\fBirido validate \\-\\-schema\\fR \\fINAME\\fR prints them.\n";

}  // namespace

std::string page_name(const CommandPage& page) {
    std::string name = page.name;
    std::ranges::replace(name, ' ', '-');
    return name;
}

std::string man_page(const CommandPage& program, const CommandPage& page,
                     const std::string& version) {
    std::string title = page_name(page);
    std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
    std::string out = ".TH \"" + plain(title) + "\" 1 \"\" \"" + plain(version) + "\" \"" +
                      program.name + " manual\"\n.nh\n.ad l\n";
    out += section("NAME") + plain(page_name(page)) + " \\- " +
           plain(page.summary.substr(0, page.summary.size() - 1)) + "\n";
    out += section("SYNOPSIS") + synopsis(page);
    out += section("DESCRIPTION") + plain(page.summary) + "\n";
    if (!page.notes.empty()) out += paragraphs(page.notes);
    out += commands_of(page) + options_of(page) + examples_of(page);
    out += section("EXIT STATUS") + kExitStatus + section("ENVIRONMENT") + kEnvironment +
           section("FILES") + kFiles;
    return out + see_also(program, page);
}

}  // namespace irido::cli
