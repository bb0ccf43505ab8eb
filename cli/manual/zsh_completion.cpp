#include "cli/manual/manual.hpp"
#include "cli/message.hpp"

namespace irido::cli {

namespace {

using Value = OptionPage::Value;

/// In single quotes, for use inside a specification of _arguments.
std::string escaped_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\'') {
            out += "'\\''";
            continue;
        }
        if (c == '[' || c == ']' || c == ':' || c == '\\' || c == '"') out += '\\';
        out += c;
    }
    return out;
}

std::string action_of(const OptionPage& option) {
    const std::string words = joined(option.words, " ");
    switch (option.value) {
        case Value::none:
            return "";
        case Value::free:
            return " ";
        case Value::word:
            return "(" + words + ")";
        case Value::word_or_file:
            return "{compadd - " + words + "; _files}";
        case Value::words:
            return "_sequence compadd - " + words;
        case Value::file:
            return "_files";
        case Value::folder:
            return "_files -/";
    }
    return "";
}

std::string zsh_value(const OptionPage& option) {
    if (option.value == Value::none) return "";
    return (option.may_lack_value ? "::" : ":") + escaped_text(option.type) + ":" +
           action_of(option);
}

/// One specification per spelling; those of an option that cannot be repeated exclude each other.
std::string option_specifications(const OptionPage& option) {
    const std::string excluded = option.repeats ? "*" : "(" + joined(option.spellings, " ") + ")";
    std::string out;
    for (const std::string& spelling : option.spellings) {
        const char* const attached = option.value == Value::none  ? ""
                                     : spelling.starts_with("--") ? "="
                                                                  : "+";
        out += " \\\n                '" + excluded + spelling + attached + "[" +
               escaped_text(first_line(option)) + "]" + zsh_value(option) + "'";
    }
    return out;
}

std::string zsh_case(const CommandPage& page) {
    std::string text = "        ('" + page.name + "')\n            _arguments -S";
    for (const OptionPage& option : all_options(page)) text += option_specifications(option);
    for (const OptionPage& argument : page.arguments)
        text += " \\\n                '" + std::string(argument.repeats ? "*" : "") + ":" +
                escaped_text(argument.type) + ":" + action_of(argument) + "'";
    if (!page.commands.empty()) {
        text += " \\\n                ':command:((";
        for (const CommandPage& command : page.commands)
            text += command.name.substr(page.name.size() + 1) + "\\:\"" +
                    escaped_text(command.summary) + "\" ";
        text += "))'";
    }
    return text + " ;;\n";
}

constexpr const char* kZshHead = R"(
_irido() {
    local command=irido
    integer at=2
    while (( at < CURRENT )); do
        case "$command $words[at]" in
            ()";

constexpr const char* kZshCases = R"() command+=" $words[at]" ;;
            (*) break ;;
        esac
        (( at++ ))
    done
    words=("$command" "${(@)words[at,-1]}")
    (( CURRENT -= at - 2 ))
    case $command in
)";

constexpr const char* kZshTail = R"(    esac
}

if [[ $funcstack[1] == _irido ]]; then
    _irido "$@"
else
    compdef _irido irido
fi
)";

}  // namespace

std::string zsh_completion(const CommandPage& program) {
    const auto [names, cases] = command_cases(program, zsh_case);
    return "#compdef irido\n# made by: irido completion zsh\n" + std::string(kZshHead) +
           joined(names, "|") + kZshCases + cases + kZshTail;
}

}  // namespace irido::cli
