#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/list.hpp"

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

/// The names of values, as name_of() has them.
template <class Values>
std::vector<std::string_view> names_of(const Values& values) {
    std::vector<std::string_view> names;
    names.reserve(std::size(values));
    for (const auto value : values) names.push_back(name_of(value));
    return names;
}

/// The value of that name. Throws UsageError, which names them all.
/// option  for the message: "--dtype"
/// values  an array of those that name_of() knows
/// typed   the name
template <class Values>
auto named(const std::string& option, const Values& values, std::string_view typed) {
    for (const auto value : values)
        if (name_of(value) == typed) return value;
    throw UsageError(option + ": " + not_one_of(names_of(values), typed));
}

/// "f16, f32 or f64"
std::string one_of(const std::vector<std::string>& words);

/// The words last offered for an option; nullptr if there are none.
const OfferedWords* words_offered(const CLI::App& command, std::string_view option);

}  // namespace irido::cli
