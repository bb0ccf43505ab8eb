#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace irido::cli {

/// What a manual page and a completion know of an option, or of an argument.
struct OptionPage {
    enum class Value { none, free, word, word_or_file, words, file, folder };

    std::vector<std::string> spellings;  ///< "-w", "--wavelengths"; "STACK" of an argument
    std::string type;                    ///< "LIST"; "" where it takes no value
    std::string text;                    ///< as in the help page
    bool is_required = false;
    bool repeats = false;
    bool may_lack_value = false;
    Value value = Value::none;
    std::vector<std::string> words;  ///< of a value of words
};

/// Options that a command has with one value of its --compute only.
struct OptionGroup {
    std::string value;
    std::vector<OptionPage> options;
};

/// A command, as its help page shows it.
struct CommandPage {
    std::string name;     ///< "irido lut color"
    std::string summary;  ///< one line, with a full stop
    std::string notes;    ///< paragraphs between empty lines; indented lines stay as they are
    std::vector<std::string> examples;
    std::vector<OptionPage> arguments, options;
    std::vector<OptionGroup> groups;
    std::vector<CommandPage> commands;  ///< those that may follow it
    bool takes_list = false;
};

/// The page of a program or of a command of it, with those of all its commands.
CommandPage command_page(const CLI::App& program);

/// The page itself and all below it.
std::vector<const CommandPage*> all_pages(const CommandPage& page);

/// All options, those of every group among them, each spelling once.
std::vector<OptionPage> all_options(const CommandPage& page);

/// The first line of an option's text, without what comes in brackets after it.
std::string first_line(const OptionPage& option);

}  // namespace irido::cli
