#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace irido::cli {

/// An option or argument, as manual pages and completions need it.
struct OptionPage {
    enum class Value { none, free, word, word_or_file, words, file, folder };

    std::vector<std::string> spellings;  ///< "-w", "--wavelengths"; "STACK" for an argument
    std::string type;                    ///< "LIST"; "" if it takes no value
    std::string text;                    ///< as on the help page
    bool is_required = false;
    bool repeats = false;
    bool may_lack_value = false;
    Value value = Value::none;
    std::vector<std::string> words;  ///< possible values, for options with fixed words
};

/// Options that a command has only with a certain value of --compute.
struct OptionGroup {
    std::string value;
    std::vector<OptionPage> options;
};

/// A command, as shown on its help page.
struct CommandPage {
    std::string name;     ///< "irido lut color"
    std::string summary;  ///< one line, with a full stop
    std::string notes;    ///< paragraphs between empty lines; indented lines are kept as they are
    std::vector<std::string> examples;
    std::vector<OptionPage> arguments, options;
    std::vector<OptionGroup> groups;
    std::vector<CommandPage> commands;  ///< its subcommands
    bool takes_list = false;
};

/// The page of a program or a command, with those of all its subcommands.
CommandPage command_page(const CLI::App& program);

/// A page and all pages below it.
std::vector<const CommandPage*> all_pages(const CommandPage& page);

/// What a completion script says of every command.
struct CommandCases {
    std::vector<std::string> names;  ///< of those below the program, in quotes
    std::string cases;               ///< of all, one after another
};
CommandCases command_cases(const CommandPage& program, std::string (*case_of)(const CommandPage&));

/// All options, including those of every group, each spelling once.
std::vector<OptionPage> all_options(const CommandPage& page);

/// The first line of an option's text, without a trailing part in brackets.
std::string first_line(const OptionPage& option);

}  // namespace irido::cli
