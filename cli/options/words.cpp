#include "cli/options/words.hpp"

#include <algorithm>
#include <sstream>

namespace irido::cli {

namespace {

/// The words of all commands; kept here because CLI11's options have no place for them.
std::vector<OfferedWords>& all_words() {
    static std::vector<OfferedWords> all;
    return all;
}

}  // namespace

void offer(OfferedWords words) {
    constexpr std::size_t kExpected = 128;
    if (all_words().empty()) all_words().reserve(kExpected);
    all_words().push_back(std::move(words));
}

void offer(const CLI::App& command, std::string_view option, const char* words,
           OfferedWords::Use use) {
    const auto make = [words] {
        std::istringstream stream(words);
        return std::vector<std::string>(std::istream_iterator<std::string>(stream), {});
    };
    offer({&command, option, make, use});
}

std::string one_of(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    return text;
}

const OfferedWords* words_offered(const CLI::App& command, std::string_view option) {
    const auto& words = all_words();
    const auto last = std::find_if(words.rbegin(), words.rend(), [&](const OfferedWords& w) {
        return w.command == &command && w.option == option;
    });
    return last == words.rend() ? nullptr : &*last;
}

}  // namespace irido::cli
