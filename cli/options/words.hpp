#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace irido::cli {

/// Words that an option or an argument takes, for completions; nothing is checked by them.
struct OfferedWords {
    enum class Use { one, one_or_file, several };  ///< several: with commas between them

    const CLI::App* command;
    std::string_view option;  ///< without dashes
    std::function<std::vector<std::string>()> make;
    Use use = Use::one;
};

void offer(OfferedWords words);

/// Offers the words that `make` returns, which is called only where they are needed. `option`, its
/// name without dashes, must live as long as the program.
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

/// Offers the words of a text, with blanks between them, which must live as long as the program.
void offer(const CLI::App& command, std::string_view option, const char* words,
           OfferedWords::Use use = OfferedWords::Use::one);

/// What was offered last for an option, nullptr if nothing was.
const OfferedWords* words_offered(const CLI::App& command, std::string_view option);

}  // namespace irido::cli
