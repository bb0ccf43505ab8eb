#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace irido::cli {

/// Words that an option or argument takes, for completions only; they are not checked.
struct OfferedWords {
    enum class Use { one, one_or_file, several };  ///< several: separated by commas

    const CLI::App* command;
    std::string_view option;  ///< without dashes
    std::function<std::vector<std::string>()> make;
    Use use = Use::one;
};

void offer(OfferedWords words);

/// Offers the words that a function returns.
/// command  the command
/// option   the option's name without dashes; must live as long as the program
/// make     returns the words; called only if they are needed
/// use      what a value is: one word, a word or a file, or several words
template <class Make>
void offer(const CLI::App& command, std::string_view option, Make make,
           OfferedWords::Use use = OfferedWords::Use::one) {
    offer({&command, option,
           [make] {
               const auto& all = make();
               return std::vector<std::string>(all.begin(), all.end());
           },
           use});
}

/// Offers the words of a text.
/// command  the command
/// option   the option's name without dashes; must live as long as the program
/// words    separated by blanks; must live as long as the program
/// use      what a value is: one word, a word or a file, or several words
void offer(const CLI::App& command, std::string_view option, const char* words,
           OfferedWords::Use use = OfferedWords::Use::one);

/// The words last offered for an option; nullptr if there are none.
const OfferedWords* words_offered(const CLI::App& command, std::string_view option);

}  // namespace irido::cli
