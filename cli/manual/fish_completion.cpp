#include "cli/manual/manual.hpp"
#include "cli/message.hpp"

namespace irido::cli {

namespace {

using Value = OptionPage::Value;

std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') out += '\\';
        out += c;
    }
    return out + "'";
}

std::string fish_value(const OptionPage& option) {
    const std::string words = joined(option.words, " ");
    switch (option.value) {
        case Value::none:
            return "";
        case Value::free:
            return " -x";
        case Value::word:
            return " -x -a " + quoted(words);
        case Value::word_or_file:
            return " -r -F -a " + quoted(words);
        case Value::words:
            return " -x -a " + quoted("(__fish_append , " + words + ")");
        case Value::file:
            return " -r -F";
        case Value::folder:
            return " -x -a '(__fish_complete_directories)'";
    }
    return "";
}

std::string fish_lines(const CommandPage& page) {
    const std::string start = "complete -c irido -n " + quoted("__irido_at " + page.name);
    std::string text;
    for (const CommandPage& command : page.commands)
        text += start + " -a " + command.name.substr(page.name.size() + 1) + " -d " +
                quoted(command.summary) + "\n";
    for (const OptionPage& argument : page.arguments)
        if (argument.value == Value::file)
            text += start + " -F\n";
        else if (!argument.words.empty())
            text += start + (argument.value == Value::word_or_file ? " -F" : "") + " -a " +
                    quoted(joined(argument.words, " ")) + "\n";
    for (const OptionPage& option : all_options(page)) {
        text += start;
        for (const std::string& spelling : option.spellings)
            text += spelling.starts_with("--") ? " -l " + spelling.substr(2)
                                               : " -s " + spelling.substr(1);
        text += fish_value(option) + " -d " + quoted(first_line(option)) + "\n";
    }
    return text;
}

constexpr const char* kFishHead = R"(
function __irido_at
    set -l command irido
    for word in (commandline -opc)[2..-1]
        switch "$command $word"
            case )";

constexpr const char* kFishCases = R"(
                set command "$command $word"
            case '*'
                break
        end
    end
    test "$command" = "$argv"
end

complete -c irido -f
)";

}  // namespace

std::string fish_completion(const CommandPage& program) {
    const auto [names, cases] = command_cases(program, fish_lines);
    return "# fish completion of irido, made by: irido completion fish\n" + std::string(kFishHead) +
           joined(names, " ") + kFishCases + cases;
}

}  // namespace irido::cli
