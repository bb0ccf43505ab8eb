#include "cli/manual/command_page.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "cli/options/command.hpp"
#include "cli/queries/query.hpp"

namespace irido::cli {

namespace {

using Value = OptionPage::Value;

Value value_of(const OfferedWords* words, const std::string& type) {
    if (words && words->use == OfferedWords::Use::several) return Value::words;
    if (words && words->use == OfferedWords::Use::one_or_file) return Value::word_or_file;
    if (words) return Value::word;
    if (type == "FILE" || type == "STACK" || type == "SCENE") return Value::file;
    return type == "DIR" ? Value::folder : Value::free;
}

OptionPage option_page(const CLI::App& command, const CLI::Option& option) {
    OptionPage page;
    for (const std::string& name : option.get_snames()) page.spellings.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) page.spellings.push_back("--" + name);
    if (option.get_positional()) page.spellings = {option.get_name()};
    page.text = option.get_description();
    page.is_required = option.get_required();
    const bool takes_value = option.get_items_expected_max() > 0;
    page.repeats =
        takes_value && option.get_items_expected_max() >= CLI::detail::expected_max_vector_size;
    page.may_lack_value = takes_value && option.get_items_expected_min() == 0;
    if (!takes_value) return page;
    page.type = option.get_positional() ? option.get_name() : option.get_type_name();
    std::erase_if(page.type, [](char c) { return c == '[' || c == ']'; });
    const std::string& last = page.spellings.back();
    const std::string name = last.substr(std::min(last.find_first_not_of('-'), last.size()));
    const OfferedWords* const words = words_offered(command, name);
    page.value = value_of(words, page.type);
    if (words) page.words = words->make();
    return page;
}

std::vector<OptionPage> option_pages(const CLI::App& command, bool positional) {
    std::vector<OptionPage> pages;
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional() == positional) pages.push_back(option_page(command, *option));
    return pages;
}

std::vector<OptionGroup> groups_of(const CLI::App& command) {
    std::vector<OptionGroup> groups;
    if (!command.get_option_no_throw("--compute")) return groups;
    std::vector<std::unique_ptr<CLI::App>> commands;  // kept, so that no two share an address
    for (const QueryKind& kind : query_kinds()) {
        commands.push_back(std::make_unique<CLI::App>());
        commands.back()->set_help_flag();
        const auto typed = kind.add_options(*commands.back());
        groups.push_back({std::string(kind.name), option_pages(*commands.back(), false)});
    }
    return groups;
}

/// "A text of\nlines." as one line with a full stop.
std::string one_line(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return text.ends_with('.') || text.empty() ? text : text + ".";
}

/// Parses the lines below a help page's options: notes, and examples after their heading.
void read_footer(const std::string& footer, CommandPage& page) {
    std::istringstream lines(footer);
    bool in_examples = false;
    for (std::string line; std::getline(lines, line);) {
        if (line == "Examples:") {
            in_examples = true;
        } else if (in_examples && line.starts_with("  ")) {
            page.examples.push_back(line.substr(2));
        } else {
            in_examples = false;
            page.notes += line + "\n";
        }
    }
    while (page.notes.ends_with('\n')) page.notes.pop_back();
}

CommandPage page_of(const CLI::App& command, const std::string& name) {
    CommandPage page{.name = name,
                     .summary = one_line(command.get_description()),
                     .notes = {},
                     .examples = {},
                     .arguments = option_pages(command, true),
                     .options = option_pages(command, false),
                     .groups = groups_of(command),
                     .commands = {},
                     .takes_list = takes_list(command)};
    read_footer(command.get_footer(), page);
    for (const CLI::App* next : command.get_subcommands([](const CLI::App*) { return true; }))
        page.commands.push_back(page_of(*next, name + " " + next->get_name()));
    return page;
}

}  // namespace

CommandPage command_page(const CLI::App& program) {
    return page_of(program, program.get_name());
}

std::vector<const CommandPage*> all_pages(const CommandPage& page) {
    std::vector<const CommandPage*> pages{&page};
    for (const CommandPage& command : page.commands)
        for (const CommandPage* below : all_pages(command)) pages.push_back(below);
    return pages;
}

CommandCases command_cases(const CommandPage& program, std::string (*case_of)(const CommandPage&)) {
    CommandCases all;
    for (const CommandPage* page : all_pages(program)) {
        all.cases += case_of(*page);
        if (page != &program) all.names.push_back("'" + page->name + "'");
    }
    return all;
}

std::vector<OptionPage> all_options(const CommandPage& page) {
    std::vector<OptionPage> options = page.options;
    for (const OptionGroup& group : page.groups)
        for (const OptionPage& option : group.options)
            if (std::ranges::find(options, option.spellings, &OptionPage::spellings) ==
                options.end())
                options.push_back(option);
    return options;
}

std::string first_line(const OptionPage& option) {
    std::string line = option.text.substr(0, option.text.find('\n'));
    line.resize(std::min({line.size(), line.find(" ["), line.find("; ")}));
    while (!line.empty() && (line.back() == ',' || line.back() == ':')) line.pop_back();
    return line;
}

}  // namespace irido::cli
