#include <map>

#include "cli/manual/manual.hpp"
#include "cli/message.hpp"

namespace irido::cli {

namespace {

using Value = OptionPage::Value;

std::vector<std::string> spellings_of(const std::vector<OptionPage>& options) {
    std::vector<std::string> all;
    for (const OptionPage& option : options)
        all.insert(all.end(), option.spellings.begin(), option.spellings.end());
    return all;
}

/// Shell code that sets how a value is completed, and from which words.
std::string assignments(const OptionPage& option) {
    const std::string words = " words='" + joined(option.words, " ") + "'";
    switch (option.value) {
        case Value::none:
            return "";
        case Value::free:
            return "kind=none";
        case Value::word:
            return "kind=word" + words;
        case Value::word_or_file:
            return "kind=word_or_file" + words;
        case Value::words:
            return "kind=words" + words;
        case Value::file:
            return "kind=file";
        case Value::folder:
            return "kind=folder";
    }
    return "";
}

std::string argument_of(const CommandPage& page) {
    if (page.commands.empty())
        return page.arguments.empty() ? "kind=none" : assignments(page.arguments.front());
    std::vector<std::string> names;
    for (const CommandPage& command : page.commands)
        names.push_back(command.name.substr(page.name.size() + 1));
    return "((at == COMP_CWORD)) && kind=word words='" + joined(names, " ") + "'";
}

std::string bash_case(const CommandPage& page) {
    const std::vector<OptionPage> options = all_options(page);
    std::map<std::string, std::vector<std::string>> spellings;  ///< by completion of values
    for (const OptionPage& option : options)
        if (option.value != Value::none)
            for (const std::string& spelling : option.spellings)
                spellings[assignments(option)].push_back(spelling);
    std::string text = "        '" + page.name + "')\n            options='" +
                       joined(spellings_of(options), " ") + "'\n            case $option in\n";
    for (const auto& [assigned, names] : spellings)
        text += "                " + joined(names, " | ") + ") " + assigned + " ;;\n";
    return text + "                *) option= ; " + argument_of(page) +
           " ;;\n            esac ;;\n";
}

constexpr const char* kBashHead = R"(_irido() {
    local command=irido at=1 kind=none cur=${COMP_WORDS[COMP_CWORD]} option= options= words= before=
    while ((at < COMP_CWORD)); do
        case "$command ${COMP_WORDS[at]}" in
            )";

constexpr const char* kBashCases = R"() command+=" ${COMP_WORDS[at]}" ;;
            *) break ;;
        esac
        ((at++))
    done
    # --option=value is three words
    if [[ $cur == = ]]; then
        option=${COMP_WORDS[COMP_CWORD - 1]} cur=
    elif [[ ${COMP_WORDS[COMP_CWORD - 1]} == = ]]; then
        option=${COMP_WORDS[COMP_CWORD - 2]}
    elif ((at < COMP_CWORD)); then
        option=${COMP_WORDS[COMP_CWORD - 1]}
    fi
    case $command in
)";

constexpr const char* kBashTail = R"(    esac
    [[ ! $option && $cur == -* ]] && kind=word words=$options
    COMPREPLY=()
    case $kind in
        word | word_or_file) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur") ;;
        words)
            [[ $cur == *,* ]] && before=${cur%,*},
            compopt -o nospace 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -W "$words" -P "$before" -- "${cur##*,}") ;;
    esac
    case $kind in
        file | word_or_file | folder)
            compopt -o filenames 2>/dev/null
            local files=-f
            [[ $kind == folder ]] && files=-d
            mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen $files -- "$cur") ;;
    esac
}
complete -F _irido irido
)";

}  // namespace

std::string bash_completion(const CommandPage& program) {
    const auto [names, cases] = command_cases(program, bash_case);
    return "# bash completion of irido, made by: irido completion bash\n" + std::string(kBashHead) +
           joined(names, " | ") + kBashCases + cases + kBashTail;
}

}  // namespace irido::cli
